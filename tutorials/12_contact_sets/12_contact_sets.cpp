// # How discrete sets approach K
//
// Run: 12_contact_sets   ε = 1e-6, h from 1/8 to 1/64; several seconds
// Run: 12_contact_sets --epsilon 1
// Run: 12_contact_sets --exercise 1
// Run: 12_contact_sets --exercise 2
//
// Needs: [05](../05_p1_structured/05_p1_structured.cpp) (weak limits, Definition 1 in
// words), [07](../07_kernel/07_kernel.cpp) (kernels),
// [08](../08_crouzeix_raviart/08_crouzeix_raviart.cpp) (Crouzeix–Raviart, CR, and its
// interpolant), [10](../10_limits/10_limits.cpp) ($K_0$),
// [11](../11_propositions/11_propositions.cpp) (the solution that is clamped on $Σ$).
//
// **The picture.** A function of CR's $K_h$, along $Γ_C$. CR asks for $v ≥ 0$ at the
// midpoints of edges alone. There this function is 0, so it is allowed, and yet half of it
// lies below the obstacle. Is CR's set near $K$ at all?
//
// **Predict.** (a) With which power of $h$ does the distance from the exact solution to
// $K_h$ fall, for P1, CR and P2? (b) Take functions like that of the picture, of norm 1.
// Does what lies below 0 vanish as $h → 0$?
//
// ## Definition 1
//
// Chapter 05 said it in words, here it is in signs. Sets $C_h$ of discrete
// functions *approach* a set $C$ if
//
// $$ ∀ v ∈ C: \inf_{v_h ∈ C_h} ‖v - v_h‖_h → 0, \tag{8} $$
// $$ v_h ∈ C_h, v_h → v \text{ weakly} ⟹ v ∈ C. \tag{9} $$
//
// (8) says that each element of $C$ can be reached, (9) that from $C_h$ nothing else can
// be. The norm $‖·‖_h$ is that of chapter 08: CR jumps between triangles, so derivatives
// are taken triangle by triangle. *Weakly* means here: the values of $v_h$ converge to
// those of $v$ against each fixed function, and $‖v_h‖_h$ stays bounded. Then the
// derivatives, triangle by triangle, have weak limits too. Without jumps these are the
// derivatives of $v$, and this is what chapter 05 has. With jumps that must be shown. (For
// methods without jumps Definition 1 is *Mosco's*, Remark 1.)
//
// A method needs it twice: for $K_h → K$, and for $K_{0h} → K_0$, the sets with $∂_y v = 0$
// in the layer. That makes four conditions. Each becomes a number here.
//
// **(8) is a distance.** The $v_h$ of $K_h$ that is nearest to $u$ makes $‖u - v_h‖_h^2$
// smallest. This is a contact problem again, with the norm in place of the energy, and the
// same program solves it. For $K_{0h}$ add the condition that $v_h$ does not vary across
// the layer: it is the same problem at $ε = 0$. How small can the distance be? For a smooth
// $v$ interpolation gives order $h$ (P1, CR) or $h^2$ (P2), and smooth ones are enough
// (Lemma 1 for $K_0$; for $K$ they are dense, too). But $u$ is not smooth where contact
// ends: $u^ε$ is like $r^{3/2}$ there, with $r$ the distance, and the second derivative of
// $u^0$ jumps (chapter 09). Either leaves P2 at least the order 3/2.
//
// **(9) for $K$: what lies below 0.** P1 is affine between vertices at which it is not
// negative, so nothing lies below: $K_h ⊂ K$. CR and P2 may dip between their points. Look
// at one edge $E$ of $Γ_C$. CR's value at the midpoint is the mean over the edge. So what
// lies below 0 is no larger than what separates $v_h$ from its mean there, and this is at
// most $|E|$ times the slope $s$. Its square, integrated along the edge, is at most
// $|E|^3 s^2$. The triangle above the edge has an area like $|E|^2$, so it adds about
// $|E|^2 s^2$ to the square of the norm. The first is $|E|$ times the second. Sum over the
// edges:
//
// $$ ‖\min(v_h, 0)‖_{L^2(Γ_C)} ≤ c_h ‖v_h‖_h,   c_h ∼ h^{1/2}. $$
//
// So in a bounded sequence the part below 0 vanishes. And where $v_h → v$ weakly, the
// values on $Γ_C$ converge weakly to those of $v$. For functions without jumps the trace
// keeps weak limits. For CR take a smooth vector field $q$ that is 0 near $Γ_D$, with
// $q·n = g$ on $Γ_C$, and integrate by parts on each triangle:
//
// $$ ∫ ∇v_h·q + ∫ v_h \operatorname{div} q = ∫_{Γ_C} v_h g + ∑_E ∫_E [v_h] q·n. $$
//
// The sum is over the inner edges. A jump $[v_h]$ of CR has the mean 0 along its edge, so
// only the change of $q$ along the edge counts, and the sum is at most a constant times
// $h ‖v_h‖_h$. In the limit the left side is that of $v$, whose gradient is the weak limit
// of the broken ones (the same formula with a $q$ that is 0 on the whole boundary says so;
// chapter 14). So $∫_{Γ_C} v_h g → ∫_{Γ_C} v g$. For $g ≥ 0$ this is not negative, because
// what lies below 0 vanishes. So $v ≥ 0$ on $Γ_C$: $v$ is in $K$. The $c_h$ of the run
// comes from an eigenvalue: the largest ratio of the two sides, with the distance to the
// mean on the left. (For P2 it is the distance to the two chords that join its three points
// on an edge.) The ratio is taken over all of $V_h$, so it is an upper bound. The function
// of the picture shows that functions of $K_h$ come near this bound: it is the worst of
// those that are 0 at all midpoints. Half of it lies below 0, so the left side is
// $2^{-1/2}$ times the distance to the mean.
//
// **(9) for $K_0$: a slope that hides in jumps.** Let functions $v_h$ of $K_{0h}$ tend
// weakly to $v$. On each triangle of the layer $∂_y v_h = 0$. Is $∂_y v = 0$, too? Without
// jumps it is. With jumps it need not be: a staircase is level on every step, and climbs
// all the same. With smaller and smaller steps its weak limit is a slope. So the
// derivative, triangle by triangle, tells nothing here.
// :figure: staircase
//
// *The values tell.* For a $v$ without jumps, and a smooth $φ$ that is 0 on the boundary of
// the layer, $∫ v ∂_y φ = -∫ φ ∂_y v$ by parts. Hence $∂_y v = 0$ if the left side is 0 for
// every such $φ$. The left side is a product of $v$ with something fixed, so it is the
// limit of the same product with $v_h$. Compute that one by parts, triangle by triangle. As
// $∂_y v_h = 0$ inside, only the edges are left,
//
// $$ ∫ v_h ∂_y φ = ∑_E ∫_E [v_h] φ n_y, $$
//
// with the jump $[v_h]$ over the edge $E$: the steps of the staircase. The question is
// whether this sum tends to 0.
//
// *One edge.* CR's jump is a straight line along $E$ with the mean 0. So a $φ$ that is
// constant along $E$ gives 0, and only the change of $φ$ along $E$ counts, which is small
// on a short edge. The jump is the difference of the $v_h$ of two triangles, which have the
// same mean over $E$. So from each triangle only the change of its $v_h$ along $E$ is left:
// a line of slope $s$ and of mean 0. Its product with a line of slope $b$ has the integral
// $b s |E|^3/12$. (At an edge on the boundary of the layer φ is 0.)
//
// *All edges of right triangles* with legs $h$. The vertical edge of a triangle has
// $n_y = 0$. Let its $v_h$ have the slope $g = ∂_x v_h$. As $∂_y v_h = 0$, its slope $s$ is
// $g$ along the horizontal edge and $2^{-1/2} g$ along the diagonal one. There $φ$ has the
// slopes $b = ∂_x φ$ and $2^{-1/2} (∂_x φ + ∂_y φ)$, $n_y$ is 1 and $2^{-1/2}$, and $|E|$
// is $h$ and $2^{1/2} h$. (φ is no straight line, but it is one up to $h^2$.) So the two
// edges give $g ∂_x φ$ and $g (∂_x φ + ∂_y φ)$, each times $h^3/12$, which is $h/6$ times
// the area of the triangle. Sum over the triangles, by Cauchy and Schwarz. Up to the order
// $h^2$ the sum is at most
//
// $$ \frac{h}{6} (‖∂_x φ‖ + ‖∂_x φ + ∂_y φ‖) ‖v_h‖_h = 0.632 h ‖v_h‖_h   \text{for } φ = \sin πx \sin πy. $$
//
// This tends to 0, so $v$ is in $K_0$. A CR function may be a staircase, but only by a
// height like $h$. The run computes the largest such sum over all $v_h$ of $G_h$ with norm
// 1, for this one $φ$, and calls it $k_h$.

