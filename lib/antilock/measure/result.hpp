#pragma once
#include <optional>
#include <string>
#include <utility>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/coulomb_friction.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Wall seconds of a run by stage. `mesh` is the time of the scene and its mesh. `assemble` is the
/// time of the discrete problem and of the check of its load. `factor` is the time of the
/// factorisation. `solve` is the time of the rest of the solve and of the checks of the result. The
/// times of the files are measured where they are written.
struct RunSeconds {
  double mesh = 0, assemble = 0, factor = 0, solve = 0;
};

/// The result of report_locking (analysis/locking_report.hpp) for a solved scene with a layer.
/// Shares are fractions of `reference`, from 0 to 1 (LockingLoss::share,
/// analysis/locking_loss.hpp).
struct LockingReport {
  std::string diagnosis;  ///< one line: whether the element locks in the layer, and why
  /// The share of LockingLoss::lower_bound, on tetrahedra that of LossBesideColumns. It is empty in
  /// four cases: nothing can lock; the function that computes it throws; it is not called, as for
  /// two bodies; or locking is not proved, which means that `estimate` is at least 5 %
  /// (`significance`, on tetrahedra comparison_significance) but the share of the lower bound is below it.
  std::optional<double> lost = {};
  /// Empty if `estimate` is below 5 %, or below a quarter on tetrahedra and for two bodies.
  /// Otherwise it is one sentence that contains "locks", the share, its origin and the remedies.
  /// The share is rounded down to whole per cent, and is at most 99 %. The origin is "proved", or,
  /// if `lost` is empty, a second solve. This is the one for v in locking_loss or in
  /// loss_beside_columns, where the layer has columns of its own, or that of Crouzeix-Raviart. On a
  /// large mesh of tetrahedra (report_locking) the sentence has no share.
  std::string warning = {};
  /// The share of LockingLoss::estimate or LossBesideColumns::estimate, or that of
  /// locking_beside_cr, as for two bodies; 0 where none was called, and where it throws.
  double estimate = 0;
  /// The energy that the layer's motion releases: LockingLoss::reference,
  /// LossBesideColumns::reference, or R_CR (analysis/locking_beside_cr.hpp).
  double reference = 0;

  /// Returns one line for a program to print: the warning, or the diagnosis if there is no warning.
  const std::string& text() const { return warning.empty() ? diagnosis : warning; }
};

/// A discrete solution with its space and its problem. Errors, certificates, pictures and files are
/// made from it.
struct Result {
  Space space;
  VariationalInequality problem = {};
  Solution solution = {};
  RunSeconds seconds = {};
  /// Empty, or one line with each reason to distrust the result. Locking comes first.
  std::string warning = {};
  /// Set by `solve` (analysis/solve.hpp) for a scene with a layer.
  std::optional<LockingReport> locking = {};
  /// Set for a model with Coulomb's friction.
  std::optional<FixedPointReport> coulomb = {};
};

/// Returns a result in the form that the analysis studies: rows of B with a positive fixed
/// compliance are assembled into A1 (problem/variational_inequality.hpp), and p keeps the entries
/// of the other rows.
inline Result assemble_fixed_rows(const Result& result) {
  const VariationalInequality& problem = result.problem;
  Result summed{result.space, assemble_fixed_rows(problem), result.solution};
  const Eigen::Index first = problem.parametric_row_count();
  Eigen::Index left = first;
  for (Eigen::Index k = 0; k < problem.fixed_compliances.size(); ++k)
    if (problem.fixed_compliances(k) == 0) {
      summed.solution.p(left) = summed.solution.p(first + k);
      ++left;
    }
  summed.solution.p.conservativeResize(left);
  return summed;
}

/// Returns both warnings in one line, or the one that is not empty.
inline std::string joined(const std::string& a, const std::string& b) {
  return a + (a.empty() || b.empty() ? "" : "; ") + b;
}

/// Adds a report on locking to a result. The warning of the result then consists of that of the
/// report, that of the solution, and the one that the result had before.
inline void add_locking_report(Result& result, std::optional<LockingReport> report) {
  const std::string locking = report ? report->warning : "";
  result.locking = std::move(report);
  result.warning = joined(joined(locking, result.solution.warning), result.warning);
}

}  // namespace antilock
