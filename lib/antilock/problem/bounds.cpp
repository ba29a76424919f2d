#include "antilock/problem/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Eigen::VectorXd infinities(Eigen::Index count) {
  return Eigen::VectorXd::Constant(count, infinity);
}

}  // namespace

double bound_or_infinity(double bound) {
  return std::abs(bound) >= infinite_bound ? std::copysign(infinity, bound) : bound;
}

BoundLimits::BoundLimits(Eigen::VectorXd lower_limits)
    : lower(std::move(lower_limits)),
      upper(infinities(lower.size())),
      force_limit(infinities(lower.size())) {}

BoundLimits::BoundLimits(Eigen::VectorXd lower_limits, Eigen::VectorXd upper_limits)
    : lower(std::move(lower_limits)),
      upper(std::move(upper_limits)),
      force_limit(infinities(lower.size())) {}

BoundLimits::BoundLimits(Eigen::VectorXd lower_limits, Eigen::VectorXd upper_limits,
                         Eigen::VectorXd force_limits)
    : lower(std::move(lower_limits)),
      upper(std::move(upper_limits)),
      force_limit(std::move(force_limits)) {}

// NaN counts as a limit: functions without limits must not accept it
bool BoundLimits::has_upper_bounds() const { return (upper.array() != infinity).any(); }
bool BoundLimits::has_force_limits() const { return (force_limit.array() != infinity).any(); }

Eigen::VectorXd bounded_values(const Bounds& bounds, const Eigen::VectorXd& u) {
  const auto on_unknowns = static_cast<Eigen::Index>(bounds.unknowns.size()),
             rows = bounds.constraints.rows();
  Eigen::VectorXd values(on_unknowns + rows);
  values.head(on_unknowns) = u(bounds.unknowns);
  if (rows > 0) values.tail(rows) = bounds.constraints * u;
  return values;
}

Eigen::VectorXd bound_forces(const Bounds& bounds, const Eigen::VectorXd& lambda,
                             Eigen::Index size) {
  const auto on_unknowns = static_cast<Eigen::Index>(bounds.unknowns.size()),
             rows = bounds.constraints.rows();
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(size);
  if (rows > 0) forces = bounds.constraints.transpose() * lambda.tail(rows);
  for (Eigen::Index i = 0; i < on_unknowns; ++i) forces(bounds.unknowns[i]) += lambda(i);
  return forces;
}

Eigen::VectorXd distance_to_bound(const Bounds& bounds, const Eigen::VectorXd& u) {
  const Eigen::VectorXd values = bounded_values(bounds, u);
  Eigen::VectorXd nearer = (values - bounds.lower).cwiseMin(bounds.upper - values);
  for (int i = 0; i < bounds.count(); ++i)
    if (std::isfinite(bounds.force_limit(i))) nearer(i) = infinity;
  return nearer;
}

double friction_energy(const Bounds& bounds, const Eigen::VectorXd& u) {
  const Eigen::VectorXd values = bounded_values(bounds, u);
  double sum = 0;
  for (int i = 0; i < bounds.count(); ++i) {
    if (std::isinf(bounds.force_limit(i))) continue;
    const double below = bounds.lower(i) - values(i), above = values(i) - bounds.upper(i);
    sum += bounds.force_limit(i) * std::max({below, above, 0.0});
  }
  return sum;
}

void require_bounds_on_unknowns(const Bounds& bounds, const std::string& who) {
  if (bounds.constraints.rows() > 0)
    throw Error(who + ": bounds on constraints are not known here; accepted: bounds on unknowns");
}

void require_hard_bounds(const Bounds& bounds, const std::string& who) {
  if (bounds.has_force_limits())
    throw Error(who + ": friction is not known here; accepted: a problem without force_limit");
}

void require_lower_bounds(const Bounds& bounds, const std::string& who) {
  require_hard_bounds(bounds, who);
  if (bounds.constraints.rows() > 0 || bounds.has_upper_bounds())
    throw Error(who +
                ": upper bounds and bounds on constraints are not known here; accepted: lower "
                "bounds on unknowns");
}

}  // namespace antilock
