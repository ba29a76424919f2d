#include "antilock/problem/bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "antilock/core/error.hpp"

namespace antilock {

double bound_or_infinity(double bound) {
  return std::abs(bound) >= infinite_bound ? std::copysign(std::numeric_limits<double>::infinity(), bound) : bound;
}

Eigen::VectorXd bounded_values(const VariationalInequality& problem, const Eigen::VectorXd& u) {
  Eigen::VectorXd values(problem.bound_count());
  values.head(static_cast<Eigen::Index>(problem.contact.size())) = u(problem.contact);
  if (problem.constraints.rows() > 0) values.tail(problem.constraints.rows()) = problem.constraints * u;
  return values;
}

Eigen::VectorXd bound_forces(const VariationalInequality& problem, const Eigen::VectorXd& lambda) {
  const auto on_unknowns = static_cast<Eigen::Index>(problem.contact.size());
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(problem.size());
  if (problem.constraints.rows() > 0)
    forces = problem.constraints.transpose() * lambda.tail(problem.constraints.rows());
  for (Eigen::Index i = 0; i < on_unknowns; ++i) forces(problem.contact[i]) += lambda(i);
  return forces;
}

Eigen::VectorXd distance_to_bound(const VariationalInequality& problem, const Eigen::VectorXd& u) {
  const Eigen::VectorXd values = bounded_values(problem, u), above = values - problem.lower;
  Eigen::VectorXd nearer = problem.upper.size() > 0 ? Eigen::VectorXd(above.cwiseMin(problem.upper - values)) : above;
  for (Eigen::Index i = 0; i < problem.force_limit.size(); ++i)
    if (std::isfinite(problem.force_limit(i))) nearer(i) = std::numeric_limits<double>::infinity();
  return nearer;
}

double friction_energy(const VariationalInequality& problem, const Eigen::VectorXd& u) {
  if (problem.force_limit.size() == 0) return 0;
  const Eigen::VectorXd values = bounded_values(problem, u);
  double sum = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::isinf(problem.force_limit(i))) continue;
    const double below = problem.lower(i) - values(i),
                 above = problem.upper.size() > 0 ? values(i) - problem.upper(i) : 0;
    sum += problem.force_limit(i) * std::max({below, above, 0.0});
  }
  return sum;
}

void set_dirichlet(VariationalInequality& problem, const std::map<int, double>& values) {
  problem.dirichlet_dofs.clear();
  problem.dirichlet_values.resize(static_cast<Eigen::Index>(values.size()));
  for (const auto& [unknown, value] : values) {
    problem.dirichlet_values(static_cast<Eigen::Index>(problem.dirichlet_dofs.size())) = value;
    problem.dirichlet_dofs.push_back(unknown);
  }
}

void clear_bounds(VariationalInequality& problem) {
  problem.contact.clear();
  for (Eigen::VectorXd* of_bounds : {&problem.lower, &problem.upper, &problem.force_limit}) of_bounds->resize(0);
  problem.constraints.resize(0, 0);
}

VariationalInequality equality_constrained(VariationalInequality problem, const std::vector<bool>& active) {
  require_lower_bounds(problem, "equality_constrained");
  if (active.size() != problem.contact.size())
    throw Error(fmt::format("equality_constrained: {} marks; accepted: {}, one per contact unknown", active.size(),
                            problem.contact.size()));
  std::map<int, double> fixed;
  for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i)
    fixed[problem.dirichlet_dofs[i]] = problem.dirichlet_values(static_cast<Eigen::Index>(i));
  for (std::size_t i = 0; i < active.size(); ++i)
    if (active[i]) fixed[problem.contact[i]] = problem.lower(static_cast<Eigen::Index>(i));
  set_dirichlet(problem, fixed);
  problem.contact.clear();
  problem.lower.resize(0);
  return problem;
}

void require_bounds_on_unknowns(const VariationalInequality& problem, const std::string& who) {
  if (problem.constraints.rows() > 0)
    throw Error(who + ": bounds on constraints are not known here; accepted: bounds on unknowns");
}

void require_hard_bounds(const VariationalInequality& problem, const std::string& who) {
  if (problem.force_limit.size() > 0)
    throw Error(who + ": friction is not known here; accepted: a problem without force_limit");
}

void require_lower_bounds(const VariationalInequality& problem, const std::string& who) {
  require_hard_bounds(problem, who);
  if (problem.constraints.rows() > 0 || problem.upper.size() > 0)
    throw Error(who +
                ": upper bounds and bounds on constraints are not known here; accepted: lower bounds on unknowns");
}

}  // namespace antilock
