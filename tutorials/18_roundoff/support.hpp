#pragma once
#include <functional>

#include "antilock/core/eigenvalues.hpp"
#include "antilock/core/error.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/solve/penalised_matrix.hpp"
#include "antilock/solve/summed.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// (23) without contact, its stiff lines of slope 2: (d/dx + 2 d/dy)/sqrt(5) in the place
/// of d/dy.
inline VariationalInequality turned(const Space& space, double epsilon) {
  VariationalInequality problem =
      assemble(Scene(Body{paper_load}, StiffLayer{epsilon}), space);
  std::vector<Eigen::Triplet<double>> entries;
  for (int t = 0, row = 0; t < space.mesh().triangle_count(); ++t) {
    if (space.mesh().region[t] != Region::layer) continue;
    const Eigen::MatrixX3d derivative =
        space.element().derivative(Eigen::Vector3d::Constant(1.0 / 3));
    const Eigen::VectorXd slopes =
        derivative * barycentric_gradients(space.mesh(), t).col(0);
    for (int i = 0; i < slopes.size(); ++i)
      entries.emplace_back(row, space.cell_dofs()(t, i), slopes(i));
    ++row;
  }
  RowMatrix d_x(problem.b.rows(), problem.b.cols());
  d_x.setFromTriplets(entries.begin(), entries.end());
  const RowMatrix across = (2 * d_x - problem.b) / std::sqrt(5.0),
                  along = (d_x + 2 * problem.b) / std::sqrt(5.0);
  const auto energy = [&](const RowMatrix& d) {
    return SparseMatrix(d.transpose() * problem.m.asDiagonal() * d);
  };
  problem.a1 += energy(across) - energy(d_x);
  problem.b = along;
  return problem;
}

/// Six methods at six epsilons, solved by `solve`: method, epsilon, u (the largest -u on
/// Sigma), from_limit (the distance from its own solution at epsilon = 0, relative).
inline Table turn_the_lines(
    int cells, const std::function<Eigen::VectorXd(const VariationalInequality&)>& cure) {
  Table rows({"method", "epsilon", "u", "from_limit"});
  const auto solve = [&](const Space& space, double epsilon) {
    return cure(turned(space, epsilon));
  };
  const auto largest = [](const Space& space, const Eigen::VectorXd& u) {
    double most = 0;
    for (int i = 0; i < u.size(); ++i)
      if (std::abs(space.dof_coordinates()(i, 1)) < 1e-12) most = std::max(most, -u(i));
    return most;
  };
  const auto add = [&](const std::string& name, const Space& space) {
    const Eigen::VectorXd limit = solve(space, 0);
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6}) {
      const Eigen::VectorXd u = solve(space, epsilon);
      rows.add({name, epsilon, largest(space, u), (u - limit).norm() / limit.norm()});
    }
  };
  const auto along =
      [](int n) {  // its layer has cells of h x 2h: each diagonal / is a line
        TriangleMesh mesh = structured_mesh(n, {0.5});
        for (auto vertex : mesh.vertices.rowwise())
          if (vertex(1) < 0) vertex(1) *= 2;
        return mesh;
      };
  add("P1 along, 4 times finer", Space(along(4 * cells), p1()));
  add("P1 along", Space(along(cells), p1()));
  add("P1 structured", Space(structured_mesh(cells), p1()));
  add("P1 unstructured", Space(unstructured_mesh(cells), p1()));
  add("CR structured", Space(structured_mesh(cells), crouzeix_raviart()));
  add("CR unstructured", Space(unstructured_mesh(cells), crouzeix_raviart()));
  return rows;
}

/// Condition numbers of the sum and of the A_delta that is factored: epsilon, summed,
/// factored. Both have the same smallest eigenvalue but for a few percent (it belongs to a
/// smooth function of the kernel of B), and the one of the sum could not be computed where
/// it matters: the sum would have to be factored.
inline Table condition_numbers(const Space& space) {
  Table conditions({"epsilon", "summed", "factored"});
  for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 1e-16}) {
    const VariationalInequality problem = assemble(paper_scene(epsilon), space);
    const DofOrdering free(problem);
    const PenalisedCholesky factor(problem);
    const SparseMatrix k = penalised_matrix(problem, free, factor.delta());
    const auto inverse = [&](const Eigen::VectorXd& x) { return factor.solve(x); };
    const double smallest = 1 / largest_eigenvalue(inverse, k.rows());
    const SparseMatrix sum = penalised_matrix(problem, free, problem.compliance);
    conditions.add(
        {epsilon, largest_eigenvalue(sum) / smallest, largest_eigenvalue(k) / smallest});
  }
  return conditions;
}

/// The exact layer stress p = epsilon^-2 d/dy u at y = -1/2: x, and p at epsilon = 1, 1e-1,
/// 1e-2 and 0.
inline Table layer_stress_curves() {
  const std::vector<Exact> exact = exact_solutions({1, 1e-1, 1e-2, 0}, 14);
  Table curves({"x", "p_1", "p_01", "p_001", "p_0"});
  for (int j = 0; j <= 200; ++j) {
    const double x = j / 200.0;
    std::vector<TableEntry> row{x};
    for (const Exact& one : exact) row.emplace_back(one.table.layer_stress(x, -0.5));
    curves.add(row);
  }
  return curves;
}

