#include "antilock/core/eigenvalues.hpp"

#include <fmt/format.h>

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/MatOp/SparseSymShiftSolve.h>
#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr int most_restarts = 1000;

/// x -> y of a symmetric matrix, for Spectra: one type for all, so that its solver is compiled once.
struct Operator {
  using Scalar = double;
  Eigen::Index size;
  std::function<void(const double* x, double* y)> apply;
  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  void perform_op(const double* x, double* y) const { apply(x, y); }
};

/// The size of the matrix as one vector sees it: 0 for none but the zero matrix, in practice. Of a single unknown the
/// eigenvalue itself.
double size_of(const Operator& matrix) {
  Eigen::VectorXd wave = Eigen::VectorXd::Ones(matrix.size), image(matrix.size);
  for (Eigen::Index i = 1; i < matrix.size; ++i) wave(i) = std::sin(1.0 + 2.0 * static_cast<double>(i));
  matrix.apply(wave.data(), image.data());
  if (!image.allFinite()) throw NotConverged("eigenvalue: the matrix is not finite", 1, 0);
  return matrix.size == 1 ? image(0) : image.lpNorm<Eigen::Infinity>();
}

/// 30 vectors between restarts are enough for the clustered ends of a stiff spectrum.
Eigenpair only_eigenpair(Operator matrix, Spectra::SortRule wanted, const char* which, double tolerance = 1e-6,
                         Eigen::Index basis = 30) {
  if (matrix.size < 1) throw Error(std::string(which) + " eigenvalue: of no unknowns; accepted: one or more");
  // Spectra takes what is far below 1 for 0, and ends without an answer where there is nothing else
  const double unit = size_of(matrix);
  if (unit == 0 || matrix.size == 1) return {unit, Eigen::VectorXd::Unit(matrix.size, 0)};
  Operator scaled{matrix.size, [&matrix, unit](const double* x, double* y) {
                    matrix.apply(x, y);
                    Eigen::Map<Eigen::VectorXd>(y, matrix.size) /= unit;
                  }};
  Spectra::SymEigsSolver<Operator> solver(scaled, 1, std::min(basis, matrix.size));
  try {
    solver.init();
    solver.compute(wanted, most_restarts, tolerance);
  } catch (const std::runtime_error& failure) {
    throw NotConverged(fmt::format("{} eigenvalue: the Lanczos iteration broke down ({})", which, failure.what()), 1,
                       0);
  }
  if (solver.info() != Spectra::CompInfo::Successful)
    throw NotConverged(fmt::format("{} eigenvalue: the Lanczos iteration has not settled to {:.0e}", which, tolerance),
                       1, static_cast<int>(solver.num_iterations()));
  return {unit * solver.eigenvalues()(0), solver.eigenvectors(1).col(0)};
}
double only_eigenvalue(Operator matrix, Spectra::SortRule wanted, const char* which) {
  return only_eigenpair(std::move(matrix), wanted, which).value;
}

}  // namespace

double largest_eigenvalue(const SparseMatrix& upper) {
  const Spectra::SparseSymMatProd<double, Eigen::Upper> product(upper);
  return only_eigenvalue({upper.rows(), [&](const double* x, double* y) { product.perform_op(x, y); }},
                         Spectra::SortRule::LargestAlge, "largest");
}

Eigenpair largest_eigenpair(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply, Eigen::Index size,
                            double tolerance, int basis) {
  return only_eigenpair({size,
                         [&](const double* x, double* y) {
                           Eigen::Map<Eigen::VectorXd>(y, size) = apply(Eigen::Map<const Eigen::VectorXd>(x, size));
                         }},
                        Spectra::SortRule::LargestAlge, "largest", tolerance, basis);
}

double largest_eigenvalue(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply, Eigen::Index size,
                          double tolerance, int basis) {
  return largest_eigenpair(apply, size, tolerance, basis).value;
}

double smallest_eigenvalue(const SparseMatrix& upper) {
  Spectra::SparseSymShiftSolve<double, Eigen::Upper> inverse(upper);
  try {
    inverse.set_shift(0);
  } catch (const std::exception&) {
    throw NotConverged("smallest eigenvalue: the matrix is singular to working precision", 0, 0);
  }
  return 1 / only_eigenvalue({upper.rows(), [&](const double* x, double* y) { inverse.perform_op(x, y); }},
                             Spectra::SortRule::LargestMagn, "smallest");
}

}  // namespace antilock
