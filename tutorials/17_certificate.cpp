// # A bound that knows no solution
//
// Run: 17_certificate                1/h from 8 to 64, three meshes, six epsilons; ten seconds
// Run: 17_certificate --exercise 1
// Run: 17_certificate --exercise 2
// Run: 17_certificate --exercise 3
//
// Needs: [00](00_string_on_an_obstacle.cpp) (energy, cone), [04](04_reference_solution.cpp) (Uzawa),
// [08](08_crouzeix_raviart.cpp) (Crouzeix-Raviart), [16](16_roundoff.cpp) (the layer stress `p` is an unknown).
//
// **The picture** (`certificate_width`). Each triangle shows its share of a proved bound of the error at `ε = 1e-6`.
// *Where P1 locks, its bound lies in the layer, and nothing in the bound knows $u$.*
//
// **Predict.** (a) The bound is computed at `ε = 1` and at `ε = 0`. Where is it closer to the error? (b) Uzawa is
// stopped after 1, 2, 4, ... steps of several hundred. From which step on does the proved bound no longer fall?
//
// ## From above and from below
//
// Write $|v|_a^2 = a(v, v)$ for the energy norm, $a = a^+ + a_x^- + ε^{-2} a_y^-$. The solution $u$ of (23) makes
// $J(v) = ½ a(v, v) - (f, v)$ smallest on $K$. Expand $J$ around $u$; by the inequality the bracket is not negative:
//
// $$ J(v) - J(u) = ½ |v - u|_a^2 + [a(u, v - u) - (f, v - u)] ≥ ½ |v - u|_a^2   for all v ∈ K. $$
//
// So each $v ∈ K$ bounds $J(u)$ from above: P1 does. Crouzeix-Raviart is not in $K$, and its energy is no bound (on the
// unit square cut in two triangles it lies above $J(u)$). It gives a *flux* $σ$ in balance with the load,
//
// $$ (σ, ∇v) = (f, v) + ∫_{Γ_C} λ v   for all v with v = 0 on Γ_D,   λ ≥ 0. $$
//
// Count fluxes by their energy, $|q|^2 = q_x^2 + q_y^2$ in the body, $q_x^2 + ε^2 q_y^2$ in the layer. Let $A∇v$ be the
// flux of $v$, in the layer $(∂_x v, p)$ with $p = ε^{-2} ∂_y v$. Complete the square:
//
// $$ J(v) + ½ |σ|^2 = ½ m^2 + C,   m = |A∇v - σ|,   C = ∫_{Γ_C} λ v ≥ 0   for v ∈ K. $$
//
// Hence the *energy bracket* $-½ |σ|^2 ≤ J(u) ≤ J(v)$, its width $w = ½ m^2 + C$, and $|u - v|_a^2 ≤ 2 w$. A little
// more is true: put $v - u$ into the balance and subtract the inequality. With $Y = |u - v|_a$ this is
// $Y^2 ≤ m Y + C$, so
//
// $$ |u - v|_a ≤ ½ m + (¼ m^2 + C)^{1/2}. $$
//
// **Where $σ$ comes from.** The equation of Crouzeix-Raviart for an edge says: what the flux $∇u_h$ loses across the
// edge is a third of the load on both triangles. Give it back triangle by triangle: $σ = ∇u_h - ½ f_T (x - c)$, for a
// load $f_T$ that is constant on a triangle with centroid $c$ (Marini 1985). The layer has no load, there
// $σ = (∂_x u_h, p)$. `analysis/certificate.cpp` treats any load and proves the same bound for $u_h$ itself. An
// iteration that is stopped early leaves forces $r_1$ unbalanced (chapter 03's residual). Their size in the energy
// norm is $ρ = (r_1^T K^{-1} r_1)^{1/2}$, with the matrix $K$ of chapter 03 (this $ρ$ is not Uzawa's step). The bound
// then has $m + ρ$ in place of $m$.
//
// **Where $v$ comes from.** From P1 on the same mesh; then the bound is large where P1 locks. Or from the *strip*:
// averages of $u_h$ in the body, and a small P1 problem on columns extruded below $Σ$, on which P1 does not lock
// (chapter 02).

#include "antilock/mesh/layered.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "common/certified.hpp"
#include "common/paper_problem.hpp"

using namespace antilock;
using tutorial::Exact, tutorial::paper_scene;

// ### Mesh
const std::vector<MeshFamily> families{
    structured(), unstructured(), {"layered", [](int n) { return layered_mesh(n); }}};

