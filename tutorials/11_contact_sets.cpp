// # How discrete sets approach K
//
// Run: 11_contact_sets   ε = 1e-6, h from 1/8 to 1/32; a few seconds
// Run: 11_contact_sets --epsilon 1
// Run: 11_contact_sets --exercise 1
// Run: 11_contact_sets --exercise 2
//
// Needs: [07](07_kernel.cpp) for kernels, [08](08_crouzeix_raviart.cpp) for Crouzeix–Raviart (CR) and its
// interpolant, [10](10_limits.cpp) for $K_0$ and weak limits.
//
// **The picture.** Distances from the exact solutions to the discrete sets, for five methods. *Every $K_h$ comes near
// $K$. Every $K_{0h}$ comes near $K_0$, but not that of P1 on an unstructured mesh: this is the hypothesis of Theorem
// 4 that fails.*
//
// **Predict.** (a) With which power of $h$ does the distance to $K_h$ fall, for P1, CR and P2? (b) CR asks for
// $v ≥ 0$ at midpoints of edges only, so a $v_h$ of size 1 may be below 0 near vertices. Does the part below 0 vanish
// as $h → 0$?
//
// ## Definition 1
//
// Sets $C_h$ of discrete functions *approach* a set $C$ when nothing of $C$ is missed and nothing foreign is added:
//
// $$ ∀ v ∈ C: \inf_{v_h ∈ C_h} ‖v - v_h‖_h → 0, \tag{8} $$
// $$ v_h ∈ C_h, v_h → v \text{ weakly} ⟹ v ∈ C. \tag{9} $$
//
// For conforming methods this is *Mosco convergence* of convex sets (Remark 1). A method needs it twice, for $K_h → K$
// and for $K_{0h} = K_h ∩ G_h → K_0 = K ∩ G$: four conditions, and each has its number here.
//
// **(8) is a distance.** The nearest $v_h$ to $u$ makes $‖u - v_h‖_h^2$ smallest over $K_h$: a contact problem with
// the form of the norm in place of $a$. For $K_{0h}$ add $B v_h = 0$, no slope across the layer: the same problem at
// ε = 0. It is enough to ask for smooth $v$, since they are dense: in $K_0$ this is *Lemma 1*, the smooth functions
// of $K_0$ come as near as one likes to each of its functions. For a smooth $v$ interpolation gives order $h$ (P1,
// CR) or $h^2$ (P2). Where contact ends, $u^ε$ is like $r^{3/2}$ with $r$ the distance from there, and the second
// derivative of $u^0$ jumps (chapter 09). Each of the two leaves P2 at least $h^{3/2}$.
//
// **(9) for $K$: what lies below 0.** P1 is affine between vertices at which $v_h ≥ 0$: nothing lies below 0,
// $K_h ⊂ K$. CR has $v_h ≥ 0$ at a midpoint only, which is the mean over the edge. P2 may dip between its three
// points. On an edge $E$ the part below 0 is no larger than the difference of $v_h$ and the constant through the
// midpoint (CR), or the two chords (P2): at most $|E|$ times the largest slope $s_E$. The integral of its square
// over $E$ is at most $|E|^3 s_E^2$. The triangle above $E$ has the area $∼ h |E|$, and adds about $h |E| s_E^2$ to
// $‖v_h‖_h^2$. As $|E| ≤ h$, the first is at most about $h$ times the second. The sum over the edges of $Γ_C$ gives
//
// $$ ‖\min(v_h, 0)‖_{L^2(Γ_C)} ≤ c_h ‖v_h‖_h,   c_h ∼ h^{1/2}. $$
//
// So a bounded sequence loses its negative part, and its weak limit is in $K$. The $c_h$ computed here is an upper
// bound: the root of the largest eigenvalue of (squares of these differences) against $‖v_h‖_h^2$, over all of $V_h$.
//
// **(9) for $K_0$: what slope a jump hides.** A weak limit $v$ of $v_h ∈ K_{0h}$ must have $∂_y v = 0$, that is
// $∫ v ∂_y φ = 0$ for each smooth $φ$ that is 0 around the layer. Triangle by triangle $∂_y v_h = 0$, so by parts
// only jumps are left: $∫ v_h ∂_y φ = ∑_E ∫_E [v_h] φ n_y$. Conforming: no jumps, 0. CR: the mean of $[v_h]$ over $E$
// is 0, so the mean of $φ$ may be subtracted, and the sum is at most $1.8 h ‖v_h‖_h$ (right triangles; on an edge,
// $|E|^3/12$ times both slopes). Its largest value $k_h$ over $v_h ∈ G_h$ with $‖v_h‖_h = 1$ is computed here for
// $φ = \sin πx \sin πy$.

#include "antilock/analysis/nearest.hpp"
#include "antilock/analysis/negative_part.hpp"
#include "antilock/form/h1_norm.hpp"
#include "antilock/measure/contact_trace.hpp"
#include "common/contact_sets_output.hpp"
#include "common/study.hpp"

using namespace antilock;
using std::numbers::pi, tutorial::Exact;

const std::vector<std::string> columns{"element", "mesh", "cells", "h", "to_k", "to_k0", "c_h", "k_h", "dip", "size"};

