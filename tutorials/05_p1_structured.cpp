// Figure 5. P1 on the structured mesh of Figure 3: no locking, at any epsilon.
//
// Run: 05_p1_structured               the paper's epsilon = 1e-6, h = 1/32; about a second
// Run: 05_p1_structured --epsilon 0   the limit problem (27) itself, on the same mesh
// Run: 05_p1_structured --epsilon 1 --cells 128
//
// What the picture shows. A hill over the left half of the body, a valley over the right half. The
// hill runs out over the layer as a ridge that is constant along the normal. Where the load presses
// down, from x = 0.702 on, the layer lies on the obstacle, flat zero. It is the picture of the
// reference solution (Figure 4).
//
// Why it works. A structured mesh has vertical mesh lines. A function of V_h that depends on x
// alone, affine between the lines, satisfies d/dy v = 0 in every triangle of the layer: on the
// layer, the kernel G_h of a0 holds one function per line, enough to approximate every function of
// x. Theorem 4 asks that K_h approach K, which P1 does on every regular mesh, and that K_0h
// approach K_0, which these functions see to. So
//
//     lim_{h->0} sup_{0 < epsilon <= 1} | u^epsilon - u_h^epsilon |_{1,Omega} = 0       (Theorem 5)
//
// Here the theorem is seen at work: the same error, to three digits, for every epsilon from 1e-2
// down to exactly 0.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none. The diagonals run from lower left to
// upper right (Figure 3). The inequality and its forms stand in common/paper_problem.hpp.

#include <algorithm>

#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

double variation_across_layer(const Eigen::VectorXd& u, int cells);

void structured_study(const tutorial::Options& options, tutorial::Report& report) {
  // 1. Mesh and space: squares cut by a diagonal, unknowns at the vertices.
  report.stage("mesh and assembly, 1/h = " + std::to_string(options.cells));
  const Method method{&p1(), structured({}, Diagonal::right)};
  const Discretisation discrete = method.on(options.cells);
  const Space& space = discrete.space();

  // 2. The discrete problem (26) at the epsilon asked for, and its solution.
  const VariationalInequality problem = assemble(tutorial::paper_scene(options.epsilon), space);
  report.stage("solve");
  const Solution solution = active_set(problem);

  // 3. The truth, a sine series, and the distance from it.
  report.stage("truth: sine series, and the errors");
  const tutorial::Exact exact(options.epsilon);
  const Errors errors = exact.errors(space, solution);

  // 4. The same mesh for a whole range of epsilon: Theorem 5 in one column.
  report.stage("the same mesh at nine epsilons");
  Table sweep({"epsilon", "max_at_unknowns"});
  for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12, 0.0}) {
    const Solution other = active_set(assemble(tutorial::paper_scene(epsilon), space));
    sweep.add({epsilon, tutorial::Exact(epsilon).errors(space, other).max_at_unknowns});
  }
  report.finish();

  tutorial::present(options.out, space, problem, solution, "P1, structured", errors);
  sweep.print("error at the unknowns against epsilon");
  sweep.write(options.out / "sweep.csv");

  // The verdicts. The cap comes from the interpolation error of the truth, h^2/8 |u''| with |u''|
  // <= 10.
  const double h = 1.0 / options.cells, cap = h * h, worst = sweep.most("max_at_unknowns");
  const Table small = sweep.where_number("epsilon", [](double epsilon) { return epsilon <= 1e-2; });
  const double spread = small.most("max_at_unknowns") / small.least("max_at_unknowns") - 1;
  report.claim(errors.max_at_unknowns <= cap,
               "Figure 5: in agreement with the reference solution (error {:.2e} <= h^2 = {:.2e})",
               errors.max_at_unknowns, cap);
  report.claim(worst <= cap && spread <= 0.05,
               "Theorem 5: uniform in epsilon (worst {:.2e} over nine epsilons down to 0; spread below 1e-2: {:.1f} %)",
               worst, 100 * spread);
  // d/dy u = epsilon^2 p, and the layer is 1 thick; 1e-12: what the solver leaves of u
  const double variation = variation_across_layer(solution.u, options.cells);
  const double stress = options.epsilon * options.epsilon * solution.p.cwiseAbs().maxCoeff();
  report.claim(variation <= 1.001 * stress + 1e-12,
               "across the layer the solution varies by {:.1e}, at most epsilon^2 max |p| = {:.1e}", variation, stress);
  const double from = contact_zone(space, problem, solution).from.value_or(1);
  report.claim(std::abs(from - exact.contact_from()) <= h,
               "contact starts at x = {:.4f}, truth {:.4f} (within h = {:.4f})", from, exact.contact_from(), h);
}

// Three things to try:
// - Diagonal::left in step 1: the error hardly changes; the vertical mesh lines matter, not the
//   diagonals.
// - --cells 64, then 128: the error falls by four each time, at every epsilon.
// - move one vertex of the layer sideways (mesh.vertices(...) in step 1): the kernel loses its
//   functions; tutorial 06 is where that ends.
int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "05_p1_structured", "Figure 5: P1 on a structured mesh does not lock", {},
                       structured_study);
}

// How far the solution is from constant along the normal: the largest |u(x, y) - u(x, 0)| over the
// vertices of the layer. They are numbered row by row from the bottom; row `cells` is Sigma.
double variation_across_layer(const Eigen::VectorXd& u, int cells) {
  const int columns = cells + 1;
  double variation = 0;
  for (int row = 0; row < cells; ++row)
    for (int i = 0; i < columns; ++i)
      variation = std::max(variation, std::abs(u(row * columns + i) - u(cells * columns + i)));
  return variation;
}
