// # Mixed and projected forms
//
// Run: 25_mixed               h from 1/8 to 1/32, ε from 1 to 1e-20, and 0; some five seconds
// Run: 25_mixed --exercise 1
// Run: 25_mixed --exercise 2
//
// Needs: [07](07_kernel.cpp) (inf-sup), [11](11_contact_sets.cpp), [12](12_uniform.cpp), [23](23_elasticity.cpp).
//
// **The pictures.** P1 on the mesh on which it locks, but the strain $∂_y u$ is averaged before it is squared.
// *Means over boxes of side $2h$ cure locking, if half of $a_0$ is kept as it is. Each other choice misses one
// hypothesis of Theorem 4.* Then incompressible rubber, P1 with a pressure per vertex, beside MINI, the same with a
// bubble: *the displacements differ little, and one of the pressures is noise.*
//
// **Predict.** (a) Fewer conditions lock less. What goes wrong if $∂_y u$ is averaged over a whole column of the
// layer? (b) Contact holds unknowns of a mixed method that does not lock. Does it lock then?
//
// ## The third family of cures: another $a_0$
//
// Mesh, element and degree change $V_h$. A *mixed* method ([7] of the paper; [4] and [25] with contact) changes
// $a_0$. Call $ε_c$ the class parameter ($ε^2$ in (23)) and $B u$ the strain that is squared in $a_0$: $∂_y u$ in
// (23), $\operatorname{div} u$ in rubber. The stress or pressure $p$ is an unknown in a space $Q_h$ of its own:
// $ε_c (p, q) = (B u, q)$ for all $q ∈ Q_h$. So $p = ε_c^{-1} P_h B u$, where $P_h$ projects on $Q_h$. Put this into
// the equation for $u$: what is left is a *projected form*,
//
// $$ a_{0h}(u, v) = (P_h B u, P_h B v). $$
//
// In the library's $B^T M B$ the rows of $B$ become means (`averaged`). Constants per group of triangles give one
// row per group, the mean of $∂_y u$ over it. Hat functions $φ_i$ give one row per vertex, $∫ φ_i B u / ∫ φ_i$: $p$
// is continuous and P1, and its mass matrix *lumped* (replaced by the sums of its rows). At $ε_c = 0$, where the
// mass matrix is not used, this is *MINI* (P1 and a bubble for $u$) and Taylor–Hood (P2 for $u$).
//
// **Theorem 4 for $a_{0h}$.** Let $0 ≤ a_{0h}(v, v) ≤ C a_0(v, v)$, and $K_{0h} = \{ v ∈ K_h : a_{0h}(v, v) = 0 \}$.
// Theorem 4 holds for $a_1 + ε_c^{-1} a_{0h}$, $0 < ε_c ≤ 1$, if
//
// - (i) $a_1 + a_{0h}$ is coercive on $V_h$, with one constant α for all $h$;
// - (ii) $K_{0h}$ comes near each $w ∈ K_0$, and $K_h$ approaches $K$;
// - (iii) if $v_h ∈ K_h$ is bounded and $a_{0h}(v_h, v_h) → 0$, its weak limits lie in $G$;
// - (iv) if $w_h → w$ weakly and $v_h → v$: $a_{0h}(w_h, v_h) → a_0(w, v)$, $\liminf a_{0h}(w_h, w_h) ≥ a_0(w, w)$.
//
// Proof as in chapters 10 and 12. For $ε_c → 0$ test with a $w_h ∈ K_{0h}$ that tends to $w$:
// $a_{0h}(u_h, w_h) = 0$, so by (i) $u_h$ is bounded and $a_{0h}(u_h, u_h) ≤ C ε_c$. By (iii) its weak limits lie in
// $K_0$. They solve (2), so there is one, $u^0$; with $w = u^0$ (i) makes the limit strong. If $ε_c$ tends to a
// positive number, (iv) is what Proposition 4 needs.
//
// **(i) against (ii).** Constants on groups of triangles that shrink with $h$ always give (iii) and (iv):
// $(B v_h, q) = (P_h B v_h, q) + (B v_h, q - P_h q)$, and $P_h q → q$. With larger groups $K_{0h}$ grows, which
// helps (ii); but $a_{0h}$ sees less, which hurts (i). The way out (Arnold and Brezzi 1993, for plates) keeps half
// of $a_0$: $a_1 + ½ a_0 + (ε_c^{-1} - ½) a_{0h}$. Then (i) holds with half the α of $a_1 + a_0$.
//
// **Under contact.** (ii) follows from an interpolant of $w$ plus a $v ∈ V_h$ that removes its projected strain. With
// the inf-sup constant β of chapter 07 there is such a $v$, at most $1/β$ times as large as this strain. It does not
// push into the obstacle if it is 0 on the contact set. So for rubber β is taken over these $v$ only, in the norms of
// $a_1$ and of $L^2$.

#include "antilock/analysis/inf_sup.hpp"
#include "common/mixed.hpp"
#include "common/study.hpp"

using namespace antilock;
using tutorial::Exact;

