// # The limit ε → 0
//
// Run: 10_limits               1/h = 32, ε from 1 to 1e-4; a few seconds
// Run: 10_limits --cells 64
// Run: 10_limits --exercise 1
//
// **Afterwards you can** prove that $u^ε$ tends to $u^0$, derive the limit model on $Σ$,
// and estimate how fast it is reached.
//
// Needs: [01](../01_domain/01_domain.cpp) ((22), (23)), [03](../03_by_hand/03_by_hand.cpp)
// ($p$), [05](../05_p1_structured/05_p1_structured.cpp) (weak limits).
//
// **The picture.** A layer of thickness 0.1 in three models: as it is (22), stretched (23),
// and with its limit in its place (25), which is the subject of this chapter. The first two
// are the same problem, and so one curve.
//
// **Predict.** (a) The factor $ε^{-2}$ in front of the stiff form grows. Does the energy
// $ε^{-2} a_y^-(u^ε, u^ε)$ grow with it, tend to a number, or tend to 0? (b) The limit
// model has no mesh for the layer. What does it put on $Σ$ in its place?
//
// ## Theorem 1: where $u^ε$ goes
//
// The paper treats a class of problems at once. Its parameter stands for $ε^2$ of (23);
// call it $ε_c$. There are a moderate form $a_1$, a stiff form $a_0$ and a convex set $K$:
//
// $$ u^ε ∈ K,  a_1(u^ε, v - u^ε) + ε_c^{-1} a_0(u^ε, v - u^ε) ≥ L(v - u^ε)  ∀ v ∈ K. \tag{1} $$
//
// The limit lives in $K_0 = K ∩ G$: what the obstacle allows, and what $a_0$ does not see.
// The limit problem is
//
// $$ u^0 ∈ K_0,  a_1(u^0, w - u^0) ≥ L(w - u^0)  ∀ w ∈ K_0. \tag{2} $$
//
// **Theorem 1.** $u^ε → u^0$ in the norm of $V$. (For (23) the paper calls this Proposition
// 5.) The proof has three steps. It needs that the form $a^ε = a_1 + ε_c^{-1} a_0$ controls
// the norm, with one $α > 0$ for all $ε$ (it is
// *coercive*): $a^ε(v, v) ≥ α ‖v‖^2$.
//
// **1. The solutions are bounded.** Take a fixed $v_0$ of $K_0$ as test function in (1).
// The stiff form does not see it, so it costs nothing at any ε. With the difference
// $d = u^ε - v_0$, (1) becomes
//
// $$ α ‖d‖^2 ≤ a^ε(d, d) ≤ L(d) - a_1(v_0, d). $$
//
// On the left stands the square of the size of $d$, on the right its first power. So $d$
// cannot be large, and the solutions are bounded. The middle is bounded then, too, and it
// contains $ε_c^{-1} a_0(u^ε, u^ε)$. So the stiff form of the solutions, without its
// factor, is at most $C ε_c$: it tends to 0.
//
// **2. A weak limit solves (2).** A bounded family has a sequence that converges weakly, as
// chapter 05's sawteeth do; call the limit $w^0$. Three things are known of weak limits. A
// closed convex set keeps them, so $w^0 ∈ K$: such a set is an intersection of half spaces
// $(v, z) ≥ c$, and a weak limit stays in each of them (*Mazur*'s theorem). A product with
// a fixed function converges. And a form that is never negative can lose by a weak limit,
// but not gain. The sawteeth lose all energy of their slopes. To see it for $a_0$, write
//
// $$ 0 ≤ a_0(u^ε - w^0, u^ε - w^0) = a_0(u^ε, u^ε) - 2 a_0(u^ε, w^0) + a_0(w^0, w^0). $$
//
// The middle term tends to $-2 a_0(w^0, w^0)$, so $a_0(w^0, w^0) ≤ \lim a_0(u^ε, u^ε) = 0$:
// the limit is in $G$, and so in $K_0$. Now test (1) with a $w$ of $K_0$, and leave out
// $-ε_c^{-1} a_0(u^ε, u^ε)$ on the left, which is not positive:
//
// $$ a_1(u^ε, w) - a_1(u^ε, u^ε) ≥ L(w - u^ε). $$
//
// All terms but one converge. That one is $a_1(u^ε, u^ε)$. It differs from
// $a_1(u^ε, u^ε) + a_0(u^ε, u^ε)$ by the stiff form, which tends to 0. This sum is never
// negative, so it can only lose in the limit. It stands on the left with a minus sign, so
// the inequality stays true. It is (2), which has one solution (chapter 00). So
// $w^0 = u^0$, whatever sequence was chosen, and the whole family tends to it weakly.
//
// **3. It converges strongly.** Put $v = u^0$ into (1), and use that $a_0(u^0, ·) = 0$:
//
// $$ α ‖u^ε - u^0‖^2 ≤ a^ε(u^ε - u^0, u^ε - u^0) ≤ L(u^ε - u^0) - a_1(u^0, u^ε - u^0) → 0. \tag{5} $$
//
// The right side holds the difference only in products with something fixed, so the weak
// limit is enough. (5) says more than convergence in the norm. Its stiff part is
// $ε^{-2} a_y^-(u^ε, u^ε) = ε^2 ‖p‖^2$, with the norm of $L^2$ in the layer: this tends to
// 0, too.
//
// **How fast?** The theorem does not say. The *symbol* does: push the layer from below with
// the pressure $\sin kπx$, and let $s_k$ be this pressure over the displacement. (Chapter
// 04 computes it.) What follows is an estimate and not a proof: it takes the same contact
// set for both solutions. A layer of thickness ε answers to the wave $\sin kπx$ on $Γ_C$
// like the limit but for a share $∼ (ε k)^2$, and from $k ∼ 1/ε$ on quite differently. How
// much of $u^0$ is in such waves? Where contact ends its pressure jumps, and the waves of a
// jump fall like $k^{-1}$. The pressure is about $s_k$ times the displacement. A rigid
// layer resists like a string, so $s_k$ grows like $k^2$, by the two derivatives of a sine.
// So the waves of the displacement on $Γ_C$ fall like $k^{-3}$. The square of a norm is the
// sum of those of the waves (*Parseval*), and in it wave $k$ counts
// $k^2 (k^{-3})^2 = k^{-4}$. Together
//
// $$ ‖u^ε - u^0‖^2 ∼ ∑_k k^{-4} \min(1, (ε k)^4) ∼ ε^3: $$
//
// up to $k = 1/ε$ each of $1/ε$ waves adds $ε^4$. So the order should be 3/2.

