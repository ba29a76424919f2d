#include "antilock/core/eigenvalues.hpp"

#include <fmt/format.h>

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/MatOp/SparseSymShiftSolve.h>
#include <Spectra/SymEigsShiftSolver.h>
#include <Spectra/SymEigsSolver.h>

#include <algorithm>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr int most_restarts = 1000;

template <class Solver>
double only_eigenvalue(Solver& solver, Spectra::SortRule wanted, const char* which, double tolerance = 1e-6) {
  solver.init();
  solver.compute(wanted, most_restarts, tolerance);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw NotConverged(fmt::format("{} eigenvalue: the Lanczos iteration has not settled to {:.0e}", which, tolerance),
                       1, static_cast<int>(solver.num_iterations()));
  return solver.eigenvalues()(0);
}

/// A function as Spectra's matrix.
struct Product {
  using Scalar = double;
  const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply;
  Eigen::Index size;
  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, size) = apply(Eigen::Map<const Eigen::VectorXd>(x, size));
  }
};

/// Vectors kept between restarts: enough for the clustered ends of a stiff spectrum.
int basis_size(const SparseMatrix& matrix) { return static_cast<int>(std::min<Eigen::Index>(30, matrix.rows())); }

}  // namespace

double largest_eigenvalue(const SparseMatrix& upper) {
  Spectra::SparseSymMatProd<double, Eigen::Upper> product(upper);
  Spectra::SymEigsSolver solver(product, 1, basis_size(upper));
  return only_eigenvalue(solver, Spectra::SortRule::LargestAlge, "largest");
}

double largest_eigenvalue(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply, Eigen::Index size,
                          double tolerance, int basis) {
  if (size == 1) return apply(Eigen::VectorXd::Ones(1))(0);
  Product product{apply, size};
  Spectra::SymEigsSolver solver(product, 1, std::min<Eigen::Index>(basis, size));
  return only_eigenvalue(solver, Spectra::SortRule::LargestAlge, "largest", tolerance);
}

double smallest_eigenvalue(const SparseMatrix& upper) {
  Spectra::SparseSymShiftSolve<double, Eigen::Upper> inverse(upper);
  Spectra::SymEigsShiftSolver solver(inverse, 1, basis_size(upper), 0.0);
  return only_eigenvalue(solver, Spectra::SortRule::LargestMagn, "smallest");
}

}  // namespace antilock
