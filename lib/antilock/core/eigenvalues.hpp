#pragma once
#include "antilock/core/matrix.hpp"

namespace antilock {

/// The largest eigenvalue of a symmetric positive definite matrix, of which the upper triangle is stored, by Lanczos
/// iteration (Spectra) to a relative 1e-6. Throws NotConverged where it does not settle.
double largest_eigenvalue(const SparseMatrix& upper);

/// The smallest one, by inverse iteration on a sparse LU factor: trustworthy only where the matrix itself can be
/// factored, that is for condition numbers well below 1e16. Throws NotConverged.
double smallest_eigenvalue(const SparseMatrix& upper);

}  // namespace antilock
