// # The limit ε → 0
//
// Run: 10_limits               h = 1/32, ε from 1 to 1e-4; a few seconds
// Run: 10_limits --cells 64
// Run: 10_limits --exercise 1
// Run: 10_limits --exercise 2
//
// Needs: [01](01_domain.cpp) ((23)), [03](03_by_hand.cpp) ($p$), [07](07_kernel.cpp), [09](09_convergence.cpp) (order).
//
// **The picture.** How far $u^ε$ is from its limit: exact (grey), and four methods on one mesh. *Each method has a
// limit, the locked one too. What is wrong with locked P1 is where it goes.*
//
// **Predict.** (a) $h$ is fixed and $ε → 0$: does locked P1 converge? (b) Now $ε = h^2$ and $h → 0$. Three steps lead
// from $u^ε$ by $u^0$ and $u_h^0$ to $u_h^ε$. Which of their lengths do not tend to 0 for locked P1?
//
// ## Theorem 1: where $u^ε$ goes
//
// The paper's class of problems is (1). In (23) the class parameter is $ε_c = ε^2$:
//
// $$ u^ε ∈ K,  a_1(u^ε, v - u^ε) + ε_c^{-1} a_0(u^ε, v - u^ε) ≥ L(v - u^ε)  ∀ v ∈ K. \tag{1} $$
//
// The limit lives in $K_0 = K ∩ G$: what the obstacle allows and $a_0$ does not see. There it solves
// $a_1(u^0, w - u^0) ≥ L(w - u^0)$ for all $w ∈ K_0$, (2). The proof needs that $a^ε = a_1 + ε_c^{-1} a_0$ is
// *coercive*: $a^ε(v, v) ≥ α ‖v‖^2$ with one $α > 0$ for all $ε$. It has three steps.
//
// *Bounded:* put $v = v_0 ∈ K_0$ into (1). As $a_0(v_0, ·) = 0$, this says with $d = u^ε - v_0$ that
// $α ‖d‖^2 ≤ a^ε(d, d) ≤ L(d) - a_1(v_0, d)$. The right side grows like $‖d‖$ only, so $‖u^ε‖ ≤ C$ and
// $a_0(u^ε, u^ε) ≤ C ε_c$. *Limit:* a bounded family has a sequence that converges *weakly* (its product with each
// fixed function converges). A closed convex set keeps its weak limits. A form like $a_0(v, v)$, which is never
// negative, can only fall in one. So the limit is in $K$ and has $a_0 = 0$: it is in $K_0$. For $w ∈ K_0$ drop
// $-ε_c^{-1} a_0(u^ε, u^ε) ≤ 0$ from (1). In the limit $a_1(u^ε, u^ε)$ can only fall, too, and (2) is left, which has
// one solution only. *Strong:* put $v = u^0$ into (1):
//
// $$ a^ε(u^ε - u^0, u^ε - u^0) ≤ L(u^ε - u^0) - a_1(u^0, u^ε - u^0) → 0. \tag{5} $$
//
// (5) says more than $u^ε → u^0$. Since $a_0(u^0, ·) = 0$, its stiff part is $ε^{-2} a_0(u^ε, u^ε) = ε^2 ‖p‖^2$ in
// $L^2$ of the layer: the energy in the thickness vanishes.
//
// No theorem gives an order. Write $u$ on $Γ_C$ as a sum of waves $u_k \sin kπx$. A layer of thickness $ε$ changes
// wave $k$ by the share $(ε k)^2$ of itself, and from $k = 1/ε$ on by about all of it. Where contact ends, the
// pressure of $u^0$ jumps, and its second derivative with it: this leaves $u_k ∼ k^{-3}$. In $‖·‖^2$ wave $k$ counts
// $k^2 u_k^2 ∼ k^{-4}$. So $‖u^ε - u^0‖^2 ∼ ∑ k^{-4} \min(1, (ε k)^4) ∼ ε^3$: order 3/2. A mesh has no waves beyond
// $1/h$. Below $ε ∼ h$ every wave is changed by a share that is like $ε^2$: order 2.
//
// ## The same on a mesh, and both at once
//
// *Proposition 1:* $u_h^ε → u_h^0$ at fixed $h$, by the same proof on $V_h$; $u_h^0$ solves (7), in
// $K_{0h} = K_h ∩ G_h$; (27) is (7) for our problem. *Proposition 2:* if $K_h$ approaches $K$, then $u_h^ε → u^ε$ as
// $h → 0$ at fixed $ε$. If $K_{0h}$ approaches $K_0$, then $u_h^0 → u^0$. (The [next chapter](11_contact_sets.cpp) is
// about these two "if".) *Proposition 3* needs both, and lets $ε$ and $h$ tend to 0 together:
//
// $$ ‖u^ε-u_h^ε‖_h ≤ ‖u^ε-u^0‖ + ‖u^0-u_h^0‖_h + ‖u_h^0-u_h^ε‖_h. \tag{18} $$
//
// ## Remark 5: the limit is a string on $Σ$
//
// A function of $K_0$ is one on the body: below $Σ$ it goes on as its values $w(x)$ on $Σ$, its *trace*. So
// $a_x^-(u, v) = ∫_Σ u' w'$, and by parts (2) becomes $∫_Σ r (w - u) ≥ 0$ for all $w ≥ 0$, with
//
// $$ -Δu = f,   u ≥ 0,   r = ∂_n u - u_{xx} ≥ 0,   u r = 0 \text{ on } Σ. \tag{25} $$
//
// This is the *Ventcel–Signorini problem*: a string on $Σ$, pulled by the body, over an obstacle. (22) has a thin
// layer, (23) the same one stretched, (25) none: the last picture has all three.

