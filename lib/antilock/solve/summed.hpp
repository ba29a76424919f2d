#pragma once
/// Exhibits, to be compared against: what most codes do. The forms are summed into one matrix in double precision, and
/// the sum forgets A1 digit by digit as the compliance falls; use active_set or uzawa instead.
#include "antilock/solve/penalised_matrix.hpp"
#include "antilock/solve/uzawa.hpp"

namespace antilock {

/// K u = load on the free unknowns, K = A1 + compliance^-1 B' M B.
struct SummedSystem {
  DofOrdering ordering;
  SparseMatrix upper_triangle;  ///< n_free x n_free, the upper triangle of K
  Eigen::VectorXd load;         ///< n_free: what the prescribed values leave of it
  Eigen::VectorXd u;            ///< N: the prescribed values, 0 elsewhere
};

/// Throws Error, `who` first, at compliance = 0, where the sum does not exist, and for bounds other than lower ones on
/// unknowns; `instead` is the solver that takes that compliance.
SummedSystem summed_system(const VariationalInequality& problem, const std::string& who, const char* instead);

enum class SummedFactor { cholesky, lu };  ///< CHOLMOD; UMFPACK

/// How the naive solver ended. None of them says that the answer is right.
enum class ConvergedReason {
  converged,            ///< the contact set reproduced itself
  cycled,               ///< a contact set came back: it would go round for ever
  linear_solve_failed,  ///< the factorisation gave up, or returned something that is not finite
  max_iterations,       ///< max_steps reached
};

std::string to_string(ConvergedReason reason);

/// An answer that nobody has vouched for: solution.kkt is the report in split form, as it is, and no level of trust was
/// applied. p is compliance^-1 B u, where u has lost the digits that p is made of.
struct NaiveResult {
  Solution solution;
  ConvergedReason reason = ConvergedReason::converged;
};

/// The sum, factored in every step of a primal-dual active set that starts from no contact. Throws as summed_system
/// does.
NaiveResult naive_summed_solve(const VariationalInequality& problem, SummedFactor kind, int max_iterations = 100);

/// The paper's algorithm with the paper's linear solver (Section 4.2): one run of conjugate gradients on the sum,
/// preconditioned by ILUT, a step. ILUT breaks down on stiff meshes that are not aligned with the layer, which is
/// reported, never returned as an answer. Throws as summed_system does, and for options.stop_at: the duality gap asks
/// for the matrix condensed on Gamma_C.
Solution uzawa_cg_ilut(const VariationalInequality& problem, const UzawaOptions& options = {});

}  // namespace antilock