#include "antilock/analysis/best_approximation.hpp"
#include "antilock/analysis/negative_part.hpp"
#include "antilock/exact/exact_norms.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "course/add_row.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using std::numbers::pi, tutorial::Exact;

const std::vector<std::string> columns{"element", "mesh", "cells", "h",   "to_k",
                                       "to_k0",   "c_h",  "k_h",   "dip", "size"};

double below(
    const Eigen::MatrixX3d& trace) {  // in L2 of Γ_C; the columns are x, value, length
  return std::sqrt(
      ((-trace.col(1).array()).cwiseMax(0).square() * trace.col(2).array()).sum());
}

// One method on one mesh: the four numbers, and of $u_h$ itself the part below 0 (`dip`)
// and its norm.
Table measure(const Method& method, int cells, const Exact& u, const Exact& u0) {
  // ### Mesh
  const Space space = method.space(cells);
  // ### Forms
  const VariationalInequality problem = assemble(u.scene, space);
  const SparseMatrix norm = h1_gram_matrix(space);
  const Eigen::VectorXd slope_of_phi = load_vector(
      space, [](double x, double y) { return pi * std::sin(pi * x) * std::cos(pi * y); },
      Region::layer);
  // ### Solve
  const Eigen::VectorXd u_h = active_set(problem).u;
  Table row(columns);
  const auto distance = [&](const Exact& to, AdmissibleSet set) {
    return best_approximation(space, problem, to.reference(), set).distance;
  };
  tutorial::add_row(row, {{"element", method.element->name()},
                          {"mesh", method.family.name},
                          {"cells", cells},
                          {"h", 1.0 / cells},
                          {"to_k", distance(u, AdmissibleSet::k_h)},
                          {"to_k0", distance(u0, AdmissibleSet::k_0h)},
                          {"c_h", negative_part(space, problem, norm).constant},
                          {"k_h", dual_norm(problem, norm, slope_of_phi, true)},
                          {"dip", below(contact_trace(space, u_h))},
                          {"size", std::sqrt(u_h.dot(norm * u_h))}});
  return row;
}