#include "antilock/exact/truth_distance.hpp"
#include "antilock/form/h1_norm.hpp"
#include "common/limit_problem.hpp"
#include "common/study.hpp"

using namespace antilock;
using tutorial::Exact;

struct Discrete {
  // ### Mesh
  Discretisation on;
  // ### Forms
  SceneSweep sweep{tutorial::paper_scene(0), on.space()};  // a1 and the factors of a0, assembled once for all ε
  SparseMatrix norm = h1_norm(on.space());                 // the matrix of the norm
  // ### Solve
  Solution at(double epsilon) {  // u_h^ε; at ε = 0 this is (7) itself, not a small ε
    sweep.set_epsilon(epsilon);
    return sweep.solve();
  }
  double distance(const Solution& a, const Solution& b) const { return std::sqrt((a.u - b.u).dot(norm * (a.u - b.u))); }
};

// Proposition 1, one method on one mesh: the distance to its own limit, and the stiff part of (5).
Table to_the_limit(const Method& method, int cells) {
  Discrete discrete{method.on(cells)};
  const Solution limit = discrete.at(0);
  Table rows({"method", "epsilon", "distance", "stiff"});
  for (int k = 0; k <= 8; ++k) {
    const double epsilon = std::pow(10.0, -0.5 * k);
    const Solution u = discrete.at(epsilon);
    const double p2 = u.p.dot(discrete.sweep.problem().m.cwiseProduct(u.p));
    rows.add({method.name(), epsilon, discrete.distance(u, limit), epsilon * epsilon * p2});
  }
  return rows;
}

// Proposition 3: the three terms of (18), and what they bound, along $ε = h^k$. No mesh enters $u^ε$ and the first term.
struct OnPath {
  int n;  // 1/h
  Exact exact;
  double first_term;
};

std::vector<OnPath> path(double k, int finest, const Exact& limit) {
  std::vector<OnPath> all;
  for (int n = 8; n <= finest; n *= 2) {
    Exact exact(tutorial::paper_scene(std::pow(n, -k)), 15);
    const double first_term = h1_distance(exact.truth, limit.truth);
    all.push_back({n, std::move(exact), first_term});
  }
  return all;
}

Table three_terms(const Method& method, const std::vector<OnPath>& path, const Exact& limit) {
  Table rows({"method", "h", "term", "value"});
  for (const auto& [n, exact, first_term] : path) {
    Discrete discrete{method.on(n)};
    const Solution u = discrete.at(exact.epsilon), u0 = discrete.at(0);
    rows.add({method.name(), 1.0 / n, "first term", first_term});
    rows.add({method.name(), 1.0 / n, "second term", limit.errors(discrete.on.space(), u0).h1});
    rows.add({method.name(), 1.0 / n, "third term", discrete.distance(u0, u)});
    rows.add({method.name(), 1.0 / n, "left side", exact.errors(discrete.on.space(), u).h1});
  }
  return rows;
}

void limits(const tutorial::Options& options, tutorial::Report& report) {
  const Exact limit(tutorial::paper_scene(0), 15);
  const std::vector<OnPath> h_squared = path(2, options.cells, limit);
  Table curves({"method", "epsilon", "distance", "stiff"}), terms({"method", "h", "term", "value"});
  for (const Method& method : methods()) {
    curves.add(to_the_limit(method, options.cells));
    terms.add(three_terms(method, h_squared, limit));
  }
  curves.add(tutorial::exact_to_the_limit(curves.numbers("epsilon"), limit));
  // ### Output
  tutorial::show_limits(options.out, curves, terms);
  tutorial::judge_orders(curves, terms, report);
  // What locked P1 loses is $u^0$ on the layer: its second term cannot be smaller than that.
  const double lost = tutorial::limit_on_layer(limit.truth), second = tutorial::last_second_term(terms);
  report.claim(second >= lost, "P1 unstructured: second term {:.3f}, |u^0| on the layer {:.3f}", second, lost);
  tutorial::judge_limit_problem(options.out, limit, options.cells, report);
}

// ## What came out
//
// (a) Yes, with the order 2 of every method. (b) Only the second: 0.253, 0.175, 0.148, never below 0.126, the norm of
// $u^0$ on the layer. So the error stays, too. Order 1.56 of the exact limit tends to 3/2 from above; $ε^2 ‖p‖^2$ has
// order 2: $p$ has a limit. At ε = 0.1, (22) and (23) agree to 1e-4 on $Γ_C$, each on its mesh. (25) is 4.5e-3 away.
//
// ## Exercises
//
// 1. Locked P1 along $ε = h$ in place of $h^2$: does its error still stay?
// 2. Take the obstacle away. Which order has $‖u^ε - u^0‖$ now?
// 3. On paper: $v = 0$ and $v = 2u^ε$ in (23) give $a^ε(u^ε, u^ε) = L(u^ε)$. Which bound on $ε ‖p‖$ follows?
// 4. On paper: derive (25) from (2) by parts.

#include "answers/10_limits.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "10_limits", "Theorem 1, Propositions 1, 2, 3, 5: the limit epsilon -> 0",
                       {.takes_epsilon = false, .least_cells = 16, .most_cells = 256, .exercises = exercises}, limits);
}
