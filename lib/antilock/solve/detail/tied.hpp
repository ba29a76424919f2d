#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// A problem whose bounds are all on unknowns. A bounded combination c . u becomes an unknown w of its own, after the N
/// others, and a row of B with compliance 0 ties the two:
///
///     B gains the row (c, -1),   lower <= w <= upper,   A1 and the load are 0 at w
///
/// Rows are scaled by a power of two, their largest entry to 1 or more and below 2: the units of a row do not matter. M
/// of such a row is what K gains, M (c, -1)' (c, -1): tuned::tie times the stiffness 1 / sum (c_j^2 / K_jj) that c . u
/// has at least, K with the usual penalty. Throws Error where K is 0 at a free unknown.
///
/// Without combinations it is the problem itself, which must then outlive this.
class Tied {
 public:
  explicit Tied(const VariationalInequality& problem);
  const VariationalInequality& operator*() const { return made_ ? *made_ : problem_; }
  const VariationalInequality* operator->() const { return &**this; }
  /// C forces in the units of the problem's own rows.
  Eigen::VectorXd forces(Eigen::VectorXd lambda) const;

 private:
  const VariationalInequality& problem_;
  std::optional<VariationalInequality> made_;
  Eigen::VectorXd scale_;  ///< by row of combinations
};

}  // namespace antilock
