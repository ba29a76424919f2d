// # Families of loads
//
// Run: 17_families_of_loads    h from 1/4 to 1/32, ε from 1 to 1e-20 and 0; some twenty seconds
// Run: 17_families_of_loads --cells 64
// Run: 17_families_of_loads --exercise 1
// Run: 17_families_of_loads --exercise 2
//
// Needs: [07](../07_kernel/07_kernel.cpp) for $G_h$, [10](../10_limits/10_limits.cpp) for
// traces and (25), [13](../13_uniform/13_uniform.cpp) for uniform convergence and the
// locking ratio, [16](../16_degree/16_degree.cpp) for $P_p$.
//
// **The picture.** Errors at ε = 0 under loads $f$ with $∫ f^2 = 1$: left under our load
// $\sin 2πx$, scaled to this size, right under the worst load of this size, below the worst
// that was found with contact. *Follow P3 and P4 on the unstructured mesh from the left
// panel to the right one.* It stands at the end of this page, because it answers (b).
//
// **Predict.** (a) Of all loads of this size, which one loses most where P1 locks: one arch
// $\sin πx$ or many short waves, near $Σ$ or far from it? (b) At ε = 0 the layer of $P_p$
// on an unstructured mesh has $p - 1$ functions left (chapter 16). Are the three of P4
// enough for all loads?
//
// ## The stronger definition
//
// The paper closes with a prospect: "we intend to generalize the result in [3] which have a
// stronger definition of locking". [3] is by Babuška and Suri. For each value of the
// parameter they take a set of solutions, and the largest error over this set. This largest
// error stands in their locking ratio, where chapter 13 has the error of one solution. So
// one bound has to serve a whole family of problems. Here the family is a *ball of loads*:
// all $f$ whose norm $‖f‖ = (∫_{Ω^+} f^2)^{1/2}$ is at most 1. (A ball of solutions is the
// other choice. For an inequality the solutions form no ball, the loads do.) Let $u_f$ and
// $u_{f,h}$ be the exact and the discrete solution under $f$. Errors are measured in the
// energy seminorm of chapter 13, and the worst one is
//
// $$ E_h(ε) = \sup_{‖f‖ ≤ 1} |u_f - u_{f,h}|_{a^ε}. $$
//
// The two words of chapter 13 keep their meaning. A method is *robust* on the ball if
// $\sup_ε E_h(ε)$ tends to 0 with $h$. It is *free of locking* if, moreover,
// $\sup_ε E_h(ε) ≤ C E_h(1)$ with one $C$ for all $h$, that is, if its locking ratio is
// bounded. Its order is that of this supremum: first over ε, then in $h$.
//
// ## Without contact: an eigenvalue
//
// Without an obstacle the solution depends linearly on the load: $u = S f$ and
// $u_h = S_h f$. In a conforming method $a(u - u_h, u_h) = 0$ (put $u_h$ into both
// equations), hence
//
// $$ |u - u_h|_a^2 = a(u, u) - a(u_h, u_h) = (f, (S - S_h) f). $$
//
// So the square of the worst error is the largest eigenvalue of $S - S_h$, and the worst
// load is its eigenfunction.
// *Lanczos iteration* finds both from products with $S - S_h$ alone, each of them one
// solve. Loads are sums of the orthonormal waves $2 \sin kπx \cos μ_m y$,
// $μ_m = (m - ½) π$. A body that is free on $Σ$ answers each wave with a multiple of it,
// and the layer adds one number per $k$, its part $(a/ε) \tanh εa$ of chapter 04's
// stiffness $s_k(ε)$ (`lib/antilock/exact/load_modes.hpp`): $S$ is known in closed form.
//
// So the whole method is one product. Let $c$ be the coefficients of a load, and let the
// matrix $F$ hold the integrals of the waves against the basis functions of $V_h$, so that
// $F c$ is the load vector. With the matrix $A$ of the discrete problem the coefficients of
// $(S - S_h) f$ are
//
// $$ S c - F^T A^{-1} F c, $$
//
// a product with $F$, a solve and a product with $F^T$. `ErrorForm` computes it, and
// `LoadModes` has the waves and $S$. The error under one load is $(c^T (S - S_h) c)^{1/2}$.
//
// The sums end at $k^2 + (m - ½)^2 ≤ W^2$, $W = 2/h$. What do the later waves add? The
// layer only takes away: it holds the body back, so the work $(f, S f)$ of a load is at
// most that of the same load on the free body, where a later wave is divided by more than
// $(πW)^2$. In a conforming method the error is no larger than $u$ itself, by the formula
// above. Hence a load of later waves has an error of at most $1/(πW)$, and with $E_W$ for
// the waves up to $W$ alone $E_h^2 ≤ E_W^2 + (πW)^{-2}$. The run prints both. (For
// Crouzeix–Raviart $a_h(u, v_h) = a_h(I_h u, v_h)$, by chapter 08's means of gradients. As
// $I_h u$ is a discrete function, $a_h(u, u_h) = (f, I_h u)$. So the square of the error is
// $(f, S f) - 2 (f, I_h S f) + (f, S_h f)$, a quadratic form of $f$ again, and its largest
// value is an eigenvalue. What the later waves add to it is not proved.)
//
// ## How much a space of this size must lose
//
// Kolmogorov asked in 1936 how well the best space of dimension $d$ approximates a set:
// the *width* of the set. The kernel $G_h$ is a space of dimension $d$ on the layer, so a
// width bounds what it must lose.
//
// **Theorem (proved).** *Let the method be conforming, and let $G_h$ have the dimension $d$
// on the layer. Then*
//
// $$ E_h(0) ≥ ℓ_{d+1},   ℓ_k = |ψ_k| / (a \coth a + a^2)^{1/2},   a = kπ,   ψ_k = \sinh(a(1 - y))/\sinh a. $$
//
// Proof ($|ψ_k|$ is the $L^2$ norm on $(0, 1)$): let $e_k$ be $ψ_k \sin kπx$ in the body
// and $\sin kπx$ in the layer. It is harmonic in the body. So for every $v$ with
// $∂_y v = 0$ in the layer $a(e_k, v)$ asks for the trace of $v$ on $Σ$ only: it is
// $(a \coth a + a^2) ∫_Σ v \sin kπx$.
//
// The traces of $G_h$ have dimension $d$, so "$a(z, v_h) = 0$ for all $v_h ∈ G_h$" is $d$
// conditions. Some combination $z ≠ 0$ of the $d + 1$ functions $e_1, ..., e_{d+1}$ fulfils
// them: the method cannot see it. Load the body with $f = z/‖z‖$. By Cauchy and Schwarz,
// and because $a(u_h, z) = 0$,
//
// $$ |u - u_h|_a ≥ a(u - u_h, z)/|z|_a = (f, z)/|z|_a = ‖z‖/|z|_a ≥ \min_{k ≤ d+1} ‖e_k‖/|e_k|_a = ℓ_{d+1}, $$
//
// since the $e_k$ are orthogonal in both norms and $ℓ_k$ falls with $k$. For $P_p$ on
// unstructured meshes $d = p - 1$ however fine the mesh is. So every degree locks for the
// ball (proved).
//
// **The sharp limit.** Let $d$ stay and let the body be resolved exactly. Then what is lost
// is precisely the largest $‖z‖/|z|_a$ of all combinations $z$ of $e_1, e_2, ...$ that
// fulfil the $d$ conditions. The traces are $x (1 - x)$ times polynomials of degree
// $p - 2$. This is an eigenvalue problem for the coefficients of $z$ (`loss_of_degree` in
// `lib/antilock/analysis/worst_load.hpp`). Discrete bodies lose more, so $E_h(0)$ is never
// below it (proved).
//
// **The width of the ball (proved).** The same proof with $z$ a combination of $n + 1$
// sines $\sin kπx \sin mπy$, $n$ the number of unknowns of the body, bounds a conforming
// method where nothing locks: $E_h ≥ 1/(π (k^2 + m^2)^{1/2})$, for the last of the first
// $n + 1$ of them. No space of as many unknowns can do better.
//
// **With contact** twice the load still gives twice the error, since $K$ is a cone. For P1
// that locks completely ($u_h = 0$ on the layer) chapter 00's expansion of $J$, with
// $v = u_h$ and $t = 1$, says $½ |u - u_h|_a^2 ≤ J(u_h) - J(u)$. Without an obstacle $=$
// stands there. The obstacle raises $J(u)$, since fewer displacements are allowed, and does
// not change $u_h$, which is 0 on $Γ_C$ anyway. So the supremum is no larger than without
// it. And it is no smaller than the loss under one load that lifts the whole layer,
// $2 \sin πx \cos(πy/2)$ (proved, both). For the other methods the error is no quadratic
// form of the load, and the run *climbs*. A load has four coefficients here, those of
// $\sin kπx$ with $k ≤ 4$ and this profile. Differences say in which direction of these
// four numbers the error grows most. The run goes a step that way, doubles the next step if
// the error grew, and halves it if not (projected gradient ascent, `ascend`). It ends at
// the error under one load, so this is a *lower bound* of the supremum.

