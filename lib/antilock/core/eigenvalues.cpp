#include "antilock/core/eigenvalues.hpp"

#include <fmt/format.h>

#include <Spectra/SymEigsSolver.h>

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <functional>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr int most_restarts = 1000;

using Apply = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// x -> y of a symmetric matrix, for Spectra: one type for all, so that its solver is compiled once.
struct Operator {
  using Scalar = double;
  Eigen::Index size;
  const Apply& apply;
  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, size) = apply(Eigen::Map<const Eigen::VectorXd>(x, size));
  }
};

/// 30 vectors between restarts are enough for the clustered ends of a stiff spectrum.
Eigenpair only_eigenpair(const Apply& apply, Eigen::Index size, const char* which, double tolerance = 1e-6,
                         int basis = 30) {
  if (size == 1) return {apply(Eigen::VectorXd::Ones(1))(0), Eigen::VectorXd::Ones(1)};
  Operator matrix{size, apply};
  Spectra::SymEigsSolver<Operator> solver(matrix, 1, std::min<Eigen::Index>(basis, size));
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, most_restarts, tolerance);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw NotConverged(fmt::format("{} eigenvalue: the Lanczos iteration has not settled to {:.0e}", which, tolerance),
                       1, static_cast<int>(solver.num_iterations()));
  return {solver.eigenvalues()(0), solver.eigenvectors(1).col(0)};
}

}  // namespace

double largest_eigenvalue(const SparseMatrix& upper) {
  const auto product = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return upper.selfadjointView<Eigen::Upper>() * x;
  };
  return only_eigenpair(product, upper.rows(), "largest").value;
}

Eigenpair largest_eigenpair(const Apply& apply, Eigen::Index size, double tolerance, int basis) {
  return only_eigenpair(apply, size, "largest", tolerance, basis);
}

double largest_eigenvalue(const Apply& apply, Eigen::Index size, double tolerance, int basis) {
  return largest_eigenpair(apply, size, tolerance, basis).value;
}

double smallest_eigenvalue(const SparseMatrix& upper) {
  const Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Upper> factor(upper);
  if (factor.info() != Eigen::Success)
    throw Error("smallest eigenvalue: the matrix has no Cholesky factor; accepted: symmetric positive definite");
  const auto inverse = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return factor.solve(x); };
  return 1 / only_eigenpair(inverse, upper.rows(), "smallest").value;
}

}  // namespace antilock