#include "antilock/exact/exact_norms.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using tutorial::Exact;

Table exact_way(const Exact& limit) {  // of the exact solution, no mesh
  Table rows({"epsilon", "distance", "stiff", "stiff / (epsilon |p^0|)^2"});
  for (int k = 0; k <= 8; ++k) {
    const double epsilon = std::pow(10.0, -0.5 * k);
    const ExactSolution u(paper_sine_load(), epsilon, true, 15);
    const double stiff = std::pow(epsilon * stress_norm(u), 2);
    rows.add({epsilon, h1_distance(u, limit.solution), stiff,
              stiff / std::pow(epsilon * stress_norm(limit.solution), 2)});
  }
  return rows;
}

// ## Remark 5: the limit is a string on $Σ$
//
// A function of $K_0$ does not vary across the layer. So it is known as soon as it is known
// on the body: below $Σ$ it goes on with the values that it has on $Σ$, its *trace*. The
// layer has the depth 1, so $a_x^-(u, w) = ∫_Σ u' w'$ for $u$ and $w$ of $K_0$. Integrate
// (2) by parts. In the body $-Δu = f$ is left, on $Σ$
//
// $$ ∫_Σ r (w - u) ≥ 0 \text{ for all } w ≥ 0,   r = ∂_n u - u_{xx}. $$
//
// That is chapter 00 once more, and as there it follows that
//
// $$ -Δu = f \text{ in } Ω^+,   u ≥ 0,   r ≥ 0,   u r = 0 \text{ on } Σ. \tag{25} $$
//
// This is the *Ventcel–Signorini problem*: $u_{xx}$ is a string on $Σ$, $∂_n u$ the body
// that pulls at it, and $r$ the push of the obstacle. So there are three models. (22) has a
// thin layer, (23) the same one stretched, (25) none.
Table on_sigma(const ExactSolution& limit) {
  Table table({"x", "u", "r", "pressure"});
  for (int j = 0; j <= 400; ++j) {
    const double x = j / 400.0, normal = -limit.gradient(x, 0).y();
    table.add({x, limit.value(x, 0), normal - limit.d_xx(x, 0), limit.pressure(x)});
  }
  return table;
}

void judge_ventcel(const Table& sigma, const Exact& limit, int cells,
                   tutorial::Report& report) {
  // Away from the end of contact, where u_xx jumps and its series rings. What the sum of
  // 2^15 waves leaves of u = 0, r = 0 and u r = 0 is 1e-12, 4e-8 and 2e-9: ten times that.
  const double end = limit.contact_from();
  double product = 0, pressure = 0, free = 0;
  for (const Table& point :
       sigma.filter_number("x", [&](double x) { return std::abs(x - end) > 0.005; })
           .rows()) {
    const double u = point.number("u"), r = point.number("r");
    product = std::max(product, std::abs(u * r));
    pressure = std::max(pressure, std::abs(r - point.number("pressure")));
    if (point.number("x") < end) free = std::max(free, std::abs(r));
  }
  report.claim(sigma.min("u") > -1e-11 && sigma.min("r") > -4e-7 && product < 2e-8,
               "(25): u >= {:.0e}, r >= {:.0e} (largest {:.2f}), |u r| <= {:.0e} (proved)",
               sigma.min("u"), sigma.min("r"), sigma.max("r"), product);
  report.claim(
      free < 4e-7 && pressure < 1e-5,
      "(25): |r| <= {:.0e} where u > 0; r is the contact pressure to {:.0e} (proved)", free,
      pressure);
  // In columns a function of K_0h is known by its trace on Sigma, and its layer has the
  // energy of P1's string. So the discrete limit is the discrete (25).
  const double apart = tutorial::against_ventcel(cells);
  report.claim(
      apart < 1e-13,
      "on a mesh: u_h^0 with a layer and the string without one agree to {:.0e} (proved)",
      apart);
}

