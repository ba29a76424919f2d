#pragma once
#include <fmt/format.h>

#include <cmath>

#include "antilock/analysis/hypotheses.hpp"
#include "antilock/core/error.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// A problem at every class parameter from 1 to 1e-12, and at 0: epsilon, energy, "max |u|" of all unknowns, corrections
/// (many: the penalty does not fit, or the problem locks), and the KKT report's largest number. J rises as epsilon falls,
/// to a limit; where the stiff part locks, to that with the stiff part held: the rest still moves. Energy and |u| are no
/// numbers where no answer was found.
inline Table energies(VariationalInequality problem) {
  Table table({"epsilon", "energy", "max |u|", "corrections", "KKT"});
  for (int k = 0; k <= 13; ++k) {
    problem.compliance = k <= 12 ? std::pow(10.0, -k) : 0;
    try {
      const Solution s = active_set(problem);
      table.add({problem.compliance, energy(problem, s), s.u.lpNorm<Eigen::Infinity>(), s.counters.corrections,
                 worst_violation(s.kkt)});
    } catch (const NotConverged& failure) {
      table.add({problem.compliance, NAN, NAN, failure.steps, failure.reached});
    }
  }
  return table;
}

/// Prints what one glue came to: its hypotheses, its energies, and the answer with the KKT report; `rigid_force` is the
/// contact force under a rigid glue.
inline void print_glue(const std::string& name, const Hypotheses& h, int finer_kernel, const Table& energies,
                       const Solution& solution, double rigid_force) {
  energies.print(
      fmt::format("{}: (H1) coercivity {:.3f}; (H2) kernel {} of {} unknowns ({} on the mesh twice as fine); K "
                  "and G meet to {:.0e}",
                  name, h.coercivity, h.kernel, h.free, finer_kernel, h.distance));
  const Kkt& k = solution.kkt;
  fmt::print(
      "  contact force {:.4f} (rigid glue: {:.4f}), KKT: gap {:.0e}, pressure {:.0e}, complementarity {:.0e}, "
      "residual {:.0e}\n\n",
      solution.lambda.sum(), rigid_force, k.min_gap, k.min_pressure, k.complementarity, k.residual);
}

/// What the solver says of a problem that it does not solve; empty where it solves it.
inline std::string refusal(const VariationalInequality& problem) {
  try {
    active_set(problem);
  } catch (const NotConverged& no) {
    return no.what();
  }
  return "";
}

}  // namespace antilock::tutorial
