// # The domain and its thin layer
//
// Run: 01_domain                  the layer drawn with thickness 0.15; a moment
// Run: 01_domain --epsilon 0.3
// Run: 01_domain --exercise 1
//
// **Afterwards you can** derive problem (23) from its strong form, and say by a change of
// variable which derivative in the layer is stiff.
//
// Needs: [00](../00_string_on_an_obstacle/00_string_on_an_obstacle.cpp) (variational
// inequality, cone, complementarity).
//
// **The picture.** An elastic body $Ω^+ = (0,1) × (0,1)$ is clamped on $Γ^+$, both sides
// and the top. A thin stiff layer $Ω_ε^- = (0,1) × (-ε,0)$ is grafted onto its lower side
// $Σ$. The layer is clamped at its two ends, $Γ_{D,ε}^-$. On its own lower side, $Γ_{C,ε}$,
// it may touch a rigid obstacle. The obstacle is drawn apart from it, to be seen: in the
// problem there is no distance between them.
//
// **What $u$ is.** The displacement $u(x, y)$ points out of the plane of the drawing: this
// is *anti-plane* elasticity. The body is sheared, as a bundle of pencils is of which each
// is pushed along its length. Every line at right angles to the drawing moves as a whole.
// The obstacle is a stop for this displacement: $u ≥ 0$ on $Γ_{C,ε}$.
//
// **Predict.** (a) The layer becomes thinner, and its stiffness grows like $1/ε$. Does it
// cost more or less energy to shear it along $x$, so that $u$ changes from left to right?
// (b) And to shear it across, so that $u$ changes from $Σ$ to $Γ_{C,ε}$?
//
// ## The equations
//
// $∂_n$ is the derivative along the outward normal $n$, of the body on $Σ$ and of the layer
// on $Γ_{C,ε}$. The paper's first problem is
//
// $$ -Δu = f in Ω^+,   -ε^{-1} Δu = 0 in Ω_ε^-,   u = 0 on Γ_{D,ε} = Γ^+ ∪ Γ_{D,ε}^-, $$
//
// $$ u^+ = u^-,   ∂_n u^+ = ε^{-1} ∂_n u^-   on Σ, $$
//
// $$ u ≥ 0,   ∂_n u ≥ 0,   u ∂_n u = 0   on Γ_{C,ε}. \tag{21} $$
//
// The last line is chapter 00's complementarity: $ε^{-1} ∂_n u$ is the pressure of the
// obstacle.
//
// **From (21) to (22).** Let $K_ε = \{ v : v = 0 on Γ_{D,ε}, v ≥ 0 on Γ_{C,ε} \}$, and
// $v ∈ K_ε$. Multiply the first line by $v - u$ and integrate by parts on both parts. On
// $Σ$ the body leaves $∂_n u^+ (v - u)$ and the layer, whose outward normal is $-n$, leaves
// $-ε^{-1} ∂_n u^- (v - u)$: they cancel, by the second line. Where the body or the layer
// is clamped, both displacements are 0. On the side of the obstacle one term is left, the
// work of the pressure. It is added to that of the load. This work is not negative: by the
// third line the pressure does no work on $u$ and is nowhere negative, and $v$ is nowhere
// negative either. Leave it out, and the equation becomes an inequality:
//
// $$ ε^{-1} ∫_{Γ_{C,ε}} ∂_n u (v - u) = ε^{-1} ∫_{Γ_{C,ε}} (∂_n u) v ≥ 0. $$
//
// With $μ_ε = 1$ in the body and $μ_ε = 1/ε$ in the layer, and no load in the layer,
//
// $$ u ∈ K_ε,   ∫_{Ω_ε} μ_ε ∇u·∇(v - u) ≥ ∫_{Ω^+} f (v - u)   for all v ∈ K_ε. \tag{22} $$
//
// **From (22) to (23).** As $ε → 0$ the domain degenerates and the coefficient explodes.
// Put $\tilde y = y/ε$ in the layer: $dy = ε d\tilde y$ and $∂_y = ε^{-1} ∂_{\tilde y}$.
// Hence, with $Ω^- = (0,1) × (-1,0)$,
//
// $$ ∫_{Ω_ε^-} ε^{-1} |∇u|² = ∫_{Ω^-} |∂_x u|² + ε^{-2} |∂_{\tilde y} u|². $$
//
// The thickness has left the domain: it stands in front of one derivative. This is the
// domain from now on.
// :figure: figure2
//
// Write $y$ for $\tilde y$ again, and give the three integrals names:
//
// $$ a^+(u,v) = ∫_{Ω^+} ∇u·∇v,   a_x^-(u,v) = ∫_{Ω^-} ∂_x u ∂_x v,   a_y^-(u,v) = ∫_{Ω^-} ∂_y u ∂_y v. $$
//
// After the change of variable leave the $ε$ out of the names too: $Γ_C$ is the side
// $y = -1$, and $Γ_D$ is what is clamped. Write $Ω$ for body and unit layer together, and
// $(f, v)$ for the work of the load. The displacements that are allowed without and with
// the obstacle are
//
// $$ V = \{ v : v = 0 on Γ_D \},   K = \{ v ∈ V : v ≥ 0 on Γ_C \},   (f, v) = ∫_{Ω^+} f v. $$
//
// The functions of $V$ have finite energy: $∫_Ω v^2 + |∇v|^2$ is finite, and its root $‖v‖$
// is their *norm*. (This is the space $H^1$.) The problem of this whole course reads
//
// $$ u ∈ K,   a^+(u, v-u) + a_x^-(u, v-u) + ε^{-2} a_y^-(u, v-u) ≥ (f, v-u)   for all v ∈ K. \tag{23} $$
//
// One factor $ε^{-2}$ in front of one form is left. The form behind it is called *stiff*:
// $a_0 = a_y^-$. The rest is the *moderate* form, $a_1 = a^+ + a_x^-$. The load is
// $f = 10 \sin 2πx$, chosen here: the paper gives none.

