#include "antilock/solve/detail/dependent_rows.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "antilock/core/dense.hpp"
#include "antilock/solve/detail/tuned.hpp"

namespace antilock {

std::optional<double> nearly_dependent_rows(const VariationalInequality& problem) {
  std::vector<int> rows;  // of compliance 0: the others decide nothing
  for (int row = problem.compliance == 0 ? 0 : static_cast<int>(problem.b.rows()) - problem.ties;
       row < problem.b.rows(); ++row)
    rows.push_back(row);
  if (rows.size() < 2 || std::min<Eigen::Index>(std::ssize(rows), problem.free_count()) > tuned::few_rows ||
      std::max<Eigen::Index>(std::ssize(rows), problem.size()) > 10 * tuned::few_rows)
    return std::nullopt;
  Eigen::MatrixXd b = Eigen::MatrixXd(problem.b)(rows, Eigen::all);
  const Eigen::VectorXd m = problem.m(rows);
  for (const int i : problem.fixed) b.col(i).setZero();
  const Eigen::VectorXd a1 = problem.a1.diagonal().cwiseAbs();
  for (Eigen::Index j = 0; j < b.cols(); ++j) {
    const double stiffness = a1(j) + b.col(j).cwiseAbs2().dot(m);
    if (stiffness > 0) b.col(j) /= std::sqrt(stiffness);
  }
  for (Eigen::Index r = 0; r < b.rows(); ++r)
    if (b.row(r).squaredNorm() > 0) b.row(r).normalize();
  const Eigen::VectorXd pivots = qr_pivots(b.transpose());
  for (const double pivot : pivots)
    if (pivot > tuned::equal && pivot < tuned::apart) return pivot;
  return std::nullopt;
}

}  // namespace antilock
