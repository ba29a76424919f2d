#pragma once
#include <functional>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// The report. Each number is relative, so that scaling the load by any factor leaves it unchanged:
///
/// | row                       | numerator                 | scale               | why                                |
/// |---------------------------|---------------------------|---------------------|------------------------------------|
/// | residual, a row i of r1   | |r1_i| - 8 eps t_i        | min(own_i, F)       | the terms of A1 u are larger than  |
/// |                           |                           |                     | the forces at work by h^-2 and     |
/// |                           |                           |                     | would hide an error; a great force |
/// |                           |                           |                     | must hide nothing elsewhere; the   |
/// |                           |                           |                     | rounding of u and p is no error    |
/// | residual, a row j of r2   | |r2_j|                    | U sum_k |B_jk|      | a strain has the unit of its row   |
/// | residual, a fixed unknown | 1 where u is not its value | 1                  | prescribed values hold exactly     |
/// | min_gap, of bound i       | s_i - lower_i             | max(U c_i, |lower_i|) | a far obstacle hides no near one |
/// |                           | upper_i - s_i             | max(U c_i, |upper_i|) | each side by itself              |
/// | min_pressure, of bound i  | lambda_i at a lower bound | force_i             | as for r1                          |
/// |                           | -lambda_i at an upper one | force_i             |                                    |
/// |                           | |lambda_i| between two    | force_i             | either sign is right               |
/// |                           | g_i - |lambda_i|, where the bound bears g_i | max(force_i, g_i)                      |
/// | complementarity           | |lambda_i gap|, the part of lambda_i that a side bears times its gap | gap's scale  |
/// |                           |                           | times force_i       |                                    |
///
/// A bound that gives way leaves no gap; beyond it complementarity asks for lambda_i = g_i: |(g_i - |lambda_i|) gap|.
///
///     s_i    the bounded value: u_k of a contact unknown k, c . u of a row c of combinations
///     c_i    what s_i is at most where no |u| is above 1: 1, and sum_k |c_k|
///     force_i  min(own_k, F_0), and its smallest value over |c_k| on the free unknowns of a combination
///     U      max(|u|, 1e-6 moderate (what is refused of it), the displacement that a load which neither lambda nor
///            B' M p bears gives its unknown alone): a locked u tends to 0, and its round-off is that of its size before
///     t      |L| + |A1| |u| + |B'| M |p|, the terms of r1
///     own    max(t, |c_k lambda|, U diag(A1 + B' M B)), the forces at one unknown
///     F_0, F max(|L|, |c_k lambda|), and with the reactions of the fixed unknowns
///
/// All zero for the zero solution of a zero load. Throws Error for a malformed problem and for sizes that do not fit.
Kkt kkt_report(const VariationalInequality& problem, const Solution& solution);

/// Levels of the largest number of a report (its worst violation): above `trusted` a solution carries a warning; above
/// `refused` no solver of this library returns it.
struct TrustLevels {
  double trusted = 1e-9;
  double refused = 1e-6;
};
double worst_violation(const Kkt& kkt);

/// Fills solution.kkt and solution.warning; throws NotConverged where the report is above `refused` or not finite.
void certify(const VariationalInequality& problem, Solution& solution, const TrustLevels& levels = {});
/// The second half of it: judges the report that the solution carries.
void require_trusted(Solution& solution, const TrustLevels& levels = {});

/// What the report compares, unknown by unknown. Of a problem in pieces each part is the sum over the pieces;
/// strain is their maximum.
struct KktParts {
  Eigen::VectorXd load;      ///< N, L
  Eigen::VectorXd terms;     ///< N, t: the sum of the absolute values of all terms of r1 but lambda
  Eigen::VectorXd moderate;  ///< N, A1 u
  Eigen::VectorXd borne;     ///< N, B' M p
  Eigen::VectorXd diagonal;  ///< N, of A1
  Eigen::VectorXd stiff;     ///< N, the diagonal of B' M B
  double strain = 0;         ///< the largest |r2| in units of its row
};
/// In one walk over A1 and one over B. u: N entries, p: R.
KktParts kkt_parts(const VariationalInequality& problem, const Eigen::VectorXd& u, const Eigen::VectorXd& p);

/// The report, row by row. Three callers' data differ: what a maximum is taken over (all ranks), which unknowns are
/// fixed, and what is bounded.
struct KktRows {
  double u = 0;            ///< U
  Eigen::VectorXd forces;  ///< N: the force that no unknown would overlook, infinite where fixed
  double residual = 0;     ///< of the equations

  /// `bounds`: N, the sum of the forces of all bounds on each unknown; `largest_bound`: N, the largest of one bound;
  /// `fixed`: N, not 0 where the value is prescribed; `largest_u`: the larger of max |u| and 1e-6 of its size before it
  /// locked; `over_all`: the maximum over all pieces.
  KktRows(const KktParts& parts, const Eigen::VectorXd& bounds, const Eigen::VectorXd& largest_bound,
          const std::vector<char>& fixed, double largest_u, double reaction,
          const std::function<double(double)>& over_all);
  /// The rows of bound i, whose value is `value`: each gap by its own bound, so that a far obstacle hides no near one.
  /// `strain`: what the bounded value is at most where no |u| is above 1; `force`: a lambda that nobody would overlook.
  void note_bound(Kkt& kkt, const Stairs& stairs, int i, double value, double lambda, double strain,
                  double force) const;
};

}  // namespace antilock
