#pragma once
#include <functional>
#include <vector>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// The two bounds of a contact unknown with friction, as indices of Bounds: a lower bound on the
/// normal displacement, and lower = upper = 0 on the tangential one, with a force limit.
struct FrictionPair {
  int normal;
  int tangential;
};

struct CoulombOptions {
  double coefficient;  ///< F > 0, dimensionless
  /// The largest accepted distance of the force limits from the fixed point: the sum of the
  /// absolute values, relative to the sum of the limits. The distance is estimated as change / (1 -
  /// contraction), with a contraction of at most 0.9.
  double tolerance = 1e-8;
  int max_steps = 100;
};

/// The course of a fixed-point iteration.
struct FixedPointReport {
  int steps = 0;           ///< problems solved
  double contraction = 0;  ///< the change of the last step divided by that of the step before
};

struct CoulombSolution {
  Solution solution;
  FixedPointReport report;
};

/// Solves a contact problem with Coulomb's friction: a tangential force of at most F lambda, with
/// lambda the normal force of the same pair, and of exactly F lambda against the motion where the
/// body slips. This is no variational inequality, because the limit depends on the solution. It is
/// the fixed point of Tresca's problem with the limits g (J. Necas, J. Jarusek, J. Haslinger, Boll.
/// Un. Mat. Ital. 17-B, 1980):
///
///     g  ->  solve the problem with the force limits g  ->  g_i = F lambda_i
///
/// The iteration starts at g = 0 and ends when the limits are as near to the fixed point as the
/// tolerance asks. It contracts if F is small enough. How small depends on the problem: the
/// contraction is F times the change of the normal forces under a unit change of the limits. Where
/// it does not contract there may still be a solution, or several.
///
/// The problem keeps the last limits, those of the returned solution. Throws Error for pairs out of
/// range and a coefficient that is not positive. Throws NotConverged where three steps in a row
/// reduce the change by less than one per cent, and after max_steps. `solver` may throw as well.
CoulombSolution coulomb_friction(
    VariationalInequality& problem, const std::vector<FrictionPair>& pairs,
    const CoulombOptions& options,
    const std::function<Solution(const VariationalInequality&)>& solver);

}  // namespace antilock
