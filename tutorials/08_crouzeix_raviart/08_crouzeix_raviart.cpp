// # Crouzeix-Raviart does not lock
//
// Run: 08_crouzeix_raviart                          the paper's epsilon = 1e-6, h = 1/32; about a second
// Run: 08_crouzeix_raviart --epsilon 0 --cells 64   the limit problem (30) itself
// Run: 08_crouzeix_raviart --exercise 1
// Run: 08_crouzeix_raviart --exercise 2
//
// **Afterwards you can** define the element of Crouzeix and Raviart, prove by Green's
// formula why it keeps the ridge on every mesh, and name its price.
//
// Needs: [05](../05_p1_structured/05_p1_structured.cpp) ((27), Theorem 4),
// [06](../06_p1_unstructured/06_p1_unstructured.cpp), [07](../07_kernel/07_kernel.cpp)
// (kernel).
//
// **The picture.** Figure 8: the mesh of Figure 6, on which P1 locks, and the ridge is
// there. *Crouzeix-Raviart did not lock on any mesh that was tried. This page has the core
// of the proof that it cannot; three of its conditions are checked in chapters 12 and 14.*
// Look closely: the triangles do not quite meet.
//
// :figure: figure8
//
// **Predict.** (a) P1 takes over the values of a ridge $w(x)$ at the corners of a triangle,
// and gets a slope across the layer (chapter 06). Crouzeix-Raviart takes over the means
// over the three edges. Does it get a slope that falls with $h$, or none at all? (b) The
// truth is not negative on all of $Γ_C$. The solution of Crouzeix-Raviart is asked to be so
// at the midpoints of edges. Is it so between them?
//
// ## The element, and the interpolation that makes it work
//
// $V_h^{nc}$ are the functions that are affine on each triangle, continuous at the
// midpoints of the edges, and 0 at those on $Γ_D$: one unknown per edge, three halves per
// triangle (P1: half a vertex per triangle). Such a function jumps, so it is not in $V$:
// the method is *nonconforming*, while P1 is *conforming*. The next picture shows one basis
// function of each: P1's hat is 1 at a vertex and reaches over six triangles; that of
// Crouzeix-Raviart is 1 along an edge, reaches over two triangles, and jumps at the other
// ends of both.
//
// :figure: basis
//
// Integrals and norms are taken triangle by triangle (*broken*; $‖·‖_{1,Ω_h}$ is the broken
// norm), and contact is asked at midpoints:
// $K_h^{nc} = \{ v ≥ 0 \text{ at the midpoints on } Γ_C \}$. $G_h^{nc}$ are the functions
// with $∂_y v = 0$ on each triangle of the layer. With that, (23) becomes (29), and (27)
// becomes (30).
//
// **The interpolation** $I_h$ gives each midpoint the mean of $v$ over its edge. For an
// affine function the mean over an edge is the value at its midpoint, so on each triangle
// $T$ with outward normal $n$, by Green's formula,
//
// $$ ∫_T ∇ I_h v = ∑_{E ⊂ ∂T} n_E ∫_E I_h v = ∑_{E ⊂ ∂T} n_E ∫_E v = ∫_T ∇ v. $$
//
// *The gradient of $I_h v$ is the mean of the gradient of $v$.* So if $v$ has no slope in
// one direction, $I_h v$ has none either, on whatever triangle: this is why the element
// does not lock. **Lemma 2** of the paper says: $K_h^{nc}$ approaches $K$, and
// $K_{0h}^{nc} = K_h^{nc} ∩ G_h^{nc}$ approaches $K_0$. Its proof rests on three properties
// of $I_h$:
//
// - If $v ∈ K_0$, then $∂_y v = 0$ in the layer, and so $∂_y I_h v = 0$ on its triangles,
//   on every mesh: $B I_h v = 0$.
// - If $v ≥ 0$ on $Γ_C$, so are its means: $I_h v ≥ 0$ at the midpoints. Hence $I_h$ maps
//   $K_0$ into $K_{0h}^{nc}$.
// - $I_h v$ is near $v$, if $v$ is smooth in the body and in the layer ($|v|_2$: the size
//   of its second derivatives):
//
// $$ ‖v - I_h v‖_{1,Ω_h} ≤ C h (|v|_{2,Ω^+} + |v|_{2,Ω^-}). \tag{32} $$
//
// Every function of $K$ or $K_0$ is a limit of smooth ones, so the first half of
// "approaches" follows (chapter 05). The second half, on weak limits, is checked in
// [chapter 12](../12_contact_sets/12_contact_sets.cpp). Theorem 4 asks for two more things
// of methods that jump, which [chapter 14](../14_estimates/14_estimates.cpp) checks. With
// these it applies, and asks nothing of the mesh but good angles:
//
// $$ \lim_{h→0} \sup_{0<ε≤1} ‖u^ε - u_h^{nc,ε}‖_{1,Ω_h} = 0.   \text{(Theorem 7)} $$
//
// The element jumps, but only with mean 0 on each edge.
// [Chapter 35](../35_interior_penalty/35_interior_penalty.cpp) shows that this is the right
// condition: the method of that chapter locks if it restricts the whole jump.

