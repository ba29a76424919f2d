#pragma once
#include <string>
#include <utility>
#include <vector>

#include "antilock/core/matrix.hpp"

namespace antilock {

/// A bound of a file or of a user's array with |bound| >= infinite_bound means that there is none,
/// because products of such numbers may leave the range of double. Smaller numbers stay finite
/// bounds, also 1e20, 1e30 and 3.4e38 (the largest float), which some programs write for infinity.
constexpr double infinite_bound = 1e40;

/// Returns the bound, or infinity of the same sign where |bound| >= infinite_bound.
double bound_or_infinity(double bound);

/// The limits of C values s_i, lower_i <= s_i <= upper_i, and of the forces lambda_i that keep the
/// values within them. All three vectors have C entries. Where a limit does not exist, its entry is
/// infinite.
///
/// The force lambda_i is at least 0 at a lower bound and at most 0 at an upper one. A bound with a
/// finite force limit is soft: it yields once its force would exceed the limit.
struct BoundLimits {
  Eigen::VectorXd lower;        ///< C; -gap for an obstacle below; -infinity: no lower bound
  Eigen::VectorXd upper;        ///< C; +infinity: no upper bound; = lower: an equation
  Eigen::VectorXd force_limit;  ///< C, 0 or more: the largest |lambda|; +infinity: a hard bound

  /// Makes no bounds, C = 0.
  BoundLimits() = default;
  /// Makes hard lower bounds.
  explicit BoundLimits(Eigen::VectorXd lower_limits);
  /// Makes hard bounds on both sides.
  BoundLimits(Eigen::VectorXd lower_limits, Eigen::VectorXd upper_limits);
  BoundLimits(Eigen::VectorXd lower_limits, Eigen::VectorXd upper_limits,
              Eigen::VectorXd force_limits);

  /// Returns C.
  int count() const { return static_cast<int>(lower.size()); }
  bool is_equation(int i) const { return lower(i) == upper(i); }
  bool has_upper_bounds() const;  ///< whether one is not infinite
  bool has_force_limits() const;  ///< whether one is not infinite
};

/// The bounds of a variational inequality (variational_inequality.hpp) and the C values s of u that
/// they bound: first the entries of u at `unknowns`, then constraints * u. The limits and
/// Solution::lambda list the bounds in this order.
struct Bounds : BoundLimits {
  /// The bounded unknowns. Reports list them in this order. The nested start (solve/contact.hpp) is
  /// a good one where neighbours in this list are neighbours on the boundary.
  std::vector<int> unknowns;
  /// (C - size of `unknowns`) x N, or 0 x 0. A row c bounds c . u, for example the normal
  /// displacement on an inclined plane or the gap between two bodies.
  RowMatrix constraints;

  /// Makes no bounds, C = 0.
  Bounds() = default;
  Bounds(std::vector<int> bounded_unknowns, BoundLimits limits, const RowMatrix& bounded_rows = {})
      : BoundLimits(std::move(limits)),
        unknowns(std::move(bounded_unknowns)),
        constraints(bounded_rows) {}
  const BoundLimits& limits() const { return *this; }
  /// Returns hard lower bounds on unknowns, one value per unknown.
  static Bounds lower_on(std::vector<int> unknowns, Eigen::VectorXd lower) {
    return {std::move(unknowns), BoundLimits(std::move(lower))};
  }
};

/// Returns the C bounded values of u (N): its entries at the bounded unknowns, then constraints *
/// u.
Eigen::VectorXd bounded_values(const Bounds& bounds, const Eigen::VectorXd& u);

/// Returns E' lambda (N = size), the forces on the unknowns of the C forces lambda at the bounds. E
/// maps u to bounded_values(u).
Eigen::VectorXd bound_forces(const Bounds& bounds, const Eigen::VectorXd& lambda,
                             Eigen::Index size);

/// Returns min(s_i - lower_i, upper_i - s_i) for each bounded value s_i of u (C): the distance to
/// the nearer bound, negative where the bound is violated. It is infinite for a bound with a force
/// limit, which any value may pass.
Eigen::VectorXd distance_to_bound(const Bounds& bounds, const Eigen::VectorXd& u);

/// Returns j(u) = sum_i g_i dist(s_i, [lower_i, upper_i]), the work of u against the bounds with a
/// finite force limit g_i (Tresca's friction). s = bounded_values(u).
double friction_energy(const Bounds& bounds, const Eigen::VectorXd& u);

/// Throws Error, whose message begins with `who`, where there are bounds on constraints.
void require_bounds_on_unknowns(const Bounds& bounds, const std::string& who);

/// Throws Error, whose message begins with `who`, where a bound has a force limit.
void require_hard_bounds(const Bounds& bounds, const std::string& who);

/// Throws Error, whose message begins with `who`, where there are upper bounds, force limits, or
/// bounds on constraints.
void require_lower_bounds(const Bounds& bounds, const std::string& who);

}  // namespace antilock
