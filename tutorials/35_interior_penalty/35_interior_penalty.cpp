// # Penalise the mean, not the jump
//
// Run: 35_interior_penalty                  the meshes of chapters 02 and 06, 1/h = 32
// Run: 35_interior_penalty --gamma 30       a larger penalty
// Run: 35_interior_penalty --exercise 1
// Run: 35_interior_penalty --exercise 2
//
// Needs: [06](../06_p1_unstructured/06_p1_unstructured.cpp) (the ridge, what is kept of
// it), [07](../07_kernel/07_kernel.cpp) (kernel on the layer),
// [08](../08_crouzeix_raviart/08_crouzeix_raviart.cpp) (Crouzeix-Raviart).
//
// **The picture.** Discontinuous P1 with an interior penalty at ε = 1e-6. Mesh, functions
// and penalty parameter are the same on both sides. *On the left each jump is penalised as
// it is, and the method locks. On the right only its mean over each edge is penalised, and
// the method does not lock.*
//
// :figure: interior_penalty
//
// **Predict.** Discontinuous P1 has three unknowns on each triangle, twice as many as
// Crouzeix-Raviart. Its jumps are not forbidden but penalised. (a) Does it lock? (b) In the
// penalty, the integral of the squared jump over an edge is replaced by the midpoint rule.
// Does the method lock then?
//
// ## The method
//
// $V_h$ now holds all functions that are affine on each triangle. They need not be
// continuous anywhere. On an edge $E$ between two triangles let $[v]$ be the jump, the
// value on one side less that on the other, $\{w\}$ the mean of both sides, and $n$ the
// normal from the first side to the second. Multiply the equation
// $-\operatorname{div} σ = f$ by $v$ and integrate by parts on each triangle. The stress σ
// has the components $∂_x u$ and $∂_y u$ in the body, $∂_x u$ and $ε^{-2} ∂_y u$ in the
// layer. Its normal component $σ·n$ is the same on both sides of an edge, so that
//
// $$ ∑_T ∫_T σ·∇v - ∑_E ∫_E (σ·n) [v] = ∫ f v. $$
//
// For a discrete $u$ the stress jumps, and its mean takes the place of $σ·n$.
// The *symmetric interior penalty* method adds two terms that vanish for the exact $u$,
// which does not jump: one that makes the form symmetric, and a penalty that makes it
// positive:
//
// $$ a_h(u, v) = ∑_T ∫_T σ(u)·∇v - ∑_E ∫_E \left( \{σ(u)·n\} [v] + \{σ(v)·n\} [u] \right)
//   + ∑_E η_E ∫_E k_E [u] [v]. $$
//
// Here $k_E$ is the stiffness in the direction of the normal, $n_x^2 + ε^{-2} n_y^2$ in the
// layer and 1 in the body. It has to be there: the second sum contains the stress, which
// grows like it. The penalty $η_E$ is γ times a length$^{-1}$ of the edge, and γ must be
// large enough. On a clamped edge there is one side, and $[u] = u$: the value 0 is imposed
// by the form and not by the space (Nitsche). On Σ the mean of the stress is replaced by
// that of the body and $k_E$ by 1, the stiffness of the softer side.
//
// Contact is asked where Crouzeix-Raviart asks it, at the midpoints of the edges on $Γ_C$.
//
// **The other method** differs in one place. It takes the means $m(u)$ of the jump over
// each edge:
//
// $$ η_E ∫_E k_E\, [u] [v]   is replaced by   η_E\, |E|\, k_E\, m(u)\, m(v). $$
//
// The jump is affine on the edge, so its mean is its value at the midpoint, and the second
// form is the first one with the midpoint rule. The other terms stay as they are: the
// stress is constant on a triangle, so they contain only the mean of the jump.
//
// ## The form as a sum of squares
//
// Both stiff forms can be read off after one completion of squares. Take the terms with
// $ε^{-2}$. On a triangle $T$ let $n_k$ be the $y$ component of the outward normal on edge
// $k$, $m_k$ the mean of the jump there, and $c_k = w_k |E_k| n_k$, where $w_k = ½$ on an
// edge between two triangles of the layer and 0 on Σ and $Γ_C$ ($w_k = 1$ on clamped edges,
// which are vertical here: $n_k = 0$). The terms of $T$ are
//
// $$ |T| (∂_y u)^2 - 2 ∂_y u ∑_k c_k m_k
//   = |T| (D u)^2 - \frac{1}{|T|} \left( ∑_k c_k m_k \right)^2,
//   D u = ∂_y u - \frac{1}{|T|} ∑_k c_k m_k. $$
//
// By Green's formula $∂_y u$ is $1/|T|$ times the sum of $|E_k| n_k$ times the mean of $u$
// over edge $k$. So $D u$ is the slope of the affine function whose mean over each edge is
// the average of the means of *both* sides. The square that is subtracted is at most
// $3 ∑_k c_k^2 m_k^2 / |T|$ (Cauchy and Schwarz). So choose the penalty as γ times this
// bound:
//
// $$ η_E = γ ∑_{T ∋ E} \frac{3 w^2 |E|}{|T|},   γ > 1. $$
//
// With this the form is a sum of squares on every mesh, whatever its angles. (This explicit
// penalty is Shahbazi's. It is about $3.5 γ/h$ on equilateral triangles. For γ ≤ 1 the
// program ends with one line, because the form need not be positive then.) With the whole
// jump there is one square more on each edge: the jump is $m_k$ plus a linear part.
//
// ## Count before you solve
//
// In the limit $ε → 0$ all squares of the stiff form must vanish. In both methods: $m = 0$
// on each edge between two triangles of the layer that is not vertical; then
// $D u = ∂_y u = 0$, so $u = a_T + b_T x$ on each triangle. Vertical edges have $n_k = 0$:
// they do not occur in the stiff form.
//
// - *The whole jump:* $[u] = 0$ at both ends of these edges, which have different $x$. So
//   $a_T$ and $b_T$ are the same on both sides, and on all triangles that are connected by
//   such edges, the groups of chapter 02. **Two functions for each group,** $a + b x$. On a
//   mesh without vertical lines there is one group: two functions, whatever $h$ is. P1 has
//   none, because it is clamped at both ends. Here the ends are vertical edges, and their
//   penalty is not stiff.
// - *The mean:* one condition per edge for two numbers per triangle. Let the layer have
//   $N_T$ triangles and $N_E$ edges of this kind. **$2 N_T - N_E$ functions.** Without
//   vertical lines the three edges of all triangles are $3 N_T = 2 N_E + 4 n$, as the
//   square has $n$ edges on each side, so there are $N_T/2 + 2 n$. (The conditions are
//   independent: suppose that numbers $μ_T$ make $∑_T μ_T |T| ∂_y v = 0$ for each $v$ of
//   Crouzeix-Raviart. Then μ is the same on both sides of an edge that is not vertical, and
//   0 at $Γ_C$.)
//
// The second kernel grows like the number of triangles, and contains the interpolant
// $I_h w$ of every function $w(x)$ (chapter 08): it has no slope, and the means of both
// sides are equal. The first does not grow. By [chapter 07](../07_kernel/07_kernel.cpp) the
// first method locks and the second passes this test.
//
// **How much is kept** by the first? In the limit the layer follows $a + b x$ and nothing
// else. Only the penalty at the two ends resists, and its stiffness is like $γ/h$. The load
// is fixed. So $a$ and $b$ are like $h/γ$: *half of the little that is kept is lost with
// each refinement.*
//
// ## The mean alone: Crouzeix-Raviart, and nothing else
//
// Look at the squares again. Instead of the two means on both sides of an edge take their
// average $\hat u$ and their difference $m$ as unknowns. (On Σ, $\hat u$ is the mean on the
// side of the layer; on a clamped edge it is 0; on $Γ_C$ there is one side.) The slopes
// $D u$ depend on $\hat u$ alone, and are those of the Crouzeix-Raviart function with the
// values $\hat u$. The other squares depend on $m$ alone, if only the mean is penalised.
// Contact asks for $\hat u ≥ 0$. The load is linear, so it is the sum of a load on $\hat u$
// and one on $m$. *The problem separates into two:* one for $\hat u$, which is (29), and
// one for $m$, a linear system without contact. So
//
// $$ \hat u = \text{ the solution of Crouzeix-Raviart, for every } γ > 1, $$
//
// and $m$ is 0 where there is no load, as in the layer. Elsewhere it falls like $1/γ$. The
// additional unknowns improve nothing. Crouzeix-Raviart is the result if the mean is set to
// zero, and also if it is penalised. Hansbo and Larson split the penalty of the jump into
// that of its mean and a second one, for elasticity, where Crouzeix-Raviart needs the other
// part of the jump ([chapter 26](../26_elasticity/26_elasticity.cpp)). They found that
// Crouzeix-Raviart is the limit for a large penalty of the mean. Here, with constant
// stiffness on each side of Σ, the averages do not even depend on γ.
//
// ## Two methods with other names
//
// Two more methods have one number $u_E$ per edge. Are they different methods?
//
// **The hybrid high-order method of degree 0** (Di Pietro, Ern and Lemaire) has also a
// number $u_T$ per triangle. From these it reconstructs an affine function $r$ on $T$: its
// gradient is $∑_k |E_k| n_k u_{E_k}/|T|$ and its mean $u_T$. It penalises
// $δ_k = u_{E_k} - r(x_k)$ at the midpoints $x_k$ with the weight $k_E$. Now the first
// formula is Green's: let $c$ be the affine function with the values $u_{E_k}$ at the
// midpoints. Then $∇r = ∇c$, and $r$ differs from $c$ by a constant, $δ_k = \bar c - u_T$,
// the same for all three edges. So $u_T$ occurs in the form only in $(\bar c - u_T)^2$, and
// in the load with the factor $∫_T f$. To eliminate it moves the load to the mean $\bar c$.
// The result is *Crouzeix-Raviart with the load $∑_T \bar v_T ∫_T f$*.
//
// **The hybridised Raviart-Thomas method** of lowest order (Arnold and Brezzi; Marini) has
// the stress as an unknown: on each triangle $σ = s + t\, (x - x_T)$, $x_T$ the centroid.
// Multipliers $u_E$ make $σ·n$ the same on both sides of an edge. Its equations with $t$
// are $-2 t |T| = ∫_T f$, and those with $s$ say that $A^{-1} s$ is
// $∑_k |E_k| n_k u_{E_k}/|T|$, again the gradient of $c$. (Both are separate, because
// $x - x_T$ has the mean 0.) The multipliers solve *the same system*.
//
// So all three have the same values on the edges and the same mean stress on each triangle.
// The program builds all three from their own definitions, with all their unknowns, and
// compares.

