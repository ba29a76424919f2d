#pragma once
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Two numbers with the energy J(u) of the exact solution between them, computed without knowing it.
struct EnergyBracket {
  double lower = 0;  ///< energy_lower_bound of a Crouzeix-Raviart solution
  double upper = 0;  ///< J of a function of K: energy() of a P1 solution, since K_h is part of K

  double width() const { return upper - lower; }
  /// At least |u - u_h| in the energy norm of Remark 4, u_h the P1 solution: |u - v|_a^2 / 2 <= J(v) - J(u) on K.
  double error_bound() const;
};

/// A lower bound of J(u) at every epsilon in [0, 1], proved (derivation in energy_bracket.cpp) up to round-off and the
/// rule that integrates the load. It lies below the energy of the Crouzeix-Raviart solution by O(h^2), however small
/// epsilon is: that energy alone is no bound. `f` is the load of the body that the problem was assembled with.
/// Throws Error for another element, another obstacle than u >= 0, and where the layer is a Ventcel term.
double energy_lower_bound(const Space& space, const VariationalInequality& problem, const Solution& solution,
                          const Field& f);

}  // namespace antilock
