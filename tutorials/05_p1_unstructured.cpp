// Figure 7. P1 on an unstructured mesh: the discretisation locks.
//
// Run: 05_p1_unstructured                             the paper's epsilon = 1e-6, h = 1/32; about a second
// Run: 05_p1_unstructured --epsilon 1e-1 --cells 64   a layer that is hardly stiff: no locking yet
//
// What the picture shows. The exact solution (Figure 4) is a hill over the left half of the body that runs out,
// constant along the normal, over the whole layer below: its ridge on the layer is 0.0457 high. The computed solution
// of Figure 7 is flat zero on the layer. It does not oscillate, it does not blow up, it looks perfectly reasonable, and
// it is wrong.
//
// Why. As epsilon -> 0 problem (23) demands d/dy u = 0 in the layer; the discrete one demands it of a P1 function,
// triangle by triangle. An affine function with d/dy v = 0 is v = a + b x: two numbers a triangle. Across an edge that
// is not vertical, continuity fixes both numbers of the neighbour. On the structured mesh whole columns are tied
// together and one free function a column is left; on an unstructured mesh everything is tied to everything, and
// through the clamped sides to zero: the kernel G_h of a0 is {0}. So
//
//     u_h^epsilon -> 0 on the layer as epsilon -> 0 with h fixed                                    (Proposition 1)
//
// and what is left on the body is the Dirichlet-Laplace problem, "without any connection to Problem (25)"
// (Section 4.1). This program checks that sentence too.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <fmt/format.h>

#include "antilock/exact/truth_table.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

// The inequality (23):  u in K,  a+(u, v-u) + a_x^-(u, v-u) + epsilon^-2 a_y^-(u, v-u) >= (f, v-u)  for all v in K,
// with K = { v >= 0 on Gamma_C, v = 0 on Gamma_D }. The scene states it; `assemble` fills in the matrices.
Scene make_scene(double epsilon) { return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}); }

// The problem that the paper says the locked solution solves: -Laplace u = f on the body, u = 0 on its whole boundary.
// On the same mesh and with the same matrices it takes two changes: every unknown of the layer, Sigma included, is
// fixed to zero, and nothing is left to touch the obstacle.
VariationalInequality dirichlet_laplace(VariationalInequality problem, const Space& space) {
  problem.fixed.clear();
  const double tolerance = 1e-12;
  for (int i = 0; i < space.size(); ++i) {
    const double x = space.points()(i, 0), y = space.points()(i, 1);
    const bool inside_body = y > tolerance && y < 1 - tolerance && x > tolerance && x < 1 - tolerance;
    if (!inside_body) problem.fixed.push_back(i);
  }
  problem.fixed_values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.fixed.size()));
  problem.contact.clear();
  problem.lower.resize(0);
  problem.b.resize(0, problem.size());  // the layer is at rest: no stress to carry
  problem.m.resize(0);
  return problem;
}

// Largest |u| over the unknowns of the layer, Sigma included.
double largest_on_layer(const Space& space, const Eigen::VectorXd& u) {
  double largest = 0;
  for (int i = 0; i < space.size(); ++i)
    if (space.points()(i, 1) <= 0) largest = std::max(largest, std::abs(u(i)));
  return largest;
}

void lock(const tutorial::Options& options, tutorial::Report& report) {
  // 1. The mesh of Figure 6: an arbitrary triangulation, fitted to Sigma.
  report.stage("mesh, 1/h = " + std::to_string(options.cells));
  const TriangleMesh mesh = unstructured_mesh(options.cells);
  const Space space(mesh, p1());

  // 2. The discrete problem (26): matrices a1 = a+ + a_x^- and, in factored form, a0 = a_y^-; the load; bounds on
  // Gamma_C.
  report.stage("assemble");
  const VariationalInequality problem = assemble(make_scene(options.epsilon), space);

  // 3. Solve. Nothing is wrong with the solver: the conditions of the inequality hold to round-off. The discrete
  // problem
  //    itself has the wrong solution.
  report.stage("solve");
  const Solution solution = active_set(problem);

  report.stage("truth: sine series");
  const Truth truth(paper_sine_load(), options.epsilon);
  const TruthTable table(truth);
  report.stage("errors");
  const Errors errors = measure_errors(space, solution, options.epsilon, reference(table));

  // 4. The problem that it solves instead.
  report.stage("Dirichlet-Laplace problem on the body");
  const Solution dirichlet = active_set(dirichlet_laplace(problem, space));
  report.finish();

  const double ridge = truth.max_on_contact();
  const double on_layer = largest_on_layer(space, solution.u);
  const double difference = (solution.u - dirichlet.u).cwiseAbs().maxCoeff();
  fmt::print("\n");
  tutorial::print_solution(space, problem, solution);
  tutorial::print_errors("P1, unstructured", errors);
  fmt::print("  largest |u| on the layer: {:.3e}, truth {:.3e}\n", on_layer, ridge);
  fmt::print("  difference from the Dirichlet-Laplace solution: {:.3e} (largest |u|: {:.3e})\n\n", difference,
             solution.u.cwiseAbs().maxCoeff());

  report.stage("write files");
  tutorial::write_results(options.out, space, problem, solution);
  report.finish();

  // The verdict. The claim is about epsilon much smaller than h; for a mild epsilon the locking is only a loss of
  // accuracy.
  const double h = 1.0 / options.cells;
  if (options.epsilon <= 0.01 * h) {
    report.claim(on_layer < 0.05 * ridge,
                 fmt::format("Figure 7: the discrete solution vanishes on the layer (|u| <= {:.1e} there; the "
                             "truth reaches {:.4f})",
                             on_layer, ridge));
    report.claim(errors.max_at_unknowns > 0.9 * ridge && errors.max_at_unknowns < 1.1 * ridge,
                 fmt::format("locking is complete: the error is the layer's whole displacement ({:.2e})",
                             errors.max_at_unknowns));
    // 0.02: what leaks through Sigma is of the size of on_layer
    report.claim(difference < 0.02 * solution.u.cwiseAbs().maxCoeff() + on_layer,
                 fmt::format("on the body it is the Dirichlet-Laplace solution (difference {:.1e})", difference));
  } else {
    report.claim(
        errors.max_at_unknowns < ridge,
        fmt::format("epsilon = {:g} is not small against h = {:g}: the layer still moves", options.epsilon, h));
  }
}

// Three things to try:
// - refine: --cells 64, 128. The error stays 4.57e-2: at epsilon = 1e-6 no mesh that fits a computer helps.
// - soften: --epsilon 1e-2. "Locks already for epsilon = 1e-2" (Figure 9): the error shrinks with h, but is 40 times
// that
//   of the structured mesh.
// - replace p1() by crouzeix_raviart() in the body of `lock`: that is tutorial 06.
int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "05_p1_unstructured", "Figure 7: P1 on an unstructured mesh locks", {}, lock);
}