#include "antilock/analysis/kernel.hpp"
#include "antilock/analysis/locking.hpp"
#include "antilock/exact/exact_norms.hpp"
#include "antilock/form/interior_penalty.hpp"
#include "course/course.hpp"
#include "support.hpp"

#include <CLI/CLI.hpp>

using namespace antilock;

double gamma_of_run = 3;  // --gamma

// A method: an element, and for discontinuous P1 the part of the jump that is penalised.
struct Discretisation {
  std::string name;
  const Element* element;
  std::optional<PenalisedJump> penalised = {};

  Space space(const TriangleMesh& mesh) const { return Space(mesh, *element); }
  // ### Forms
  // One line tells the two penalties apart.
  VariationalInequality problem(const Scene& scene, const Space& space) const {
    return penalised ? assemble(scene, space, InteriorPenalty{gamma_of_run, *penalised})
                     : assemble(scene, space);
  }
};
const Discretisation conforming{"continuous P1", &p1()},
    cr{"Crouzeix-Raviart", &crouzeix_raviart()},
    whole_jump{"whole jump", &discontinuous_p1(), PenalisedJump::whole},
    mean_jump{"mean of the jump", &discontinuous_p1(), PenalisedJump::mean};
const std::vector<Discretisation> discretisations{conforming, cr, whole_jump, mean_jump};