// ### Forms
// How the strain is averaged on a mesh of width $h$ (empty: not at all), and the part of $a_0$ that is kept.
using Means = std::function<Shares(const TriangleMesh& mesh, const FactoredForm& strain, double h)>;
struct Projection {
  std::string name;
  Method method;
  Means means;
  double kept;
};
const Means patches = [](auto& mesh, auto& strain, double) { return vertex_shares(mesh, strain, strain_rule(p1())); };
const Means columns = [](auto& mesh, auto& strain, double h) { return box_shares(mesh, strain, h, 2); };
const Means boxes = [](auto& mesh, auto& strain, double h) { return box_shares(mesh, strain, 2 * h, 2 * h); };
const Method any{&p1(), unstructured()}, regular{&p1(), structured()}, cr{&crouzeix_raviart(), unstructured()};
const std::vector<Projection> projections{{"P1 as it is", any, {}, 0},
                                          {"patches (half kept)", any, patches, 0.5},
                                          {"columns (half kept)", any, columns, 0.5},
                                          {"boxes (nothing kept)", regular, boxes, 0},
                                          {"boxes (half kept)", any, boxes, 0.5},
                                          {"Crouzeix-Raviart", cr, {}, 0}};

VariationalInequality layer_problem(const Projection& way, const Space& space, int cells) {
  VariationalInequality problem = assemble(tutorial::paper_scene(1), space);
  return way.means ? projected(problem, way.means(space.mesh(), layer_strain(space), 1.0 / cells), way.kept) : problem;
}

// One mesh: (i), (ii) and (iii) in numbers, then the error at each ε.
Table measure(const Projection& way, int cells, const std::vector<Exact>& truth) {
  // ### Mesh
  const Discretisation on = way.method.on(cells);
  // ### Solve
  Sweep sweep(layer_problem(way, on.space(), cells));
  const tutorial::Asked asked = tutorial::what_theorem_4_asks(on.space(), sweep.problem(), truth.back());
  Table rows(tutorial::projection_columns);
  for (const Exact& exact : truth) {
    sweep.set_compliance(projected_compliance(exact.epsilon * exact.epsilon, way.kept));
    Solution solution = sweep.solve();
    solution.p.resize(0);  // means, not one stress per triangle: the errors of u alone
    rows.add({way.name, 1.0 / cells, exact.epsilon, exact.errors(on.space(), solution).h1, asked.alpha, asked.near,
              asked.hidden, solution.counters.corrections, solution.seconds.total()});
  }
  return rows;
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  const std::vector<Exact> truth = tutorial::exact_solutions({1, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-10, 1e-20, 0}, 14);
  Table layer(tutorial::projection_columns), constants(tutorial::beta_columns), forces(tutorial::force_columns);
  for (const Projection& way : projections)
    for (int n = 8; n <= options.cells; n *= 2) layer.add(measure(way, n, truth));
  for (const tutorial::Mixed& way : tutorial::mixed_methods()) {
    constants.add(tutorial::inf_sup_constants(way));  // without contact, and with the contact set held
    forces.add(tutorial::push(way, options));
  }
  // ### Output
  tutorial::judge_projections(options.out, layer, truth.back().truth, report);
  tutorial::judge_mixed(options.out, constants, forces, options.cells, report);
}

// ## What came out
//
// (a) A mean over a column sees $u$ on $Σ$ less $u$ on $Γ_C$, and nothing between. (iii) fails: a slope of 0.180 is
// hidden at every $h$ (chapter 11's $k_h$), and the error stays at 0.217. Patches (the triangles at a vertex) ask for
// as many means as the layer has unknowns: (ii) fails, 0.148 as for P1, only at smaller ε (1/h = 32, ε = 1e-3: 0.056,
// P1 0.145). Boxes with nothing kept, even on the structured mesh, leave zigzags that cost next to nothing: (i) fails,
// α falls like $h^{1.9}$, the error grows from 0.46 to 1.38. Boxes with half kept: (i) α ≥ 0.51, (ii) $h^{0.98}$, (iii)
// $h^{1.05}$, worst error $h^{1.00}$, locking ratio 1.06. Their worst error at 1/h = 32 is 0.060, that of
// Crouzeix–Raviart 0.055.
//
// (b) No: β of MINI is 0.187 with and without contact at 1/h = 12, of Taylor–Hood 0.280, of CR 0.594 and 0.610. Of P1
// with a pressure per triangle it falls like $h$, and contact takes 44 % of it; the force is 177 % off. Of P1 with a
// pressure per vertex it is 0: some pressure is seen by no displacement. The largest pressure is 3.7 there (Taylor–Hood
// 1.0), while the force is right to 0.9 % (MINI 0.67, CR 0.33, Taylor–Hood 0.05).
//
// ## Exercises
//
// 1. Boxes of side $h/2$, $h$, $2h$, $4h$: which side is best? Is smaller always better?
// 2. Hold the rubber's sides too. What becomes of β while the groove fills up, and of the solution at ε = 0 after that?
// 3. On paper: which problem do the columns solve as $h → 0$? ($a_1 + ½ a_0$, plus $(ε^{-2} - ½) ∫ d^2 dx$
//    with $d(x)$ the difference that a column sees.)

#include "answers/25_mixed.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "25_mixed", "Mixed and projected forms: another a0, and what Theorem 4 asks of it",
                       {.takes_epsilon = false, .least_cells = 32, .most_cells = 64, .exercises = exercises}, study);
}
