#pragma once
#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "antilock/core/progress.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/contact.hpp"
#include "antilock/solve/defaults.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/solve/penalised_cholesky.hpp"

namespace antilock {

struct CorrectionOptions {
  double tolerance = 1e-10;  ///< on the relative algebraic error of u in the maximum norm: far below that of any mesh
  int max_corrections = defaults::max_corrections;  ///< reached: NotConverged
  ProgressHook progress = {};                       ///< called after every correction that is not the last
  double contact_tolerance = 0;  ///< to which the contact solver works, relative to the largest |u|; 0: to round-off

  /// The KKT violation above which no solution is returned: a u that is right to the tolerance has some of it. A large
  /// tolerance gives little accuracy, with a warning.
  double kkt_fail() const { return std::max(KktTolerances{}.fail, 10 * tolerance); }
};

struct ActiveSetOptions {
  CorrectionOptions corrections;
  std::optional<double> penalty;  ///< delta where compliance is smaller; empty: choose_penalty
  ContactReduction reduction = ContactReduction::automatic;  ///< of the factor, where the solver makes it
  int max_contact_iterations =
      1000;  ///< of a correction's contact iteration, which ends, but perhaps late; reached: NotConverged
  std::optional<BoundStatuses> start;  ///< C: statuses to start from; empty: the nested start
};

/// Solves the discrete problem, and cannot know whether the element locks: `solve` (analysis/solve.hpp) reports that.
///
/// Two loops. The outer one is the iterated penalty method: the proximal point method on the dual problem for the layer
/// stress p = compliance^-1 B u (R. T. Rockafellar, SIAM J. Control Optim. 14, 1976). Its step is 1 / (delta -
/// compliance), since each correction satisfies B u = compliance p + (delta - compliance) dp with the new u and p. It
/// corrects u and p by one factor of the penalised A_delta = K = A1 + delta^-1 B' M B. The inner one finds the contact
/// set of each correction:
///
///     repeat, correction 0 the first solve:
///              r1 = L - A1 u - B' M p + lambda,   r2 = compliance p - B u       exact: residual.hpp
///              K du = r1 + delta^-1 B' M r2 + dlambda, with the bounds of u     contact.hpp
///              u += du,   p += dp = (B du - r2) / delta
///              stop where the estimated error of u is within the tolerance      forward_error.hpp
///     then:    add the error of nearly dependent rows, check the KKT conditions: forward_error.hpp, kkt.hpp
///              a warning, or NotConverged
///
/// No digit of A1 is ever added to a large one, so the answer is right at every compliance down to and including 0,
/// where it solves (7) exactly. Once the contact set stays, a mode with a0 = sigma a1 is multiplied by (delta -
/// compliance) / (delta + sigma) < 1 in each correction: it converges for every delta, fast where delta is small beside
/// sigma, and Anderson's mix (anderson.hpp) does the rest. After 15 corrections the next 15 are made with delta / 64.
///
/// To read in this order: problem/variational_inequality.hpp, bound_status.hpp, contact.hpp, residual.hpp, this,
/// forward_error.hpp; the constants with their reasons are in defaults.hpp. The outer loop stands in active_set.cpp,
/// IteratedPenalty::solve. A loop that stops otherwise, after five corrections say, changes the one condition there;
/// `finalise` checks the last correction all the same, and throws where it is not within the tolerance.
///
/// Without contact unknowns this is a linear solve. counters.contact are the steps on the finest level, the largest
/// number over the corrections. Throws Error for a malformed problem, NotConverged instead of ever returning an
/// unconverged answer. A constraint on c . u gets a slack variable
/// (slack_form.hpp).
Solution active_set(const VariationalInequality& problem, const ActiveSetOptions& options = {});

/// The same with a factor made before, for a sweep over loads, bounds or compliances of one pair (A1, B).
Solution active_set(const VariationalInequality& problem, PenalisedCholesky& factor,
                    const ActiveSetOptions& options = {});

/// Solves the contact problem of one correction, in which v and lambda count from what they are so far: a SchurComplementContact
/// or a SparseContact, as the factor was made. `before`: of the last correction, empty at first; `u_scale`: the largest
/// |u|.
using ContactSolver =
    std::function<ContactResult(ContactSystem&, const Bounds&, const ContactResult& before, double u_scale)>;

/// The outer loop, with any solver of the inner problem. Throws as active_set does; `name` is the solver's.
Solution iterated_penalty(const VariationalInequality& problem, PenalisedCholesky& factor, const ContactSolver& contact,
                          const CorrectionOptions& options, const std::string& name);

}  // namespace antilock