// The dimension that is counted above.
int predicted_kernel(const Discretisation& method, const TriangleMesh& mesh, int cells) {
  const int triangles = tutorial::layer_triangles(mesh),
            groups = layer_components(mesh).count;
  if (method.penalised == PenalisedJump::mean)
    return 2 * triangles - tutorial::stiff_edges(mesh);
  if (method.penalised == PenalisedJump::whole) return 2 * groups;
  if (!method.element->conforming()) return triangles / 2;
  return groups == cells
             ? cells - 1
             : 0;  // a hat function on each line between two columns; else nothing
}

// ### Solve
// The kernels, by the rank of B.
Table count_kernels(int finest) {
  Table counts({"mesh", "cells", "method", "kernel", "predicted"});
  for (const char* family : {"structured", "staggered", "unstructured"})
    for (int n = 4; n <= finest; n *= 2) {
      const TriangleMesh mesh = mesh_family(family).mesh(n);
      for (const Discretisation& method : discretisations)
        counts.add({family, n, method.name,
                    layer_kernel_dimension(
                        method.problem(tutorial::paper_scene(0), method.space(mesh))),
                    predicted_kernel(method, mesh, n)});
    }
  return counts;
}

// The library's diagnosis from the matrices on two meshes, without a solution.
LockingDiagnosis diagnose(const Discretisation& method) {
  const auto on = [&](int cells) {
    return method.problem(tutorial::paper_scene(0),
                          method.space(mesh_family("unstructured").mesh(cells)));
  };
  return diagnose_locking(on(4), on(8));
}

