// Figure 8. Crouzeix-Raviart (P1 nonconforming) on the unstructured mesh on which P1 locks: it does not.
//
// Run: 06_crouzeix_raviart                            the paper's epsilon = 1e-6, h = 1/32; about a second
// Run: 06_crouzeix_raviart --epsilon 0 --cells 64     the limit problem (30) itself
//
// What the picture shows. The solution of Figure 4 again, on the mesh of Figure 6, the ridge on the layer included.
// Look closely: the triangles do not quite meet. A Crouzeix-Raviart function is affine on each triangle and continuous
// at the edge midpoints only; the small steps between triangles are the price of the freedom that cures the locking.
//
// Why it works. V_h^nc has an unknown an edge: three halves a triangle (P1: half a vertex a triangle). The condition
// d/dy v = 0 takes one a triangle; what is left is a kernel G_h^nc of about half a function a layer triangle, on every
// mesh. And the interpolation that keeps the mean over each edge maps K_0 into it (Green's formula, proof of Lemma 2),
// so that
//
//     lim_{h->0} sup_{0 < epsilon <= 1} | u^epsilon - u_h^{nc,epsilon} |_{1,Omega_h} = 0                   (Theorem 7)
//
// with no condition on the mesh.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <fmt/format.h>

#include <algorithm>

#include "antilock/exact/truth_table.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

// The inequality (29): (23) with every integral taken triangle by triangle, since v is discontinuous, and the contact
// condition v >= 0 at the midpoints of the edges on Gamma_C. The scene does not know which element will be used.
Scene make_scene(double epsilon) { return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}); }

// The largest step between two triangles, measured at the ends of their common edge (at its midpoint they meet).
double largest_jump(const Space& space, const Eigen::VectorXd& u) {
  const TriangleMesh& mesh = space.mesh();
  const auto value_at = [&](int t, int vertex) {
    double value = 0;
    for (int i = 0; i < 3; ++i) {
      Eigen::Vector3d lambda = Eigen::Vector3d::Zero();
      lambda(i) = 1;
      if (mesh.triangles(t, i) == vertex)
        value = space.element().basis(lambda).dot(Eigen::VectorXd(u(space.unknowns().row(t))));
    }
    return value;
  };
  double jump = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.edge_triangles(e, 0), b = mesh.edge_triangles(e, 1);
    if (b < 0) continue;
    for (int end = 0; end < 2; ++end)
      jump = std::max(jump, std::abs(value_at(a, mesh.edges(e, end)) - value_at(b, mesh.edges(e, end))));
  }
  return jump;
}

void robust(const tutorial::Options& options, tutorial::Report& report) {
  // 1. The very mesh of tutorial 05.
  report.stage("mesh, 1/h = " + std::to_string(options.cells));
  const TriangleMesh mesh = unstructured_mesh(options.cells);

  // 2. Two spaces on it: the one that locks and the one that does not. One word differs.
  report.stage("assemble: P1 and Crouzeix-Raviart");
  const Scene scene = make_scene(options.epsilon);
  const Space conforming(mesh, p1()), nonconforming(mesh, crouzeix_raviart());
  const VariationalInequality p1_problem = assemble(scene, conforming), problem = assemble(scene, nonconforming);

  report.stage("solve: P1");
  const Solution p1_solution = active_set(p1_problem);
  report.stage("solve: Crouzeix-Raviart");
  const Solution solution = active_set(problem);

  // 3. Both against the truth.
  report.stage("truth: sine series");
  const Truth truth(paper_sine_load(), options.epsilon);
  const TruthTable table(truth);
  report.stage("errors");
  const Errors p1_errors = measure_errors(conforming, p1_solution, options.epsilon, reference(table));
  const Errors errors = measure_errors(nonconforming, solution, options.epsilon, reference(table));
  report.finish();

  const double jump = largest_jump(nonconforming, solution.u);
  fmt::print("\n");
  tutorial::print_solution(nonconforming, problem, solution);
  tutorial::print_errors("P1", p1_errors);
  tutorial::print_errors("Crouzeix-Raviart", errors);
  fmt::print("  unknowns: P1 {}, Crouzeix-Raviart {}; largest step between triangles {:.2e}\n\n",
             p1_solution.counters.unknowns, solution.counters.unknowns, jump);

  report.stage("write files");
  tutorial::write_results(options.out, nonconforming, problem, solution);
  report.finish();

  // The verdicts. Cap 4 h^2: three times what was measured between 1/16 and 1/128 at epsilon = 1e-6; a locked solution
  // at 1/h = 32 is ten times above it.
  const double h = 1.0 / options.cells, cap = 4 * h * h;
  report.claim(errors.max_at_unknowns <= cap,
               fmt::format("Figure 8: matches the reference solution (error {:.2e} <= 4 h^2 = {:.2e})",
                           errors.max_at_unknowns, cap));
  // a step is h/2 times a jump of the gradient, itself O(h)
  report.claim(jump <= 40 * h * h, fmt::format("the steps between triangles are small (largest {:.1e})", jump));
  // on fewer cells Crouzeix-Raviart itself is off by a tenth of what P1 loses
  if (options.epsilon <= 0.01 * h && options.cells >= 16)
    report.claim(p1_errors.max_at_unknowns > 10 * errors.max_at_unknowns,
                 fmt::format("where P1 locks ({:.2e}), Crouzeix-Raviart does not ({:.2e})", p1_errors.max_at_unknowns,
                             errors.max_at_unknowns));
  const auto zone = contact_zone(nonconforming, problem, solution);
  const double from = zone.from.value_or(1),
               exact = truth.contact_zones().empty() ? 1 : truth.contact_zones().front().first;
  report.claim(std::abs(from - exact) <= 1.5 * h,
               fmt::format("contact starts at x = {:.4f}, truth {:.4f} (h = {:.4f})", from, exact, h));
}

// Three things to try:
// - --epsilon 1e-1, 1e-2, ..., 0: the error settles and stays.
// - structured_mesh(options.cells) in step 1: Crouzeix-Raviart on the structured mesh; the error is about half.
// - compare the times of the two solves at --cells 128: what the three times as many unknowns cost.
int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "06_crouzeix_raviart", "Figure 8: Crouzeix-Raviart does not lock on any mesh", {},
                       robust);
}
