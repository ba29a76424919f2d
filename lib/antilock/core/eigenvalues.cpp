#include "antilock/core/eigenvalues.hpp"

#include <fmt/format.h>

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/MatOp/SparseSymShiftSolve.h>
#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <functional>

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

/// 30 vectors between restarts are enough for the clustered ends of a stiff spectrum.
Eigenpair only_eigenpair(Operator matrix, Spectra::SortRule wanted, const char* which, double tolerance = 1e-6,
                         Eigen::Index basis = 30) {
  Spectra::SymEigsSolver<Operator> solver(matrix, 1, std::min(basis, matrix.size));
  solver.init();
  solver.compute(wanted, most_restarts, tolerance);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw NotConverged(fmt::format("{} eigenvalue: the Lanczos iteration has not settled to {:.0e}", which, tolerance),
                       1, static_cast<int>(solver.num_iterations()));
  return {solver.eigenvalues()(0), solver.eigenvectors(1).col(0)};
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
  if (size == 1) return {apply(Eigen::VectorXd::Ones(1))(0), Eigen::VectorXd::Ones(1)};
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
  inverse.set_shift(0);
  return 1 / only_eigenvalue({upper.rows(), [&](const double* x, double* y) { inverse.perform_op(x, y); }},
                             Spectra::SortRule::LargestMagn, "smallest");
}

}  // namespace antilock
