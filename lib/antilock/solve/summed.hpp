#pragma once
/// Reference implementations, for comparison only: they assemble both forms into one matrix in
/// double precision, as most codes do, and this sum loses the digits of A1 as the compliance falls.
/// Use active_set or uzawa instead.
#include "antilock/solve/penalised_matrix.hpp"
#include "antilock/solve/uzawa.hpp"

namespace antilock {

/// The assembled system K u = load on the n_free free unknowns, K = A1 + compliance^-1 B' M B.
struct SummedSystem {
  DofOrdering ordering;
  SparseMatrix upper_triangle;  ///< n_free x n_free, the upper triangle of K
  Eigen::VectorXd load;         ///< n_free: L - K u of the prescribed values
  Eigen::VectorXd u;            ///< N: the prescribed values, 0 elsewhere
};

/// Assembles the system. Throws Error for rows of B with fixed compliances, and for bounds other
/// than lower bounds on unknowns. Throws Error also at compliance = 0 where B has rows, because K
/// does not exist then. The message begins with `who` and recommends the solver `instead`.
SummedSystem summed_system(const VariationalInequality& problem, const std::string& who,
                           const char* instead);

enum class SummedFactor { cholesky, lu };  ///< CHOLMOD; UMFPACK

/// The reason why the naive solver ended. No value implies that the solution is right.
enum class ConvergedReason {
  converged,            ///< the contact set is that of the iteration before
  cycled,               ///< an earlier contact set came back, and the iteration would not end
  linear_solve_failed,  ///< the factorisation failed, or its solution is not finite
  max_iterations,       ///< the largest number of iterations was reached
};

/// Returns "settled", "cycled", "refused" or "step cap", in this order.
std::string to_string(ConvergedReason reason);

/// A solution without any guarantee: solution.kkt is its KKT report, which was compared with no
/// tolerance. p is compliance^-1 B u. Where u has locked, B u has lost the digits of p.
struct NaiveResult {
  Solution solution;
  ConvergedReason reason = ConvergedReason::converged;
};

/// Solves by the primal-dual active set method, which starts without contact and factors K on the
/// inactive unknowns in every iteration. Throws as summed_system does.
NaiveResult naive_summed_solve(const VariationalInequality& problem, SummedFactor kind,
                               int max_iterations = 100);

/// Solves by the algorithm and the linear solver of [SR04], Section 4.2 (cited in
/// problem/variational_inequality.hpp): Uzawa's method, in which each step solves with K by
/// conjugate gradients and an ILUT preconditioner. Throws NotConverged where ILUT breaks down, as
/// it does for small epsilon on meshes that are not aligned with the layer, and where an iteration
/// does not converge. Throws Error as summed_system does and for options.stop_at, which needs the
/// condensed matrix.
Solution uzawa_cg_ilut(const VariationalInequality& problem, const UzawaOptions& options = {});

}  // namespace antilock
