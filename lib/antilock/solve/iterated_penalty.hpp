#pragma once
#include <functional>

#include "antilock/core/progress.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/contact_problem.hpp"
#include "antilock/solve/penalty_factor.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// Solves the contact problem of one correction; `correction` counts from 0, `before` is the answer of the last (empty
/// at 0).
using ContactSolver = std::function<ContactAnswer(const ContactProblem&, const ContactAnswer& before, int correction)>;

struct CorrectionOptions {
  double tolerance = 1e-10;   ///< on the estimated relative algebraic error of u in the maximum norm; a thousandth of
                              ///< it on p compliance = B u, row by row, where errors of modes that B nearly misses hide
  double refused = 1e-6;      ///< KKT report above which no answer is returned (see TrustLevels)
  int max_corrections = 100;  ///< reached: NotConverged
  ProgressHook progress = {};  ///< called after every correction that is not the last
  double contact = 0;         ///< to which the contact solver works, relative to the largest |u|; 0: to round-off
};

/// The options for a relative error of `asked` at best. Who asks for little gets little, with a warning: the report may
/// be ten times as large.
CorrectionOptions corrections_to(double asked);

/// The iterated penalty method (an augmented Lagrangian in the layer stress p = compliance^-1 B u). One factorisation
/// of the moderately penalised K = A1 + delta^-1 B' M B; the true problem enters through the residual in split form
/// only:
///     r1 = L - A1 u - B' M p + lambda            r2 = compliance p - B u
///     K du = r1 + delta^-1 B' M r2 + dlambda     dp = (B du - r2) / delta
/// with the contact conditions solved on Gamma_C in every correction. No digit of A1 is ever added to a large one, so
/// the answer is right at every compliance down to and including 0, where it solves (7) exactly. Throws NotConverged,
/// with how far it came, after max_corrections or where B u = 0 cannot be met. The caller has asked the factor whether
/// it fits. Its steps are a page each: the loop is
/// corrections.hpp.
Solution iterated_penalty(const VariationalInequality& problem, PenaltyFactor& factor, const ContactSolver& contact,
                          const CorrectionOptions& options, const std::string& name);

}  // namespace antilock
