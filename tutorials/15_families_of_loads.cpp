// # Families of loads
//
// Run: 15_families_of_loads    h from 1/6 to 1/24, ε from 1 to 1e-20 and 0; some eight seconds
// Run: 15_families_of_loads --cells 32
// Run: 15_families_of_loads --exercise 1
// Run: 15_families_of_loads --exercise 2
//
// Needs: [07](07_kernel.cpp) for $G_h$, [12](12_uniform.cpp) for uniform convergence, [14](14_degree.cpp) for $P_p$.
//
// **The picture.** Errors at ε = 0, per unit of load: under our one load (left), under the worst load of all (right).
// *Left, P3 and P4 on the unstructured mesh look better than P1 on the structured one. Right, they lock as P1 does:
// no error falls below a number that $\dim G_h$ sets.*
//
// **Predict.** (a) Of all loads on the body with $∫ f^2 = 1$, which one loses most when P1 locks: a single arch or
// short waves, near $Σ$ or far from it? (b) On $P_p$'s unstructured mesh the layer has $p - 1$ functions that cost
// nothing. Are three of them (P4) enough for all loads?
//
// ## The stronger definition
//
// The paper closes with a prospect: "we intend to generalize the result in [3] which have a stronger definition of
// locking". Babuška and Suri ([3]) ask for one bound for a *ball* of loads. Ours is $|f|_{L^2(Ω^+)} ≤ 1$: loads on
// the body, as in (23). (A load on the thin layer of (22) does work $O(\sqrt ε)$ per unit of its norm: exercise 3.)
// Errors are measured in the energy seminorm of $a^ε$ (Remark 4). It bounds the norm of Theorem 4 uniformly in ε, and
// at ε = 0, where $∂_y (u - u_h) = 0$ in the layer, it is the broken $H^1$ seminorm. So
//
// $$ E_h(ε) = \sup_{|f| ≤ 1} |u_f - u_{f,h}|_{a^ε}, $$
//
// *free of locking:* $\sup_ε E_h(ε) ≤ C E_h(1)$; *robust:* it tends to 0, with the order in $h$ that $E_h(1)$ has.
//
// ## Without contact: an eigenvalue
//
// Let $u = S f$ and $u_h = S_h f$. In a conforming method $a(u - u_h, u_h) = 0$, hence
//
// $$ |u - u_h|_a^2 = a(u, u) - a(u_h, u_h) = (f, (S - S_h) f): $$
//
// $E_h^2$ is the largest eigenvalue of $S - S_h$, its eigenfunction the worst load. Lanczos iteration finds both: it
// needs nothing but products. $2 \sin kπx \cos μ_m y$, $μ_m = (m - 1/2) π$, are an orthonormal basis of the loads, and
// $S$ is known in it: for each $k$ a diagonal less a product of two vectors (`exact/load_modes.cpp`). Waves beyond
// $W = 2/h$ are left out. In a conforming method $|u - u_h|_a ≤ |u|_a$, so by Cauchy and Schwarz they add at most
// $1/(πW)^2$ to $E_h^2$. Crouzeix–Raviart is not conforming: there $a_h(u, v_h) = a_h(I_h u, v_h)$ gives
// $|u - u_h|^2 = (f, S f) + (f, u_h) - 2 (f, I_h u)$, and no bound of what those waves add is proved.
//
// ## How much a kernel must lose
//
// At ε = 0 the layer of $u$ carries a trace on $Σ$. The load acts on wave $k$ of it through
// $ψ_k = \sinh(a(1 - y))/\sinh a$, $a = kπ$, against the stiffness $a \coth a + a^2$. So wave $k$ alone is worth
//
// $$ ℓ_k = \frac{|ψ_k|}{\sqrt{a \coth a + a^2}} ≈ \frac{1}{\sqrt{2 a (a + a^2)}}, \quad ℓ_1 = 0.1094, ℓ_2 = 0.0417, $$
//
// with $|ψ_k|^2 = (\coth a - a / \sinh^2 a) / 2a$, for the load $ψ_k \sin kπx$ scaled to norm 1. If $G_h$ has dimension
// $d$ on the layer, one combination of the first $d + 1$ waves is orthogonal to it, and all of that is lost:
// **$E_h(0) ≥ ℓ_{d+1}$ on every mesh**, however fine the body. For $P_p$ on an unstructured mesh $d = p - 1$: every
// degree locks for the ball, at $ℓ_p$.
//
// **With contact** the error is still homogeneous, since $K$ is a cone. What locks completely ($u_h = 0$ on the layer)
// has $|u - u_h|^2 / 2 ≤ J(u_h) - J(u)$, and without an obstacle $J(u)$ is smaller: contact makes the supremum no
// larger. $ψ_1 \sin πx$ lifts the layer everywhere, so it is $ℓ_1$ again. For the others no theorem is at hand; the run
// climbs over loads of four waves, which gives a *lower bound* of the supremum.

