#pragma once
#include "antilock/exact/exact_solution.hpp"

namespace antilock {

/// ||u_a - u_b||_{1,Omega}, the norm of Theorem 1, of two exact solutions, body and layer together: by Parseval's theorem on
/// rows y = const, and Gauss' rule over the rows. They may differ in epsilon, load and points.
double h1_distance(const ExactSolution& a, const ExactSolution& b);

/// ||u||_{2,Omega+} + ||u||_{2,Omega-}, the right side of (28) and (31), by the same rule: each the root of the
/// integral of u^2 + |grad u|^2 + u_xx^2 + 2 u_xy^2 + u_yy^2.
double h2_norm(const ExactSolution& exact);

/// |p| in L2 of the layer, p = epsilon^-2 d/dy u (its limit at epsilon = 0), by the same rule. The stiff part of (5) is
/// epsilon^2 |p|^2.
double stress_norm(const ExactSolution& exact);

/// ||u||_{1,Omega-}, body left out, by the same rule: what is lost where a locked layer does not move.
double layer_norm(const ExactSolution& exact);

/// ||u - v||_{1,Omega} for the v that is 0 on the layer and solves -Delta v = f on the body clamped on Sigma, too: how far
/// from the limit u (epsilon = 0) a method tends to that locks altogether. In the body u - v is the sum of
/// w_k sin(k pi x) sinh(a (1 - y)) / sinh(a), w_k the waves of u on Sigma.
double clamped_distance(const ExactSolution& limit);

/// Squares of second derivatives, by the same rule: |u|_2^2 on the body, the integral of u_xx^2 + 2 u_xy^2 + u_yy^2; on
/// the layer F^2, that of u_xx^2 + epsilon^-2 u_xy^2; and of p_x^2 on the layer, which grows without a bound as epsilon
/// tends to 0 where contact ends. For a load in L2 the first plus twice the second is its square
/// (tutorials/guides/uniform_rate.md).
struct Regularity {
  double body, layer, stress_x;
};
Regularity regularity(const ExactSolution& exact);

}  // namespace antilock
