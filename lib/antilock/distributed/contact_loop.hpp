#pragma once
#include <optional>

#include "antilock/core/progress.hpp"
#include "antilock/distributed/detail/distributed_problem.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock::distributed {

/// The part of a start or of a solution that belongs to this rank.
struct State {
  Eigen::VectorXd u;         ///< at every unknown of the subdomain
  Eigen::VectorXd p;         ///< the layer stress, per row of B of the subdomain
  std::vector<char> active;  ///< per owned row: whether it is in contact
};
/// Returns u = 0 and p = 0 with an empty contact set.
State zero_state(const DistributedProblem& problem);

/// The preconditioner of the conjugate gradients of a correction.
enum class Preconditioner {
  multigrid,  ///< BoomerAMG on A_delta: for a layer in columns
  strips,     ///< two levels that know the kernel of B (detail/strip_multigrid.hpp): for any layer
  factor,     ///< a factor of A_delta by MUMPS: for any layer, but it scales badly with the ranks
};

struct LoopOptions {
  /// The largest |du| of the last correction, relative to the largest |u|.
  double tolerance = 1e-10;
  double residual = 1e-9;  ///< the largest residual of the equations, relative to the largest force
  /// Number of smoothing steps, which replace the first correction and need no multigrid
  /// (contact_loop).
  int smoothings = 0;
  int max_iterations = 500;  ///< of conjugate gradients, per correction
  int max_corrections = 60;  ///< since the last change of the contact set
  /// Called on every rank before each correction and after the last one; `false` on one rank stops
  /// all ranks.
  ProgressHook progress;
  /// Empty: the choice of solve_nested, and multigrid in contact_loop.
  std::optional<Preconditioner> preconditioner;
};

/// Counts and times of the loop. The counts are the same on every rank.
struct LoopReport {
  int corrections = 0;        ///< linear solves
  int set_changes = 0;        ///< changes of the contact set
  int setups = 0;             ///< of the preconditioner
  int linear_iterations = 0;  ///< of conjugate gradients, all corrections
  int max_iterations = 0;     ///< the same, for the correction with the most iterations
  /// The largest |du| of the last correction, relative to the largest |u|.
  double change = 0;
  double seconds_setup = 0, seconds_solve = 0;
  /// The processor time of this rank in seconds. On a shared machine it is less than the elapsed
  /// time.
  double processor = 0;
};

/// Solves the discrete problem by the iterated penalty method and the primal-dual active set method
/// in one loop. Each correction
///
///     (A1 + delta^-1 B' M B) du = r1 + delta^-1 B' M r2  off the contact set,
///                            du = bound - u              on it
///
/// is solved by conjugate gradients, to a relative accuracy of 1e-4 in the energy norm. With
/// Preconditioner::strips the error must also fall below 1e-6 of sqrt(L' u), the energy norm of the
/// iterate: the residual after a change of the contact set is large and stiff, and 1e-4 of it may
/// hide the soft part that decides the next set, which would then cycle (measured: more than 200
/// sets for delta far below h^2, and 3 to 6 corrections with this condition). The first
/// correction uses the contact set of the start. Before each later one, a point of the set stays in
/// it if the bound presses on it (r1 < 0), and another point enters it if u is below the bound.
/// With Preconditioner::strips a point stays, too, if r1 is below the largest |r1| off the set,
/// which is the error of the last solve. The loop ends where the set has not changed, `tolerance`
/// and `residual` are met, and r1 <= 0 on the set or at the level of round-off. (A1, B, M, r1, r2
/// and delta are those of detail/distributed_problem.hpp.) The preconditioner is set up again if
/// the set has changed; of the strips only those with a changed point are factored again. The old
/// hierarchy of multigrid would need up to four times as many iterations, because a released point
/// frees a whole column of the layer.
///
/// The error of a start from a coarser level consists of short waves. A few smoothing steps remove
/// them, so that the contact set is then nearly right and multigrid is set up only once. Residuals
/// are computed from A1, B, M and p, never from the summed matrix on the left.
///
/// Every rank must call it. Throws on every rank: NotConverged where it does not converge, and
/// Interrupted where the progress hook returns false.
LoopReport contact_loop(const DistributedProblem& problem, State& state,
                        const LoopOptions& options = {});

}  // namespace antilock::distributed
