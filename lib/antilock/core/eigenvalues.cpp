#include "antilock/core/eigenvalues.hpp"

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/MatOp/SparseSymShiftSolve.h>
#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <functional>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr int most_restarts = 1000;
constexpr double tolerance = 1e-6;

/// x -> y of a symmetric matrix, for Spectra: one type for all, so that its solver is compiled once.
struct Operator {
  using Scalar = double;
  Eigen::Index size;
  std::function<void(const double* x, double* y)> apply;
  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  void perform_op(const double* x, double* y) const { apply(x, y); }
};

double only_eigenvalue(Operator matrix, Spectra::SortRule wanted, const char* which) {
  constexpr Eigen::Index kept = 30;  // vectors between restarts: enough for the clustered ends of a stiff spectrum
  Spectra::SymEigsSolver<Operator> solver(matrix, 1, std::min(kept, matrix.size));
  solver.init();
  solver.compute(wanted, most_restarts, tolerance);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw NotConverged(std::string(which) + " eigenvalue: the Lanczos iteration has not settled to 1e-6", 1,
                       static_cast<int>(solver.num_iterations()));
  return solver.eigenvalues()(0);
}

}  // namespace

double largest_eigenvalue(const SparseMatrix& upper) {
  const Spectra::SparseSymMatProd<double, Eigen::Upper> product(upper);
  return only_eigenvalue({upper.rows(), [&](const double* x, double* y) { product.perform_op(x, y); }},
                         Spectra::SortRule::LargestAlge, "largest");
}

double smallest_eigenvalue(const SparseMatrix& upper) {
  Spectra::SparseSymShiftSolve<double, Eigen::Upper> inverse(upper);
  inverse.set_shift(0);
  return 1 / only_eigenvalue({upper.rows(), [&](const double* x, double* y) { inverse.perform_op(x, y); }},
                             Spectra::SortRule::LargestMagn, "smallest");
}

}  // namespace antilock