Table certify_both(const MeshFamily& family, int cells, const std::vector<Exact>& truth) {
  const Discretisation cr(family.mesh(cells), crouzeix_raviart()), linear(cr, p1());
  // ### Forms
  SceneSweep below(paper_scene(1), cr.space()), above(paper_scene(1), linear.space());
  Table rows(tutorial::certificate_columns);
  for (const Exact& exact : truth) {
    below.set_epsilon(exact.epsilon);
    above.set_epsilon(exact.epsilon);
    // ### Solve
    const Solution u_h = below.solve(), p1_solution = above.solve();
    // One flux, two functions v: the strip, which certify() makes, and P1's own solution. Nothing here knows u.
    const Companion v = p1_companion(p1_solution);
    const Scene scene = paper_scene(exact.epsilon);
    const Certificate strip = certify(scene, cr.space(), below.problem(), u_h);
    const Certificate own = certify(scene, cr.space(), below.problem(), u_h, {.companion = &v});
    // The errors, and J(CR), for the verdicts alone.
    const double cr_energy = energy(below.problem(), u_h), cr_error = exact.errors(cr.space(), u_h).energy;
    const double p1_error = exact.errors(linear.space(), p1_solution).energy;
    rows.add(tutorial::certified_row("CR", family.name, cells, exact, strip, cr_error, cr_energy));
    rows.add(tutorial::certified_row("P1", family.name, cells, exact, own, p1_error, cr_energy));
  }
  return rows;
}

// ### Output
void verdicts(const Table& all, const Table& uzawa, tutorial::Report& report) {
  const double finest = all.most("cells"), half = finest / 2;
  report.claim(all.least("ratio") >= 1, "no bound lies below its error, in {} runs (proved)", all.size());
  report.claim(all.least("inside") >= 0, "every bracket holds the exact energy (proved)");
  report.claim(all.least("width_ratio") >= 1, "(2 width)^(1/2), too, is never below the error (proved)");
  report.claim(all.least("cr_below") >= 0, "the energy of Crouzeix-Raviart lies below J(u) (observed, not proved)");
  const Table shift = all.where("element", "CR").where("mesh", "unstructured").where("cells", finest);
  report.claim(shift.most("shift") < 1.001 * shift.least("shift"),  // ½ |τ|², which the load alone decides
               "the proved bound lies {:.2f} h^2 below J(CR), at every epsilon", shift.most("shift"));
  const Table bounds = uzawa.where("quantity", "bound");
  const double late = bounds.where("steps", 16).number("value") / bounds.last("value");
  report.claim(late <= 1.05, "Uzawa: the bound after 16 steps is {:.3f} times that after 512", late);
  if (finest < 64) return report.not_judged("what is sharp and what closes: that takes meshes to 1/64");
  for (const std::string mesh : {"structured", "unstructured", "layered"}) {
    const Table cr = all.where("element", "CR").where("mesh", mesh),
                p1 = all.where("element", "P1").where("mesh", mesh);
    const Table thin = cr.where("cells", finest).where_number("epsilon", [](double e) { return e <= 0.1; });
    const double varies = thin.most("ratio") / thin.least("ratio") - 1;
    report.claim(cr.most("ratio") <= (mesh == "structured" ? 1.5 : 1.4) && varies <= 0.02,
                 "CR {}: bound / error is {:.2f} to {:.2f}; for epsilon <= 0.1 it varies by {:.1f} %", mesh,
                 cr.least("ratio"), cr.most("ratio"), 100 * varies);
    for (const double epsilon : {1.0, 1e-4, 0.0}) {
      const Table two = p1.where("epsilon", epsilon).where_number("cells", [&](double n) { return n >= half; });
      const double order = two.order("width", "h"), share = two.last("layer_share");
      const bool locks = mesh == "unstructured" && epsilon < 1e-2;  // else energies have order 2
      report.claim((locks ? order < 0.6 : order > 1.8) && (share > 0.5) == locks,
                   "P1 {}, epsilon = {:g}: width ~ h^{:.2f}, {:.0f} % of the bound lie in the layer{}", mesh, epsilon,
                   order, 100 * share, locks ? ": locked" : "");
    }
  }
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  const std::vector<Exact> truth = tutorial::exact_solutions({1, 1e-1, 1e-2, 1e-4, 1e-6, 0});
  Table results(tutorial::certificate_columns);
  for (const MeshFamily& family : families)
    for (int cells = 8; cells <= options.cells; cells *= 2) {
      report.stage(fmt::format("{} mesh, 1/h = {}: P1 and CR, certified", family.name, cells));
      results.add(certify_both(family, cells, truth));
    }
  report.finish();
  const Table uzawa = tutorial::certify_uzawa(truth[2]);
  tutorial::show_certificates(options.out, results, uzawa);
  verdicts(results, uzawa, report);
}

// ## What came out
//
// (a) Nowhere: bound / error is 1.28 to 1.47 for CR at every `ε`. (b) From step 8 on: then the algebraic error is below
// that of the mesh. Where P1 locks the ratio comes near 1, and the bracket stays open: it shows without $u$.
//
// ## Exercises
//
// 1. Multiply `u_h` and `p` by 1.01. By how much does the bound grow? (What is $r_1$ then?)
// 2. With an obstacle at distance $0.02 x (1 - x)$ no $u$ is known. Do the brackets of `1/h = 16` and `32` agree?
// 3. Why may P2 not take the place of P1 in the upper bound? (Is a parabola $≥ 0$ between its unknowns?)
int main(int argc, char** argv) {
  const auto exercises = tutorial::certificate_exercises();
  return tutorial::run(
      argc, argv, "17_certificate", "a proved bound of the error, equally sharp at every epsilon",
      {.takes_epsilon = false, .cells = 64, .least_cells = 16, .most_cells = 256, .exercises = exercises}, study);
}