#include "antilock/core/error.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;

TriangleMesh squashed(TriangleMesh mesh, double epsilon);  // Figure 2 to Figure 1
double energy_form(const VariationalInequality& problem,
                   const Eigen::VectorXd& v);  // a(v, v)
Eigen::VectorXd test_function(const Space& space);

void domain(const tutorial::Options& options, tutorial::Report& report) {
  const double epsilon = options.epsilon;
  if (!(epsilon >= 0.05 && epsilon <= 0.6))
    throw Error(
        fmt::format("--epsilon {}: a layer to look at; accepted 0.05 to 0.6", epsilon));

  // ### Output
  tutorial::write_drawing(options.out / "figure1.csv", epsilon,
                          {"$Ω_ε^−$", "$Γ_{D,ε}^−$", "$Γ_{C,ε}$", "$ε$", ""});
  tutorial::write_drawing(options.out / "figure2.csv", 1,
                          {"$Ω^−$", "$Γ_D^−$", "$Γ_C$", "1", "$y ↦ y/ε$"});

  // ### Mesh
  // The same triangles twice: thin for (22), unit for (23).
  const Space unit_space(unstructured_mesh(options.cells), p1()),
      thin_space(squashed(unit_space.mesh(), epsilon), p1());
  // ### Forms
  const auto original = assemble(
      Scene(Body{paper_load}, ThinLayer{epsilon}, UnilateralContact{}), thin_space);
  const auto scaled = assemble(
      Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}), unit_space);

  // The same function on both: only the places of the vertices change.
  const Eigen::VectorXd v = test_function(unit_space);
  const double before = energy_form(original, v), after = energy_form(scaled, v);

  // ### Solve
  const Eigen::VectorXd u_thin = active_set(original).u, u_unit = active_set(scaled).u;
  const double apart = (u_thin - u_unit).lpNorm<Eigen::Infinity>(),
               size = u_unit.lpNorm<Eigen::Infinity>();

  Table table({"", "thin, (22)", "unit, (23)", "difference"});
  table.add({"a(v, v) of a test function", before, after, after - before});
  table.add({"largest u of the solution", u_thin.maxCoeff(), u_unit.maxCoeff(), apart});
  table.print(
      fmt::format("epsilon = {}, {} unknowns in both", epsilon, unit_space.free_count()),
      10);

  // Equal but for round-off: sums of some 1e4 terms leave 1e-15 of a form, and the solver
  // stops at 1e-10 of u.
  const double form = std::abs(after / before - 1), solution = apart / size;
  report.claim(form <= 1e-13,
               "the change of variable keeps the form: a(v, v) agrees to {:.0e} (proved)",
               form);
  report.claim(solution <= 1e-10,
               "and the solution: (22) and (23) agree to {:.0e} (proved)", solution);
}

