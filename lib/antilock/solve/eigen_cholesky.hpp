#pragma once
#include <memory>

#include "antilock/solve/sparse_cholesky.hpp"

namespace antilock {

/// Eigen's simplicial factor: headers alone, without CHOLMOD and a BLAS. In a browser it is the default
/// (host/stubs.cpp of tutorials/book/wasm); elsewhere the tests hold the default to it. AMD orders the rows that are
/// not to stay last.
std::unique_ptr<SparseCholesky> eigen_cholesky();

}  // namespace antilock
