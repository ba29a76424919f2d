// # Families of loads
//
// Run: 15_families_of_loads    h from 1/6 to 1/24, ε from 1 to 1e-20 and 0; some eight seconds
// Run: 15_families_of_loads --cells 32
// Run: 15_families_of_loads --exercise 1
// Run: 15_families_of_loads --exercise 2
//
// Needs: [07](07_kernel.cpp) for $G_h$, [10](10_limits.cpp) for traces and (25), [12](12_uniform.cpp) for uniform
// convergence and the locking ratio, [14](14_degree.cpp) for $P_p$.
//
// **The picture.** Errors at ε = 0 under loads $f$ with $∫ f^2 = 1$: under our load $\sin 2πx$, scaled to this size
// (left), and under the worst load of this size (right). *Left, P3 and P4 on the unstructured mesh look better than P1
// on the structured one. Right, they lock as P1 does: no error falls below a number that $\dim G_h$ sets.*
//
// **Predict.** (a) Of all loads of this size, which one loses most where P1 locks: one arch $\sin πx$ or many short
// waves, near $Σ$ or far from it? (b) At ε = 0 the layer of $P_p$ on an unstructured mesh has $p - 1$ functions left
// (chapter 14). Are the three of P4 enough for all loads?
//
// ## The stronger definition
//
// The paper closes with a prospect: "we intend to generalize the result in [3] which have a stronger definition of
// locking". [3] is by Babuška and Suri. It asks for one bound for a whole *ball of loads*, here all $f$ with
// $‖f‖ = (∫_{Ω^+} f^2)^{1/2} ≤ 1$. Let $u_f$ and $u_{f,h}$ be the exact and the discrete solution under $f$. Errors
// are measured in the energy seminorm of chapter 12. It is at least $α^{1/2}$ times the norm of Theorem 4 for every
// $ε ≤ 1$. At ε = 0, where neither $u_f$ nor $u_{f,h}$ varies across the layer, it is the norm of the gradient. The
// worst error is
//
// $$ E_h(ε) = \sup_{‖f‖ ≤ 1} |u_f - u_{f,h}|_{a^ε}. $$
//
// A method is *free of locking* if $\sup_ε E_h(ε) ≤ C E_h(1)$ with one $C$ for all $h$: the locking ratio stays
// bounded. It is *robust* if $\sup_ε E_h(ε) → 0$ as $h → 0$.
//
// ## Without contact: an eigenvalue
//
// Without an obstacle $u = S f$ and $u_h = S_h f$ with linear maps $S$, $S_h$. In a conforming method
// $a(u - u_h, u_h) = 0$ (put $u_h$ into both equations), hence
//
// $$ |u - u_h|_a^2 = a(u, u) - a(u_h, u_h) = (f, (S - S_h) f). $$
//
// So $E_h^2$ is the largest eigenvalue of $S - S_h$, and the worst load is its eigenfunction. *Lanczos iteration* finds
// both from products with $S - S_h$ alone, each of them one solve. Loads are sums of the orthonormal waves
// $2 \sin kπx \cos μ_m y$, $μ_m = (m - ½) π$. A body that is free on $Σ$ answers each wave with a multiple of it; the
// layer adds one number per $k$ (`exact/load_modes.cpp`). So $S$ is known in closed form. The sums end at
// $k^2 + (m - ½)^2 ≤ W^2$, $W = 2/h$. For a load of later waves $|u|_a^2 = (f, S f) ≤ ‖f‖^2/(πW)^2$. In a conforming
// method $|u - u_h|_a ≤ |u|_a$, so these waves add at most $1/(πW)^2$ to $E_h^2$. (For Crouzeix–Raviart chapter 08's
// $a_h(u, v_h) = a_h(I_h u, v_h)$ gives an eigenvalue too; what the later waves add to it is not proved.)
//
// ## How much a kernel must lose
//
// *Let the method be conforming, and let $G_h$ have the dimension $d$ on the layer. Then $E_h(0) ≥ ℓ_{d+1}$,* where
//
// $$ ℓ_k = |ψ_k| / (a \coth a + a^2)^{1/2}:   ℓ_1 = 0.1094, ℓ_2 = 0.0417, ℓ_3 = 0.0232, ℓ_4 = 0.0153, $$
//
// $a = kπ$, $ψ_k = \sinh(a(1 - y))/\sinh a$, $|ψ_k|^2 = ∫_0^1 ψ_k^2 = (\coth a - a / \sinh^2 a) / 2a$. Proof: let $e_k$
// be $ψ_k \sin kπx$ in the body and $\sin kπx$ in the layer. In the body it is harmonic, so $a(e_k, v)$ for
// $∂_y v = 0$ in the layer is $(a \coth a + a^2) ∫_Σ v \sin kπx$: it asks for the trace of $v$ only. So $d$ conditions
// say that $a(z, v_h) = 0$ for all $v_h ∈ G_h$, and a combination $z ≠ 0$ of $e_1, ..., e_{d+1}$ fulfils them. Load the
// body with $f = z/‖z‖$. By Cauchy and Schwarz
//
// $$ |u - u_h|_a ≥ a(u - u_h, z)/|z|_a = (f, z)/|z|_a = ‖z‖/|z|_a ≥ \min_{k ≤ d+1} ‖e_k‖/|e_k|_a = ℓ_{d+1}, $$
//
// since the $e_k$ are orthogonal in both norms and $ℓ_k$ falls with $k$. For $P_p$ on unstructured meshes $d = p - 1$,
// however fine the mesh is: every degree locks for the ball, at $ℓ_p$.
//
// **With contact** twice the load still gives twice the error, since $K$ is a cone. For P1 that locks completely
// ($u_h = 0$ on the layer) chapter 00 with $t = 1$ says $½ |u - u_h|_a^2 ≤ J(u_h) - J(u)$, and $=$ without an obstacle.
// The obstacle raises $J(u)$ and leaves $u_h$: the supremum is no larger than without it. It is at least $ℓ_1$, since
// $ψ_1 \sin πx$ lifts the whole layer. For the other methods the run climbs over loads of four waves: a *lower bound*.

