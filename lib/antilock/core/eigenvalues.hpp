#pragma once
#include <functional>

#include "antilock/core/matrix.hpp"

namespace antilock {

/// The largest eigenvalue of a symmetric positive definite matrix, of which the upper triangle is stored, by Lanczos
/// iteration (Spectra) to a relative 1e-6. Throws NotConverged where it does not settle.
double largest_eigenvalue(const SparseMatrix& upper);

/// An operator by its products with vectors.
using Apply = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;
/// An eigenvalue and its eigenvector, of norm 1.
struct Eigenpair {
  double value;
  Eigen::VectorXd vector;
};

/// The same of an operator on R^size, to a relative `tolerance`; from below. 30 vectors between restarts
/// are enough for the clustered ends of a stiff spectrum. One product per step of the iteration, at
/// least min(size, `basis`) of them. Throws Error for no unknowns, NotConverged.
Eigenpair largest_eigenpair(const Apply& apply, Eigen::Index size, double tolerance = 1e-6, int basis = 30);
inline double largest_eigenvalue(const Apply& apply, Eigen::Index size, double tolerance = 1e-6, int basis = 30) {
  return largest_eigenpair(apply, size, tolerance, basis).value;
}

}  // namespace antilock
