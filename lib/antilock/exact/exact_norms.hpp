#pragma once
#include "antilock/exact/exact_solution.hpp"

namespace antilock {

/// Returns ||u_a - u_b||_{1,Omega} of two exact solutions, the norm of Theorem 1 of [SR04] (cited
/// in problem/variational_inequality.hpp), over body and layer together. It is computed by
/// Parseval's theorem on rows y = const, and by Gauss's rule over the rows. The solutions may
/// differ in epsilon, load and number of points. Omega+ is the body, Omega- the layer, and Sigma
/// the interface of both.
double h1_distance(const ExactSolution& a, const ExactSolution& b);

/// Returns ||u||_{2,Omega+} + ||u||_{2,Omega-}, the right side of (28) and (31), by the same rule.
/// Each norm is the root of the integral of u^2 + |grad u|^2 + u_xx^2 + 2 u_xy^2 + u_yy^2.
double h2_norm(const ExactSolution& exact);

/// Returns the L2 norm of p = epsilon^-2 d/dy u (at epsilon = 0 its limit) on the layer, by the
/// same rule. The stiff part of (5) is epsilon^2 |p|^2.
double stress_norm(const ExactSolution& exact);

/// Returns ||u||_{1,Omega-}, by the same rule. This is the error on the layer of a method in whose
/// solution the layer does not move.
double layer_norm(const ExactSolution& exact);

/// Returns ||u - v||_{1,Omega} for the v that is 0 on the layer and solves -Delta v = f on the
/// body, clamped on Sigma as well. A method that locks completely tends to v. So this norm is the
/// limit of its error at epsilon = 0, where u is the solution of the limit problem. In the body u -
/// v is the sum of w_k sin(k pi x) sinh(a (1 - y)) / sinh(a), w_k the waves of u on Sigma.
double clamped_distance(const ExactSolution& limit);

/// Integrals of squared second derivatives, by the same rule. `body` is |u|_2^2, the integral of
/// u_xx^2 + 2 u_xy^2 + u_yy^2 over the body. `layer` is F^2, the integral of u_xx^2 + epsilon^-2
/// u_xy^2 over the layer. `stress_x` is the integral of p_x^2 over the layer. It grows without
/// bound as epsilon tends to 0, because p jumps where contact ends. For a load f in L2, |u|_2^2 + 2
/// F^2 = |f|^2 (tutorials/guides/uniform_rate.md).
struct Regularity {
  double body, layer, stress_x;
};
Regularity regularity(const ExactSolution& exact);

}  // namespace antilock