#include "antilock/measure/residual.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;

// **The element in C++.** Let $λ_i$ be the hat function of corner $i$ on a triangle. The
// basis function of the edge opposite to it is $1 - 2 λ_i$: on this edge $λ_i = 0$, and at
// the two other midpoints $λ_i = ½$. These two lines are the whole difference from P1.
Eigen::Array3d basis(const Eigen::Array3d& lambda) { return 1 - 2 * lambda; }
constexpr double derivative = -2;  // of the basis function i by lambda_i

// The integrals are those of chapter 05, with these derivatives and a value per edge.
struct Forms {
  double moderate = 0, stiff = 0;  // a_1(u, v) and a_y^-(u, v), triangle by triangle
};
Forms integrate(const Space& space, const Eigen::VectorXd& u, const Eigen::VectorXd& v) {
  const TriangleMesh& mesh = space.mesh();
  Forms forms;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::RowVector3i edges = mesh.triangle_edges.row(t);  // edge i opposite to i
    const Eigen::Matrix<double, 3, 2> gradients =
        derivative * barycentric_gradients(mesh, t);
    const Eigen::RowVector2d du = u(edges).transpose() * gradients;
    const Eigen::RowVector2d dv = v(edges).transpose() * gradients;
    forms.moderate += mesh.area(t) * du.x() * dv.x();
    double& across = mesh.region[t] == Region::body ? forms.moderate : forms.stiff;
    across += mesh.area(t) * du.y() * dv.y();
  }
  return forms;
}

// $I_h v$: the mean over each edge, by Gauss's rule of three points on 16 parts of it.
Eigen::VectorXd edge_means(const Space& space, const Field& v) {
  const TriangleMesh& mesh = space.mesh();
  Eigen::VectorXd means = Eigen::VectorXd::Zero(space.size());
  for (int e = 0; e < mesh.edge_count(); ++e)
    for (int part = 0; part < 16; ++part)
      for (const auto& [place, weight] : {std::pair{0.5 - std::sqrt(0.15), 5.0},
                                          {0.5, 8.0},
                                          {0.5 + std::sqrt(0.15), 5.0}}) {
        const double t = (part + place) / 16;
        const Eigen::RowVector2d at = (1 - t) * mesh.vertices.row(mesh.edges(e, 0)) +
                                      t * mesh.vertices.row(mesh.edges(e, 1));
        means(e) += weight / (18 * 16) * v(at.x(), at.y());
      }
  return means;
}

// Lemma 2 in numbers: strain and smallest value on $Γ_C$ of $I_h u^0$, and its distance
// from $u^0$, the truth.
Table interpolate(const std::vector<int>& cells, const Element& element) {
  const tutorial::Exact limit(tutorial::paper_scene(0));
  Table table({"cells", "h", "strain", "smallest", "distance"});
  for (const int n : cells) {
    const Space space = Method{&element, unstructured()}.space(n);
    const VariationalInequality problem = assemble(tutorial::paper_scene(0), space);
    Solution interpolated;
    const Field u0 = [&](double x, double y) { return limit.table.value(x, y); };
    interpolated.u = element.conforming() ? interpolant(space, u0) : edge_means(space, u0);
    interpolated.p = Eigen::VectorXd::Zero(problem.b.rows());
    table.add({n, 1.0 / n, (problem.b * interpolated.u).lpNorm<Eigen::Infinity>(),
               interpolated.u(space.contact_dofs()).minCoeff(),
               limit.errors(space, interpolated).h1});
  }
  return table;
}

