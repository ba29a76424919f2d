#pragma once
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/tuned.hpp"

namespace antilock {

/// A problem whose bounds are all on unknowns. A bounded combination c . u becomes an unknown w of its own, after the N
/// others, and a row of B with compliance 0 ties the two:
///
///     B gains the row (c, -1),   lower <= w <= upper,   A1 and the load are 0 at w
///
/// Rows are scaled by a power of two, their largest entry to 1 or more and below 2: the units of a row do not matter.
/// Of such a row K gains delta^-1 M (c, -1)' (c, -1): tuned::tie times the stiffness 1 / sum (c_j^2 / K_jj) that c . u
/// has at least, K = A1 + delta^-1 B' M B. Throws Error where K is 0 at a free unknown.
///
/// Without combinations it is the problem itself, which must then outlive this.
class Tied {
 public:
  Tied(const VariationalInequality& problem, double delta) : problem_(problem) {
    if (problem.combinations.rows() > 0) tie(made_.emplace(problem), delta);
  }
  const VariationalInequality& operator*() const { return made_ ? *made_ : problem_; }
  const VariationalInequality* operator->() const { return &**this; }
  /// C forces in the units of the problem's own rows.
  Eigen::VectorXd forces(Eigen::VectorXd lambda) const { return scaled(std::move(lambda), scale_); }

 private:
  void tie(VariationalInequality& tied, double delta) {
    const Eigen::Index n = tied.size(), rows = tied.b.rows(), ties = tied.combinations.rows();
    Eigen::VectorXd stiffness = tied.a1.diagonal();
    stiffness += tied.b.cwiseAbs2().transpose() * tied.m / delta;
    for (const int i : tied.fixed) stiffness(i) = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < n; ++j)  // the tie would hide it from the factor but for round-off
      if (!(stiffness(j) > 0))
        throw Error(
            fmt::format("solve: unknown {} is held by nothing: A1 and B' M B are 0 there; accepted: a matrix A1 + "
                        "B' M B that is positive definite on the free unknowns",
                        j));
    tied.own_compliances.conservativeResizeLike(Eigen::VectorXd::Zero(tied.own_compliances.size() + ties));
    tied.combinations.resize(0, 0);
    tied.a1.conservativeResize(n + ties, n + ties);
    tied.a1.makeCompressed();
    tied.load.conservativeResizeLike(Eigen::VectorXd::Zero(n + ties));
    tied.b.conservativeResize(rows + ties, n + ties);
    tied.m.conservativeResize(rows + ties);
    scale_.resize(ties);
    for (Eigen::Index k = 0; k < ties; ++k) {
      double largest = 0, yields = 0;
      for (RowMatrix::InnerIterator c(problem_.combinations, k); c; ++c)
        largest = std::max(largest, std::abs(c.value()));
      scale_(k) = std::ldexp(1, -std::ilogb(largest));
      for (RowMatrix::InnerIterator c(problem_.combinations, k); c; ++c) {
        const double value = tied.b.insert(rows + k, c.col()) = scale_(k) * c.value();
        yields += value * value / stiffness(c.col());
      }
      tied.b.insert(rows + k, n + k) = -1;
      tied.m(rows + k) = delta * tuned::tie / yields;
      tied.contact.push_back(static_cast<int>(n + k));
    }
    tied.b.makeCompressed();
    tied.lower = scaled(std::move(tied.lower), scale_);
    tied.upper = scaled(std::move(tied.upper), scale_);
    tied.force_bound = scaled(std::move(tied.force_bound), scale_.cwiseInverse());
  }

  static Eigen::VectorXd scaled(Eigen::VectorXd bound, const Eigen::VectorXd& scale) {
    if (bound.size() > 0) bound.tail(scale.size()).array() *= scale.array();
    return bound;
  }

  const VariationalInequality& problem_;
  std::optional<VariationalInequality> made_;
  Eigen::VectorXd scale_;  ///< by row of combinations
};

}  // namespace antilock
