// Figures 1 and 2. The domain, and the change of variable that makes a thin layer thick.
//
// Run: 01_domain   the layer drawn with thickness 0.15; a moment
// Run: 01_domain --epsilon 0.3
//
// What the pictures show. An elastic body Omega+ = (0,1) x (0,1), clamped on Gamma+ (both sides and
// the top). A thin stiff layer Omega_epsilon^- = (0,1) x (-epsilon,0) is grafted onto its lower
// side Sigma. The layer is clamped on its two ends Gamma_D,epsilon^- and may touch a rigid obstacle
// on Gamma_C,epsilon. The thinner the layer, the stiffer it is: its Lame coefficients are those of
// the body divided by epsilon. The displacement u is out of the plane of the drawing (anti-plane
// elasticity). The obstacle is a stop for that displacement, u >= 0 on Gamma_C,epsilon; the picture
// draws it below Gamma_C and apart from it, in the problem there is no distance between them.
//
// The equations, (21):
//
//     -Delta u = f in the body,   -epsilon^-1 Delta u = 0 in the layer,   u = 0 on Gamma_D,epsilon,
//     on Sigma, between body (+) and layer (-):   u+ = u-,   d_n u+ = epsilon^-1 d_n u-,
//     on Gamma_C,epsilon:   u >= 0,   d_n u >= 0,   u d_n u = 0   (gap or pressure, never both)
//
// From (21) to (22). Take v in K_epsilon = { v = 0 on Gamma_D,epsilon, v >= 0 on Gamma_C,epsilon },
// multiply by v - u, integrate by parts on both parts. The terms on Sigma cancel, by the second
// condition there. What is left on the boundary is
//
//     epsilon^-1 int_Gamma_C d_n u (v - u)  =  epsilon^-1 int_Gamma_C (d_n u) v  >=  0,
//
// since u d_n u = 0 and neither d_n u nor v is negative. This is the term that makes an inequality
// of the equation: with mu_epsilon = 1 in the body and 1/epsilon in the layer,
//
//     u in K_epsilon,   int mu_epsilon grad u . grad (v - u) >= int f (v - u),  all v in K_epsilon  (22)
//
// From (22) to (23). Two difficulties come at once: the domain degenerates and the coefficient
// explodes. The change of variable y~ = y/epsilon in the layer removes the first. There dy =
// epsilon dy~ and d/dy = epsilon^-1 d/dy~, so that
//
//     int_{thin} 1/epsilon |grad u|^2 = int_{unit} |d/dx u|^2 + epsilon^-2 |d/dy~ u|^2         (23)
//
// What is left of the thickness is one factor in front of one form, on a domain that does not
// change (Figure 2).

#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/drawing.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

TriangleMesh squashed(TriangleMesh mesh, double epsilon);                            // Figure 2 to Figure 1
double energy_form(const VariationalInequality& problem, const Eigen::VectorXd& v);  // a(v, v)
Eigen::VectorXd test_function(const Space& space);

void domain(const tutorial::Options& options, tutorial::Report& report) {
  const double epsilon = options.epsilon;
  if (!(epsilon >= 0.05 && epsilon <= 0.6))
    throw Error(fmt::format("--epsilon {}: a layer to look at; accepted 0.05 to 0.6", epsilon));

  // 1. The two drawings.
  tutorial::write_drawing(options.out / "figure1.csv", epsilon, {"$Ω_ε^−$", "$Γ_{D,ε}^−$", "$Γ_{C,ε}$", "$ε$", ""});
  tutorial::write_drawing(options.out / "figure2.csv", 1, {"$Ω^−$", "$Γ_D^−$", "$Γ_C$", "1", "$y ↦ y/ε$"});

  // 2. Both problems on the same triangles: (22) on the thin layer, (23) on the unit layer.
  report.stage("assemble and solve (22) and (23)");
  const TriangleMesh unit = unstructured_mesh(options.cells), thin = squashed(unit, epsilon);
  const Space unit_space(unit, p1()), thin_space(thin, p1());
  const auto original = assemble(Scene(Body{paper_load}, ThinLayer{epsilon}, UnilateralContact{}), thin_space);
  const auto scaled = assemble(Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}), unit_space);

  // 3. The same function on both: its nodal values do not change, only the places of the vertices.
  const Eigen::VectorXd v = test_function(unit_space);
  const double before = energy_form(original, v), after = energy_form(scaled, v);

  // 4. And the same solution of the inequality.
  const Eigen::VectorXd u_thin = active_set(original).u, u_unit = active_set(scaled).u;
  const double apart = (u_thin - u_unit).lpNorm<Eigen::Infinity>(), size = u_unit.lpNorm<Eigen::Infinity>();
  report.finish();

  Table table({"", "thin, (22)", "unit, (23)", "difference"});
  table.add({"a(v, v) of a test function", before, after, after - before});
  table.add({"largest u of the solution", u_thin.maxCoeff(), u_unit.maxCoeff(), apart});
  table.print(fmt::format("epsilon = {}, {} unknowns in both", epsilon, unit_space.free_count()), 10);

  // The verdict. Equal up to round-off: sums of some 1e4 terms, and a solver that stops at 1e-10.
  const double form = std::abs(after / before - 1), solution = apart / size;
  report.claim(form <= 1e-12, "the change of variable keeps the form: a(v, v) agrees to {:.0e}", form);
  report.claim(solution <= 1e-8, "and the solution: (22) and (23) agree to {:.0e}", solution);
}

// Three things to try:
// - --epsilon 0.05: the triangles of the thin layer become needles, 20 times as long as high; those
//   of Figure 2 do not.
// - replace v by a function of x alone: after the change of variable epsilon^-2 multiplies nothing.
// - write (21) on the unit layer: which normal derivative carries the epsilon^-2 on Sigma and on
//   Gamma_C?
int main(int argc, char** argv) {
  tutorial::Options options;
  options.epsilon = 0.15;
  return tutorial::run(argc, argv, "01_domain", "Figures 1 and 2: the domain and the change of variable", options,
                       domain);
}

// The mesh of Figure 1: that of Figure 2 with its layer squashed to the thickness epsilon.
TriangleMesh squashed(TriangleMesh mesh, double epsilon) {
  for (auto vertex : mesh.vertices.rowwise())
    if (vertex.y() < 0) vertex.y() *= epsilon;
  return mesh;
}

// The stiff part wherever it is: in a1 for (22), in B and the compliance for (23).
double energy_form(const VariationalInequality& problem, const Eigen::VectorXd& v) {
  const double rest = v.dot(problem.a1 * v);
  if (problem.b.rows() == 0) return rest;
  const Eigen::VectorXd strain = problem.b * v;
  return rest + strain.dot(problem.m.cwiseProduct(strain)) / problem.compliance;
}

// Some function that is not constant along any direction: sin(3x) e^y + xy.
Eigen::VectorXd test_function(const Space& space) {
  const auto x = space.points().col(0).array(), y = space.points().col(1).array();
  return (3 * x).sin() * y.exp() + x * y;
}
