#pragma once
#include <memory>

#include "antilock/solve/sparse_cholesky.hpp"

namespace antilock {

/// Returns Eigen's simplicial factor, which needs neither CHOLMOD nor a BLAS. AMD orders all rows
/// except those that must stay last. A browser uses it as the default (host/stubs.cpp of
/// tutorials/book/wasm); elsewhere tests compare the default with it.
std::unique_ptr<SparseCholesky> eigen_cholesky();

}  // namespace antilock