void nonconforming(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  // The very mesh of chapter 06, and two spaces on it.
  const Space conforming = Method{&p1(), unstructured()}.space(options.cells);
  const Space space(conforming, crouzeix_raviart());
  // ### Forms
  // The scene does not know the element.
  const Scene scene = tutorial::paper_scene(options.epsilon);
  const VariationalInequality p1_problem = assemble(scene, conforming),
                              problem = assemble(scene, space);
  // ### Solve
  const Solution p1_solution = active_set(p1_problem), solution = active_set(problem);
  const tutorial::Exact exact(tutorial::paper_scene(options.epsilon));
  const Errors p1_errors = exact.errors(conforming, p1_solution),
               errors = exact.errors(space, solution);
  const Table lemma = interpolate({8, 16, 32, 64}, crouzeix_raviart());

  // ### Output
  tutorial::print_errors("P1", p1_errors);
  tutorial::present(options.out, exact.scene, {space, problem, solution},
                    "Crouzeix-Raviart", errors);
  lemma.print("Lemma 2: the interpolant of u^0 on unstructured meshes");
  lemma.write(options.out / "interpolant.csv");
  tutorial::draw_basis_functions(options.out);

  const double h = 1.0 / options.cells, jump = tutorial::largest_jump(space, solution.u);
  const Eigen::Array3d midpoint(0, 0.5, 0.5);  // of edge 0
  const Eigen::VectorXd v =
      space.dof_coordinates().col(0).cwiseProduct(space.dof_coordinates().col(1));
  const Forms forms = integrate(space, v, v);
  const double moderate = v.dot(problem.a1 * v);
  const double stiff = (problem.b * v).cwiseAbs2().dot(problem.m);
  report.claim((basis(midpoint) == Eigen::Array3d(1, 0, 0)).all() &&
                   std::abs(forms.moderate / moderate - 1) < 1e-12 &&
                   std::abs(forms.stiff / stiff - 1) < 1e-12,
               "the two lines of the element give the integrals of the matrices (proved)");
  // 6e-9 of the truth's table and (h/16)^3 of Gauss's rule where u'' jumps, both over an
  // edge h = 1/8 ... 1/64: 1e-7
  report.claim_within(lemma.max("strain"), 0, 1e-6,
                      "Lemma 2 (proved): largest |B I_h u^0|:");
  report.claim(
      lemma.min("smallest") >= -1e-8,
      "Lemma 2 (proved): I_h u^0 >= 0 at the midpoints on Gamma_C (smallest {:.1e})",
      lemma.min("smallest"));
  report.claim_order(lemma, "distance", "h", 0.9, 1.05,
                     "(32): |u^0 - I_h u^0|, order 1 proved");
  // h^2 / 8 |u''| with |u''| <= 10 would be 1.25 h^2 for P1's interpolant
  report.claim_within(errors.max_at_unknowns / (h * h), 0.4, 2,
                      "Figure 8 matches the truth; error / h^2 (observed):");
  // A step is h/2 times a jump of the gradient: like h^2, and at the end of contact like
  // h^(3/2) where h << epsilon.
  report.claim_within(jump / (h * std::sqrt(h)), 0, 1.5,
                      "largest step between triangles / h^(3/2) (observed):");
  // P1 keeps 1/(1 + (5.84 k / epsilon)^2) of the ridge (chapter 06), and its top lies
  // between two unknowns.
  const double ridge = exact.solution.max_on_contact();
  if (options.epsilon <= 0.01 * h && options.cells >= 16)
    report.claim_within(
        p1_errors.max_at_unknowns / ridge, 0.97, 1.01,
        fmt::format(
            "Crouzeix-Raviart misses {:.3f} of the ridge, and P1 all of it (observed):",
            errors.max_at_unknowns / ridge));
  else
    report.not_judged(
        "P1 against Crouzeix-Raviart: P1 locks for epsilon <= h/100, and 16 cells tell "
        "them apart");
  const double from = contact_zone({space, problem, solution}).from.value_or(1);
  report.claim_within((from - exact.contact_from()) / h, -1.5, 1.5,
                      "start of contact - truth, in cells:");
}

// ## What came out
//
// :live: mesh=unstructured
//
// :output: Lemma 2
//
// (a) None at all, on any triangle. (b) No: it is nonnegative at the midpoints on $Γ_C$,
// and may be a little below 0 at the ends of an edge, where it jumps. So $K_h^{nc}$ is not
// in $K$. This, and the jumps, are the price (chapter 14); the three times as many unknowns
// are the other one (chapter 21). Of the ridge the run misses the share 0.021, and P1
// misses all of it. The interpolation error of (32) falls like $h^{0.98}$.
// :number: 0.021 = line "Crouzeix-Raviart misses {} of the ridge"
// :number: 0.98 = line "order 1 proved: order {} ("
//
// ## Exercises
//
// 1. Interpolate $u^0$ with P1, values at the vertices of the same meshes. Is
//    $B I_h u^0 = 0$?
// 2. On the structured mesh of $1/h = 32$ the largest error at an unknown is 1.03e-3, at
//    $ε = 10^{-6}$. Predict it on 64. Then on 64 at $ε = 0$, and at $10^{-2}$.
// 3. On paper: why is P1's interpolation no substitute in the proof? Which of the three
//    means over edges does it keep?
//
// ## Further reading
//
// - [Crouzeix and Raviart 1973](../guides/bibliography.md#crouzeix-1973): the element, and
//   means over edges.
// - [Brenner and Scott 2008](../guides/bibliography.md#brenner-2008): nonconforming
//   elements, and inequalities of Poincaré, Friedrichs and Korn for them.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "08_crouzeix_raviart",
                       "Figure 8: Crouzeix-Raviart does not lock on any mesh",
                       {.exercises = exercises}, nonconforming);
}
