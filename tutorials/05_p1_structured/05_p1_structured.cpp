// # P1 on the structured mesh
//
// Run: 05_p1_structured                     the paper's epsilon = 1e-6, h = 1/32; about two seconds
// Run: 05_p1_structured --epsilon 0         the limit problem (27) itself, on the same mesh
// Run: 05_p1_structured --epsilon 1 --cells 128
// Run: 05_p1_structured --exercise 1
// Run: 05_p1_structured --exercise 2
//
// **Afterwards you can** say what a method must fulfil to be good at every $ε$, and check
// it for P1 on the structured mesh.
//
// Needs: [02](../02_meshes/02_meshes.cpp) (kernel, structured mesh),
// [03](../03_by_hand/03_by_hand.cpp) (split form, layer stress).
//
// **The picture.** Figure 5, on the mesh of Figure 3: the hill, the valley and the ridge of
// the reference solution. This is the method that works. The question of this chapter is
// why it works, at every $ε$.
//
// **Two things that every chapter uses from here on.** Errors are measured against the
// exact solution of (23). It is a series of sines without a mesh, and
// [chapter 04](../04_reference_solution/04_reference_solution.cpp) derives it. The programs
// use the library. Its words are explained there as well, in ten lines: a *scene* is the
// problem, a *method* is an element with a family of meshes, a *space* is a method at one
// $h$, and a *result* holds the solution.
//
// **Predict.** (a) The same mesh serves $ε = 1$ and $ε = 10^{-12}$. By what factor do the
// errors differ? (b) As $ε → 0$ also $∂_y u → 0$ in the layer. What, then, carries the pull
// of the body through the layer down to the obstacle?
//
// ## Why it works
//
// The limit of (23) is the problem on $K_0 = K ∩ G$, the displacements of $K$ with
// $∂_y v = 0$ in the layer (chapter 02 gave the reason, chapter 10 the proof). The limit of
// the discrete problem is the same with the discrete sets. With $a_1$ the moderate form of
// chapter 01,
//
// $$ u_h^0 ∈ K_{0h} = K_h ∩ G_h,   a_1(u_h^0, w_h - u_h^0) ≥ (f, w_h - u_h^0)   for all w_h ∈ K_{0h}. \tag{27} $$
//
// So a method that is to be good at every $ε$ must be good in two places: its $K_h$ must
// serve for $K$, and its $K_{0h}$ for $K_0$. **Theorem 4** of the paper says that this is
// enough:
//
// > If $K_h$ approaches $K$ and $K_{0h}$ approaches $K_0$, then the error tends to 0
// uniformly in $ε$:
// > it stays below one bound that depends on $h$ alone and tends to 0 with it.
//
// **What *approaches* means** (Definition 1). First, nothing is missed: each element of $K$
// is a limit of elements of $K_h$. Second, nothing foreign is added: elements of $K_h$ that
// come together do so in $K$. But "come together" is meant in a weak sense. A sequence
// $v_h$ tends to $v$ *weakly* if its size stays bounded and its product with each fixed $w$
// tends to that of $v$: $(v_h, w)_1 → (v, w)_1$, where
//
// $$ (v, w)_1 = ∫_Ω v w + ∇v·∇w,   ‖v‖_{1,Ω}^2 = (v, v)_1. $$
//
// The sawteeth below do so, and their limit is 0. The values tend to 0, the slopes do not.
// But against a fixed function the positive slopes cancel the negative ones, the better the
// shorter the teeth. A weak limit forgets what oscillates faster and faster. Chapter 12
// measures both conditions, for five methods.
// :figure: sawteeth
//
// **For $K$** P1 has both, on every regular mesh: interpolants of smooth functions come
// near, and P1 functions that are not negative at the vertices are nowhere negative on
// $Γ_C$.
//
// **For $K_0$** the mesh decides. Its second condition holds, since functions of $K_{0h}$
// lie in $K_0$ themselves, and their weak limits do not leave $K_0$ (chapter 10 says why).
// The first one asks that each function of $K_0$ is a limit of functions of $K_{0h}$. It is
// enough to ask it of smooth ones, since they come as near as one likes to any (Lemma 1).
// Take such a $v$. In the layer it is a function of $x$ and not negative. Its *interpolant*
// is the P1 function with the same values at the vertices. On the structured mesh, vertices
// above each other have equal values, so the interpolant is a sum of the hat functions of
// the vertical lines, with factors that are not negative. These are in $K_{0h}$ (chapter
// 02): on this mesh the interpolant does not leave the kernel. And it is as near to $v$ as
// interpolants are. So Theorem 4 applies, and
//
// $$ \lim_{h→0} \sup_{0<ε≤1} ‖u^ε - u_h^ε‖_{1,Ω} = 0.   \text{(Theorem 5)} $$
//
// **The layer stress.** Put a function that lives in the layer alone into (23), and
// integrate by parts: $∂_y p = -∂_{xx} u$ there. For small $ε$, $u$ is a function of $x$,
// so $p$ is a straight line in $y$. At the top it is the pull of the body, $p = ∂_y u^+$ on
// $Σ$, at the bottom the pressure of the obstacle, $p = -λ$ on $Γ_C$.

