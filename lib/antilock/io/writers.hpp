#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/space.hpp"
#include "antilock/space/vector_space.hpp"

namespace antilock {

/// MSH 2.2 ASCII with the physical groups of Figure 2.
void write_msh(const std::filesystem::path& path, const TriangleMesh& mesh);
/// FreeFEM's native .msh: nv nt nbe; x y label; i j k region; i j label. The same numbering, labels as in
/// EdgeTag/Region.
void write_freefem_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);
/// A table: one header line, then rows, comma separated. Here and below a number is the shortest text that reads back
/// as the same double (up to 17 digits). Every writer throws Error, `path` first, and leaves no partial file.
void write_csv(const std::filesystem::path& path, const std::vector<std::string>& header, const Eigen::MatrixXd& rows);
/// `x,y,u`: one row an unknown.
void write_solution_csv(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u);
/// VTU (ASCII XML) for ParaView and the figures: point data `u`, cell data `region` (1 body, 2 layer). A vertex a
/// triangle corner, so that Crouzeix-Raviart fields keep their jumps; P1 fields share their vertices.
void write_vtu(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u);
/// VTU of a body deformed by u (not magnified): the points where it moved them, three a triangle, point data
/// `displacement`, cell data `pressure` (one value a triangle).
void write_deformed_vtu(const std::filesystem::path& path, const VectorSpace& space, const Eigen::VectorXd& u,
                        const Eigen::VectorXd& pressure);

}  // namespace antilock
