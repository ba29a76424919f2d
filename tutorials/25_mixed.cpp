// # Mixed and projected forms
//
// Run: 25_mixed               h from 1/8 to 1/32, ε from 1 to 1e-20, and 0; some five seconds
// Run: 25_mixed --exercise 1
// Run: 25_mixed --exercise 2
//
// Needs: [07](07_kernel.cpp) (inf-sup), [11](11_contact_sets.cpp), [12](12_uniform.cpp), [23](23_elasticity.cpp).
//
// **The pictures.** P1 on the mesh on which it locks, with the stiff strain averaged before it is squared. *Means over
// boxes of side $2h$ cure, if half of $a_0$ is kept as it is. Each of the others misses one hypothesis.* Then rubber
// with P1 and a pressure per vertex, beside MINI: *the displacements differ little, and one of the pressures is noise.*
//
// **Predict.** (a) Fewer conditions lock less. What is wrong with a single condition per column of the layer? (b) An
// obstacle holds unknowns. Does that hurt the inf-sup constant of a good mixed method?
//
// ## The third family of cures: another $a_0$
//
// Mesh, element and degree change $V_h$. A *mixed* method ([7] of the paper; [4] and [25] with contact) has an unknown
// $p$ of its own in a space $Q_h$: $ε (p, q) = (B u, q)$ for all $q ∈ Q_h$. So $p = ε^{-1} P_h B u$ with $P_h$ the
// projection on $Q_h$, and what is left is a *projected* form, $a_{0h}(u, v) = (P_h B u, P_h B v)$. In the library's
// $B' M B$ with diagonal $M$ the rows of $B$ become means (`averaged`). Groups of triangles, with areas as weights, are
// constants per group. Hat functions $φ_i$ as weights give the row $∫ φ_i B u / ∫ φ_i$ per vertex, a continuous $p$: at
// ε = 0 this *is* MINI (P1 and a bubble) and Taylor–Hood (P2). Above, the mass matrix of $p$ is lumped.
//
// **Theorem 4 for $a_{0h}$.** Let $a_{0h} ≤ C a_0$, and $K_{0h} = \{ v ∈ K_h : a_{0h}(v, v) = 0 \}$. It holds if
//
// - (i) $a_1 + a_{0h}$ is coercive on $V_h$, with one constant α for all $h$;
// - (ii) $K_{0h}$ comes near each $w ∈ K_0$, and $K_h$ approaches $K$;
// - (iii) if $v_h ∈ K_h$ is bounded and $a_{0h}(v_h, v_h) → 0$, its weak limits lie in $G$;
// - (iv) if $w_h → w$ weakly, $v_h → v$: $a_{0h}(w_h, v_h) → a_0(w, v)$, $\liminf a_{0h}(w_h, w_h) ≥ a_0(w, w)$.
//
// For $ε → 0$ test with the $w_h$ of (ii): $a_{0h}(u_h, w_h) = 0$, so by (i) $u_h$ is bounded and
// $a_{0h}(u_h, u_h) ≤ C ε$. By (iii) its weak limits lie in $K_0$. They solve (2), and (i) makes the limit strong, as
// in Proposition 3. For $ε → \bar ε > 0$, (iv) is the consistency that Proposition 4 needs. *For groups that shrink,
// (iii) and (iv) are free:* $(B v_h, q) = (P_h B v_h, q) + (B v_h, q - P_h q)$, and $P_h q → q$. What remains is (i)
// against (ii): with fewer groups $K_{0h}$ grows, and so does what $a_{0h}$ cannot see. The way out (Arnold and
// Brezzi 1993, for plates) keeps half: $a_1 + ½ a_0 + (ε^{-2} - ½) a_{0h}$. Then (i) holds with half the old α.
//
// **Under contact** what mends $B w_h = 0$ in (ii) must not move what touches: the inf-sup constant β of chapter 07 is
// taken over the $v$ that vanish on the contact set; here in the norms of $a_1$ and of $L^2$.

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

