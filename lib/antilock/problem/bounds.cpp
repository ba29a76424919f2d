#include "antilock/problem/bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

void require_bound(bool holds, const std::string& what) {
  if (!holds) throw Error("variational inequality: " + what);
}

void check_combinations(const VariationalInequality& problem) {
  const RowMatrix& rows = problem.combinations;
  if (rows.rows() == 0) return;
  require_bound(rows.cols() == problem.size(),
                fmt::format("combinations have {} columns; accepted {}, one per unknown", rows.cols(), problem.size()));
  require_bound(rows.isCompressed(), "combinations are accepted compressed only");
  require_bound(Eigen::Map<const Eigen::VectorXd>(rows.valuePtr(), rows.nonZeros()).allFinite(),
                "an entry of combinations is not finite");
  std::vector<char> fixed(problem.size(), 0);
  for (const int i : problem.fixed) fixed[i] = 1;
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    bool free = false;
    for (RowMatrix::InnerIterator c(rows, row); c; ++c) free = free || (c.value() != 0 && fixed[c.col()] == 0);
    require_bound(free, fmt::format("combination {} holds no free unknown; accepted: one or more", row));
  }
}

}  // namespace

Eigen::VectorXd bounded_values(const VariationalInequality& problem, const Eigen::VectorXd& u) {
  Eigen::VectorXd values(problem.bound_count());
  values.head(static_cast<Eigen::Index>(problem.contact.size())) = u(problem.contact);
  if (problem.combinations.rows() > 0) values.tail(problem.combinations.rows()) = problem.combinations * u;
  return values;
}

Eigen::VectorXd bound_forces(const VariationalInequality& problem, const Eigen::VectorXd& lambda) {
  const auto on_unknowns = static_cast<Eigen::Index>(problem.contact.size());
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(problem.size());
  if (problem.combinations.rows() > 0)
    forces = problem.combinations.transpose() * lambda.tail(problem.combinations.rows());
  for (Eigen::Index i = 0; i < on_unknowns; ++i) forces(problem.contact[i]) += lambda(i);
  return forces;
}

Eigen::VectorXd slack(const VariationalInequality& problem, const Eigen::VectorXd& u) {
  const Eigen::VectorXd values = bounded_values(problem, u), above = values - problem.lower;
  Eigen::VectorXd nearer = problem.upper.size() > 0 ? Eigen::VectorXd(above.cwiseMin(problem.upper - values)) : above;
  for (Eigen::Index i = 0; i < problem.force_bound.size(); ++i)
    if (std::isfinite(problem.force_bound(i))) nearer(i) = std::numeric_limits<double>::infinity();
  return nearer;
}

double force_bound(const VariationalInequality& problem, Eigen::Index i) {
  return problem.force_bound.size() > 0 ? problem.force_bound(i) : std::numeric_limits<double>::infinity();
}

double friction_energy(const VariationalInequality& problem, const Eigen::VectorXd& u) {
  if (problem.force_bound.size() == 0) return 0;
  const Eigen::VectorXd values = bounded_values(problem, u);
  double sum = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::isinf(problem.force_bound(i))) continue;
    const double below = problem.lower(i) - values(i),
                 above = problem.upper.size() > 0 ? values(i) - problem.upper(i) : 0;
    sum += problem.force_bound(i) * std::max({below, above, 0.0});
  }
  return sum;
}

VariationalInequality held_in_contact(VariationalInequality problem, const std::vector<bool>& active) {
  require_lower_bounds(problem, "held_in_contact");
  if (active.size() != problem.contact.size())
    throw Error(fmt::format("held_in_contact: {} marks; accepted: {}, one per contact unknown", active.size(),
                            problem.contact.size()));
  std::map<int, double> fixed;
  for (std::size_t i = 0; i < problem.fixed.size(); ++i)
    fixed[problem.fixed[i]] = problem.fixed_values(static_cast<Eigen::Index>(i));
  for (std::size_t i = 0; i < active.size(); ++i)
    if (active[i]) fixed[problem.contact[i]] = problem.lower(static_cast<Eigen::Index>(i));
  problem.fixed.clear();
  problem.fixed_values.resize(static_cast<Eigen::Index>(fixed.size()));
  for (const auto& [unknown, value] : fixed) {
    problem.fixed_values(static_cast<Eigen::Index>(problem.fixed.size())) = value;
    problem.fixed.push_back(unknown);
  }
  problem.contact.clear();
  problem.lower.resize(0);
  return problem;
}

void check_bounds(const VariationalInequality& problem) {
  check_combinations(problem);
  const Eigen::VectorXd &lower = problem.lower, &upper = problem.upper;
  const int bounds = problem.bound_count();
  require_bound(lower.size() == bounds,
                fmt::format("lower has {} entries; accepted {}: one bound per contact unknown and per combination",
                            lower.size(), bounds));
  require_bound(upper.size() == 0 || upper.size() == bounds,
                fmt::format("upper has {} entries; accepted none, or {} as in lower", upper.size(), bounds));
  require_bound(
      problem.force_bound.size() == 0 || problem.force_bound.size() == bounds,
      fmt::format("force_bound has {} entries; accepted none, or {} as in lower", problem.force_bound.size(), bounds));
  for (Eigen::Index i = 0; i < problem.force_bound.size(); ++i)
    require_bound(
        problem.force_bound(i) >= 0,
        fmt::format("force_bound {} is {}; accepted: 0 or more, infinity for any", i, problem.force_bound(i)));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < bounds; ++i) {
    const double low = lower(i), high = upper.size() > 0 ? upper(i) : infinity;
    require_bound(
        (std::isfinite(low) || low == -infinity) && (std::isfinite(high) || high == infinity) &&
            (std::isfinite(low) || std::isfinite(high)),
        fmt::format("bound {} is not finite: from {} to {}; accepted: one finite side or two, -infinity below "
                    "or infinity above for none",
                    i, low, high));
    require_bound(low <= high, fmt::format("bound {} is from {} to {}; accepted: lower <= upper, equal for an equation",
                                           i, low, high));
  }
}

void require_bounds_on_unknowns(const VariationalInequality& problem, const std::string& who) {
  if (problem.combinations.rows() > 0)
    throw Error(who + ": bounds on combinations are not known here; accepted: bounds on unknowns");
}

void require_firm_bounds(const VariationalInequality& problem, const std::string& who) {
  if (problem.force_bound.size() > 0)
    throw Error(who + ": friction is not known here; accepted: a problem without force_bound");
}

void require_lower_bounds(const VariationalInequality& problem, const std::string& who) {
  require_firm_bounds(problem, who);
  if (problem.combinations.rows() > 0 || problem.upper.size() > 0)
    throw Error(who +
                ": upper bounds and bounds on combinations are not known here; accepted: lower bounds on unknowns");
}

}  // namespace antilock
