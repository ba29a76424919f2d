// Figure 5. P1 on the structured mesh of Figure 3: no locking, at any epsilon.
//
// Run: 04_p1_structured                           the paper's epsilon = 1e-6, h = 1/32; about a second
// Run: 04_p1_structured --epsilon 0               the limit problem (27) itself, on the same mesh
// Run: 04_p1_structured --epsilon 1 --cells 128
//
// What the picture shows. A hill over the left half of the body, a valley over the right; the hill runs out over the
// layer as a ridge that is constant along the normal, and where the load presses down the layer lies on the obstacle,
// flat zero, from x = 0.702 on. It is the picture of the reference solution (Figure 4).
//
// Why it works. A structured mesh has vertical mesh lines. A function of V_h that depends on x alone, affine between
// the lines, satisfies d/dy v = 0 in every triangle of the layer: the kernel G_h of a0 holds one function a line,
// enough to approximate every function of x. That is all that Theorem 4 asks (K_0h approaches K_0), so that
//
//     lim_{h->0} sup_{0 < epsilon <= 1} | u^epsilon - u_h^epsilon |_{1,Omega} = 0                          (Theorem 5)
//
// Here the theorem is seen at work: the same error, to three digits, for every epsilon from 1e-2 down to exactly 0.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none. The diagonals run from lower left to upper right (Figure
// 3).

#include <fmt/format.h>

#include <algorithm>

#include "antilock/exact/truth_table.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

// The inequality (23):  u in K,  a+(u, v-u) + a_x^-(u, v-u) + epsilon^-2 a_y^-(u, v-u) >= (f, v-u)  for all v in K
//
//     a+(u, v)   = int_body  grad u . grad v        the body
//     a_x^-(u, v) = int_layer d/dx u d/dx v          the layer along itself
//     a_y^-(u, v) = int_layer d/dy u d/dy v          the layer across: the stiff part, epsilon^-2 in front
//     K           = { v >= 0 on Gamma_C, v = 0 on Gamma_D }
Scene make_scene(double epsilon) { return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}); }

// How far the solution is from constant along the normal: the largest |u(x, y) - u(x, 0)| over the vertices of the
// layer.
double variation_across_layer(const Eigen::VectorXd& u, int cells) {
  double variation = 0;
  const int columns = cells + 1;  // vertices are numbered row by row from the bottom; row `cells` is Sigma
  for (int row = 0; row < cells; ++row)
    for (int i = 0; i < columns; ++i)
      variation = std::max(variation, std::abs(u(row * columns + i) - u(cells * columns + i)));
  return variation;
}

void structured(const tutorial::Options& options, tutorial::Report& report) {
  // 1. Mesh and space: squares cut by a diagonal, unknowns at the vertices.
  report.stage("mesh, 1/h = " + std::to_string(options.cells));
  const TriangleMesh mesh = structured_mesh(options.cells, Domain{}, Diagonal::right);
  const Space space(mesh, p1());

  // 2. The discrete problem (26) at the epsilon asked for, and its solution.
  report.stage("assemble");
  const VariationalInequality problem = assemble(make_scene(options.epsilon), space);
  report.stage("solve");
  const Solution solution = active_set(problem);

  // 3. The truth, a sine series, and the distance from it.
  report.stage("truth: sine series");
  const Truth truth(paper_sine_load(), options.epsilon);
  const TruthTable table(truth);
  report.stage("errors");
  const Errors errors = measure_errors(space, solution, options.epsilon, reference(table));

  // 4. The same mesh for a whole range of epsilon: Theorem 5 in one column.
  report.stage("the same mesh at nine epsilons");
  std::vector<Eigen::Vector2d> sweep;
  for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12, 0.0}) {
    const Solution other = active_set(assemble(make_scene(epsilon), space));
    const TruthTable its_truth(Truth(paper_sine_load(), epsilon));
    sweep.emplace_back(epsilon, measure_errors(space, other, epsilon, reference(its_truth)).max_at_unknowns);
  }
  report.finish();

  fmt::print("\n");
  tutorial::print_solution(space, problem, solution);
  tutorial::print_errors("P1, structured", errors);
  fmt::print("  epsilon:                 ");
  for (const auto& row : sweep) fmt::print("{:9.0e}", row(0));
  fmt::print("\n  error at the unknowns:   ");
  for (const auto& row : sweep) fmt::print("{:9.2e}", row(1));
  fmt::print("\n\n");

  report.stage("write files");
  tutorial::write_results(options.out, space, problem, solution);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(sweep.size()), 2);
  for (std::size_t i = 0; i < sweep.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = sweep[i];
  write_csv(options.out / "sweep.csv", {"epsilon", "max_at_unknowns"}, rows);
  report.finish();

  // The verdicts. Caps from the interpolation error of the truth, h^2/8 |u''| with |u''| <= 10: P1 is no better, nor
  // much worse.
  const double h = 1.0 / options.cells, cap = 1.0 * h * h;
  double worst = 0, best = 1;
  for (const auto& row : sweep) {
    worst = std::max(worst, row(1));
    best = row(0) <= 1e-2 ? std::min(best, row(1)) : best;
  }
  double worst_small = 0;
  for (const auto& row : sweep) worst_small = row(0) <= 1e-2 ? std::max(worst_small, row(1)) : worst_small;
  report.claim(errors.max_at_unknowns <= cap,
               fmt::format("Figure 5: in agreement with the reference solution (error {:.2e} <= h^2 = {:.2e})",
                           errors.max_at_unknowns, cap));
  report.claim(
      worst <= cap && worst_small <= 1.05 * best,
      fmt::format(
          "Theorem 5: uniform in epsilon (worst {:.2e} over nine epsilons down to 0; spread below 1e-2: {:.1f} %)",
          worst, 100 * (worst_small / best - 1)));
  if (options.epsilon <= 1e-4) {
    const double variation = variation_across_layer(solution.u, options.cells);
    report.claim(variation < 1e-6,
                 fmt::format("the solution is constant along the normal in the layer (variation {:.1e})", variation));
    const auto zone = contact_zone(space, problem, solution);
    const double from = zone.from.value_or(1),
                 exact = truth.contact_zones().empty() ? 1 : truth.contact_zones().front().first;
    report.claim(std::abs(from - exact) <= h,
                 fmt::format("contact starts at x = {:.4f}, truth {:.4f} (within h = {:.4f})", from, exact, h));
  }
}

// Three things to try:
// - Diagonal::left in step 1: the error hardly changes; the vertical mesh lines matter, not the diagonals.
// - --cells 64, then 128: the error falls by four each time, whatever epsilon.
// - move one vertex of the layer sideways (mesh.vertices(...) in step 1): the kernel loses its functions; tutorial 05
// is where that ends.
int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "04_p1_structured", "Figure 5: P1 on a structured mesh does not lock", {},
                       structured);
}
