#include "antilock/core/eigenvalues.hpp"

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/MatOp/SparseSymShiftSolve.h>
#include <Spectra/SymEigsShiftSolver.h>
#include <Spectra/SymEigsSolver.h>

#include <algorithm>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr int most_restarts = 1000;
constexpr double tolerance = 1e-6;

template <class Solver>
double only_eigenvalue(Solver& solver, Spectra::SortRule wanted, const char* which) {
  solver.init();
  solver.compute(wanted, most_restarts, tolerance);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw NotConverged(std::string(which) + " eigenvalue: the Lanczos iteration has not settled to 1e-6", 1,
                       static_cast<int>(solver.num_iterations()));
  return solver.eigenvalues()(0);
}

/// Vectors kept between restarts: enough for the clustered ends of a stiff spectrum.
int basis_size(const SparseMatrix& matrix) { return static_cast<int>(std::min<Eigen::Index>(30, matrix.rows())); }

}  // namespace

double largest_eigenvalue(const SparseMatrix& upper) {
  Spectra::SparseSymMatProd<double, Eigen::Upper> product(upper);
  Spectra::SymEigsSolver solver(product, 1, basis_size(upper));
  return only_eigenvalue(solver, Spectra::SortRule::LargestAlge, "largest");
}

double smallest_eigenvalue(const SparseMatrix& upper) {
  Spectra::SparseSymShiftSolve<double, Eigen::Upper> inverse(upper);
  Spectra::SymEigsShiftSolver solver(inverse, 1, basis_size(upper), 0.0);
  return only_eigenvalue(solver, Spectra::SortRule::LargestMagn, "smallest");
}

}  // namespace antilock
