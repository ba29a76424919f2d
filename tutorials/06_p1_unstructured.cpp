// Figure 7. P1 on an unstructured mesh: the discretisation locks.
//
// Run: 06_p1_unstructured                             the paper's epsilon = 1e-6, h = 1/32; about a second
// Run: 06_p1_unstructured --epsilon 1e-1 --cells 64   a layer that is hardly stiff: no locking yet
//
// What the picture shows. The exact solution (Figure 4) is a hill over the left half of the body
// that runs out, constant along the normal, over the whole layer below: its ridge on the layer is
// 0.0457 high. The computed solution of Figure 7 is flat zero on the layer. It does not oscillate,
// it does not blow up, it looks perfectly reasonable, and it is wrong.
//
// Why. As epsilon -> 0 problem (23) demands d/dy u = 0 in the layer. The discrete problem demands
// it of a P1 function, triangle by triangle. An affine function with d/dy v = 0 is v = a + b x: two
// numbers per triangle. Across an edge that is not vertical, continuity fixes both numbers of the
// neighbour. On the structured mesh whole columns are tied together, and one free function per
// column is left. On an unstructured mesh every triangle of the layer is tied to every other, and
// through the clamped ends to zero: every function of the kernel G_h of a0 vanishes on the layer.
// So
//
//     u_h^epsilon -> 0 on the layer as epsilon -> 0 with h fixed                    (Proposition 1)
//
// How much of the ridge is left at epsilon > 0? About 1/(1 + x) with x = (h^(3/2)/epsilon)^2 on
// these meshes: tutorial 13 measures it. And what is left on the body is the Dirichlet-Laplace
// problem, "without any connection to Problem (25)" (Section 4.1). This program checks both.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

VariationalInequality dirichlet_laplace(VariationalInequality problem, const Space& space);
double largest_on_layer(const Space& space, const Eigen::VectorXd& u);

void lock(const tutorial::Options& options, tutorial::Report& report) {
  // 1. The mesh of Figure 6: an arbitrary triangulation, fitted to Sigma.
  report.stage("mesh and assembly, 1/h = " + std::to_string(options.cells));
  const Discretisation discrete = Method{&p1(), unstructured()}.on(options.cells);
  const Space& space = discrete.space();

  // 2. The discrete problem (26): matrices a1 = a+ + a_x^- and, in factored form, a0 = a_y^-; the
  //    load; bounds on Gamma_C.
  const VariationalInequality problem = assemble(tutorial::paper_scene(options.epsilon), space);

  // 3. Solve. Nothing is wrong with the solver: the conditions of the inequality hold to round-off.
  //    The discrete problem itself has the wrong solution.
  report.stage("solve");
  const Solution solution = active_set(problem);

  report.stage("truth: sine series, and the errors");
  const tutorial::Exact exact(options.epsilon);
  const Errors errors = exact.errors(space, solution);
  const double ridge = exact.truth.max_on_contact();

  // 4. The problem that it solves instead.
  report.stage("Dirichlet-Laplace problem on the body");
  const Solution dirichlet = active_set(dirichlet_laplace(problem, space));
  const double on_layer = largest_on_layer(space, solution.u);
  const double difference = (solution.u - dirichlet.u).cwiseAbs().maxCoeff();
  report.finish();

  tutorial::present(options.out, space, problem, solution, "P1, unstructured", errors);
  fmt::print("  largest |u| on the layer: {:.3e}, truth {:.3e}\n", on_layer, ridge);
  fmt::print("  difference from the Dirichlet-Laplace solution: {:.3e} (largest |u|: {:.3e})\n\n", difference,
             solution.u.cwiseAbs().maxCoeff());

  // The verdict. First the law of tutorial 13, at any epsilon > 0: a factor 4 for its constant,
  // which is not derived.
  const double h = 1.0 / options.cells, x = h * h * h / (options.epsilon * options.epsilon);
  const double kept = solution.u(space.contact()).maxCoeff() / ridge;
  if (options.epsilon > 0 && x < 1e12)  // beyond, 1/x is round-off
    report.claim(4 * kept * (1 + x) > 1 && kept * (1 + x) < 4,
                 "of the ridge {:.1e} is kept, 1/(1 + x) = {:.1e} with x = (h^(3/2)/epsilon)^2", kept, 1 / (1 + x));
  if (options.epsilon > 0.01 * h)
    return report.not_judged("whether the solution vanishes on the layer: it does for epsilon well below h");
  constexpr double solved = 1e-10;  // what the solver leaves of u
  report.claim(on_layer < 4 * ridge / (1 + x) + solved,
               "Figure 7: the discrete solution vanishes on the layer (|u| <= {:.1e} there; the truth reaches {:.4f})",
               on_layer, ridge);
  // 10 h^2: how much the largest nodal value of the ridge and of the error on the body may differ
  // from the ridge
  report.claim(std::abs(errors.max_at_unknowns / ridge - 1) < 10 * h * h,
               "locking is complete: the error is the layer's whole displacement ({:.2e})", errors.max_at_unknowns);
  // both solve the same equations on the body, and differ by on_layer at most on Sigma: a maximum
  // principle
  report.claim(difference < 1.001 * on_layer + solved,
               "on the body it is the Dirichlet-Laplace solution (difference {:.1e})", difference);
}

// The problem that the paper says the locked solution solves: -Laplace u = f on the body, u = 0 on
// its whole boundary. On the same mesh and with the same matrices it takes two changes: every
// unknown of the layer, Sigma included, is fixed to zero, and nothing is left to touch the
// obstacle.
VariationalInequality dirichlet_laplace(VariationalInequality problem, const Space& space) {
  constexpr double tolerance = 1e-12;
  problem.fixed.clear();
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

// Three things to try:
// - refine: --cells 64, 128. The error stays 4.57e-2: at epsilon = 1e-6 no mesh that fits a
//   computer helps.
// - soften: --epsilon 1e-2. The P1 method with an unstructured mesh "locks already" there (caption
//   of Figure 9): the error shrinks with h, but is 40 times that of the structured mesh.
// - replace p1() by crouzeix_raviart() in the body of `lock`: that is tutorial 08.
int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "06_p1_unstructured", "Figure 7: P1 on an unstructured mesh locks", {}, lock);
}

// Largest |u| over the unknowns of the layer, Sigma included.
double largest_on_layer(const Space& space, const Eigen::VectorXd& u) {
  return (space.points().col(1).array() <= 0).select(u.array().abs(), 0).maxCoeff();
}
