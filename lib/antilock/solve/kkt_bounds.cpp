#include "antilock/solve/kkt_bounds.hpp"

#include <algorithm>
#include <limits>

#include "antilock/problem/bounds.hpp"

namespace antilock {
namespace {

using scale_free::least;
using scale_free::most;
using scale_free::ratio;

/// The units that a bound is judged in.
struct BoundUnits {
  double strain;  ///< what the bounded value is at most where no |u| is above 1
  double force;   ///< a lambda that no unknown in the bound would overlook
};
BoundUnits bound_units(const VariationalInequality& problem, Eigen::Index bound, const Eigen::VectorXd& forces) {
  const auto contact = static_cast<Eigen::Index>(problem.contact.size());
  if (bound < contact) return {1, forces(problem.contact[bound])};
  BoundUnits units{0, std::numeric_limits<double>::infinity()};
  for (RowMatrix::InnerIterator c(problem.combinations, bound - contact); c; ++c) {
    if (c.value() == 0) continue;
    units.strain += std::abs(c.value());
    units.force = std::min(units.force, forces(c.col()) / std::abs(c.value()));
  }
  return units;
}

/// The rows of the report for bound i, whose value is `value`: each gap by its own bound, so that a far obstacle hides no
/// near one.
void note_bound(Kkt& kkt, const VariationalInequality& problem, Eigen::Index i, double value, double lambda,
                double u_scale, double force) {
  const double lower = problem.lower(i);
  const double upper = problem.upper.size() > 0 ? problem.upper(i) : std::numeric_limits<double>::infinity();
  const double bears = force_bound(problem, i);
  const bool soft = std::isfinite(bears);
  // between two bounds either sign of lambda is right, and each side answers for its own
  const bool two = std::isfinite(lower) && std::isfinite(upper);
  const double up = two ? std::max(lambda, 0.0) : lambda, down = two ? std::max(-lambda, 0.0) : -lambda;
  const auto side = [&](double bound, double gap, double pressure) {
    if (!std::isfinite(bound)) return;
    const double scale = std::max(u_scale, std::abs(bound));
    if (!two) kkt.min_pressure = least(kkt.min_pressure, ratio(pressure, force));
    if (!soft) kkt.min_gap = least(kkt.min_gap, ratio(gap, scale));
    // what is not borne beyond a bound; a bound that bears far more than the forces at work is not passed by round-off
    const bool beyond = soft && gap < 0;
    const double idle = beyond ? bears - pressure : pressure, unit = beyond ? std::max(force, bears) : force;
    kkt.complementarity = most(kkt.complementarity, ratio(std::abs(idle * gap), scale * unit));
  };
  if (two) kkt.min_pressure = least(kkt.min_pressure, ratio(std::abs(lambda), force));
  if (soft) kkt.min_pressure = least(kkt.min_pressure, ratio(bears - std::abs(lambda), std::max(force, bears)));
  side(lower, value - lower, up);
  side(upper, upper - value, down);
}

}  // namespace

Eigen::VectorXd largest_bound_forces(const VariationalInequality& problem, const Eigen::VectorXd& lambda) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(problem.size());
  const auto contact = static_cast<Eigen::Index>(problem.contact.size());
  for (Eigen::Index i = 0; i < contact; ++i) largest(problem.contact[i]) = std::abs(lambda(i));
  for (Eigen::Index row = 0; row < problem.combinations.rows(); ++row)
    for (RowMatrix::InnerIterator c(problem.combinations, row); c; ++c)
      largest(c.col()) = std::max(largest(c.col()), std::abs(c.value() * lambda(contact + row)));
  return largest;
}

void report_bounds(Kkt& kkt, const VariationalInequality& problem, const Solution& solution, double u_scale,
                   Eigen::VectorXd forces) {
  if (problem.bound_count() == 0) return;
  kkt.min_gap = kkt.min_pressure = std::numeric_limits<double>::infinity();
  for (const int i : problem.fixed) forces(i) = std::numeric_limits<double>::infinity();  // the clamp bears any
  const Eigen::VectorXd values = bounded_values(problem, solution.u);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const BoundUnits units = bound_units(problem, i, forces);
    note_bound(kkt, problem, i, values(i), solution.lambda(i), u_scale * units.strain, units.force);
  }
  if (kkt.min_gap == std::numeric_limits<double>::infinity()) kkt.min_gap = 0;  // every bound gives way
}

}  // namespace antilock
