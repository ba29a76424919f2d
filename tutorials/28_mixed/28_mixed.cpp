// # Mixed and projected forms
//
// Run: 28_mixed               h from 1/8 to 1/32, ε from 1 to 1e-20, and 0; some seconds
// Run: 28_mixed --exercise 1
//
// Needs: [05](../05_p1_structured/05_p1_structured.cpp) for Definition 1 in words,
// [10](../10_limits/10_limits.cpp) for the limit and for coercive forms,
// [13](../13_uniform/13_uniform.cpp) for Theorem 4.
//
// **The picture.** P1 where it locks, but the strain across the layer is averaged before it
// is squared. *Means over boxes of side $2h$ cure locking, if half of the stiff form is
// kept. The others miss a hypothesis of Theorem 4.*
//
// **Predict.** (a) The fewer conditions are asked, the less a method locks. What goes wrong
// if the strain is averaged over a whole column of the layer? (b) And if all of the stiff
// form is averaged over boxes, none of it kept as it is?
//
// ## The third family of cures: another stiff form
//
// Mesh, element and degree change the discrete functions. A *mixed* method ([7] of the
// paper; [4], which appeared in 2005, and [25] with contact) changes the stiff form
// instead. Write $B u$ for the strain that is squared in it, and $ε_c$ for the class
// parameter: in (23) they are $∂_y u$ and $ε^2$. The stress $p$ is an unknown in a space
// $Q_h$, tied to the strain by $ε_c (p, q) = (B u, q)$ for all $q$ of this space. The right
// side sees of the strain only its projection on the space of stresses, $P_h B u$. So the
// stress is this projection, divided by the class parameter. Put into the equation of the
// displacement it leaves the problem with a *projected form* in place of $a_0$:
//
// $$ a_{0h}(u, v) = (P_h B u, P_h B v). $$
//
// To choose the stresses is to choose what is averaged. If they are constant on groups of
// triangles, the projection is the mean over each group. In the library these means are the
// rows of $B$. Small groups ask for more, large for less.
// :figure: groups
//
// ## Theorem 4 for another stiff form
//
// Theorem 4 compares spaces for one stiff form. What does another one have to fulfil? It is
// never negative and at most a constant times $a_0$. Let $K_{0h}$ be the functions of $K_h$
// that it does not see. There may also be friction
// ([chapter 30](../30_friction/30_friction.cpp)): a convex term $j ≥ 0$ in the energy,
// replaced by a convex $j_h ≥ 0$. Then the method converges uniformly in the class
// parameter, from 0 to 1, if $K_h$ approaches $K$ (Definition 1) and
//
// - (i) *it holds:* $a_1 + a_{0h}$ is coercive on $V_h$, with one constant α for all $h$;
// - (ii) *it leaves enough:* each $w ∈ K_0$ is the limit of some $w_h ∈ K_{0h}$;
// - (iii) *it leaves nothing foreign:* weak limits of bounded $v_h ∈ K_h$ lie in $G$, if
//   $a_{0h}(v_h, v_h) → 0$;
// - (iv) *it is the right one at last:* if $w_h → w$ weakly and $v_h → v$, then
//   $a_{0h}(w_h, v_h) → a_0(w, v)$;
// - with friction: $j_h(v_h) → j(v)$, and $j_h(w_h)$ is at least $j(w)$ in the limit.
//
// (From (iv) it follows that $a_{0h}(w_h, w_h)$ is at least $a_0(w, w)$ in the limit. For
// $v_h → w$ it is at least $2 a_{0h}(w_h, v_h) - a_{0h}(v_h, v_h)$.)
//
// *Proof.* Were it false, the error would stay away from 0 for some sequence of ever finer
// meshes and of parameters, which converge to some $ε_* ≥ 0$. The exact solutions converge
// to the one at this limit (Theorem 1). So it is enough that the discrete ones do so, too.
// Let first $ε_* = 0$. The steps are those of Theorem 1 in
// [chapter 10](../10_limits/10_limits.cpp).
//
// **Step 1: bounded.** Take a $w$ of $K_0$, and for test functions the $w_h$ of (ii). The
// stiff form of $u_h$ with $w_h$ is 0, because that of $w_h$ with itself is (Cauchy and
// Schwarz). So the inequality becomes
//
// $$ a_1(u_h, u_h) + ε_c^{-1} a_{0h}(u_h, u_h) + j_h(u_h) ≤ a_1(u_h, w_h) - L(w_h - u_h) + j_h(w_h). $$
//
// As the parameter is at most 1, the left side is at least $α ‖u_h‖^2$ by (i). The right
// side grows like $‖u_h‖$ only. So the $u_h$ are bounded, and their stiff form is at most
// $C ε_c$: it tends to 0.
//
// **Step 2: where the limits lie.** A weak limit lies in $K$ by (9), and in $G$ by (iii).
// So it lies in $K_0$.
//
// **Step 3: which problem the limits solve.** Drop the stiff term on the left, which is not
// negative, and go to the limit. The two other terms can only fall there. For $j_h$ this is
// asked. For $a_1$ let $w$ be the weak limit, $w_h → w$ as in (ii), and $d = u_h - w_h$,
// which tends to 0 weakly. By (i) $a_1(d, d) + a_{0h}(d, d) ≥ 0$, and the second term is
// the stiff form of $u_h$, which tends to 0. So in the limit $a_1(d, d)$ is not negative,
// and
//
// $$ a_1(u_h, u_h) = a_1(d, d) + 2 a_1(w_h, d) + a_1(w_h, w_h) $$
//
// is at least $a_1(w, w)$. Hence the limit solves (2). That has one solution, $u^0$.
//
// **Step 4: strong.** Take $w = u^0$, and bring the left side of step 1 to the difference
// $d = u_h - w_h$:
//
// $$ a_1(d, d) + ε_c^{-1} a_{0h}(d, d) ≤ L(d) - a_1(w_h, d) + j_h(w_h) - j_h(u_h). $$
//
// The right side tends to 0 or below, because $d$ tends to 0 weakly. By (i) it tends to 0
// strongly.
//
// If $ε_* > 0$, do the same with a $w$ of $K$ and $w_h$ of $K_h$. Then the stiff terms do
// not vanish. By (iv) $a_{0h}(w_h, d)$ tends to 0 and $a_{0h}(w_h, w_h)$ to $a_0(w, w)$. So
// step 3 holds for $a_1 + ε_c^{-1} a_{0h}$ in the place of $a_1$, and the limit solves (1)
// at $ε_*$. ∎
//
// **(i) against (ii).** Let the groups shrink with $h$. Then (iii) and (iv) always hold:
// $(B v_h, q)$ differs from $(P_h B v_h, q)$ by $(B v_h, q - P_h q)$, which vanishes,
// because means over small groups come near $q$. Larger groups leave more functions, which
// helps (ii), but the form sees less, which hurts (i). One way out (Arnold and Brezzi 1993,
// for plates) keeps half of $a_0$: $a_1 + ½ a_0 + (ε_c^{-1} - ½) a_{0h}$. Why does half
// help? The half that is kept sees every strain. Where $a_1 ≥ 0$, as here, the form is at
// least half of $a_1 + a_0$: (i) holds with half the α. And in the limit this half asks for
// nothing new, because $a_0 = 0$ there anyway. (The parameter $1/(ε_c^{-1} - ½)$ is up to
// 2 now. The bound of step 1 holds, as $a_1 + ½ a_0$ alone is coercive.)