// The height of the ridge, and the share of it that is kept: the largest value on $Γ_C$
// over that of the exact solution.
double height(double epsilon) {
  return tutorial::Exact(tutorial::paper_scene(epsilon), 12).solution.max_on_contact();
}
double share_kept(const Discretisation& method, const TriangleMesh& mesh, double epsilon,
                  double of_height) {
  const VariationalInequality problem =
      method.problem(tutorial::paper_scene(epsilon), method.space(mesh));
  return active_set(problem).u(problem.bounds.unknowns).maxCoeff() / of_height;
}

Table shares(int cells) {
  Table table({"mesh", "epsilon", "method", "kept"});
  const std::vector<std::string> families{"unstructured", "staggered"};
  for (const double epsilon : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const double truth = height(epsilon);
    for (const std::string& family : families) {
      const TriangleMesh mesh = mesh_family(family).mesh(cells);
      for (const Discretisation& method : discretisations)
        table.add({family, epsilon, method.name, share_kept(method, mesh, epsilon, truth)});
    }
  }
  return table;
}

// The limit ε = 0 on rows of triangles, where the law $h/γ$ is in plain sight.
Table refine(const Discretisation& method, const std::vector<int>& cells) {
  Table table({"h", "kept"});
  const double truth = height(0);
  for (const int n : cells)
    table.add({1.0 / n, share_kept(method, mesh_family("staggered").mesh(n), 0, truth)});
  return table;
}

// The mean penalised more and more: the largest difference from Crouzeix-Raviart at the
// midpoints of edges, of the averages $\hat u$ of both sides and of the sides themselves.
Table approach_crouzeix_raviart(const TriangleMesh& mesh, double epsilon) {
  const Scene scene = tutorial::paper_scene(epsilon);
  const Space edges(mesh, crouzeix_raviart()), triangles(mesh, discontinuous_p1());
  const Eigen::VectorXd on_edges = active_set(assemble(scene, edges)).u;
  Table table({"gamma", "averages", "sides"});
  for (const double gamma : {10.0, 100.0, 1000.0, 10000.0}) {
    const Eigen::VectorXd u =
        active_set(assemble(scene, triangles, InteriorPenalty{gamma, PenalisedJump::mean}))
            .u;
    double sides = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (int i = 0; i < 3; ++i)
        sides = std::max(sides, std::abs(u(triangles.cell_dofs()(t, i)) -
                                         on_edges(edges.cell_dofs()(t, i))));
    const double averages =
        (tutorial::averages_on_edges(triangles, u) - on_edges).cwiseAbs().maxCoeff();
    table.add({gamma, averages, sides});
  }
  return table;
}

// The error in the broken H1 norm, over ε and meshes.
Table errors(const Discretisation& method,
             const std::vector<tutorial::Exact>& exact_solutions, int finest) {
  Table table({"h", "epsilon", "h1"});
  for (int n = 8; n <= finest; n *= 2) {
    const Space space = method.space(mesh_family("unstructured").mesh(n));
    for (const tutorial::Exact& exact : exact_solutions) {
      Solution solution = active_set(method.problem(exact.scene, space));
      solution.p.resize(0);  // the errors of u alone
      table.add({1.0 / n, exact.epsilon, exact.errors(space, solution).h1});
    }
  }
  return table;
}

