#pragma once
#include <string>

#include "antilock/core/matrix.hpp"

namespace antilock::subcommands {

/// Reads a matrix from a Matrix Market file: `coordinate` or `array`, `real` or `integer`,
/// `general` or `symmetric`. Entries with the same indices are added. Throws Error, `PATH: line N:
/// what is wrong; accepted: ...`, for anything else, a wrong number of entries, an index outside
/// the matrix, or a number that is not finite.
SparseMatrix read_matrix(const std::string& path);
/// Does the same for a vector: one column, one row, or the diagonal of a square matrix.
Eigen::VectorXd read_vector(const std::string& path);

}  // namespace antilock::subcommands
