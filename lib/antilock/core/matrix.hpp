#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

using SparseMatrix = Eigen::SparseMatrix<double>;                ///< by columns
using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;  ///< by rows

}  // namespace antilock
