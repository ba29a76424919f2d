#pragma once
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/penalty_factor.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Two numbers with the energy J(u) of the exact solution between them, computed without knowing it.
struct EnergyBracket {
  double lower = 0;  ///< energy_lower_bound of a Crouzeix-Raviart solution
  double upper = 0;  ///< J of a function of K: energy() of a P1 solution, since K_h is part of K

  double width() const { return upper - lower; }
};

/// A lower bound of J(u) at every epsilon in [0, 1], proved (derivation in energy_bracket.cpp) up to round-off, for the
/// load as sampled. It lies below the energy of the Crouzeix-Raviart solution by O(h^2), however small epsilon is: that
/// energy alone is no bound. It holds with a gap, with nonzero fixed values and for a solve stopped early; `factor` as
/// for unbalanced(). Sharper with a function of K at hand: certify(). Throws Error as equilibrated_flux does.
double energy_lower_bound(const Scene& scene, const Space& space, const VariationalInequality& problem,
                          const Solution& solution, PenaltyFactor* factor = nullptr);

}  // namespace antilock