#include "antilock/analysis/best_approximation.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/exact/exact_norms.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "antilock/models/project_strain.hpp"
#include "course/add_row.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using tutorial::Exact;

// ### Forms
// How the strain is averaged on a mesh of width $h$ (empty: not at all), and the part of
// $a_0$ that is kept.
using Means = std::function<StrainProjection(const TriangleMesh& mesh,
                                             const FactoredForm& strain, double h)>;
struct Projection {
  std::string name;
  Method method;
  Means means;
  double kept;
};
const Means patches = [](auto& mesh, auto& strain, double) {
  return vertex_projection(mesh, strain, strain_quadrature(p1()));
};
const Means columns = [](auto& mesh, auto& strain, double h) {
  return box_projection(mesh, strain, h, 2);
};
const Means boxes = [](auto& mesh, auto& strain, double h) {
  return box_projection(mesh, strain, 2 * h, 2 * h);
};
const Method any{&p1(), unstructured()}, regular{&p1(), structured()},
    cr{&crouzeix_raviart(), unstructured()};
const std::vector<Projection> projections{{"P1 as it is", any, {}, 0},
                                          {"patches (half kept)", any, patches, 0.5},
                                          {"columns (half kept)", any, columns, 0.5},
                                          {"boxes (nothing kept)", regular, boxes, 0},
                                          {"boxes (half kept)", any, boxes, 0.5},
                                          {"Crouzeix-Raviart", cr, {}, 0}};

