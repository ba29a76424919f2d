#include "antilock/core/eigenvalues.hpp"

#include <fmt/format.h>

#include <Spectra/SymEigsSolver.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr int most_restarts = 1000;

/// What Spectra asks for products: those of the operator / unit.
struct Operator {
  using Scalar = double;
  Eigen::Index size;
  const Apply& apply;
  double unit;
  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, size) = apply(Eigen::Map<const Eigen::VectorXd>(x, size)) / unit;
  }
};

/// The size of the matrix as one vector sees it: 0 for none but the zero matrix, in practice. Of a
/// single unknown the eigenvalue itself.
double size_of(const Apply& apply, Eigen::Index size) {
  Eigen::VectorXd wave = Eigen::VectorXd::Ones(size);
  for (Eigen::Index i = 1; i < size; ++i) wave(i) = std::sin(1.0 + 2.0 * static_cast<double>(i));
  const Eigen::VectorXd image = apply(wave);
  if (!image.allFinite()) throw NotConverged("eigenvalue: the matrix is not finite", 1, 0);
  return size == 1 ? image(0) : image.lpNorm<Eigen::Infinity>();
}

}  // namespace

double largest_eigenvalue(const SparseMatrix& upper) {
  const auto product = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return upper.selfadjointView<Eigen::Upper>() * x;
  };
  return largest_eigenvalue(product, upper.rows());
}

Eigenpair largest_eigenpair(const Apply& apply, Eigen::Index size, double tolerance, int basis) {
  if (size < 1) throw Error("largest eigenvalue: of no unknowns; accepted: one or more");
  // Spectra takes what is far below 1 for 0, and ends without an answer where there is nothing else
  const double unit = size_of(apply, size);
  if (unit == 0 || size == 1) return {unit, Eigen::VectorXd::Unit(size, 0)};
  Operator scaled{size, apply, unit};
  Spectra::SymEigsSolver<Operator> solver(scaled, 1, std::clamp<Eigen::Index>(basis, 2, size));
  try {
    solver.init();
    solver.compute(Spectra::SortRule::LargestAlge, most_restarts, tolerance);
  } catch (const std::runtime_error& failure) {
    throw NotConverged(
        fmt::format("largest eigenvalue: the Lanczos iteration broke down ({})", failure.what()), 1,
        0);
  }
  if (solver.info() != Spectra::CompInfo::Successful)
    throw NotConverged(
        fmt::format("largest eigenvalue: the Lanczos iteration has not settled to {:.0e}",
                    tolerance),
        1, static_cast<int>(solver.num_iterations()));
  return {unit * solver.eigenvalues()(0), solver.eigenvectors(1).col(0)};
}

}  // namespace antilock
