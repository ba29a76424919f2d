#pragma once
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// What the equations in split form leave over, on all N unknowns and R rows:
///     r1 = L + lambda - A1 u - B' M p   (on fixed unknowns: minus the reaction)      r2 = compliance p - B u
struct SplitResidual {
  Eigen::VectorXd r1, r2;
};
SplitResidual split_residual(const VariationalInequality& problem, const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                             const Eigen::VectorXd& lambda);
/// The same in long double, for corrections that round-off in the residual itself keeps from settling (slivers).
SplitResidual extended_residual(const VariationalInequality& problem, const Eigen::VectorXd& u,
                                const Eigen::VectorXd& p, const Eigen::VectorXd& lambda);

/// What a row of B makes of the largest u = 1: the unit of its strain. 1 for a row without entries.
Eigen::VectorXd absolute_row_sums(const RowMatrix& b);

/// The report, each number relative to what its condition is made of, so that scaling the load by any factor leaves it
/// unchanged: each row of r1 against the forces at work, max(|L|, |lambda|, |reactions|), since the terms of A1 u are
/// larger than these by h^-2 and would hide an error, or against the forces at its own unknown where all of these are
/// smaller (its terms of r1, its lambda, what a displacement of the size of u meets there in A1 + B' M B), so that a
/// great force hides nothing elsewhere; each row of r2 against its own sum |B| times the largest of |u| and
/// the displacement of a single unknown under its load (or `moderate`); gaps against max(|u|, |their bound|), pressures
/// against max(|L|, |lambda|) or, where smaller, the forces at their own unknown. All zero for the zero solution of a
/// zero load.
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

}  // namespace antilock
