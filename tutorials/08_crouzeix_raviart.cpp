// Figure 8. Crouzeix-Raviart (P1 nonconforming) on the unstructured mesh on which P1 locks: it does
// not.
//
// Run: 08_crouzeix_raviart                          the paper's epsilon = 1e-6, h = 1/32; about a second
// Run: 08_crouzeix_raviart --epsilon 0 --cells 64   the limit problem (30) itself
//
// What the picture shows. The solution of Figure 4 again, on the mesh of Figure 6, the ridge on the
// layer included. Look closely: the triangles do not quite meet. A Crouzeix-Raviart function is
// affine on each triangle and continuous at the edge midpoints only. The small steps between
// triangles are the price of the freedom that cures the locking.
//
// Why it works. V_h^nc has one unknown per edge: three halves per triangle (P1: half a vertex per
// triangle). The condition d/dy v = 0 takes one per triangle of the layer. What is left there is a
// kernel G_h^nc of about half a function per layer triangle, on every mesh. And the interpolation
// that keeps the mean over each edge maps K_0 into it (Green's formula, proof of Lemma 2), so that
//
//     lim_{h->0} sup_{0 < epsilon <= 1} | u^epsilon - u_h^{nc,epsilon} |_{1,Omega_h} = 0   (Theorem 7)
//
// with no condition on the mesh beyond a regular family.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <algorithm>

#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

double largest_jump(const Space& space, const Eigen::VectorXd& u);

void robust(const tutorial::Options& options, tutorial::Report& report) {
  // 1. The very mesh of tutorial 06, and two spaces on it: the one that locks and the one that does
  // not.
  report.stage("mesh and assembly, 1/h = " + std::to_string(options.cells));
  const Discretisation conforming = Method{&p1(), unstructured()}.on(options.cells);
  const Discretisation nonconforming(conforming, crouzeix_raviart());
  const Space& space = nonconforming.space();

  // 2. The inequality (29): (23) with every integral taken triangle by triangle, since v is
  //    discontinuous, and the contact condition v >= 0 at the midpoints of the edges on Gamma_C.
  //    The scene does not know the element.
  const Scene scene = tutorial::paper_scene(options.epsilon);
  const VariationalInequality p1_problem = assemble(scene, conforming.space()), problem = assemble(scene, space);
  report.stage("solve: P1");
  const Solution p1_solution = active_set(p1_problem);
  report.stage("solve: Crouzeix-Raviart");
  const Solution solution = active_set(problem);

  // 3. Both against the truth.
  report.stage("truth: sine series, and the errors");
  const tutorial::Exact exact(options.epsilon);
  const Errors p1_errors = exact.errors(conforming.space(), p1_solution), errors = exact.errors(space, solution);
  const double jump = largest_jump(space, solution.u);
  report.finish();

  tutorial::print_errors("P1", p1_errors);
  tutorial::present(options.out, space, problem, solution, "Crouzeix-Raviart", errors);
  fmt::print("  unknowns: P1 {}, Crouzeix-Raviart {}; largest step between triangles {:.2e}\n\n",
             p1_solution.counters.unknowns, solution.counters.unknowns, jump);

  // The verdicts. Interpolation costs h^2/8 |u''| with |u''| <= 10, twice on a nonconforming space;
  // the end of contact, where u'' is not bounded, the rest of 4 h^2. A locked solution at 1/h = 32
  // is ten times above it.
  const double h = 1.0 / options.cells, cap = 4 * h * h;
  report.claim(errors.max_at_unknowns <= cap,
               "Figure 8: matches the reference solution (error {:.2e} <= 4 h^2 = {:.2e})", errors.max_at_unknowns,
               cap);
  // A step is h/2 times a jump of the discrete gradient. At the end of contact u is like r^(3/2),
  // its gradient like r^(1/2): the largest jump falls like h^(1/2), the largest step like h^(3/2).
  report.claim(jump <= 1.5 * h * std::sqrt(h), "the steps between triangles are small: {:.2f} h^(3/2) at most",
               jump / (h * std::sqrt(h)));
  // on fewer cells Crouzeix-Raviart itself is off by a tenth of what P1 loses
  if (options.epsilon <= 0.01 * h && options.cells >= 16)
    report.claim(p1_errors.max_at_unknowns > 10 * errors.max_at_unknowns,
                 "where P1 locks ({:.2e}), Crouzeix-Raviart does not ({:.2e})", p1_errors.max_at_unknowns,
                 errors.max_at_unknowns);
  else
    report.not_judged("P1 against Crouzeix-Raviart: P1 locks for epsilon <= h/100, and 16 cells tell them apart");
  const double from = contact_zone(space, problem, solution).from.value_or(1);
  report.claim(std::abs(from - exact.contact_from()) <= 1.5 * h,
               "contact starts at x = {:.4f}, truth {:.4f} (h = {:.4f})", from, exact.contact_from(), h);
}

// Three things to try:
// - --epsilon 1e-1, 1e-2, ..., 0: the error settles and stays.
// - structured() in step 1: Crouzeix-Raviart on the structured mesh; the error is about half.
// - compare the times of the two solves at --cells 128: what the three times as many unknowns cost.
int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "08_crouzeix_raviart", "Figure 8: Crouzeix-Raviart does not lock on any mesh", {},
                       robust);
}

// The largest step between two triangles, measured at the ends of their common edge (at its
// midpoint they meet).
double largest_jump(const Space& space, const Eigen::VectorXd& u) {
  const TriangleMesh& mesh = space.mesh();
  const auto value_at = [&](int t, int vertex) {
    int corner = 0;
    while (mesh.triangles(t, corner) != vertex) ++corner;
    return space.element().basis(Eigen::Vector3d::Unit(corner)).dot(Eigen::VectorXd(u(space.unknowns().row(t))));
  };
  double jump = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.edge_triangles(e, 0), b = mesh.edge_triangles(e, 1);
    for (int end = 0; end < 2 && b >= 0; ++end)
      jump = std::max(jump, std::abs(value_at(a, mesh.edges(e, end)) - value_at(b, mesh.edges(e, end))));
  }
  return jump;
}