void limits(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  // ### Forms
  // ### Solve
  const Exact limit(tutorial::paper_scene(0), 15), thick(tutorial::paper_scene(0.1), 15);
  const Table way = exact_way(limit), sigma = on_sigma(limit.solution);
  const Table models = tutorial::three_models(0.1, options.cells);
  // ### Output
  way.print("the exact solution on its way to the limit");
  tutorial::write_limits(options.out, way, sigma, models);

  const Table small =
      way.filter_number("epsilon", [](double epsilon) { return epsilon < 4e-3; });
  report.claim_order(small, "distance", "epsilon", 1.45, 1.65,
                     "Theorem 1 (proved), the order 3/2 (observed)");
  report.claim_within(small.pairwise_orders("distance", "epsilon").back(), 1.48, 1.53,
                      "its last step (observed):");
  // p tends to p^0 like epsilon^(1/2): it jumps on Gamma_C
  report.claim_within(small.last("stiff / (epsilon |p^0|)^2"), 0.98, 1.01,
                      "(5): its stiff part / (epsilon |p^0|)^2:");
  judge_ventcel(sigma, limit, options.cells, report);
  // (22) and (23) are one problem: between them is the mesh, of second order. The thin
  // layer has 2 rows of cells at 1/h = 16 and 3 at 32, and (2/3)^2 = 0.44.
  const double here = tutorial::most_apart(models, "thin", "scaled"),
               coarser = tutorial::most_apart(
                   tutorial::three_models(0.1, options.cells / 2), "thin", "scaled");
  if (options.cells < 32)
    report.not_judged(
        "(22) against (23): the thin layer has two rows of cells, here and at 2 h");
  else
    report.claim(
        here < 0.5 * coarser,
        "(22) and (23) at epsilon = 0.1: {:.1e} apart on Gamma_C, {:.1e} at 2 h (proved)",
        here, coarser);
  double exact = 0;  // |u^0.1 - u^0| on Gamma_C
  for (int i = 1; i < options.cells; ++i) {
    const double x = static_cast<double>(i) / options.cells;
    exact = std::max(exact,
                     std::abs(thick.solution.value(x, -1) - limit.solution.value(x, -1)));
  }
  report.claim_within(tutorial::most_apart(models, "scaled", "limit") / exact, 0.9, 1.1,
                      "(25) is as far from them as u^0 from u^0.1 (proved): times");
}

// ## What came out
// :output: the exact solution
//
// :figure: way
//
// (a) It tends to 0, like $ε^2$, since $p$ has a limit: a finite stress on a slope that
// vanishes does no work. The order of $u^ε - u^0$ tends to 3/2 from above.
//
// (b) A string. The picture shows both factors of (25). Where $u^0 > 0$ nothing pushes;
// where $r > 0$ nothing moves. At the end of contact $r$ jumps, and this is what the order
// 3/2 is made of.
// :figure: ventcel_signorini
//
// (25) is the limit and not the layer: at $ε = 0.1$ (22) and (23) are 1e-4 apart, each on
// its mesh, and (25) is 4.5e-3 from both. Chapter 23 bounds this error by $ε ‖p^0‖$ in the
// norm of the energy.
// :number: 1e-4 = line "(22) and (23) at epsilon = 0.1: {} apart"
// :live: models
//
// What a mesh does to the limit is the subject of
// [Propositions 1 to 3](../11_propositions/11_propositions.cpp).
//
// ## Exercises
//
// 1. Take the obstacle away. Which order has $‖u^ε - u^0‖$ now?
// 2. On paper: $v = 0$ and $v = 2u^ε$ in (23) give $a^ε(u^ε, u^ε) = L(u^ε)$. Which bound on
//    $ε ‖p‖$ follows?
// 3. On paper: derive (25) from (2) by parts.
//
// ## Further reading
//
// - [Brezis 2011](../guides/bibliography.md#brezis-2011): weak limits, and the theorems of
//   Mazur and Stampacchia.
// - [Slimane and Renard 2004](../guides/bibliography.md#slimane-2004): Theorem 1 in the
//   words of the paper, and Remark 5.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "10_limits",
                       "Theorem 1, Proposition 5, Remark 5: the limit epsilon -> 0",
                       {.takes_epsilon = false,
                        .least_cells = 16,
                        .most_cells = 256,
                        .exercises = exercises},
                       limits);
}