#include "antilock/mesh/layered.hpp"
#include "common/load_ascent.hpp"
#include "common/study.hpp"
#include "common/worst_loads_output.hpp"

using namespace antilock;
using std::numbers::pi;

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
  WorstLoad worst(double epsilon) {
    form.set_epsilon(epsilon);
    return form.worst();
  }
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
  // With contact: ascent over the loads $\sum_{k ≤ 4} c_k 2 \sin kπx \cos(πy/2)$, from one arch and from two.
  for (const Method& method : all_methods)
    for (const int n : {options.cells / 4, options.cells / 2}) {
      tutorial::ErrorUnderContact error(method, n, 0);
      const double found = tutorial::ascend(std::ref(error), {Eigen::Vector4d::Unit(0), Eigen::Vector4d(1, 1, 0, 0)});
      results.add({tutorial::contact, method.name(), 1.0 / n, 0, found});
    }
  // ### Output
  const Table halves = tutorial::half_of_the_loss(options.cells);  // the ε at which half of the loss has come
  tutorial::judge_worst_loads(options, results, all_methods, halves, report);
}

// ## What came out
//
// On the ball, as $h$ goes from 1/6 to 1/24 at ε = 0: P1 structured 0.069, 0.036, 0.019; layered 0.050, 0.025, 0.013;
// Crouzeix–Raviart 0.048, 0.025, 0.012, all of order 0.93 to 1.00, with locking ratios of at most 1.01. P1 unstructured
// stays above $ℓ_1$: 0.117, 0.111, 0.110; P2 above $ℓ_2$: 0.0427, 0.0418, 0.0417. Half of that has come at
// $ε ∼ h^{1.44}$ and $h^{2.39}$. **P3 and P4 look robust under our load and are not for the ball:** at 1/h = 8 their
// errors, 0.0063 and 0.0062, are half of that of structured P1 at 1/h = 24 and 5 % of $|u|_a$. The ball has 0.0257 and
// 0.0180, above $ℓ_3 = 0.0232$ and $ℓ_4 = 0.0153$. One load sees only whether $G_h$ contains something near its own
// trace: that of P3 holds a cubic much like $\sin 2πx$, and nothing like $\sin 3πx$.
//
// (a) One arch, largest at $Σ$: our load loses a quarter of what $ψ_1 \sin πx$ loses. (b) No. Where nothing locks, the
// worst load sits on the worst triangles of the body, far from the layer: the same place for P1 on the layered mesh and
// for Crouzeix–Raviart, which share the body. P2 gains no order there, since $f ∈ L^2$ gives $u$ no third derivatives.
//
// With contact the climb finds the free worst error for locked P1 (0.102 with this profile in $y$), and order 0.90 to
// 0.98 for the robust methods. It stays below the worst of the whole ball without contact; over the same four waves
// contact adds up to 6 % (a longer climb found 9 %). *Price:* the dense matrix of the loads takes some 30 MB and 0.2 s
// per mesh at 1/h = 24, a worst load 20 to 60 solves.
//
// ## Exercises
//
// Predict first. `--exercise N` prints the prediction and its outcome; the answers are in `answers/`.
//
// 1. The load $\sin πx$ at ε = 0: does P2 on the unstructured mesh look robust? And on the ball?
// 2. Take fewer waves into the ball. Does the worst error of locked P1 fall? That of structured P1?
// 3. On paper: a load $g$ on the thin layer of (22). Show that its work is at most $\sqrt ε ‖g‖ ‖v‖$ in the stretched
//    layer. Does the ball of loads on all of $Ω$ lock otherwise?
// 4. On paper: show that a conforming method's largest $L^2(Ω^+)$ error on the ball is $E_h^2$.

#include "answers/15_families_of_loads.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "15_families_of_loads", "the worst load of a ball: locking in the sense of [3]",
      {.takes_epsilon = false, .cells = 24, .least_cells = 16, .most_cells = 48, .exercises = exercises}, study);
}