// The worst $v_h$ of CR that is 0 at all midpoints of $Γ_C$: its trace, the $c_h$ for it,
// and what lies below 0.
struct Worst {
  Eigen::MatrixX3d trace;
  double c_h, below, at_midpoints;
};
Worst worst_dip(const Space& space) {
  VariationalInequality problem = assemble(tutorial::paper_scene(0), space);
  for (const int unknown : problem.bounds.unknowns)
    problem.dirichlet_dofs.push_back(unknown);
  std::sort(problem.dirichlet_dofs.begin(), problem.dirichlet_dofs.end());
  problem.dirichlet_values =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.dirichlet_dofs.size()));
  problem.bounds = {};
  const NegativePart part = negative_part(space, problem, h1_gram_matrix(space));
  const Eigen::MatrixX3d trace = contact_trace(space, part.worst);
  return {trace, part.constant, below(trace),
          part.worst(space.contact_dofs()).cwiseAbs().maxCoeff()};
}

void judge(const Method& method, const Table& own, double lost, tutorial::Report& report) {
  const std::string name = method.name();
  const bool linear = method.element->degree() == 1, jumps = !method.element->conforming();
  const double low = linear ? 0.9 : 1.8, high = linear ? 1.1 : 2.1;
  report.claim_order(own, "to_k", "h", low, high,
                     name + ", (8) for K (proved), its order (observed)");
  if (name == "P1 unstructured") {  // nearest: 0 on the layer and on Sigma; rest^2 is the
                                    // error of P1 in the body
    Table rest({"h", "rest"});
    for (const Table& row : own.rows())
      rest.add({row.number("h"), std::pow(row.number("to_k0"), 2) - lost * lost});
    report.claim_order(rest, "rest", "h", 1.7, 2.2,
                       name + ", (8) for K_0 fails (proved): distance^2 - 0.138^2");
  } else {
    report.claim_order(own, "to_k0", "h", low, high,
                       name + ", (8) for K_0 (proved), its order (observed)");
  }
  if (method.element->name() == "P1")  // 1e-15: the values of a P1 function at its vertices
    report.claim(own.max("dip") <= 1e-15, "{}, (9) for K: nothing lies below 0 (proved)",
                 name);
  else
    report.claim_order(
        own, "c_h", "h", 0.45, 0.55,
        name + ", (9) for K: c_h at most C h^(1/2) (proved), its order (observed)");
  if (!jumps)  // quadrature of the load: its error, not that of the method; 6e-12 for P2
    report.claim(own.last("k_h") < 1e-10,
                 "{}, (9) for K_0: no hidden slope, {:.0e} (proved)", name,
                 own.last("k_h"));
  else
    report.claim_within(own.last("k_h") * own.max("cells"), 0.2, 0.3,
                        name +
                            ", (9) for K_0: at most 0.632 h (proved on right triangles), "
                            "k_h / h (observed)");
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  const Exact u(tutorial::paper_scene(options.epsilon)), u0(tutorial::paper_scene(0));
  std::vector<Method> all = methods();
  all.push_back({&p2(), structured()});
  Table results(columns);
  for (const Method& method : all)
    for (int n = 8; n <= options.cells; n *= 2) results.add(measure(method, n, u, u0));
  const Worst dip = worst_dip(Method{&crouzeix_raviart(), structured()}.space(16));
  // ### Output
  results.print("distances to K_h and K_0h, c_h, k_h, the part of u_h below 0, its norm",
                3);
  tutorial::write_contact_sets(options.out, results, u, dip.trace);
  for (const Method& method : all)
    judge(method,
          results.filter("element", method.element->name())
              .filter("mesh", method.family.name),
          clamped_distance(u0.solution), report);
  const double c_h = results.filter("element", "CR")
                         .filter("mesh", "structured")
                         .filter("cells", 16)
                         .number("c_h");
  report.claim_within(
      c_h / dip.c_h, 1, 1.2,
      "c_h of CR on 1/h = 16, over that of the v_h of the picture (at least 1: proved)");
  report.claim(dip.at_midpoints <= 1e-14,
               "the v_h of the picture is in K_h: at the midpoints 0 to {:.0e} (proved)",
               dip.at_midpoints);
  // Half of a straight line with the mean 0 lies below 0, so half of its square: sums over
  // 32 points have 0.1 % of it.
  report.claim_within(dip.below / dip.c_h * std::sqrt(2), 0.99, 1.01,
                      "the v_h of the picture has c_h / 2^(1/2) below 0 (proved): times");
}

