#pragma once
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
  /// Whether MUMPS factors the matrix. It takes the place of multigrid, and is meant for layers
  /// that are not made of columns.
  bool direct = false;
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
/// is solved by conjugate gradients with multigrid, to a relative accuracy of 1e-4. The first
/// correction uses the contact set of the start. Before each later one, a point of the set stays in
/// it if the bound presses on it (r1 < 0), and another point enters it if u is below the bound. The
/// loop ends where the set has not changed, and `tolerance` and `residual` are met. (A1, B, M, r1,
/// r2 and delta are those of detail/distributed_problem.hpp.) Multigrid is set up again if the set
/// has changed. The old hierarchy would need up to four times as many iterations, because a
/// released point frees a whole column of the layer.
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