// ## What came out
// :output:
//
// Form and solution are the same on both domains, but for round-off (chapter 18): the
// energy of the test function is 63.896267 on either, and $u$ rises to 0.235526.
// :number: 63.896267 = table "epsilon = 0.15" "thin, (22)" "=a(v, v) of a test function"
// :number: 0.235526 = table "epsilon = 0.15" "unit, (23)" "=largest u of the solution"
//
// (a) Neither more nor less. A function of $x$ alone has the energy $ε^{-1} ∫ |∂_x u|²$ on
// an area like $ε$: the two factors cancel. (b) More, like $ε^{-2}$. A change across takes
// place over the thickness of the layer. So its slope grows like $1/ε$, the square of the
// slope like $ε^{-2}$, and the same two factors cancel. As the layer becomes thinner this
// costs more than any load supplies: in the limit the displacement does not vary across the
// layer. The stiff form enforces it, and a discretisation must be able to do it. That is
// what this course is about.
//
// ## Exercises
//
// 1. The layer is made thinner. Which costs more energy from then on: $\sin πx$, or
//    $\tilde y \sin πx$ in the layer?
// 2. On paper: which condition of (21) changes for an obstacle at distance $g$? Which term
//    of the derivation?
// 3. On paper: write (21) on the unit layer. Which equation holds in it, and what passes
//    from body to layer on $Σ$?
//
// ## Further reading
//
// - [Slimane and Renard 2004](../guides/bibliography.md#slimane-2004): the problems (21) to
//   (23), in the words of the paper.
// - [Kikuchi and Oden 1988](../guides/bibliography.md#kikuchi-1988): contact conditions in
//   elasticity, derived in the same way.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "01_domain",
                       "Figures 1 and 2: the domain and the change of variable",
                       {.epsilon = 0.15, .exercises = exercises}, domain);
}

// The mesh of Figure 1: that of Figure 2 with its layer squashed to the thickness epsilon.
TriangleMesh squashed(TriangleMesh mesh, double epsilon) {
  for (auto vertex : mesh.vertices.rowwise())
    if (vertex.y() < 0) vertex.y() *= epsilon;
  return mesh;
}

// The stiff part is in a1 for (22), and in B and epsilon^2 for (23).
double energy_form(const VariationalInequality& problem, const Eigen::VectorXd& v) {
  const double rest = v.dot(problem.a1 * v);
  if (problem.b.rows() == 0) return rest;
  const Eigen::VectorXd strain = problem.b * v;
  return rest + strain.dot(problem.m.cwiseProduct(strain)) / problem.compliance;
}

// Some function that is not constant along any direction: sin(3x) e^y + xy.
Eigen::VectorXd test_function(const Space& space) {
  const auto x = space.dof_coordinates().col(0).array(),
             y = space.dof_coordinates().col(1).array();
  return (3 * x).sin() * y.exp() + x * y;
}
