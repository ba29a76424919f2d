#pragma once
#include <limits>
#include <optional>

#include "antilock/core/progress.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/penalised_cholesky.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// An algebraic error that is balanced with the discretisation error, so that further iterations
/// would not improve the solution (A. Ern and M. Vohralik, SIAM J. Sci. Comput. 35, 2013).
/// certificate/balanced_tolerance.hpp computes it. v is the iterate projected onto the admissible
/// set, J the energy with the penalty delta in place of a smaller compliance.
struct AlgebraicTolerance {
  double energy = 0;    ///< the accepted J(v) - J(u_h)
  double relative = 0;  ///< the accepted |v - u_h|_a / |u_h|_a, in the energy norm of J
};

struct UzawaOptions {
  /// The iteration stops where |change of lambda| / rho in one step, divided by the largest |u|, is
  /// at most this number. (|change of lambda| / rho has the unit of u.)
  double tolerance = 1e-10;
  int max_iterations = 1'000'000;  ///< steps of all corrections together; after these: NotConverged
  /// Wall seconds after which NotConverged is thrown.
  double max_seconds = std::numeric_limits<double>::infinity();
  /// The step length rho. Empty: 2 / (largest + smallest eigenvalue) of the flexibility matrix
  /// S^-1, where S is the Schur complement of the contact unknowns. If scaling S^-1 to a unit
  /// diagonal improves its condition, the formula is applied to the scaled matrix, and unknown i
  /// has the resulting step length divided by (S^-1)_ii. Lanczos iteration computes the
  /// eigenvalues.
  std::optional<double> step_length;
  /// Stops as soon as the duality gap, computed every 32 steps, proves J(v) - J(u_h) <=
  /// stop_at->energy for the problem of a correction. If compliance >= delta, that is the given
  /// problem. Otherwise it is the problem with delta in place of the compliance.
  std::optional<AlgebraicTolerance> stop_at;
  ProgressHook progress = {};  ///< called every 32 steps and after each correction but the last
};

/// Solves by Uzawa's method, the algorithm of [SR04], Section 4.2 (cited in
/// problem/variational_inequality.hpp). It is a projected gradient method for the contact forces
/// (multipliers) lambda on the contact boundary Gamma_C:
///
///     u solves A u = L + lambda,   lambda <- max(0, lambda - rho (u - lower))   on Gamma_C
///
/// Here A = A1 + compliance^-1 B' M B. With upper bounds min(0, lambda - rho (u - upper)) is added,
/// and |lambda| is cut to force_limit. The problem is condensed on the C bounds by a Cholesky
/// factor, so that a step costs one product with the dense C x C flexibility matrix. The stiff form
/// is treated by the iterated penalty method, and constraints in slack form, as in active_set.
/// Solution::history has one entry per step. Throws Error for a malformed problem or option, and
/// NotConverged, with the last relative step, in place of a solution that has not converged.
Solution uzawa(const VariationalInequality& problem, const UzawaOptions& options = {});
/// Does the same with a factor that exists already, made with ContactReduction::schur_complement.
/// Throws Error for another one.
Solution uzawa(const VariationalInequality& problem, PenalisedCholesky& factor,
               const UzawaOptions& options = {});

}  // namespace antilock
