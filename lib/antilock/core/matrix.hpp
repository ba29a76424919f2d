#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

using SparseMatrix = Eigen::SparseMatrix<double>;                ///< by columns
using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;  ///< by rows

}  // namespace antilock
