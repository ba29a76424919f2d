#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/space/space.hpp"

namespace antilock {

/// Writes a table: one header line, then the rows, separated by commas. A number is the shortest
/// text that reads back as the same double (up to 17 digits). Both functions throw Error, whose
/// message begins with `path`, and leave no partial file.
void write_csv(const std::filesystem::path& path, const std::vector<std::string>& header,
               const Eigen::MatrixXd& rows);
/// Writes one row per unknown of the space: `x,y,u`, or `x,y,u_x,u_y` for the 2 N values of a
/// displacement on the N unknowns of a space. For an element whose unknowns are means the columns
/// are `x,y,u,mean`: u is the value of the function at (x, y), and `mean` the unknown.
void write_solution_csv(const std::filesystem::path& path, const Space& space,
                        const Eigen::VectorXd& u);

}  // namespace antilock
