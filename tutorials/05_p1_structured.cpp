// # P1 on the structured mesh
//
// Run: 05_p1_structured                     the paper's epsilon = 1e-6, h = 1/32; about a second
// Run: 05_p1_structured --epsilon 0         the limit problem (27) itself, on the same mesh
// Run: 05_p1_structured --epsilon 1 --cells 128
// Run: 05_p1_structured --exercise 1
// Run: 05_p1_structured --exercise 2
//
// Needs: [02](02_meshes.cpp) (kernel, structured mesh), [03](03_by_hand.cpp) (split form, layer stress),
// [04](04_reference_solution.cpp) (the truth).
//
// **The pictures.** Figure 5, on the mesh of Figure 3: the hill, the valley and the ridge of the reference solution.
// *P1 on the structured mesh does not lock.* The second picture shows `u` and the contact pressure on `Γ_C` for four
// `ε`: the thinner the layer, the less changes. The third shows the layer stress `p = ε⁻² ∂_y u` at three depths.
//
// **Predict.** (a) The same mesh serves `ε = 1` and `ε = 10⁻¹²`. By what factor do the errors differ? (b) `∂_y u → 0`
// in the layer. What does the layer do, then, to bring the pull of the body down to the obstacle?
//
// ## Why it works
//
// Vertical mesh lines leave one hat function of $x$ per inner line in the kernel $G_h$ (chapter 02). The limit of
// (23) is the problem on $K_0 = K ∩ G$, the displacements of $K$ with $∂_y v = 0$ in the layer; that of the discrete
// problem is
//
// $$ u_h^0 ∈ K_{0h} = K_h ∩ G_h,   a_1(u_h^0, w_h - u_h^0) ≥ (f, w_h - u_h^0)   for all w_h ∈ K_{0h}. \tag{27} $$
//
// **Theorem 4** of the paper: *if $K_h$ approaches $K$ and $K_{0h}$ approaches $K_0$, the error tends to 0 uniformly
// in $ε$*: one bound, which depends on $h$ and not on $ε$, tends to 0. "$K_h$ approaches $K$" has two parts
// (Definition 1; chapter 11 measures it). Every element of $K$ is a limit of elements of $K_h$. And no weak limit of
// elements of $K_h$ lies outside $K$. ($v_h$ tends to $v$ *weakly* if it stays bounded and $a_1(v_h, w)$ tends to
// $a_1(v, w)$ for every fixed $w$: $v_h$ may oscillate faster and faster.) P1 has both for $K$ on every regular mesh.
// $K_0$ asks for more: every nonnegative function of $x$ on the layer must be a limit of functions in $K_{0h}$. On
// this mesh it is one. $K_{0h}$ contains the nonnegative sums of the hat functions of the vertical lines, so the
// *interpolant* of such a function, which has its values at the vertices, is among them. With $‖v‖_{1,Ω}$, the norm
// that measures $v$ and its first derivatives in body and layer, this gives
//
// $$ \lim_{h→0} \sup_{0<ε≤1} ‖u^ε - u_h^ε‖_{1,Ω} = 0.   \text{(Theorem 5)} $$
//
// **The layer stress.** Put a function that lives in the layer into (23): $∂_y p = -∂_{xx} u$ there. For small $ε$,
// $u$ is a function of $x$, so $p$ is a straight line in $y$: from the pull of the body at the top, $p = ∂_y u^+$ on
// $Σ$, to the pressure of the obstacle at the bottom, $p = -λ$ on $Γ_C$. The stress is what keeps $∂_y u$ at 0. It
// stays finite.

#include "common/course.hpp"
#include "common/layer_curves.hpp"

using namespace antilock;

// Theorem 5 in one column: the largest error at the unknowns of one mesh, for one epsilon after the other.
Table sweep_epsilon(const Space& space) {
  Table sweep({"epsilon", "error"});
  for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12, 0.0}) {
    const Solution solution = active_set(assemble(tutorial::paper_scene(epsilon), space));
    sweep.add({epsilon, tutorial::Exact(tutorial::paper_scene(epsilon)).errors(space, solution).max_at_unknowns});
  }
  return sweep;
}

void structured_study(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  const Discretisation discrete = Method{&p1(), structured({}, Diagonal::right)}.on(options.cells);
  const Space& space = discrete.space();
  // ### Forms
  const VariationalInequality problem = assemble(tutorial::paper_scene(options.epsilon), space);
  // ### Solve
  const Solution solution = active_set(problem);
  const tutorial::Exact exact(tutorial::paper_scene(options.epsilon));
  const Errors errors = exact.errors(space, solution);
  const Table sweep = sweep_epsilon(space), stress = tutorial::stress_by_depth(space, solution);

  // ### Output
  tutorial::present(options.out, space, problem, solution, "P1, structured", errors);
  sweep.print("error at the unknowns against epsilon");
  sweep.write(options.out / "sweep.csv");
  stress.write(options.out / "stress.csv");
  tutorial::on_contact({1.0, 1e-1, 1e-2, 0.0}, space).write(options.out / "contact_by_epsilon.csv");

  // The cap is the interpolation error of the truth, h^2 / 8 |u''| with |u''| <= 10, rounded down to h^2.
  const double h = 1.0 / options.cells, worst = sweep.most("error");
  report.claim_within(errors.max_at_unknowns / (h * h), 0, 1, "Figure 5 agrees with the truth; error / h^2:");
  report.claim_within(worst / (h * h), 0, 1, "Theorem 5: worst error over nine epsilons down to 0, / h^2:");
  // u^epsilon differs from u^0 by O(epsilon^(3/2)) (chapter 10): below 1e-2 that is 1e-3 of u. 5 %: of an error.
  const Table small = sweep.where_number("epsilon", [](double epsilon) { return epsilon <= 1e-2; });
  report.claim_within(small.most("error") / small.least("error") - 1, 0, 0.05, "spread of the errors below 1e-2:");
  const double from = contact_zone(space, problem, solution).from.value_or(1);
  report.claim_within((from - exact.contact_from()) / h, -1, 1, "start of contact - truth, in cells:");
  if (options.epsilon > 0.01)
    return report.not_judged("the stress as a straight line in y: it is one for small epsilon");
  // middle - mean of top and bottom, all at the centres of cells; h: they are half a cell away from the boundary
  double bent = 0, size = 0;
  for (const Table& row : stress.rows()) {
    bent = std::max(bent, std::abs(row.number("middle") - 0.5 * (row.number("top") + row.number("bottom"))));
    size = std::max(size, std::abs(row.number("top")));
  }
  report.claim_within(bent / size, 0, h, "the stress is a straight line in y: bent by a share of");
}

// ## What came out
//
// (a) By a factor 1.6 between $ε = 1$ and $10^{-1}$, and not at all below: one mesh serves all. (b) It transmits the
// pull by the stress $p$, which is *not* small. In the picture the bottom curve is $-λ$, and 0 where nothing touches.
//
// ## Exercises
//
// 1. Turn the diagonals of the mesh to the left. Does P1 lock?
// 2. Double the load. Does the contact zone grow? Does the pressure double?
// 3. On paper: integrate $∂_y p = -u''(x)$ over the layer to get $λ = -∂_y u^+ - u''$ on $Σ$, the condition that is
//    left of the layer. (Chapter 10 calls it Ventcel's.)

#include "answers/05_p1_structured.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "05_p1_structured", "Figure 5: P1 on a structured mesh does not lock",
                       {.least_cells = 2, .exercises = exercises}, structured_study);
}
