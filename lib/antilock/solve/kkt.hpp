#pragma once
#include <cmath>
#include <vector>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// Measures how well a solution (u, p, lambda) satisfies the KKT conditions of the inequality. L is
/// the load, E' lambda the forces of the bounds on the unknowns (problem/bounds.hpp), s_i the
/// bounded value of bound i, g_i its force limit, and
///
///     r1 = L + E' lambda - A1 u - B' M p,   r2 = compliance p - B u
///
/// Each number of the report is relative: if the load, the bounds and the prescribed values are
/// multiplied by one factor, the report stays the same. The scales:
///
///     U        max(max |u|, 1e-6 penalised_max_u). The second term is needed because a locked u
///              tends to 0, while its round-off stays that of the unlocked u
///     t        |L| + |A1| |u| + |B'| M |p| + |E'| |lambda|: the absolute values of all terms of r1
///     f        max(t, U diag(|A1| + B' M B)): the forces at one unknown
///     F_0      the largest |L_k| and |E_ik lambda_i|
///     F        the largest of F_0 and of the reactions |r1_k| at prescribed unknowns
///     force_i  of a bound on unknown k: min(f_k, F_0); of a constraint c: the smallest of
///              min(f_k, F_0) / |c_k| over its free unknowns k
///     reach_i  of a bound on an unknown: U; of a constraint c: U sum_k |c_k|
///
/// residual is the largest of
///
///     (|r1_k| - 8 eps t_k) / min(f_k, F)     for each free unknown k
///     |r2_j| / (U sum_k |B_jk|)              for each row j of B
///     1                                      where a prescribed unknown does not have its value
///
/// min_gap is the smallest over the hard bounds of
///
///     (s_i - lower_i) / max(reach_i, |lower_i|),   (upper_i - s_i) / max(reach_i, |upper_i|)
///
/// min_pressure is the smallest of
///
///     lambda_i / force_i                        at a lower bound without an upper one
///     -lambda_i / force_i                       at an upper bound without a lower one
///     |lambda_i| / force_i                      between two bounds
///     (g_i - |lambda_i|) / max(force_i, g_i)    at a bound with a force limit
///
/// complementarity is the largest over the bounds of
///
///     |(g_i - |lambda_i|) gap_i| / max(force_i, g_i)    beyond a bound with a force limit
///     |lambda_i gap_i| / force_i                        otherwise
///
/// gap_i is the relative distance of bound i, one of the two quotients under min_gap. Between two
/// bounds a positive lambda_i counts only at the lower bound, and a negative one only at the upper
/// bound.
///
/// kkt.cpp has the reasons for the scales. A zero solution of a zero load has a report of
/// zeros. Throws Error for a malformed problem and for sizes that do not fit.
Kkt kkt_report(const VariationalInequality& problem, const Solution& solution);

/// Levels of the worst violation of a report. A solution above `warn` carries a warning. No solver
/// returns a solution above max(fail, 10 tolerance) (CorrectionOptions::kkt_fail), except for
/// naive_summed_solve, which checks nothing. The worst violation of a solution is normally below
/// both levels, because `warn` is ten times the default tolerance of the corrections.
struct KktTolerances {
  double warn = 1e-9;
  double fail = 1e-6;
};
/// Returns the largest of -min_gap, -min_pressure, complementarity and residual, and infinity where
/// one of them is not finite.
double worst_violation(const Kkt& kkt);

/// Computes solution.kkt and appends to solution.warning. Throws NotConverged where the worst
/// violation is above `fail`, and Error as kkt_report does.
void check_kkt(const VariationalInequality& problem, Solution& solution,
               const KktTolerances& levels = {});
/// Does the second half of check_kkt: compares solution.kkt with the levels.
void apply_tolerances(Solution& solution, const KktTolerances& levels = {});

/// The parts of kkt_report. For a problem on subdomains the vectors are summed over them, and
/// strain is the maximum. Then residual and complementarity of Kkt are the maxima over the
/// subdomains, and min_gap and min_pressure are the minima.
struct KktParts {
  Eigen::VectorXd r1;         ///< N
  Eigen::VectorXd terms;      ///< N, t
  Eigen::VectorXd stiffness;  ///< N, diag(|A1| + B' M B)
  double strain = 0;          ///< the largest |r2_j| / sum_k |B_jk|
  /// Adds a term to r1 and its absolute value to t.
  void add_force(Eigen::Index unknown, double force) {
    r1(unknown) += force;
    terms(unknown) += std::abs(force);
  }
};
/// Computes the parts without the forces of the bounds. u: N entries, p: R.
KktParts kkt_parts(const VariationalInequality& problem, const Eigen::VectorXd& u,
                   const Eigen::VectorXd& p);

/// Adds the residuals of r1 and r2 to the report. `fixed` (N) is not 0 at prescribed unknowns. `u`,
/// `force` and `with_reactions` are U, F_0 and F. For a problem on subdomains they are computed
/// from the whole problem. Returns min(f_k, F_0) of all unknowns (N), infinite at prescribed ones.
Eigen::VectorXd add_equations(Kkt& kkt, const KktParts& parts, const std::vector<char>& fixed,
                              double u, double force, double with_reactions);
/// Adds the gap, pressure and complementarity of bound i to the report. `value` is s_i, `reach` is
/// reach_i and `force` is force_i.
void add_bound(Kkt& kkt, const BoundLimits& bounds, int i, double value, double lambda,
               double reach, double force);

}  // namespace antilock
