#pragma once
#include <functional>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/penalised_cholesky.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

struct ProximalGalerkinOptions {
  /// The iteration stops where a proximal step changes each |s_i| / sqrt(F_ii) by at most this
  /// number times the largest one (or times 1e-6 R, if that is larger), see below.
  double tolerance = 1e-10;
  /// alpha_k, the length of proximal step k = 0, 1, ..., a positive number. Empty: 2^k.
  std::function<double(int)> step_length = {};
  int max_proximal_steps = 100;  ///< after these: NotConverged
  int max_newton_steps = 100;    ///< in one proximal step; after these: NotConverged
  /// For the linear solves. The default tolerance is smaller than that of active_set, because the
  /// errors of w and F lambda may exceed that of their sum s.
  CorrectionOptions corrections{.tolerance = 1e-12};
};

/// Returns whether a Newton step for the latent variable (C) has converged: whether it moves each
/// psi_i by at most 1e-7 (1 + |moved_i|). `moved` (C) is the change of psi in the proximal step so
/// far. Convergence is quadratic, so that the step after it would move psi by the square.
bool newton_step_has_converged(const Eigen::VectorXd& step, const Eigen::VectorXd& moved);

/// Solves by the latent variable proximal point method: proximal Galerkin (B. Keith and T. M.
/// Surowiec, Found. Comput. Math., 2024; J. S. Dokken, P. E. Farrell, B. Keith, I. P. A.
/// Papadopoulos and T. M. Surowiec, Comput. Methods Appl. Mech. Engrg., 2025), with a lumped latent
/// variable: one number psi_i per bound. The bounded values s (C entries, bounded_values(u) of
/// problem/bounds.hpp) are images of psi, so that they lie strictly inside their bounds:
///
///     s_i = lower_i + r_i exp(psi_i)                                 a lower bound alone
///     s_i = upper_i - r_i exp(-psi_i)                                an upper bound alone
///     s_i = lower_i + (upper_i - lower_i) / (1 + exp(-psi_i))        both
///
/// A proximal step minimises J(u) plus 1 / alpha_k times the Bregman divergence of the entropy that
/// belongs to this map, from the last u. Its optimality conditions are, with psi' of the last step,
///
///     A1 u + B' M p = L + E' lambda,   B u = compliance p
///     lambda_i = c_i (psi'_i - psi_i) / alpha_k
///
/// Nothing is divided by the compliance, so that compliance 0 is a value like any other. Let w be
/// the bounded values without any force, and F (C x C) the flexibility matrix of the bounds: F
/// lambda is the change of s by forces lambda (flexibility.hpp). Both come from C + 1 linear solves
/// by the iterated penalty method, so that they have the digits of A1. The step becomes a system of
/// C equations,
///
///     s(psi) + F diag(c) (psi - psi') / alpha_k = w
///
/// Newton's method for it has the same iterates as Newton's method for the system above. Its matrix
/// diag(s'(psi)) + F diag(c) / alpha_k is symmetric positive definite after scaling, also where F
/// is singular, because the system is the condition for the minimum of a strictly convex function
/// of psi.
///
/// The scales make the iteration independent of all units: R = max_i |w_i - bound_i| / sqrt(F_ii),
/// r_i = R sqrt(F_ii), c_i = R / (sqrt(F_ii) G), where G is the largest row sum of
/// |F_ij| / sqrt(F_ii F_jj). The first psi is 0.
///
/// A proximal step has a solution if and only if forces can move all bounded values strictly inside
/// of their bounds at once: if K_h has an inner point. On a mesh that locks completely K_h contains
/// only one u at compliance 0, and the flexibility of a bound is 0. The method then throws
/// NotConverged. (active_set returns this u.) It may also throw it for active bounds that depend on
/// each other, as two bounds on one value do: F is singular on them, and s'(psi) is 0 in double
/// precision, so that no psi is determined.
///
/// At a bound that is just touched, s_i = lower_i and lambda_i = 0, the distance falls like
/// 1 / alpha_k, some 35 proximal steps in all. At the other bounds it falls like
/// exp(-lambda_i alpha_k / c_i).
///
/// Solution::history has the relative change of s in each proximal step, and
/// Counters::contact_iterations counts all Newton steps, one dense factorisation each. u, p and
/// lambda belong together, as the last linear solve leaves them: s differs from s(psi) by round-off
/// and may violate a bound by that. A bound counts as active where |lambda_i| F_ii is larger than
/// the distance from the bound. Without bounds, or where w violates none, it is one linear solve.
///
/// Throws Error for a malformed problem or option, for an equation lower = upper, and for force
/// limits. Throws NotConverged where a proximal step has no solution, and in place of a solution
/// that has not converged.
Solution proximal_galerkin(const VariationalInequality& problem,
                           const ProximalGalerkinOptions& options = {});

/// Does the same with a factor of the problem without its bounds (`bounds` is {}), which serves
/// every load, every bound and every compliance of one pair (A1, B). Throws Error for a factor of
/// other matrices, or of a problem with bounds.
Solution proximal_galerkin(const VariationalInequality& problem, PenalisedCholesky& factor,
                           const ProximalGalerkinOptions& options = {});

}  // namespace antilock
