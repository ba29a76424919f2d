#pragma once
#include "antilock/core/eigenvalues.hpp"
#include "antilock/solve/detail/penalised_matrix.hpp"
#include "common/course.hpp"

namespace antilock::tutorial {

/// Condition numbers of the sum and of the A_delta that is factored: epsilon, summed, factored. Both have the same smallest
/// eigenvalue but for a few percent (it belongs to a smooth function of the kernel of B), and the one of the sum could
/// not be computed where it matters: the sum would have to be factored.
inline Table condition_numbers(const Space& space) {
  Table conditions({"epsilon", "summed", "factored"});
  for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 1e-16}) {
    const VariationalInequality problem = assemble(paper_scene(epsilon), space);
    const FreeNumbering free(problem);
    const PenaltyFactor factor(problem);
    const SparseMatrix k = penalised_matrix(problem, free, factor.delta());
    const auto inverse = [&](const Eigen::VectorXd& x) { return factor.solve(x); };
    const double smallest = 1 / largest_eigenvalue(inverse, k.rows());
    const SparseMatrix sum = penalised_matrix(problem, free, problem.compliance);
    conditions.add({epsilon, largest_eigenvalue(sum) / smallest, largest_eigenvalue(k) / smallest});
  }
  return conditions;
}

/// The exact layer stress p = epsilon^-2 d/dy u at y = -1/2: x, and p at epsilon = 1, 1e-1, 1e-2 and 0.
inline Table layer_stress_curves() {
  const std::vector<Exact> exact = exact_solutions({1, 1e-1, 1e-2, 0}, 14);
  Table curves({"x", "p_1", "p_01", "p_001", "p_0"});
  for (int j = 0; j <= 200; ++j) {
    const double x = j / 200.0;
    std::vector<Entry> row{x};
    for (const Exact& one : exact) row.emplace_back(one.table.layer_stress(x, -0.5));
    curves.add(row);
  }
  return curves;
}

/// Prints P1's errors, how its solvers ended, and the condition numbers; writes results.csv, and layer_stress_curves as
/// stress.csv.
inline void show_round_off(const std::filesystem::path& out, const Table& results, const Table& conditions) {
  results.where("element", "P1").pivot("epsilon", "solver", "error").print("P1 structured: error at the unknowns", 3);
  results.where("element", "P1")
      .pivot("epsilon", "solver", "ended")
      .print("how they ended, and what the checks in split form say");
  conditions.print("condition number of the sum, and of the A_delta that is factored", 2);
  results.select({"solver", "element", "mesh", "epsilon", "error", "ended", "seconds"}).write(out / "results.csv");
  layer_stress_curves().write(out / "stress.csv");
}

}  // namespace antilock::tutorial
