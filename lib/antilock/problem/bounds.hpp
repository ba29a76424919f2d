#pragma once
#include <map>
#include <string>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// A bound of this size or more, in a file or an array of a user's, is none: products of such numbers
/// leave the range of double. The customary infinities 1e20, 1e30 and 3.4e38 are numbers, and bound nothing.
constexpr double infinite_bound = 1e40;

/// The bound, infinite where it is void: |bound| >= infinite_bound, as the largest double.
double bound_or_infinity(double bound);

/// The bounded values of any u of N entries: its contact unknowns, then constraints * u. C entries.
Eigen::VectorXd bounded_values(const VariationalInequality& problem, const Eigen::VectorXd& u);

/// The N forces on the unknowns of C forces lambda at the bounds: the transpose of bounded_values.
Eigen::VectorXd bound_forces(const VariationalInequality& problem, const Eigen::VectorXd& lambda);

/// The distance of each bounded value from the nearer of its bounds, negative where it lies outside, infinite where the
/// bound has a force limit. C entries.
Eigen::VectorXd distance_to_bound(const VariationalInequality& problem, const Eigen::VectorXd& u);

/// j(u), the work against bounds with a force_limit (Tresca's friction): the sum of force_limit times the distance
/// from the bounds.
double friction_energy(const VariationalInequality& problem, const Eigen::VectorXd& u);

/// Replaces the dirichlet_dofs of the problem and their values by these.
void set_dirichlet(VariationalInequality& problem, const std::map<int, double>& values);

/// Leaves the problem without bounds, on unknowns or constraints.
void clear_bounds(VariationalInequality& problem);

/// The equality-constrained problem of an active set (Nocedal and Wright, ch. 16): the bounds marked in `active` (one
/// mark per contact unknown) hold as equations, and the other bounds are gone. It is linear, and where `active` is the
/// contact set of the solution, with the same solution. Throws Error for another number of marks, and where bounds are
/// others than lower ones on unknowns.
VariationalInequality equality_constrained(VariationalInequality problem, const std::vector<bool>& active);

/// Throws Error where `who` takes bounds on unknowns alone and the problem has constraints.
void require_bounds_on_unknowns(const VariationalInequality& problem, const std::string& who);

/// Throws Error where `who` takes bounds without a force limit and the problem has others.
void require_hard_bounds(const VariationalInequality& problem, const std::string& who);

/// Throws Error where `who` takes lower bounds on unknowns alone and the problem has others.
void require_lower_bounds(const VariationalInequality& problem, const std::string& who);

}  // namespace antilock
