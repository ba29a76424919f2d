#pragma once
#include <optional>
#include <string>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// What an answer has lost because its layer does not follow. J(v) = a(v, v)/2 - L(v); v is a function of K that is
/// free to move in the layer.
struct LostEnergy {
  static constexpr double telling = 0.05;  ///< v is within a few per cent of the best: whoever has lost 10 % is told so
  double lost = 0;    ///< J(u_h) - J(v), a lower bound of J(u_h) - J(u): negative where v is the worse of the two
  double motion = 0;  ///< what the motion of the layer is worth: the larger of J(v_0) - J(v) and |v - v_0|_a^2 / 2, v_0
                      ///< the function whose layer is held at 0
  double doubt = 0;   ///< what J(v) owes to bounds that keep v above the obstacle between its points, at most
  int unknowns = 0;   ///< of the problem solved for v

  double scale = 0;  ///< |J(u_h)|

  /// The share that is lost, 0 to 1; 0 where the motion is worth less than 1e-8 of J(u_h). Empty where v tells nothing: it
  /// has more energy than u_h by a twentieth of the motion, or its doubt decides whether a twentieth is lost.
  std::optional<double> share() const;
};

/// For P1 or P2 on a mesh with a layer, of (23) or (22); derivation in lost_energy.cpp. Costs a small part of the solve.
/// P1 takes every scene but a load on the layer, P2 those of the paper. Throws Error for others, for another element or
/// without a layer's mesh, and what active_set throws.
LostEnergy lost_energy(const Scene& scene, const Space& space, const VariationalInequality& problem,
                       const Solution& solution);

/// What an answer to a scene with a layer says of its own locking.
struct LayerReport {
  std::string diagnosis;       ///< one line: whether the method follows the layer as epsilon -> 0, and why
  std::optional<double> lost;  ///< LostEnergy::share(), where the method can lock
  std::string
      warning;  ///< empty, or one sentence with the word "locks", the share, how it is known (proved; by a law where
                ///< `lost` is empty) and the remedies
  double motion = 0;  ///< LostEnergy::motion, what `lost` is a share of
};
/// Empty for a scene without a layer. The number is made where lost_energy is, and on layers in columns for none: what can
/// be told from the mesh costs nothing. Elsewhere the law of bending speaks, and nothing is proved.
std::optional<LayerReport> report_layer(const Scene& scene, const Space& space, const VariationalInequality& problem,
                                        const Solution& solution);

}  // namespace antilock
