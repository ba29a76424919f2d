#pragma once
#include <functional>

#include "antilock/core/detail/progress.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/contact.hpp"
#include "antilock/solve/detail/tuned.hpp"
#include "antilock/solve/penalty_factor.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// The contact problem of one correction: v and lambda count from what they are so far.
struct ContactQuestion {
  ContactSystem& system;  ///< DenseContact or SparseContact, as the factor was made
  const Stairs& stairs;
  const ContactAnswer& before;  ///< of the last correction; empty at first
  double u_scale;               ///< largest |u| so far
};
using ContactSolver = std::function<ContactAnswer(const ContactQuestion&)>;

struct CorrectionOptions {
  double tolerance = 1e-10;                       ///< on the relative algebraic error of u in the maximum norm
  double refused = 1e-6;                          ///< KKT report above which no answer is returned (see TrustLevels)
  int max_corrections = tuned::most_corrections;  ///< reached: NotConverged
  ProgressHook progress = {};                     ///< called after every correction that is not the last
  double contact = 0;  ///< to which the contact solver works, relative to the largest |u|; 0: to round-off
};

/// The options for a relative error of `asked` at best. Who asks for little gets little, with a warning: the report may
/// be ten times as large.
CorrectionOptions corrections_to(double asked);

/// The iterated penalty method: the proximal point method on the dual problem for the layer stress p = compliance^-1 B
/// u, with step 1/delta (R. T. Rockafellar, SIAM J. Control Optim. 14, 1976). One factor of the moderately penalised K
/// = A1 + delta^-1 B' M B; the true problem enters through its residual alone, in twofold precision (residual.hpp):
///
///     r1 = L - A1 u - B' M p + lambda            r2 = compliance p - B u
///     K du = r1 + delta^-1 B' M r2 + dlambda     dp = (B du - r2) / delta
///
/// with the contact conditions solved in every correction. No digit of A1 is ever added to a large one, so the answer
/// is right at every compliance down to and including 0, where it solves (7) exactly.
///
/// Once the contact set stays, a mode with a0 = sigma a1 is multiplied by (delta - compliance) / (delta + sigma) < 1 in
/// each correction: it converges for every delta, fast where delta is small beside sigma, and Anderson's mix
/// (anderson.hpp) does the rest. After 15 corrections the next 15 are made with delta / 64 (tuned.hpp). Throws
/// NotConverged, with how far it came, after max_corrections, and as judge.hpp says where no u is admissible or the
/// answer does not hold. The caller has asked the factor whether it fits.
Solution iterated_penalty(const VariationalInequality& problem, PenaltyFactor& factor, const ContactSolver& contact,
                          const CorrectionOptions& options, const std::string& name);

}  // namespace antilock