void judge_kernels(const Table& counts, tutorial::Report& report) {
  report.claim(counts.numbers("kernel") == counts.numbers("predicted"),
               "every kernel has the predicted dimension (proved)");
  const auto dimensions = [&](const Discretisation& method) {
    return counts.filter("mesh", "unstructured")
        .filter("method", method.name)
        .numbers("kernel");
  };
  const std::vector<double> whole = dimensions(whole_jump);
  report.claim(std::count(whole.begin(), whole.end(), 2) == static_cast<long>(whole.size()),
               "whole jump, no vertical lines through the layer: 2 functions on every mesh "
               "(proved)");
  report.claim(
      diagnose(whole_jump).locks() && !diagnose(mean_jump).locks(),
      "the library's diagnosis: the whole jump locks, the mean does not (observed)");
}

void judge_shares(const Table& table, const std::string& family, tutorial::Report& report) {
  const Table mesh = table.filter("mesh", family);
  const auto kept = [&](const Discretisation& method) {
    return mesh.filter("method", method.name);
  };
  // chapter 08: the error of Crouzeix-Raviart is below 2 h^2, 4 % of the ridge at 1/h = 32
  for (const Discretisation& method : {cr, mean_jump})
    report.claim(kept(method).min("kept") > 0.96 && kept(method).max("kept") < 1.04,
                 "{}: {} keeps {:.3f} to {:.3f} of the ridge at every epsilon (observed)",
                 family, method.name, kept(method).min("kept"), kept(method).max("kept"));
  for (const Discretisation& method : {conforming, whole_jump})
    report.claim_within(
        kept(method).filter("epsilon", 1e-3).number("kept"), 0, 0.2,
        fmt::format("{}: {} keeps at epsilon = 1e-3 (observed):", family, method.name));
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  const TriangleMesh any = mesh_family("unstructured").mesh(options.cells),
                     small = mesh_family("unstructured").mesh(8);
  const Table counts = count_kernels(16), table = shares(options.cells),
              rows = refine(whole_jump, {8, 12, 16, 24, 32});
  const Table limit = approach_crouzeix_raviart(small, 1e-6),
              hybrids = tutorial::compare_hybrid_methods(small);
  const std::vector<tutorial::Exact> exact =
      tutorial::exact_solutions({1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 0}, 14);
  const tutorial::Supremum whole = tutorial::supremum(
                               errors(whole_jump, exact, options.cells), "h1", "epsilon"),
                           mean = tutorial::supremum(
                               errors(mean_jump, exact, options.cells), "h1", "epsilon");
  // ### Output
  for (const Discretisation& method : {whole_jump, mean_jump}) {
    const Space space = method.space(any);
    write_vtu(
        options.out / (method.penalised == PenalisedJump::whole ? "whole.vtu" : "mean.vtu"),
        space, active_set(method.problem(tutorial::paper_scene(1e-6), space)).u);
  }
  table.write(options.out / "kept.csv");
  counts.filter("mesh", "unstructured")
      .pivot("cells", "method", "kernel")
      .print("kernel on the layer, unstructured");
  for (const char* family : {"unstructured", "staggered"})
    table.filter("mesh", family)
        .pivot("epsilon", "method", "kept")
        .print(fmt::format("kept, {} mesh", family), 3);
  rows.print("whole jump, staggered mesh, epsilon = 0");
  limit.print("mean of the jump less Crouzeix-Raviart", 3);
  hybrids.print("three methods, relative differences", 3);
  whole.rows.print("whole jump: worst H1 error over epsilon");
  mean.rows.print("mean of the jump: worst H1 error over epsilon");

  judge_kernels(counts, report);
  for (const char* family : {"unstructured", "staggered"})
    judge_shares(table, family, report);
  report.claim_order(rows, "kept", "h", 0.8, 1.2,
                     "whole jump at epsilon = 0: kept falls like h (proved)");
  report.claim_within(limit.max("averages"), 0, 1e-9,
                      "mean of the jump: averages are Crouzeix-Raviart's (proved):");
  report.claim_order(limit, "sides", "gamma", -1.1, -0.9,
                     "its two sides differ from them like 1/gamma (proved)");
  report.claim_within(std::max(hybrids.max("displacement"), hybrids.max("stress")), 0, 1e-8,
                      "three methods, one displacement and one stress (proved):");
  report.claim_orders(mean.rows, "worst", 0.8, 1.2,
                      "mean of the jump: worst error over epsilon (observed)");
  // The layer keeps a hundredth of its ridge, so the error is at least nine tenths of the
  // ridge's norm.
  const double ridge = layer_norm(exact.back().solution);
  report.claim(
      whole.rows.last("worst") > 0.9 * ridge,
      "whole jump: the worst error stays, {:.3f}; |u^0| on the layer is {:.3f} (observed)",
      whole.rows.last("worst"), ridge);
}