// ## What came out
// :output: distances to K_h
// :figure: contact_sets
//
// (a) As interpolation has it: order 1 for P1 and CR, for P2 a little below 2, and the same
// for $K_0$. The exception is P1 on the unstructured mesh. All functions of its $K_{0h}$
// vanish on the layer, so the distance tends to 0.138: to all digits shown chapter 11's
// distance from $u^0$ to the solution that is clamped on $Σ$. This is the hypothesis of
// Theorem 4 that fails.
//
// (b) Yes: $c_h$ falls like $h^{1/2}$. The solutions are smooth and far better than the
// worst: $u_h$ of CR on $1/h = 32$ dips by 2e-4 where $c_h$ allows 7e-2. The picture shows
// where: only at the end of contact.
// :number: 2e-4 = table "distances to K_h" dip element=CR mesh=unstructured cells=32
// :figure: contact_trace
//
// ## Exercises
//
// 1. $v = \min(x, 1-x) (1-y)/2$ is in $K$ and has a kink at $x = 1/2$. How fast does P1
//    approach it, on both meshes?
// 2. Move the vertices of the structured mesh by up to $h/10$. Does $K_{0h}$ of P1 approach
//    $K_0$?
// 3. On paper: where is $K_h$ of P2 not a part of $K$? Draw a parabola.
//
// ## Further reading
//
// - [Mosco 1969](../guides/bibliography.md#mosco-1969): the two conditions, for sets
//   without jumps.
// - [Brezis 2011](../guides/bibliography.md#brezis-2011): weak limits.
// - [Ciarlet 2002](../guides/bibliography.md#ciarlet-2002): interpolation, and the obstacle
//   problem.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "12_contact_sets",
      "Definition 1: how K_h approaches K, and K_0h approaches K_0",
      {.cells = 64, .least_cells = 32, .most_cells = 64, .exercises = exercises}, study);
}