// One method on one mesh: the four numbers, and of $u_h$ itself the part below 0 in $L^2(Γ_C)$ (`dip`) and $‖u_h‖_h$.
Table measure(const Method& method, int cells, const Exact& u, const Exact& u0) {
  // ### Mesh
  const Discretisation on = method.on(cells);
  // ### Forms
  const VariationalInequality problem = assemble(tutorial::paper_scene(u.epsilon), on.space());
  const SparseMatrix norm = h1_norm(on.space());
  const Eigen::VectorXd slope_of_phi = load_vector(
      on.space(), [](double x, double y) { return pi * std::sin(pi * x) * std::cos(pi * y); }, Region::layer);
  // ### Solve
  const Eigen::VectorXd u_h = active_set(problem).u;
  const Eigen::MatrixX3d trace = contact_trace(on.space(), u_h);  // x, value, length
  const Eigen::ArrayXd below = (-trace.col(1)).cwiseMax(0);
  Table row(columns);
  row.add({method.element->name(), method.family.name, cells, 1.0 / cells,
           nearest(on.space(), problem, u.reference(), Within::k_h).distance,
           nearest(on.space(), problem, u0.reference(), Within::k_0h).distance,
           negative_part_constant(on.space(), problem, norm), dual_norm(problem, norm, slope_of_phi, true),
           std::sqrt((below.square() * trace.col(2).array()).sum()), std::sqrt(u_h.dot(norm * u_h))});
  return row;
}

void verdict(const Method& method, const Table& own, tutorial::Report& report);

void study(const tutorial::Options& options, tutorial::Report& report) {
  const Exact u(tutorial::paper_scene(options.epsilon)), u0(tutorial::paper_scene(0));
  std::vector<Method> all = methods();
  all.push_back({&p2(), structured()});
  Table results(columns);
  for (const Method& method : all)
    for (int n = 8; n <= options.cells; n *= 2) results.add(measure(method, n, u, u0));
  // ### Output
  results.print("distances to K_h and K_0h, c_h, k_h, the part of u_h below 0, its norm", 3);
  tutorial::write_contact_sets(options.out, results, u);
  for (const Method& method : all)
    verdict(method, results.where("element", method.element->name()).where("mesh", method.family.name), report);
}

// 0.1 beside the orders of the text: the meshes are coarse.
void verdict(const Method& method, const Table& own, tutorial::Report& report) {
  const bool linear = method.element->degree() == 1, locks = method.name() == "P1 unstructured";
  const double low = linear ? 0.9 : 1.4, high = linear ? 1.1 : 2.1, finest = own.most("cells");
  report.claim_within(own.order("to_k", "h"), low, high, method.name() + ", (8) for K: order of the distance");
  const Table fine = own.where_number("cells", [=](double cells) { return cells >= finest / 2; });
  if (locks)  // what it cannot have is u^0 on the layer, of norm 0.126
    report.claim(own.last("to_k0") > 0.126, "{}, (8) for K_0 fails: {:.3f} away at 1/h = {}", method.name(),
                 own.last("to_k0"), finest);
  else
    report.claim_within(fine.order("to_k0", "h"), low, high, method.name() + ", (8) for K_0: order of the distance");
  if (method.element->name() == "P1")  // 1e-9: the digits of the solver
    report.claim(own.most("dip") < 1e-9, "{}, (9) for K: nothing lies below 0", method.name());
  else
    report.claim_within(own.order("c_h", "h"), 0.45, 0.55, method.name() + ", (9) for K: order of c_h");
  if (method.element->conforming())
    report.claim(own.most("k_h") < 1e-6, "{}, (9) for K_0: no hidden slope but for quadrature", method.name());
  else
    report.claim(own.order("k_h", "h") > 0.7 && own.last("k_h") * finest < 1.8,
                 "{}, (9) for K_0: k_h = {:.2f} h at 1/h = {}, order {:.2f}", method.name(), own.last("k_h") * finest,
                 finest, own.order("k_h", "h"));
  bool bounded = true;
  for (const Table& row : own.rows()) bounded &= row.number("dip") <= row.number("c_h") * row.number("size") + 1e-9;
  report.claim(bounded, "{}: u_h dips {:.0e} below 0, c_h allows {:.0e}", method.name(), own.last("dip"),
               own.last("c_h") * own.last("size"));
}

// ## What came out
//
// (a) As interpolation has it: orders 0.98 (P1), 0.98 and 0.99 (CR), 1.95 (P2), and the same for $K_0$, but for P1 on
// the unstructured mesh: 0.253, 0.175, 0.148, never below 0.126, the norm of $u^0$ on the layer, where all functions of
// its $K_{0h}$ vanish. (b) Yes: $c_h$ falls like $h^{0.50}$ (CR, P2). The solutions are smooth and far better: $u_h$ of
// CR dips 2e-4 where $c_h$ allows 7e-2. The hidden slope $k_h$ is $0.26 h$ and, unstructured, at most $0.21 h$.
//
// ## Exercises
//
// 1. $v = \min(x, 1-x) (1-y)/2$ is in $K$ and has a kink at $x = 1/2$. How fast does P1 approach it, on both meshes?
// 2. Move the vertices of the structured mesh by up to $h/10$. Does $K_{0h}$ of P1 approach $K_0$?
// 3. On paper: where is $K_h$ of P2 not a part of $K$? Draw a parabola.

#include "answers/11_contact_sets.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "11_contact_sets", "Definition 1: how K_h approaches K, and K_0h approaches K_0",
                       {.least_cells = 32, .most_cells = 64, .exercises = exercises}, study);
}
