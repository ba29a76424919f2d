#pragma once
#include <optional>
#include <string>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Wall seconds of a run by stage: the scene and its mesh, the discrete problem with a look at its load, the factor, the
/// rest of the solve with the checks of the result. The files are timed where they are written.
struct RunSeconds {
  double mesh = 0, assemble = 0, factor = 0, solve = 0;
};

/// What report_locking (analysis/locking_report.hpp) finds in a solved scene with a layer.
struct LockingReport {
  std::string diagnosis;  ///< one line: whether the method follows the layer as epsilon -> 0, and why
  /// The share of LockingLoss::lower_bound, where the method can lock; empty where it locks and that is not proved.
  std::optional<double> lost = {};
  /// Empty, or one sentence with the word "locks", the share, how it is known (proved, or by a second solve with
  /// columns where `lost` is empty) and the remedies.
  std::string warning = {};
  double estimate = 0;   ///< the share of LockingLoss::estimate
  double reference = 0;  ///< LockingLoss::reference, of which both are shares

  /// One line for a program to print: the warning, or the diagnosis where there is none.
  const std::string& text() const { return warning.empty() ? diagnosis : warning; }
};

/// A discrete solution with its space and its problem, from which everything is measured, proved, drawn and written.
struct Result {
  Space space;
  VariationalInequality problem = {};
  Solution solution = {};
  RunSeconds seconds = {};
  /// Empty, or one line: each reason to distrust the result, first that the element locks.
  std::string warning = {};
  std::optional<LockingReport> locking = {};  ///< of a scene with a layer, where it was asked for
};

/// Returns a result in the form that the analysis studies: rows of B with a positive fixed compliance
/// are assembled into A1 (problem/variational_inequality.hpp), and p has the other rows' entries.
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

/// Both warnings in one line, or the one that is not empty.
inline std::string joined(const std::string& a, const std::string& b) {
  return a + (a.empty() || b.empty() ? "" : "; ") + b;
}

}  // namespace antilock
