#pragma once
#include <Eigen/Core>
#include <istream>
#include <string>
#include <vector>

#include "antilock/core/detail/eigen_memory.hpp"

namespace antilock::doors {

/// A table of finite numbers with this header line, comma separated, one row per line; empty lines are passed over. Throws
/// Error, `NAME: line N: what is wrong; accepted: ...`, for another header, another number of entries, or an entry that is
/// no finite number. rows x header.size().
Eigen::MatrixXd read_csv(std::istream& in, const std::string& name, const std::vector<std::string>& header);
/// The same from a file; throws Error where it cannot be opened.
Eigen::MatrixXd read_csv(const std::string& path, const std::vector<std::string>& header);

}  // namespace antilock::doors
