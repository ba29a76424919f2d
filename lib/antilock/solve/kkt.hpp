#pragma once
#include <cmath>
#include <vector>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// The report. Each number is relative, so that scaling the load by any factor leaves it unchanged:
///
/// | row                       | numerator                  | scale                 |
/// |---------------------------|----------------------------|-----------------------|
/// | residual, a row i of r1   | |r1_i| - 8 eps t_i         | min(own_i, F)         |
/// | residual, a row j of r2   | |r2_j|                     | U sum_k |B_jk|        |
/// | residual, a fixed unknown | 1 where u is not its value | 1                     |
/// | min_gap, of bound i       | s_i - lower_i              | max(U c_i, |lower_i|) |
/// |                           | upper_i - s_i              | max(U c_i, |upper_i|) |
/// | min_pressure, of bound i  | lambda_i at a lower bound  | force_i               |
/// |                           | -lambda_i at an upper one  | force_i               |
/// |                           | |lambda_i| between two     | force_i               |
/// |                           | g_i - |lambda_i|, where g_i is the force limit       | max(force_i, g_i)             |
/// | complementarity           | |lambda_i gap|, lambda_i of that side alone           | the gap's scale times force_i |
///
/// Why: the terms of A1 u are larger than the forces at work by h^-2 and would hide an error; a great force must hide
/// nothing elsewhere, nor a far obstacle a near one; the rounding of u and p is no error; a strain has the unit of its
/// row; prescribed values hold exactly; between two bounds either sign of lambda is right, and each side is by itself.
/// A bound that slips leaves no gap; beyond it complementarity asks for lambda_i = g_i: |(g_i - |lambda_i|) gap|.
///
///     s_i    the bounded value: u_k of a contact unknown k, c . u of a row c of constraints
///     c_i    what s_i is at most where no |u| is above 1: 1, and sum_k |c_k|
///     force_i  min(own_k, F_0), and its smallest value over |c_k| on the free unknowns of a constraint
///     U      max(|u|, 1e-6 penalised_max_u): a locked u tends to 0, and its round-off is that of its size before
///     t      |L| + |A1| |u| + |B'| M |p| + |lambda|, the terms of r1
///     own    max(t, U diag(A1 + B' M B)), the forces at one unknown
///     F_0, F the largest load and force of a bound on an unknown, and with the reactions of the fixed unknowns
///
/// All zero for the zero solution of a zero load. Throws Error for a malformed problem and for sizes that do not fit.
Kkt kkt_report(const VariationalInequality& problem, const Solution& solution);

/// Levels of the largest number of a report (its worst violation): above `warn` a solution carries a warning; above
/// `fail` no solver of this library returns it. Promises, not limits of the arithmetic: ten times the tolerance of
/// the corrections, and what no figure and no mesh of the course could show.
struct KktTolerances {
  double warn = 1e-9;
  double fail = 1e-6;
};
double worst_violation(const Kkt& kkt);

/// Fills solution.kkt and solution.warning; throws NotConverged where the report is above `fail` or not finite.
void check_kkt(const VariationalInequality& problem, Solution& solution, const KktTolerances& levels = {});
/// The second half of check_kkt: compares the report that the solution has with the tolerances.
void apply_tolerances(Solution& solution, const KktTolerances& levels = {});

/// What the report compares, unknown by unknown. Of a problem on subdomains each part is the sum over them;
/// strain and the numbers of the report are maxima, min_gap and min_pressure minima.
struct KktParts {
  Eigen::VectorXd r1;         ///< N
  Eigen::VectorXd terms;      ///< N, t: the sum of the absolute values of all terms of r1
  Eigen::VectorXd stiffness;  ///< N, the diagonals of |A1| and of B' M B
  double strain = 0;          ///< the largest |r2| in units of its row
  /// One term more of r1.
  void add_force(Eigen::Index unknown, double force) {
    r1(unknown) += force;
    terms(unknown) += std::abs(force);
  }
};
/// All but the forces of the bounds. u: N entries, p: R.
KktParts kkt_parts(const VariationalInequality& problem, const Eigen::VectorXd& u, const Eigen::VectorXd& p);

/// Adds the residual of the equations to the report. Returns min(own, F_0) of all unknowns (N), infinite where `fixed`
/// (N) is not 0: where the value is prescribed. `u`, `force`, `with_reactions`: U, F_0, F, of a problem on subdomains
/// those of the whole.
Eigen::VectorXd add_equations(Kkt& kkt, const KktParts& parts, const std::vector<char>& fixed, double u, double force,
                              double with_reactions);
/// Adds the rows of bound i to the report, whose value is s_i = `value`. `reach`: U c_i; `force`: force_i.
void add_bound(Kkt& kkt, const Bounds& bounds, int i, double value, double lambda, double reach, double force);

}  // namespace antilock
