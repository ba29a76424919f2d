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

/// Options of the outer loop.
struct CorrectionOptions {
  /// The tolerance for the estimated algebraic error of u in the maximum norm, relative to the
  /// largest |u|. The default is far below discretisation errors.
  double tolerance = 1e-10;
  int max_corrections = defaults::max_corrections;  ///< after these: NotConverged
  ProgressHook progress = {};                       ///< called after each correction but the last
  /// The accuracy of the contact solver, relative to the largest |u|. 0: it is exact up to
  /// round-off.
  double contact_tolerance = 0;

  /// Returns the KKT violation above which no solution is returned: max(KktTolerances::fail, 10
  /// tolerance). It grows with the tolerance, because a u whose error is equal to the tolerance
  /// violates the KKT conditions by about as much.
  double kkt_fail() const { return std::max(KktTolerances{}.fail, 10 * tolerance); }
};

struct ActiveSetOptions {
  CorrectionOptions corrections;
  /// delta is the larger one of this penalty and the compliance. Empty: choose_penalty. Not used if
  /// a factor is given.
  std::optional<double> penalty;
  ContactReduction reduction = ContactReduction::automatic;  ///< not used if a factor is given
  /// The largest number of contact iterations in one correction; NotConverged beyond.
  int max_contact_iterations = 1000;
  /// C statuses from which the first correction starts; empty: the nested start. Each later
  /// correction starts from the statuses of the one before.
  std::optional<BoundStatuses> start;
};

/// Solves a discrete variational inequality. It receives matrices and no mesh, so it cannot know
/// whether the element locks. `solve` (analysis/solve.hpp) reports that.
///
/// There are two nested loops. The outer one is the iterated penalty method: the proximal point
/// method on the dual problem for the multiplier p = compliance^-1 B u (R. T. Rockafellar, SIAM
/// J. Control Optim. 14, 1976). It corrects u and p by one Cholesky factor of
/// K = A1 + delta^-1 B' M B, where delta >= compliance is the penalty. The inner loop is the active
/// set method of contact.hpp: it finds the contact set of each correction. With L the load and
/// E' lambda the forces lambda of the bounds on the unknowns (problem/bounds.hpp):
///
///     u = 0 but for the prescribed values, p = 0, lambda = 0;  repeat:
///       r1 = L - A1 u - B' M p + E' lambda,  r2 = compliance p - B u            residual.hpp
///       solve K du = r1 + delta^-1 B' M r2 + E' dlambda with the bounds on u    contact.hpp
///       u += du,  p += dp,  lambda += dlambda,  dp = (B du - r2) / delta
///       stop where the estimated error of u is within the tolerance             forward_error.hpp
///     add the error of nearly dependent rows of B                               forward_error.hpp
///     check the KKT conditions: a warning, or NotConverged                      kkt.hpp
///
/// The length of the proximal step is 1 / (delta - compliance), because the new u and p satisfy
///
///     B u = compliance p + (delta - compliance) dp.
///
/// Rows of B with fixed compliances have penalties of their own (PenalisedCholesky::penalties).
///
/// Residuals never use the assembled sum K, so they carry no cancellation error. The factor does,
/// but this only slows the corrections down. Therefore a small compliance costs u no digits
/// (measured: tests/hard), and at compliance 0 the method solves (7) of [SR04] without a penalty
/// error (problem/variational_inequality.hpp).
///
/// Let a0(e, v) = sigma a1(e, v) for all v, sigma > 0. Once the contact set stays the same, each
/// correction multiplies the part of the error along such a mode e by (delta - compliance) /
/// (delta + sigma) < 1. So these modes converge for every delta, and fast where delta is small
/// beside sigma. Anderson's mixing (anderson.hpp) accelerates the slow ones. After every
/// defaults::corrections_per_penalty corrections delta is divided by defaults::penalty_reduction.
/// It stays at least the compliance, and at least defaults::round_off times the stiffness ratio
/// (problem/choose_penalty.hpp).
///
/// Constraints c . u are solved for in slack form (detail/slack_form.hpp). Without bounds each
/// correction is one linear solve. With finite force limits the loop does not stop at the first du,
/// unless du = 0 (active_set.cpp has the reason). Counters::contact_iterations is the largest
/// number of iterations of one correction, without those of the nested start. Throws Error for a
/// malformed problem or option, and NotConverged in place of a solution that has not converged.
///
/// Reading order: problem/variational_inequality.hpp, bound_status.hpp, contact.hpp, residual.hpp,
/// this header, forward_error.hpp. The constants and their reasons are in defaults.hpp. The outer
/// loop is IteratedPenalty::solve in active_set.cpp; to use another stopping criterion, change one
/// condition there.
Solution active_set(const VariationalInequality& problem, const ActiveSetOptions& options = {});

/// Does the same with a factor that exists already, for a sweep over loads, bounds or compliances
/// with one pair (A1, B). The factor is computed anew if its delta is below the compliance, and the
/// corrections may leave it with a smaller delta. Throws Error for a factor of other matrices.
Solution active_set(const VariationalInequality& problem, PenalisedCholesky& factor,
                    const ActiveSetOptions& options = {});

/// Solves the contact problem of one correction, in which v is an increment to the current iterate.
/// The forces of `before` and of the result are total forces, and not increments: they contain the
/// forces of the current iterate, which are the multiplier estimate of the ShiftedBounds. The
/// factor determines whether the system is a SchurComplementContact or a SparseContact. `before` is
/// the result of the last correction, and is empty in the first one. `u_scale` is the largest |u|.
using ContactSolver = std::function<ContactResult(ContactSystem&, const ShiftedBounds&,
                                                  const ContactResult& before, double u_scale)>;

/// Runs the outer loop with any solver of the inner problem. `name` is the solver's name in
/// messages. Throws as active_set does.
Solution iterated_penalty(const VariationalInequality& problem, PenalisedCholesky& factor,
                          const ContactSolver& contact, const CorrectionOptions& options,
                          const std::string& name);

}  // namespace antilock