#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;

const std::vector<Method> all_methods{{&p1(), structured()},
                                      {&p1(), unstructured()},
                                      {&p1(), mesh_family("layered")},
                                      {&crouzeix_raviart(), unstructured()},
                                      {&p2(), unstructured()}};
constexpr const char *one_load = "our load", *ball = "worst load of the ball",
                     *arches = "p arches, no contact", *contact = "contact, at least";

// One method on one mesh: forms of the error, for all ε.
struct Ball {
  // ### Mesh
  Space space;
  // ### Forms
  ErrorForm form;
  Ball(const Method& method, int cells)
      : space(method.space(cells)), form(space, LoadModes(2 * cells)) {}
  // ### Solve
  WorstLoad worst(double epsilon) { return form.set_epsilon(epsilon), form.worst(); }
  double ours(double epsilon, int wave = 2) {  // the load 10 sin 2πx, scaled to norm 1
    form.set_epsilon(epsilon);
    return form.error(form.modes().constant_in_y(wave, std::sqrt(2.0)));
  }
};

// The claims of one method. Proved: what follows from the theorems above, with `all_waves`
// for the waves beyond W.
void judge(const Method& method, const Table& own, tutorial::Report& report) {
  const std::string name = method.name();
  const int p = method.element->degree();
  const Table rigid = own.filter("epsilon", 0), worst = rigid.filter("load", ball),
              climbs = own.filter("load", contact);
  const double last = worst.last("error"), limit = loss_of_degree(p);
  if (p < 3)  // both from Lanczos iterations to 1e-4
    report.claim(
        std::abs(own.filter("load", ball).filter("epsilon", 1e-20).last("error") / last -
                 1) < 1e-3,
        "{}: epsilon = 1e-20 is epsilon = 0 (observed)", name);
  if (method.element->conforming() && method.family.name == "unstructured") {  // it locks
    report.claim(worst.min("all_waves") >= limit && std::abs(last / limit - 1) < 0.01,
                 "{} loses {:.4f} on the ball: with all waves no less than {:.4f} "
                 "(proved), to 1 % that (observed)",
                 name, last, limit);
    const double ours = rigid.filter("load", one_load).last("error");
    if (p > 2)
      return report.claim(ours < 0.4 * limit, "{} looks free of locking: {:.4f} (observed)",
                          name, ours);
    report.claim_orders(own.filter("load", ball).filter("epsilon", 1), "error", 0.8, 1.1,
                        name + " at epsilon = 1");
    // one arch is the worst of these loads; two arches press down, too, and what touches is
    // not lost
    return report.claim_within(
        climbs.last("error") / rigid.filter("load", arches).number("error"),
        p == 1 ? 0.99 : 0.9, p == 1 ? 1.01 : 1,
        fmt::format("{}: contact over no contact (observed)", name));
  }
  const Table suprema =
      tutorial::suprema_over_epsilon(own.filter("load", ball));  // then the order in h
  report.claim(suprema.max("ratio") < 1.02, "{}: locking ratio {:.4f} (observed)", name,
               suprema.max("ratio"));
  const Table denser = own.filter("load", "worst load of the ball, between");
  report.claim(denser.max("error") <
                   1.001 * suprema.filter("h", denser.first("h")).number("supremum"),
               "{}: twice as many epsilons leave the supremum as it is (observed)", name);
  report.claim_orders(suprema, "supremum", 0.85, 1.1, name + " on the ball");
  report.claim_orders(climbs, "error", 0.85, 1.1, name + " with contact, climbed");
  const double least = suprema.min("over_width"), most = suprema.max("over_width");
  report.claim(
      least >= 1 && most <= (method.element->conforming() ? 2 : 2.5),
      "{}: {:.2f} to {:.2f} times the width of its unknowns ({}; at most: observed)", name,
      least, most, method.element->conforming() ? "not below 1: proved" : "nonconforming");
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  Table results({"load", "method", "h", "epsilon", "error", "all_waves", "over_width"});
  std::vector<Method> methods = all_methods;
  for (const Element* element : {&p3(), &p4()})
    methods.push_back({element, unstructured()});
  for (const Method& method : methods) {
    const int p = method.element->degree(),
              finest = p > 2 ? options.cells / 4 : options.cells;
    for (int n = options.cells / 8; n <= finest; n *= 2) {
      Ball on(method, n);
      const auto add = [&](const char* load, double epsilon, double error) {
        results.add({load, method.name(), 1.0 / n, epsilon, error,
                     std::hypot(error, on.form.modes().beyond()),
                     error / kolmogorov_width(tutorial::unknowns_of_body(on.space))});
      };
      for (const double epsilon : p > 2 ? std::vector<double>{0}
                                        : std::vector{1.0, 1e-1, 1e-2, 1e-4, 1e-20, 0.0}) {
        add(one_load, epsilon, on.ours(epsilon));
        add(ball, epsilon, on.worst(epsilon).error);
      }
      if (n != finest / 2) continue;  // twice as many ε: the supremum must not change
      for (const double epsilon : {0.3, 0.03, 1e-3, 1e-6}) {
        add("worst load of the ball, between", epsilon, on.worst(epsilon).error);
        add("our load, between", epsilon, on.ours(epsilon));  // for the picture
      }
      tutorial::draw_load(options.out, method, on.form.modes(), on.worst(0).load);
      if (p > 2) continue;  // with contact: a climb over four waves
      add(arches, 0, on.form.error(on.form.modes().wave(p, 1)));  // 2 sin pπx cos(πy/2)
      for (int coarse = options.cells / 8; coarse <= n; coarse *= 2)
        results.add({contact, method.name(), 1.0 / coarse, 0,
                     tutorial::climb_in_contact(method, coarse), 0, 0});
    }
  }
  // ### Output
  tutorial::show_worst_errors(options.out, results, 2.0 / options.cells);
  for (const Method& method : methods)
    judge(method, results.filter("method", method.name()), report);
}