// ## What came out
//
// :output: kernel on the layer
//
// :live: penalty
//
// (a) Yes. At $ε = 10^{-3}$ it keeps 0.055 of the ridge, twice the share of P1. In the
// limit P1 keeps nothing, because its share falls like $ε^2$. The share of the whole jump
// stays at 0.0080, because of $a + b x$:
// :number: 0.055 = table "kept, unstructured mesh" "whole jump" epsilon=0.001
// :number: 0.0080 = table "kept, unstructured mesh" "whole jump" epsilon=1e-06
//
// :figure: interior_penalty_kept
//
// :output: kept, unstructured mesh
//
// :output: whole jump, staggered mesh
//
// (b) No. The midpoint rule asks for less, as one-point integration does for the beam
// ([chapter 25](../25_beam/25_beam.cpp)). Here it asks for what Crouzeix-Raviart fulfils:
//
// :output: mean of the jump less
//
// With 2 times as many unknowns the method is not more accurate than Crouzeix-Raviart. The
// two hybrid methods have the same solution as well:
//
// :output: three methods
//
// ## Exercises
//
// 1. Whole jump, staggered mesh, $ε = 0$, $1/h = 32$: replace γ = 3 by 6. How much of the
//    ridge is kept?
// 2. Whole jump on the structured mesh at $ε = 10^{-6}$: does it lock?
// 3. On paper: the stiffness of the penalty at the two ends on the staggered mesh. At which
//    γ would the whole jump keep all of the ridge, and why is that no cure?
// 4. On paper: the nonsymmetric method has $+\{σ(v)·n\} [u]$ in place of the minus. Does
//    the change cure locking?
//
// ## Further reading
//
// - D. N. Arnold, *An interior penalty finite element method with discontinuous elements*,
//   SIAM J. Numer. Anal. 19 (1982), 742-760,
//   [10.1137/0719052](https://doi.org/10.1137/0719052).
// - D. N. Arnold, F. Brezzi, B. Cockburn and L. D. Marini, *Unified analysis of
//   discontinuous Galerkin methods for elliptic problems*, SIAM J. Numer. Anal. 39 (2002),
//   1749-1779, [10.1137/S0036142901384162](https://doi.org/10.1137/S0036142901384162). The
//   first method of this page is their IP method, with weights on Σ.
// - P. Hansbo and M. G. Larson, *Discontinuous Galerkin and the Crouzeix-Raviart element:
//   application to elasticity*, ESAIM: M2AN 37 (2003), 63-72,
//   [10.1051/m2an:2003020](https://doi.org/10.1051/m2an:2003020). The second method.
// - S. C. Brenner, L. Owens and L.-Y. Sung, *A weakly over-penalized symmetric interior
//   penalty method*, Electron. Trans. Numer. Anal. 30 (2008), 107-127. They penalise only
//   the mean of the jump, with a higher power of $1/h$.
// - D. A. Di Pietro, A. Ern and S. Lemaire, *An arbitrary-order and compact-stencil
//   discretization of diffusion on general meshes based on local reconstruction operators*,
//   Comput. Methods Appl. Math. 14 (2014), 461-472,
//   [10.1515/cmam-2014-0018](https://doi.org/10.1515/cmam-2014-0018).
// - D. N. Arnold and F. Brezzi, *Mixed and nonconforming finite element methods:
//   implementation, postprocessing and error estimates*, RAIRO M2AN 19 (1985), 7-32,
//   [10.1051/m2an/1985190100071](https://doi.org/10.1051/m2an/1985190100071).
// - K. Shahbazi, *An explicit expression for the penalty parameter of the interior penalty
//   method*, J. Comput. Phys. 205 (2005), 401-407,
//   [10.1016/j.jcp.2004.11.017](https://doi.org/10.1016/j.jcp.2004.11.017).

#include "answers.hpp"

int main(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--gamma", gamma_of_run, "penalty parameter, above 1")
        ->check(CLI::PositiveNumber);
  };
  return tutorial::run(argc, argv, "35_interior_penalty",
                       "Discontinuous P1: the whole jump penalised, or its mean",
                       {.takes_epsilon = false,
                        .least_cells = 32,
                        .most_cells = 64,
                        .add = add,
                        .exercises = exercises},
                       study);
}