/// Prints P1's errors, how its solvers ended, and the condition numbers; writes
/// results.csv, and layer_stress_curves as stress.csv.
inline void show_round_off(const std::filesystem::path& out, const Table& results,
                           const Table& conditions) {
  results.filter("element", "P1")
      .pivot("epsilon", "solver", "error")
      .print("P1 structured: error at the unknowns", 3);
  results.filter("element", "P1")
      .pivot("epsilon", "solver", "ended")
      .print("how they ended, and what the checks in split form say");
  conditions.print("condition number of the sum, and of the A_delta that is factored", 2);
  results.select({"solver", "element", "mesh", "epsilon", "error", "ended", "seconds"})
      .write(out / "results.csv");
  layer_stress_curves().write(out / "stress.csv");
}

/// Solves with a given contact set and penalty delta.
using Cure = std::function<Eigen::VectorXd(const VariationalInequality&,
                                           const std::vector<bool>& active, double delta)>;

inline const std::vector<std::string> solver_columns{
    "solver", "element", "mesh", "epsilon", "error", "ended",
    "wrong",  "refused", "flat", "seconds", "apart"};

/// How a solver ended, in words, and whether the checks in split form refuse its answer, or
/// there is none.
struct Ending {
  std::string text;
  bool refused = false;
};

/// Every solver on one discrete problem, one row each: the library in split form, a cure
/// with its contact set, the sum by Cholesky and LU, the paper's CG + ILUT. error: the
/// largest at the unknowns; ended: what the solver says of itself; wrong: more than twice
/// the right error, or no answer; refused: what the checks in split form say, or no answer;
/// flat: the largest |u| on Gamma_C over the right one; seconds; apart: the largest
/// distance from the library's answer, relative.
inline Table compare_solvers(const Method& method, const Space& space, const Exact& exact,
                             const Cure& cure) {
  const VariationalInequality problem = assemble(exact.scene, space);
  Table rows(solver_columns);
  double right = 0;       // the error of the split form
  Eigen::VectorXd split;  // its answer
  const auto add = [&](const std::string& solver, const Eigen::VectorXd& u,
                       const Ending& ended, double seconds) {
    double error = u.size() == 0 ? std::nan("") : 0;
    for (int i = 0; i < u.size(); ++i)
      error = std::max(error,
                       std::abs(u(i) - exact.table.value(space.dof_coordinates()(i, 0),
                                                         space.dof_coordinates()(i, 1))));
    if (solver == "split form") right = error, split = u;
    const double apart =
        u.size() == 0 ? std::nan("") : (u - split).lpNorm<Eigen::Infinity>();
    rows.add({solver, method.element->name(), method.family.name, exact.epsilon, error,
              ended.text, !(error <= 2 * right), ended.refused,
              u.size() == 0 ? std::nan("")
                            : u(space.contact_dofs()).maxCoeff() /
                                  split(space.contact_dofs()).maxCoeff(),
              seconds, apart / split.lpNorm<Eigen::Infinity>()});
  };
  const auto warned = [](const std::string& warning) {
    return Ending{warning.empty() ? "trusted" : "warned"};
  };
  const Ending no_answer{"no answer", true};
  const auto checked = [&](Solution solution) {
    try {
      check_kkt(problem, solution);
      return warned(solution.warning);
    } catch (const NotConverged&) {
      return Ending{"refused", true};
    }
  };

  Stopwatch watch;
  PenalisedCholesky factor(problem);
  const Solution stable = active_set(problem, factor);
  add("split form", stable.u, warned(stable.warning), watch.lap());
  const Eigen::VectorXd cured = cure(problem, stable.active, factor.delta());
  add("cure in 20 lines", cured, {}, watch.lap());
  for (const auto& [kind, name] : {std::pair{SummedFactor::cholesky, "sum: Cholesky"},
                                   {SummedFactor::lu, "sum: LU"}}) {
    watch.lap();
    const NaiveResult naive = naive_summed_solve(problem, kind);
    const double seconds = watch.lap();
    if (naive.reason ==
        ConvergedReason::linear_solve_failed) {  // the factorisation itself gave up
      add(name, {}, no_answer, seconds);
      continue;
    }
    Ending ended = checked(naive.solution);
    ended.text = to_string(naive.reason) + "; " + ended.text;
    add(name, naive.solution.u, ended, seconds);
  }
  watch.lap();
  UzawaOptions patience;
  patience.max_iterations = 600;  // steps, not seconds: the same picture on every machine
  try {
    const Solution cg = uzawa_cg_ilut(problem, patience);
    add("sum: CG + ILUT", cg.u, warned(cg.warning), watch.lap());
  } catch (const NotConverged&) {  // the paper's own linear solver gives up, and says so
    add("sum: CG + ILUT", {}, no_answer, watch.lap());
  }
  return rows;
}

}  // namespace antilock::tutorial
