#pragma once
#include <limits>
#include <optional>

#include "antilock/core/progress.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/penalised_cholesky.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// An algebraic error that is balanced with the discretisation error (Ern and Vohralik 2013): to push it further down
/// is not worth the steps. certificate/balanced_tolerance.hpp computes it.
struct AlgebraicTolerance {
  double energy = 0;    ///< of J(v) - J(u_h), v = the iterate pushed out of the obstacle, J with the penalty delta in
                        ///< place of a smaller compliance
  double relative = 0;  ///< the same in u: of |v - u_h|_a relative to |u_h|_a, the norm with delta, too
};

struct UzawaOptions {
  double tolerance = 1e-10;  ///< on the step in the gap, |lambda - max(0, lambda - rho gap)| / rho, relative to max |u|
  int max_iterations = 1'000'000;                                ///< reached: NotConverged
  double max_seconds = std::numeric_limits<double>::infinity();  ///< wall clock; reached: NotConverged
  /// rho; empty: 2 / (largest + smallest eigenvalue of the compliance C), by Lanczos iteration, or the same of C scaled
  /// to a unit diagonal, over its diagonal, where that is better conditioned.
  std::optional<double> step_length;
  /// Stops as soon as the duality gap, computed every 32 steps, proves J(v) - J(u_h) <= stop_at->energy
  /// for the problem that a correction solves: (6) itself where compliance >= delta, else with delta in its place.
  std::optional<AlgebraicTolerance> stop_at;
  ProgressHook progress = {};  ///< called every 32 steps, and after every correction that is not the last
};

/// The paper's algorithm: projected gradient on the contact pressure,
///     A u = L + lambda,   lambda <- max(0, lambda - rho (u - lower))   on Gamma_C,
/// and + min(0, lambda - rho (u - upper)) where there is an upper bound, cut to |lambda| <= force_limit; the linear
/// solve by Cholesky. Condensed on Gamma_C (the flexibility is dense there and small) a step costs a product with a C x
/// C matrix; the stiff part is treated by iterated penalty, as in active_set. history holds one entry per step. Throws
/// NotConverged, with how far it came, instead of ever returning an unconverged answer. Bounds of other shapes as in
/// active_set.
Solution uzawa(const VariationalInequality& problem, const UzawaOptions& options = {});
Solution uzawa(const VariationalInequality& problem, PenalisedCholesky& factor, const UzawaOptions& options = {});

}  // namespace antilock