VariationalInequality layer_problem(const Projection& way, const Space& space, int cells) {
  VariationalInequality problem = assemble(tutorial::paper_scene(1), space);
  return way.means ? project_strain(
                         problem, way.means(space.mesh(), layer_strain(space), 1.0 / cells),
                         way.kept)
                   : problem;
}

// One mesh: (i) to (iii) in numbers, then the error at each ε. α needs dense eigenvalues,
// on small meshes. For (ii) the distance from $u^0$ to $K_{0h}$. For (iii) what one slope
// can be while the form sees nothing: the largest $∫ ∂_y v\, φ$ over such $v$ of norm 1,
// with $φ = \sin πx \sin πy$ (chapter 12's $k_h$).
Table measure(const Projection& way, int cells, const std::vector<Exact>& exact_solution) {
  // ### Mesh
  const Space space = way.method.space(cells);
  // ### Solve
  Sweep sweep(layer_problem(way, space, cells));
  const SparseMatrix norm = h1_gram_matrix(space);
  const double alpha =
      space.free_count() < 1000 ? coercivity(sweep.problem(), norm) : std::nan("");
  const double near =
      best_approximation(space, sweep.problem(), exact_solution.back().reference(),
                         AdmissibleSet::k_0h)
          .distance;
  using std::numbers::pi;
  const Field slope_of_phi = [](double x, double y) {
    return pi * std::sin(pi * x) * std::cos(pi * y);
  };
  const double hidden = dual_norm(sweep.problem(), norm,
                                  load_vector(space, slope_of_phi, Region::layer), true);
  Table rows(tutorial::projection_columns);
  for (const Exact& exact : exact_solution) {
    sweep.set_compliance(
        projected_class_parameter(exact.epsilon * exact.epsilon, way.kept));
    Solution solution = sweep.solve();
    solution.p.resize(0);  // means, not one stress per triangle: the errors of u alone
    tutorial::add_row(rows, {{"name", way.name},
                             {"h", 1.0 / cells},
                             {"epsilon", exact.epsilon},
                             {"h1", exact.errors(space, solution).h1},
                             {"alpha", alpha},
                             {"near", near},
                             {"hidden", hidden},
                             {"corrections", solution.counters.corrections},
                             {"seconds", solution.seconds.total()}});
  }
  return rows;
}

// P2, its strain averaged by the hat functions of the vertices, half of the stiff form
// kept: the $H^1$ error in contact at each ε.
Table averaged_p2(int cells, const std::vector<Exact>& exact_solution) {
  const Space space = Method{&p2(), unstructured()}.space(cells);
  const StrainProjection means =
      vertex_projection(space.mesh(), layer_strain(space), strain_quadrature(p2()));
  Sweep sweep(project_strain(assemble(tutorial::paper_scene(1), space), means, 0.5));
  Table rows({"h", "epsilon", "h1"});
  for (const Exact& exact : exact_solution) {
    sweep.set_compliance(projected_class_parameter(exact.epsilon * exact.epsilon, 0.5));
    Solution solution = sweep.solve();
    solution.p.resize(0);  // means, not stresses of triangles: the errors of u alone
    rows.add({1.0 / cells, exact.epsilon, exact.errors(space, solution).h1});
  }
  return rows;
}