#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;

// Theorem 5 in one column: the largest error at the unknowns of one mesh, for one epsilon
// after the other.
Table sweep_epsilon(const Space& space) {
  Table sweep({"epsilon", "error"});
  for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12, 0.0}) {
    const tutorial::Exact exact(tutorial::paper_scene(epsilon));
    sweep.add(
        {epsilon,
         exact.errors(space, active_set(assemble(exact.scene, space))).max_at_unknowns});
  }
  return sweep;
}

// How well the stress fits, at one $x$ after the other. Lay a straight line through its
// lowest and its highest value. How far is the middle value off this line, the line off
// $-λ$ at $y = -1$, and the line off the exact stress at $y = 0$? Each answer is divided by
// the largest stress. The values belong to the middles of cells, so the line must be
// continued by half a cell at either end.
Table off_the_line(const Table& stress, const Eigen::VectorXd& force,
                   const ExactSolution& exact_solution, double h) {
  Table off({"x", "line", "bottom", "top"});
  const double size = std::max(stress.max("top"), -stress.min("bottom")),
               half = 0.5 * h / (1 - h);
  for (int i = 0; const Table& row : stress.rows()) {
    const double top = row.number("top"), bottom = row.number("bottom"),
                 x = row.number("x");
    off.add(
        {x, std::abs(row.number("middle") - (top + bottom) / 2) / size,
         std::abs(bottom + half * (bottom - top) + force(i++) / h) / size,
         std::abs(top + half * (top - bottom) - exact_solution.layer_stress(x, 0)) / size});
  }
  return off;
}

// **The integrals of (23) in C++**, for two P1 functions with the values $u$ and $v$ at the
// vertices. On a triangle their derivatives are numbers, sums over the hat functions. So
// each integral is an area times a product. `assemble` turns the same sums into the
// matrices of chapter 03, and a verdict compares both.
struct Forms {
  double moderate = 0, stiff = 0;  // a_1(u, v) and a_y^-(u, v)
};
Forms integrate(const Space& space, const Eigen::VectorXd& u, const Eigen::VectorXd& v) {
  const TriangleMesh& mesh = space.mesh();
  Forms forms;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::RowVector3i corners = mesh.triangles.row(t);
    const Eigen::Matrix<double, 3, 2> hats = barycentric_gradients(mesh, t);
    const Eigen::RowVector2d du = u(corners).transpose() * hats;
    const Eigen::RowVector2d dv = v(corners).transpose() * hats;
    forms.moderate += mesh.area(t) * du.x() * dv.x();  // d/dx d/dx, in body and layer
    double& across = mesh.region[t] == Region::body ? forms.moderate : forms.stiff;
    across += mesh.area(t) * du.y() * dv.y();  // d/dy d/dy: moderate in the body alone
  }
  return forms;
}

