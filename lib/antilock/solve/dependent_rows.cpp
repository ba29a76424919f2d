#include "antilock/solve/dependent_rows.hpp"

#include <algorithm>
#include <cmath>

#include "antilock/core/dense.hpp"

namespace antilock {

std::optional<double> nearly_dependent_rows(const VariationalInequality& problem) {
  constexpr Eigen::Index most = 200;
  if (problem.b.rows() < 2 || std::min<Eigen::Index>(problem.b.rows(), problem.free_count()) > most ||
      std::max<Eigen::Index>(problem.b.rows(), problem.size()) > 10 * most)
    return std::nullopt;
  Eigen::MatrixXd b = problem.b;
  for (const int i : problem.fixed) b.col(i).setZero();
  const Eigen::VectorXd a1 = problem.a1.diagonal().cwiseAbs();
  for (Eigen::Index j = 0; j < b.cols(); ++j) {
    const double stiffness = a1(j) + b.col(j).cwiseAbs2().dot(problem.m);
    if (stiffness > 0) b.col(j) /= std::sqrt(stiffness);
  }
  for (Eigen::Index r = 0; r < b.rows(); ++r)
    if (b.row(r).squaredNorm() > 0) b.row(r).normalize();
  const Eigen::VectorXd pivots = qr_pivots(b.transpose());
  for (const double pivot : pivots)
    if (pivot > 2e-15 && pivot < 3e-9) return pivot;
  return std::nullopt;
}

}  // namespace antilock
