#pragma once
#include "antilock/core/progress.hpp"
#include "antilock/distributed/detail/distributed_problem.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock::distributed {

/// What a solve starts from and ends with, the part of this rank.
struct State {
  Eigen::VectorXd u;         ///< at every unknown of the subdomain
  Eigen::VectorXd p;         ///< the layer stress, per row of B of the subdomain
  std::vector<char> active;  ///< per owned row: in contact
};
State zero_state(const DistributedProblem& problem);

struct LoopOptions {
  double tolerance = 1e-10;  ///< largest |du| / largest |u| of the last correction
  double residual = 1e-9;    ///< of the equations, relative to the largest force
  int smoothings = 0;        ///< in place of the first correction: steps that need no multigrid (contact_loop)
  int max_iterations = 500;  ///< of conjugate gradients, per correction
  int max_corrections = 60;  ///< since the contact set changed last
  ProgressHook progress;     ///< told of each correction on every rank; `false` on any stops all
  bool direct = false;       ///< MUMPS factors the matrix in place of multigrid: for layers without columns
};

/// What the loop did; the same on every rank.
struct LoopReport {
  int corrections = 0;        ///< linear solves
  int set_changes = 0;        ///< changes of the contact set
  int setups = 0;             ///< of the preconditioner
  int linear_iterations = 0;  ///< of conjugate gradients, all corrections
  int max_iterations = 0;     ///< the same, of the correction that took most
  double change = 0;          ///< of the last correction, relative
  double seconds_setup = 0, seconds_solve = 0;
  double processor = 0;  ///< seconds that this rank's processor worked on it: on a shared machine fewer than the wall's
};

/// Iterated penalty and primal-dual active set in one loop. Each correction
///     (A1 + delta^-1 B' M B) du = r1 + delta^-1 B' M r2  off the contact set,  du = bound - u on it
/// is solved by conjugate gradients with multigrid on the contact set that the last one proposes; the multigrid is set
/// up anew where the set changed (kept, it takes up to four times the iterations: a released point frees a whole column
/// of the layer, which the old hierarchy does not know). A start from a coarser level is wrong by short waves alone, which
/// a few smoothing steps take away: the set that follows them is the right one, or nearly, and multigrid is set up once
/// and not twice. Residuals are formed from A1, B, M and p, never from A_delta.
/// Every rank must call it. Throws, on every rank, NotConverged where it does not settle, Interrupted where it is told
/// to stop.
LoopReport contact_loop(const DistributedProblem& problem, State& state, const LoopOptions& options = {});

}  // namespace antilock::distributed
