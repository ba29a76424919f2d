#pragma once
#include <map>
#include <string>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// A bound of a file or of a user's array with |bound| >= infinite_bound means that there is none,
/// because products of such numbers may leave the range of double. Smaller numbers stay finite
/// bounds, also 1e20, 1e30 and 3.4e38 (the largest float), which some programs write for infinity.
constexpr double infinite_bound = 1e40;

/// Returns the bound, or infinity of the same sign where |bound| >= infinite_bound.
double bound_or_infinity(double bound);

/// Returns the C bounded values of u (N): its contact unknowns, then constraints * u.
Eigen::VectorXd bounded_values(const VariationalInequality& problem, const Eigen::VectorXd& u);

/// Returns E' lambda (N), the forces on the unknowns of the C forces lambda at the bounds. E maps u
/// to bounded_values(u).
Eigen::VectorXd bound_forces(const VariationalInequality& problem, const Eigen::VectorXd& lambda);

/// Returns min(s_i - lower_i, upper_i - s_i) for each bounded value s_i of u (C): the distance to
/// the nearer bound, negative where the bound is violated. It is infinite for a bound with a force
/// limit, which any value may pass.
Eigen::VectorXd distance_to_bound(const VariationalInequality& problem, const Eigen::VectorXd& u);

/// Returns j(u) = sum_i g_i dist(s_i, [lower_i, upper_i]), the work of u against the bounds with a
/// finite force limit g_i (Tresca's friction). s = bounded_values(u).
double friction_energy(const VariationalInequality& problem, const Eigen::VectorXd& u);

/// Replaces the dirichlet_dofs of the problem and their values by these.
void set_dirichlet(VariationalInequality& problem, const std::map<int, double>& values);

/// Removes all bounds, those on unknowns and those on constraints.
void clear_bounds(VariationalInequality& problem);

/// Returns the equality-constrained problem of an active set (J. Nocedal and S. J. Wright,
/// Numerical Optimization, ch. 16). `active` has one mark per contact unknown. Marked bounds hold
/// as equations, u = lower, and the other bounds are removed, so that the problem is linear. Where
/// `active` is the contact set of the solution, both problems have the same solution. Throws Error
/// for another number of marks, and for bounds other than lower bounds on unknowns.
VariationalInequality equality_constrained(VariationalInequality problem, const std::vector<bool>& active);

/// Throws Error, whose message begins with `who`, where the problem has bounds on constraints.
void require_bounds_on_unknowns(const VariationalInequality& problem, const std::string& who);

/// Throws Error, whose message begins with `who`, where the problem has force limits.
void require_hard_bounds(const VariationalInequality& problem, const std::string& who);

/// Throws Error, whose message begins with `who`, where the problem has upper bounds, force limits,
/// or bounds on constraints.
void require_lower_bounds(const VariationalInequality& problem, const std::string& who);

}  // namespace antilock