// β with nothing held, and with the contact set of the solution at ε = 0.
const std::vector<std::string> beta_columns{"name", "h", "contact", "beta"};
Table inf_sup_constants(const tutorial::Mixed& way) {
  Table rows(beta_columns);
  for (const int n : {4, 8, 12}) {
    const TriangleMesh mesh = with_free_sides(structured_mesh(n, Domain{0}));
    const VariationalInequality problem = tutorial::rubber(way, Space(mesh, way.element));  // of chapter 23, ε = 0
    for (const bool contact : {false, true}) {
      const std::vector<bool> nothing(problem.contact.size());
      const auto linear = held_in_contact(problem, contact ? active_set(problem).active : nothing);
      const double beta = inf_sup(multiplier_gram(linear, linear.a1), Eigen::MatrixXd(linear.m.asDiagonal()));
      rows.add({way.name, 1.0 / n, contact ? "contact held" : "contact free", beta});
    }
  }
  return rows;
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  const std::vector<Exact> truth = tutorial::exact_solutions({1, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-10, 1e-20, 0}, 14);
  Table layer(tutorial::projection_columns), constants(beta_columns), forces(tutorial::force_columns);
  for (const Projection& way : projections)
    for (int n = 8; n <= options.cells; n *= 2) layer.add(measure(way, n, truth));
  for (const tutorial::Mixed& way : tutorial::mixed_methods()) {
    constants.add(inf_sup_constants(way));
    forces.add(tutorial::push(way, options));
  }
  // ### Output
  tutorial::judge_projections(options.out, layer, truth.back().truth, report);
  tutorial::judge_mixed(options.out, constants, forces, options.cells, report);
}

// ## What came out
//
// (a) A mean over a column sees $u$ on $Σ$ less $u$ on $Γ_C$, and nothing between: (iii) fails, the hidden slope is
// 0.180 at each $h$, and the error stays at 0.217. Patches ask for as much as the layer has unknowns, so (ii) fails,
// 0.148 as for P1; they lock later (1/h = 32, ε = 1e-3: 0.056, P1 0.145). Boxes alone leave zigzags that cost next to
// nothing: (i) fails, α falls like $h^{1.9}$, the error grows from 0.46 to 1.38. Boxes with half kept: (ii) $h^{0.98}$,
// (iii) $h^{1.05}$, worst error $h^{1.00}$, locking ratio 1.06. They are right for smooth functions, and (ii) asks no
// more: in the dual norm of chapter 07 their β is 0.73 at every $h$ where boxes end at lines of the mesh, but on this
// mesh it falls, 0.67, 0.45, 0.26 (contact held: 0.59, 0.40, 0.21). *Price* at 1/h = 128, ε = 1e-6, in seconds (H1
// error): boxes 0.17 (0.0145), CR 0.29 (0.0138), P1 on a layered mesh 0.06 (0.0137).
//
// (b) No: β of MINI is 0.187 with and without the contact set, of Taylor–Hood 0.280, of CR 0.594 and 0.610 (1/h =
// 12). Of P1 with a pressure per triangle it falls like $h$, and contact takes 44 % of it (1/h = 12). With a pressure
// per vertex it is 0, which shows in a largest pressure of 3.7 (Taylor–Hood 1.0), while the force is right to 0.9 %.
// *Price* on 32 cells: Taylor–Hood 0.11 s (force off by 0.05 %), MINI 0.06 s (0.67 %), CR 0.03 s (0.33 %).
//
// ## Exercises
//
// 1. Boxes of side $h/2$, $h$, $2h$, $4h$: which side is best? Is smaller always better?
// 2. Hold the rubber's sides too. What becomes of β while the groove fills up, and of the solution at ε = 0 after that?
// 3. On paper: which problem do the columns solve as $h → 0$?

#include "answers/25_mixed.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "25_mixed", "Mixed and projected forms: another a0, and what Theorem 4 asks of it",
                       {.takes_epsilon = false, .least_cells = 32, .most_cells = 64, .exercises = exercises}, study);
}
