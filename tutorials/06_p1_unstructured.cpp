// # P1 on the unstructured mesh
//
// Run: 06_p1_unstructured                             the paper's epsilon = 1e-6, h = 1/32; about a second
// Run: 06_p1_unstructured --epsilon 1e-1 --cells 64   a layer that is hardly stiff: no locking yet
// Run: 06_p1_unstructured --exercise 1
// Run: 06_p1_unstructured --exercise 2
//
// Needs: [02](02_meshes.cpp) (kernel, tied triangles), [05](05_p1_structured.cpp) (the limit problem (27),
// Theorem 4).
// :live: mesh=unstructured
//
// **The picture.** Figure 7: the same problem, the same element, about as many triangles as in Figure 5, but the mesh
// of Figure 6. *The ridge on the layer is gone: the solution is flat zero there.* It does not oscillate, it does not
// blow up, it looks perfectly reasonable, and it is wrong by 0.0457, the whole height of the ridge.
//
// **Predict.** (a) Refine: `h = 1/64` in place of `1/32`. How much smaller is the error at `ε = 10⁻⁶`? (b) The body
// does not know that its layer has locked. Which problem does it solve, then?
//
// ## Why it locks
//
// The limit $ε → 0$ of the discrete problem at fixed $h$ is (27), the problem on $K_{0h} = K_h ∩ G_h$ (Proposition
// 1). On this mesh all triangles of the layer are tied together, and every function of $G_h$ is 0 there (chapter 02).
// So
//
// $$ u_h^ε → 0   \text{on the layer, as } ε → 0 \text{ with } h \text{ fixed.} $$
//
// How fast? Write the discrete problem with its stress (chapter 03): $B u = ε² p$. On this mesh $B u = 0$ only for
// $u = 0$ in the layer, so $u$ there is at most a constant (which depends on $h$) times $ε² |p|$, and the stress $p$
// is bounded. What is kept of the ridge falls like $ε²$. Chapter 13 measures how the constant depends on $h$: of the
// ridge about
//
// $$ 1/(1 + x),   x = (h^{3/2}/ε)^2 $$
//
// is kept. All is well while $ε$ is large against $h^{3/2}$. Refining moves this boundary to smaller $ε$; it never
// disappears. So the supremum over $ε$ of the error does not tend to 0: this is what *locking* means.
//
// What is left for the body? On $Σ$ it must fit to a layer that is 0. It is "the solution to a standard Laplace
// problem with an homogeneous Dirichlet boundary condition, without any connection to Problem (25)" (Section 4.1;
// (25) is what (23) tends to, chapter 10).

#include "common/course.hpp"

using namespace antilock;

// Largest |u| over the unknowns of the layer, Σ included.
double largest_on_layer(const Space& space, const Eigen::VectorXd& u) {
  return (space.points().col(1).array() <= 0).select(u.array().abs(), 0).maxCoeff();
}

// The problem that the paper says the locked solution solves, with the same matrices: every unknown of the layer is
// fixed to zero, and nothing is left to touch the obstacle.
VariationalInequality dirichlet_laplace(VariationalInequality problem, const Space& space) {
  problem.fixed.clear();
  for (int i = 0; i < space.size(); ++i) {
    const double x = space.points()(i, 0), y = space.points()(i, 1), round = 1e-12;
    if (!(y > round && y < 1 - round && x > round && x < 1 - round)) problem.fixed.push_back(i);
  }
  problem.fixed_values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.fixed.size()));
  problem.contact.clear();
  problem.lower.resize(0);
  problem.b.resize(0, problem.size());  // the layer is at rest: no stress to carry
  problem.m.resize(0);
  return problem;
}

void lock(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  const Discretisation discrete = Method{&p1(), unstructured()}.on(options.cells);
  const Space& space = discrete.space();
  // ### Forms
  VariationalInequality problem = assemble(tutorial::paper_scene(options.epsilon), space);
  // ### Solve
  // Nothing is wrong with the solver: the conditions of the inequality hold to round-off. It is the discrete
  // problem that has the wrong solution.
  const Solution solution = active_set(problem);
  const Solution dirichlet = active_set(dirichlet_laplace(problem, space));
  const tutorial::Exact exact(tutorial::paper_scene(options.epsilon));
  const Errors errors = exact.errors(space, solution);

  // ### Output
  const double ridge = exact.truth.max_on_contact(), on_layer = largest_on_layer(space, solution.u);
  const double difference = (solution.u - dirichlet.u).cwiseAbs().maxCoeff();
  tutorial::present(options.out, space, problem, solution, "P1, unstructured", errors);
  Table table({"", "value"});
  table.add({"largest |u| on the layer", on_layer});
  table.add({"the same of the truth", ridge});
  table.add({"largest difference from the Dirichlet-Laplace solution", difference});
  table.print();

  // The law of chapter 13; its constant is measured, not derived: a factor 4.
  const double h = 1.0 / options.cells, x = h * h * h / (options.epsilon * options.epsilon);
  const double kept = solution.u(space.contact()).maxCoeff() / ridge;
  if (options.epsilon > 0 && x < 1e12)  // beyond, 1/x is round-off
    report.claim_within(kept * (1 + x), 0.25, 4, "share of the ridge that is kept, times 1 + (h^(3/2)/epsilon)^2:");
  if (options.epsilon > 0.01 * h)
    return report.not_judged("whether the solution vanishes on the layer: it does for epsilon well below h");
  constexpr double solved = 1e-10;  // what the solver leaves of u
  report.claim_within(on_layer, 0, 4 * ridge / (1 + x) + solved, "Figure 7: largest |u| on the layer");
  // The error on the body is below that on the layer, and the largest nodal value of the ridge is below its top by h^2.
  report.claim_within(std::abs(errors.max_at_unknowns / ridge - 1), 0, 10 * h * h, "error / ridge - 1:");
  // Both solve the same equations on the body and differ by on_layer at most on its boundary: a maximum principle.
  report.claim_within(difference, 0, 1.001 * on_layer + solved, "difference from the Dirichlet-Laplace solution:");
  if (x > 1e8) return;  // ten times larger, epsilon must still be far below h^(3/2), and u above round-off
  problem.compliance *= 100;
  const double ten_times = largest_on_layer(space, active_set(problem).u);
  report.claim_within(ten_times / on_layer, 95, 105, "ten times the epsilon keeps a hundred times as much:");
}

// ## What came out
//
// (a) Not at all: the error is 4.57e-2 on both meshes, and by the law it stays so until $1/h$ is about $10^4$. (b) It
// solves the problem of a body that is clamped on $Σ$ as well: the layer acts as a clamp. Neither the solver nor a
// look at the picture would tell.
//
// ## Exercises
//
// 1. Refine from $1/h = 32$ to 64 at $ε = 10^{-6}$. What happens to the error, what to the small rest of the ridge?
// 2. Keep the body's triangles, and put the layer into columns (the layered mesh of chapter 02). Does it lock?
// 3. `--epsilon 1e-2`: the method "locks already" there (caption of Figure 9). Predict by the law what is kept at
//    `--cells 16` and at `--cells 64`, and check.
// 4. On paper: for which loads is nothing lost on this mesh? (Those whose $u^0$ is 0 on the layer. Whether a method
//    locks is a question about all loads.)

#include "answers/06_p1_unstructured.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "06_p1_unstructured", "Figure 7: P1 on an unstructured mesh locks",
                       {.exercises = exercises}, lock);
}