void judge(const Table& layer, const ExactSolution& limit, tutorial::Report& report) {
  const auto of = [&](const char* name) {
    return layer.filter("name", name).filter("epsilon", 0);
  };
  const auto sup = [&](const char* name) {
    return tutorial::supremum(layer.filter("name", name), "h1", "epsilon");
  };
  // What has no function on the layer loses all of $u^0$ there.
  const double lost = layer_norm(limit);
  for (const char* name : {"P1 as it is", "patches (half kept)"})
    report.claim(of(name).min("near") > lost && of(name).min("h1") > lost &&
                     of(name).last("h1") < 1.25 * lost,
                 "(observed) {}: (ii) fails, u^0 stays {:.3f} away; so does the worst "
                 "error, {:.3f}: |u^0| on the "
                 "layer is {:.3f}",
                 name, of(name).last("near"), of(name).last("h1"), lost);
  const double slope = tutorial::slope_hidden_by_columns();
  const Table columns_h = of("columns (half kept)");
  report.claim(
      columns_h.min("hidden") > 0.85 * slope && columns_h.max("hidden") < 1.02 * slope,
      "(proved) columns (half kept): (iii) fails, K_0h hides a slope of {:.3f}, in the "
      "limit {:.3f}",
      columns_h.last("hidden"), slope);
  const double stays = sup("columns (half kept)").rows.rows().back().number("order");
  report.claim(stays < 0.1, "(observed) and the worst error stays, {:.3f}, order {:.2f}",
               columns_h.last("h1"), stays);
  // A zigzag across the layer, of a wave length of some $h$, has energy from $∂_x$ alone: α
  // ~ $h^2$.
  const Table alone = of("boxes (nothing kept)").filter_number("alpha", [](double a) {
    return std::isfinite(a);
  });
  report.claim_orders(alone, "alpha", 1.8, 2.1, "boxes (nothing kept): (i) fails, alpha");
  const Table grows = sup("boxes (nothing kept)").rows;
  const std::vector<double> orders = grows.pairwise_orders("worst", "h");
  report.claim(*std::max_element(orders.begin(), orders.end()) < -0.5 &&
                   grows.last("worst") > 2 * grows.first("worst"),
               "(observed) and the worst error grows on every mesh, {:.2f} to {:.2f}",
               grows.first("worst"), grows.last("worst"));
  const Table half = of("boxes (half kept)");
  report.claim(
      half.filter_number("alpha", [](double a) { return std::isfinite(a); }).min("alpha") >
          0.5 * 0.9129,
      "(proved) boxes (half kept): (i), alpha is at least half of that on V, 0.9129");
  // $∫ ∂_y v\, φ = ∫ ∂_y v\, (φ - P_h φ)$, and of φ the means over squares of side $s$ miss
  // $s π / 24^{1/2}$.
  for (const Table& row : half.rows()) {
    const double share =
        row.number("hidden") / (2 * row.number("h") * std::numbers::pi / std::sqrt(24.0));
    if (row.number("h") == half.min("h") || share > 1 || share < 0.4)
      report.claim(
          share < 1 && share > 0.4,
          "(proved) and (iii): the slope hidden is {:.3f}, {:.2f} of what means miss",
          row.number("hidden"), share);
  }
  for (const char* name : {"boxes (half kept)", "Crouzeix-Raviart"}) {
    const tutorial::Supremum worst = sup(name);
    const double ratio = worst.rows.last("worst") /
                         layer.filter("name", name).filter("epsilon", 1).last("h1");
    report.claim_orders(of(name), "near", 0.9, 1.1,
                        fmt::format("{}: (ii), from u^0 to K_0h", name));
    report.claim_orders(worst.rows, "worst", 0.9, 1.15,
                        fmt::format("{}: sup over epsilon", name));
    report.claim(
        worst.denser < 1.02 && ratio < 1.1,
        "(observed) {}: locking ratio {:.2f}; every second epsilon would do to {:.2f} %",
        name, ratio, 100 * (worst.denser - 1));
    report.claim(layer.filter("name", name).max("corrections") <= 4,
                 "(observed) {}: {} corrections at most", name,
                 layer.filter("name", name).max("corrections"));
  }
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  const std::vector<Exact> exact_solution = tutorial::exact_solutions(
      {1, 0.3, 0.1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-6, 1e-10, 1e-20, 0}, 14);
  Table layer(tutorial::projection_columns);
  for (const Projection& way : projections)
    for (const int n : {8, 12, 16, 24, 32})
      if (n <= options.cells) layer.add(measure(way, n, exact_solution));
  // ### Output
  tutorial::show_projections(options.out, layer);
  judge(layer, exact_solution.back().solution, report);
  Table parabolas({"h", "epsilon", "h1"});
  for (const int n : {8, 12, 16, 24, 32}) parabolas.add(averaged_p2(n, exact_solution));
  report.claim_order(
      parabolas.filter("epsilon", 0), "h1", "h", 1.3, 1.9,
      "P2 and hat functions (half kept), in contact at epsilon = 0: H1 error "
      "(observed)");
  report.claim_order(tutorial::supremum(parabolas, "h1", "epsilon").rows, "worst", "h", 1.3,
                     1.9,
                     "P2 and hat functions (half kept), in contact: sup over epsilon "
                     "(observed)");
}

