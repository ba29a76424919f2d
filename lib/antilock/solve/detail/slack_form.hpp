#pragma once
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/defaults.hpp"

namespace antilock {

/// A problem in slack form, whose bounds are all on unknowns. A constraint lower <= c . u <= upper
/// gets a slack variable w, an unknown after the N others, and an equality row of B with the fixed
/// compliance 0 (J. Nocedal and S. J. Wright, Numerical Optimization, ch. 15):
///
///     B gains the row (c, -1),   lower <= w <= upper,   A1 and the load are 0 at w
///
/// Each row is scaled by a power of two so that its largest entry is at least 1 and below 2: the
/// units of a row do not matter. For such a row K = A1 + delta^-1 B' M B gains delta^-1 M (c, -1)'
/// (c, -1). This stiffness is defaults::slack_stiffness_ratio times 1 / sum_j (c_j^2 / K_jj), a
/// lower estimate of the stiffness of c . u in K. Throws Error where K is 0 at a free unknown.
///
/// Without constraints it refers to the problem itself, which must then outlive it.
class SlackForm {
 public:
  SlackForm(const VariationalInequality& problem, double delta) : problem_(problem) {
    if (problem.bounds.constraints.rows() > 0)
      introduce_slacks(slack_problem_.emplace(problem), delta);
  }
  const VariationalInequality& operator*() const {
    return slack_problem_ ? *slack_problem_ : problem_;
  }
  const VariationalInequality* operator->() const { return &**this; }
  /// Returns C forces in the units of the constraints of the problem itself.
  Eigen::VectorXd forces(Eigen::VectorXd lambda) const { return scaled(std::move(lambda), scale_); }

 private:
  void introduce_slacks(VariationalInequality& problem, double delta) {
    const Eigen::Index n = problem.size(), rows = problem.b.rows(),
                       slacks = problem.bounds.constraints.rows();
    Eigen::VectorXd stiffness = problem.a1.diagonal();
    stiffness += problem.b.cwiseAbs2().transpose() * problem.m / delta;
    for (const int i : problem.dirichlet_dofs)
      stiffness(i) = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < n;
         ++j)  // the equality row would hide it from the factor but for round-off
      if (!(stiffness(j) > 0))
        throw Error(
            fmt::format("solve: unknown {} is held by nothing: A1 and B' M B are 0 there; "
                        "accepted: a matrix A1 + "
                        "B' M B that is positive definite on the free unknowns",
                        j));
    problem.fixed_compliances.conservativeResizeLike(
        Eigen::VectorXd::Zero(problem.fixed_compliances.size() + slacks));
    problem.bounds.constraints.resize(0, 0);
    problem.a1.conservativeResize(n + slacks, n + slacks);
    problem.a1.makeCompressed();
    problem.load.conservativeResizeLike(Eigen::VectorXd::Zero(n + slacks));
    problem.b.conservativeResize(rows + slacks, n + slacks);
    problem.m.conservativeResize(rows + slacks);
    scale_.resize(slacks);
    for (Eigen::Index k = 0; k < slacks; ++k) {
      double largest = 0, flexibility = 0;
      for (RowMatrix::InnerIterator c(problem_.bounds.constraints, k); c; ++c)
        largest = std::max(largest, std::abs(c.value()));
      scale_(k) = std::ldexp(1, -std::ilogb(largest));
      for (RowMatrix::InnerIterator c(problem_.bounds.constraints, k); c; ++c) {
        const double value = problem.b.insert(rows + k, c.col()) = scale_(k) * c.value();
        flexibility += value * value / stiffness(c.col());
      }
      problem.b.insert(rows + k, n + k) = -1;
      problem.m(rows + k) = delta * defaults::slack_stiffness_ratio / flexibility;
      problem.bounds.unknowns.push_back(static_cast<int>(n + k));
    }
    problem.b.makeCompressed();
    problem.bounds.lower = scaled(std::move(problem.bounds.lower), scale_);
    problem.bounds.upper = scaled(std::move(problem.bounds.upper), scale_);
    problem.bounds.force_limit =
        scaled(std::move(problem.bounds.force_limit), scale_.cwiseInverse());
  }

  static Eigen::VectorXd scaled(Eigen::VectorXd bound, const Eigen::VectorXd& scale) {
    bound.tail(scale.size()).array() *= scale.array();
    return bound;
  }

  const VariationalInequality& problem_;
  std::optional<VariationalInequality> slack_problem_;
  Eigen::VectorXd scale_;  ///< by row of constraints
};

}  // namespace antilock