// ## What came out
//
// :figure: families_of_loads
// :output: worst load of the ball, epsilon = 0
//
// P1 in columns and Crouzeix–Raviart halve their worst error with $h$. P1 on the
// unstructured mesh comes down to $ℓ_1$ and stays, P2 to $ℓ_2$. **P3 and P4 look free of
// locking under our load**, where at 1/h = 8 their errors are below those of structured P1
// at 1/h = 32. On the ball they stop at their sharp limits. One load tests one trace: the
// kernel of P3 holds $x (1 - x) (1 - 2x)$, which is much like $\sin 2πx$. (P4 has 0.0178 at
// 1/h = 4 and 0.0180 at 1/8: the ball of the coarser mesh has a quarter as many waves.) P1
// layered is within a third of the width: of all spaces of as many unknowns none could have
// less than three quarters of its worst error.
// :number: 0.0178 = table "worst load of the ball" 0.25 "method=P4 unstructured"
// :number: 0.0180 = table "worst load of the ball" 0.125 "method=P4 unstructured"
//
// (a) One arch, largest at $Σ$: $ψ_1 \sin πx$. Our load costs P1 about a fifth of what this
// one costs, 0.0247 over 0.1097 on 1/h = 32 (0.214 of it where the body is resolved
// exactly). (b) No: three functions cannot fit four waves.
// :number: 0.0247 = table "our load, epsilon = 0" 0.03125 "method=P1 unstructured"
// :number: 0.1097 = table "worst load of the ball" 0.03125 "method=P1 unstructured"
// :figure: worst_loads
//
// Where nothing locks, the worst load sits on the body's worst triangles. Where a method
// locks, it is largest at $Σ$, and along $x$ it is near the first wave that the kernel does
// not hold.
// :figure: families_by_epsilon
//
// **With contact** the climb finds nothing worse for P1 than one arch, which lifts the
// whole layer: no point touches. P2 loses less than under two arches without contact: where
// the load presses down, the layer does not move at all.
//
// ## Exercises
//
// 1. The load $\sin πx$ at ε = 0: does P2 on the unstructured mesh look free of locking?
// And on the ball?
// 2. Take fewer waves into the ball. Does the worst error of locked P1 fall? That of
//    structured P1?
// 3. On paper: let a load act on the thin layer of (22), too. How does its work depend on
//    ε?
// 4. On paper: without contact, how large can the $L^2(Ω^+)$ error of a conforming method
//    be on the ball?
//
// ## Further reading
//
// - [Babuška and Suri 1992](../guides/bibliography.md#babuska-1992): the definition over a
//   set of solutions.
// - [Babuška and Suri 1992b](../guides/bibliography.md#babuska-1992b): the same for nearly
//   incompressible materials.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "17_families_of_loads",
                       "the worst load of a ball: a stronger definition of locking",
                       {.takes_epsilon = false,
                        .cells = 32,
                        .least_cells = 32,
                        .most_cells = 64,
                        .exercises = exercises},
                       study);
}