// ## What came out
//
// :output: Theorem 4
//
// (a) A mean over a column sees the values on $Σ$ less those on $Γ_C$, and nothing between.
// (iii) fails: a slope of 0.18 is hidden at every $h$, and the error stays at
// 0.217. *Patches* (all triangles at a vertex, one mean per vertex) ask for as many means
// as the layer has unknowns. (ii) fails, as for P1. It is only seen at smaller ε: at ε =
// 1e-3 their error is 0.055 where P1 has 0.145; in the limit both have 0.148.
// :number: 0.217 = table "Theorem 4 for" "sup error" "strain=columns (half kept)" h=0.0312
//
// (b) Even on the structured mesh, where P1 does not lock, zigzags across the layer are
// left whose means are 0. They cost next to nothing: (i) fails, α falls like $h^2$, and the
// error grows from 0.46 to 1.38. Its locking ratio stays at 1.24, because the error at ε =
// 1 grows as well: a bounded ratio means something only where a method converges (chapter
// 13). With half of the stiff form kept the zigzags cost something again. Of the four
// hypotheses three are in the table, and (iv) is proved above. The error over all ε then
// falls like $h$. At 1/h = 32 it is 0.060 with 2336 unknowns; that of Crouzeix–Raviart is
// 0.055, with 7136.
// :number: 0.46 = table "Theorem 4 for" "sup error" "strain=boxes (nothing kept)" h=0.125
// :number: 1.38 = table "Theorem 4 for" "sup error" "strain=boxes (nothing kept)" h=0.0312
// :number: 1.24 = table "Theorem 4 for" "locking ratio" "strain=boxes (nothing kept)" h=0.0312
//
// P2 can be averaged in the same way, with the hat functions of the vertices as weights and
// half of the stiff form kept. Without contact its error in $H^1$ then falls like $h^2$ on
// Delaunay meshes (observed; exercise 3 of [chapter 38](../38_order_two/38_order_two.cpp)).
// In contact, from $1/h = 8$ to 32, its order is 1.81 at ε = 0, and 1.77 for the worst
// error over ε (observed).
// :number: 1.81 = line "P2 and hat functions (half kept), in contact at epsilon = 0: H1 error (observed): order {}"
// :number: 1.77 = line "P2 and hat functions (half kept), in contact: sup over epsilon (observed): order {}"
//
// ## Exercises
//
// 1. Boxes of side $h/2$, $h$, $2h$, $4h$: which side is best? Is smaller always better?
// 2. On paper: which problem do the columns solve as $h → 0$?
// 3. On paper: which slope $∫ ∂_y v \sin πx \sin πy$ can a $v$ of norm 1 have, if $v$ is
//    equal on Σ and on $Γ_C$?
//
// ## Further reading
//
// - [Boffi, Brezzi and Fortin 2013](../guides/bibliography.md#boffi-2013): mixed methods.
// - [Arnold and Brezzi 1985](../guides/bibliography.md#arnold-1985): mixed and
//   nonconforming elements as two forms of one method.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "28_mixed", "Projected forms: another a0, and what Theorem 4 asks of it",
      {.takes_epsilon = false, .least_cells = 32, .most_cells = 64, .exercises = exercises},
      study);
}
