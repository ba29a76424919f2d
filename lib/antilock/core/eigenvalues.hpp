#pragma once
#include <functional>

#include "antilock/core/matrix.hpp"

namespace antilock {

/// Returns the largest eigenvalue of a symmetric positive definite matrix, whose upper triangle is
/// stored, by Lanczos iteration (Spectra) to a relative 1e-6. Throws NotConverged where the
/// iteration does not converge.
double largest_eigenvalue(const SparseMatrix& upper);

/// An operator, which is given by its products with vectors.
using Apply = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;
/// An eigenvalue and its eigenvector, of norm 1.
struct Eigenpair {
  double value;
  Eigen::VectorXd vector;
};

/// Returns the largest eigenvalue, with its eigenvector, of a symmetric positive definite operator
/// on R^size. Lanczos iteration approximates it from below to a relative `tolerance`. `basis` is
/// the number of vectors between restarts. 30 vectors are enough for the clustered ends of a stiff
/// spectrum. Each step of the iteration takes one product, and there are at least min(size,
/// `basis`) steps. Throws Error for size = 0, and NotConverged where the iteration does not
/// converge.
Eigenpair largest_eigenpair(const Apply& apply, Eigen::Index size, double tolerance = 1e-6,
                            int basis = 30);
inline double largest_eigenvalue(const Apply& apply, Eigen::Index size, double tolerance = 1e-6,
                                 int basis = 30) {
  return largest_eigenpair(apply, size, tolerance, basis).value;
}

}  // namespace antilock