#include "antilock/mesh/layered.hpp"
#include "common/load_ascent.hpp"
#include "common/study.hpp"
#include "common/worst_loads_output.hpp"

using namespace antilock;

const MeshFamily layered{"layered", [](int n) { return layered_mesh(n); }};
const std::vector<Method> all_methods{{&p1(), structured()},
                                      {&p1(), unstructured()},
                                      {&p1(), layered},
                                      {&crouzeix_raviart(), unstructured()},
                                      {&p2(), unstructured()}};

// One method on one mesh: forms of the error, for all ε.
struct Ball {
  // ### Mesh
  Discretisation on;
  // ### Forms
  ErrorForm form;
  Ball(const Method& method, int cells) : on(method.on(cells)), form(on.space(), LoadModes(2 * cells)) {}
  // ### Solve
  WorstLoad worst(double epsilon) { return form.set_epsilon(epsilon), form.worst(); }
  double ours(double epsilon, int wave = 2) {  // the load 10 sin 2πx, scaled to norm 1
    form.set_epsilon(epsilon);
    return form.error(form.modes().constant_in_y(wave, std::sqrt(2.0)));
  }
};

void study(const tutorial::Options& options, tutorial::Report& report) {
  Table results(tutorial::worst_load_columns);
  for (const Method& method : all_methods)
    for (int n = options.cells / 4; n <= options.cells; n *= 2) {
      Ball on(method, n);
      for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-20, 0.0}) {
        if (n == options.cells && epsilon < 1 && epsilon > 0) continue;
        results.add({tutorial::one_load, method.name(), 1.0 / n, epsilon, on.ours(epsilon)});
        results.add({tutorial::ball, method.name(), 1.0 / n, epsilon, on.worst(epsilon).error});
      }
      if (n == options.cells / 2) tutorial::draw_worst(options.out, method, on.form.modes(), on.worst(0).load, report);
    }
  for (const Method& method : {Method{&p3(), unstructured()}, Method{&p4(), unstructured()}})
    for (const int n : {4, 8}) {
      Ball on(method, n);
      results.add({tutorial::ball, method.name(), 1.0 / n, 0, on.worst(0).error});
      results.add({tutorial::one_load, method.name(), 1.0 / n, 0, on.ours(0)});
    }
  for (const Method& method : all_methods)  // with contact: a climb over four waves in x
    for (const int n : {options.cells / 4, options.cells / 2})
      results.add({tutorial::contact, method.name(), 1.0 / n, 0, tutorial::worst_found_in_contact(method, n, 0)});
  // ### Output
  const Table halves = tutorial::half_of_the_loss(options.cells);  // the ε at which half of the loss has come
  tutorial::judge_worst_loads(options, results, all_methods, halves, report);
}

// ## What came out
//
// Worst errors of the ball at ε = 0 for 1/h = 6, 12, 24: P1 structured 0.069, 0.036, 0.019, P1 layered 0.050, 0.025,
// 0.013, Crouzeix–Raviart 0.048, 0.025, 0.012. Their orders are 0.93 to 1.00, their locking ratios at most 1.002. P1
// unstructured stays above $ℓ_1$: 0.117, 0.111, 0.110. P2 stays above $ℓ_2$: 0.0427, 0.0418, 0.0417. As ε falls, half
// of the square of this loss has come at $ε ∼ h^{1.44}$ (P1) and $h^{2.39}$ (P2). **P3 and P4 look robust under our
// load:** their errors at 1/h = 8, 0.0063 and 0.0062, are half of that of structured P1 at 1/h = 24. On the ball they
// have 0.0257 and 0.0180, above $ℓ_3$ and $ℓ_4$. One load tests one trace: the kernel of P3 holds $x (1 - x) (1 - 2x)$,
// much like $\sin 2πx$. (a) One arch, largest at $Σ$: $ψ_1 \sin πx$. Under our load P1 loses a quarter of that, 0.026
// of 0.110. (b) No. With contact the climb finds 0.102 for locked P1 (its waves, all like $\cos(πy/2)$ in $y$, do not
// make up $ψ_1$), and orders 0.90 to 0.98 where nothing locks.
//
// ## Exercises
//
// 1. The load $\sin πx$ at ε = 0: does P2 on the unstructured mesh look robust? And on the ball?
// 2. Take fewer waves into the ball. Does the worst error of locked P1 fall? That of structured P1?
// 3. On paper: the work $∫ g v$ of a load $g$ on (22)'s thin layer is at most $\sqrt ε ‖g‖ ‖v‖$, $v$ stretched.
// 4. On paper: a conforming method's largest $L^2(Ω^+)$ error on the ball is $E_h^2$. (What is the norm of $S - S_h$?)

#include "answers/15_families_of_loads.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "15_families_of_loads", "the worst load of a ball: locking in the sense of [3]",
      {.takes_epsilon = false, .cells = 24, .least_cells = 16, .most_cells = 48, .exercises = exercises}, study);
}