void structured_study(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  const Space space = Method{&p1(), structured({}, Diagonal::right)}.space(options.cells);
  // ### Forms
  // The load is `paper_load`; any other goes here, as `SineLoad{{{2, {10}}}}`
  // ($10 \sin 2πx$), and into the truth below.
  const Scene scene(Body{paper_load}, StiffLayer{options.epsilon}, UnilateralContact{});
  const VariationalInequality problem = assemble(scene, space);
  // ### Solve
  const Solution solution = active_set(problem);
  const tutorial::Exact exact(scene);
  const Errors errors = exact.errors(space, solution);
  const Table sweep = sweep_epsilon(space),
              stress = tutorial::stress_by_depth(space, solution);
  const double h = 1.0 / options.cells;
  const Table off = off_the_line(stress, solution.lambda, exact.solution, h);

  // ### Output
  tutorial::present(options.out, exact.scene, {space, problem, solution}, "P1, structured",
                    errors);
  sweep.print("error at the unknowns against epsilon");
  fmt::print(
      "  stress: off the line {:.0e}, off -lambda {:.0e}, off the exact one on Sigma "
      "{:.3f}\n",
      off.max("line"), off.max("bottom"), off.max("top"));
  sweep.write(options.out / "sweep.csv");
  stress.write(options.out / "stress.csv");
  tutorial::on_contact({1.0, 1e-1, 1e-2, 0.0}, space)
      .write(options.out / "contact_by_epsilon.csv");
  tutorial::sawteeth().write(options.out / "sawteeth.csv");

  const Eigen::VectorXd v =
      space.dof_coordinates().col(0).cwiseProduct(space.dof_coordinates().col(1));
  const Forms forms = integrate(space, v, v);
  const double moderate = v.dot(problem.a1 * v);
  const double stiff = (problem.b * v).cwiseAbs2().dot(problem.m);
  // sums of some 10^4 rounded terms
  report.claim_within(
      std::max(std::abs(forms.moderate / moderate - 1), std::abs(forms.stiff / stiff - 1)),
      0, 1e-12, "v = x y: the integrals are those of the matrices (proved), apart by");
  // Both constants are seen. What is proved is that they exist, the second one for all
  // epsilons together.
  report.claim_within(errors.max_at_unknowns / (h * h), 0.16, 0.64,
                      "Figure 5: error at the unknowns / h^2 (observed):");
  report.claim_within(sweep.max("error") / (h * h), 0.26, 1.05,
                      "Theorem 5: worst of nine epsilons / h^2 (observed):");
  // u^epsilon differs from u^0 by O(epsilon^(3/2)) (chapter 10): below 1e-2 that is 1e-3 of
  // u, and 1 % of an error.
  const Table small =
      sweep.filter_number("epsilon", [](double epsilon) { return epsilon <= 1e-2; });
  report.claim_within(small.max("error") / small.min("error") - 1, 0, 0.01,
                      "spread of the errors below 1e-2 (observed):");
  const double from = contact_zone({space, problem, solution}).from.value_or(1);
  report.claim_within((from - exact.contact_from()) / h, -1, 1,
                      "start of contact - truth, in cells (observed):");
  if (options.epsilon > 1e-3)
    return report.not_judged(
        "the stress as a straight line in y: it is one for small epsilon");
  // d_yy p = -d_xx (d_y u) = -epsilon^2 d_xx p, and p jumps in a cell: bent by (epsilon /
  // h)^2 / 8 and 6e-9 of round-off.
  const double round_off = 6e-9 + std::pow(options.epsilon / h, 2) / 8;
  report.claim(off.max("line") <= round_off,
               "the stress is a straight line in y, up to {:.0e} (proved)",
               off.max("line"));
  report.claim(off.max("bottom") <= round_off,
               "which ends at -lambda on Gamma_C, up to {:.0e} (proved)",
               off.max("bottom"));
  report.claim_within(
      off.max("top") / h, 0, 0.5,
      "and begins at the pull of the body on Sigma, up to h times (observed)");
}

// ## What came out
// :output: error at the unknowns
//
// (a) By a factor 1.6: the error is 5.1e-4 at $ε = 1$ and 3.1e-4 at $10^{-1}$. Below
// $10^{-2}$ all errors agree to 0.13 %: one mesh serves all.
// :number: 5.1e-4 = table "error at the unknowns" error epsilon=1
// :number: 3.1e-4 = table "error at the unknowns" error epsilon=0.1
// :number: 0.13 = 100 * line "spread of the errors below 1e-2 (observed): {}"
// :figure: contact_by_epsilon
//
// (b) By the stress $p = ε^{-2} ∂_y u$, which is *not* small: a tiny slope times a huge
// stiffness is a finite force. Its straight line begins at the pull of the body and ends at
// $-λ$, which is 0 where nothing touches. Where the layer is free, none of the pull arrives
// at the bottom. There the layer is a string: by $∂_y p = -u''$ the pull bends the ridge,
// and the tension of the ridge carries it along $x$ to the clamped end and to the contact.
// :figure: stress
//
// ## Exercises
//
// 1. Turn the diagonals of the mesh to the left. Does P1 lock?
// 2. Double the load. Does the contact zone grow? Does the pressure double?
// 3. On paper: integrate $∂_y p = -u''(x)$ over the layer. Which condition on $Σ$ is left
//    of the layer?
//
// ## Further reading
//
// - [Mosco 1969](../guides/bibliography.md#mosco-1969): the two conditions of Definition 1,
//   for functions that do not jump.
// - [Glowinski 1984](../guides/bibliography.md#glowinski-1984): a proof of convergence for
//   inequalities with finite elements.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "05_p1_structured",
                       "Figure 5: P1 on a structured mesh does not lock",
                       {.least_cells = 2, .exercises = exercises}, structured_study);
}
