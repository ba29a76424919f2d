// # Rubber that rubs
//
// Run: 30_friction                          ε = 1/λ = 1e-8, 32 cells, four discretisations; λ from 1 to infinity
// Run: 30_friction --epsilon 0 --cells 16   incompressible
// Run: 30_friction --exercise 1
// Run: 30_friction --exercise 2
//
// Needs: [00](../00_string_on_an_obstacle/00_string_on_an_obstacle.cpp) for the inequality
// and the active set, [26](../26_elasticity/26_elasticity.cpp) for the block and its
// elements, [28](../28_mixed/28_mixed.cpp) for Theorem 4 with friction. **Here ε is the
// parameter of the class (1) itself**, $ε = 1/λ$.
//
// **The picture.** The block of chapter 26 is pressed on its obstacle, and the obstacle
// rubs (λ = 1e8). *Left: the tangential force $T$ of the floor stays between $-g$ and $g$.
// Right: where $|T| < g$ the rubber sticks, elsewhere it slips. P1 on parallel triangles
// shears along its diagonals only: its whole contact zone slides to the right.*
//
// **Predict.** (a) At λ = 1e8 the pressed block slips outwards on both sides, as the
// picture shows. In which direction does the floor pull its left half at λ = 1? (b) At
// which λ does it stick on the longest piece?
//
// ## From the energy to stick and slip
//
// A floor with *Tresca's friction* resists sliding with a force per length of at most
// $g(x)$, which is given. To slide by $u_x$ against it takes the work $g |u_x|$ per length.
// So the block minimises
//
// $$ J(v) = ½ a(v, v) + j(v),   j(v) = ∫_{Γ_C} g |v_x|,   K = \{ v = (0, -0.1) \text{ on top}, v_y ≥ -\text{gap} \}, $$
//
// where $a$ is chapter 26's form with $λ$. $j$ is convex and has a corner at 0. Compare
// $J(u)$ with $J(u + t (v - u))$ as in chapter 00. Convexity gives
// $j(u + t(v - u)) ≤ (1 - t) j(u) + t j(v)$. Divide by $t$ and let $t → 0$:
//
// $$ u ∈ K:   a(u, v - u) + j(v) - j(u) ≥ 0   \text{ for all } v ∈ K. $$
//
// Let $N$ and $T$ be the forces per length of the floor on the block, upwards and to the
// right: $a(u, v) = ∫_{Γ_C} N v_y + T v_x$ for all $v$ that are 0 on top. Change $u_x$
// alone, near one point. There $T (s - u_x) + g |s| - g |u_x| ≥ 0$ for every number $s$.
// With $s = 0$ and $s = 2 u_x$ this says $T u_x = -g |u_x|$. What is left,
// $T s + g |s| ≥ 0$, says $|T| ≤ g$. So there are three cases:
//
// $$ \text{stick: } u_x = 0, |T| ≤ g;   \text{slip right: } u_x ≥ 0, T = -g;   \text{slip left: } u_x ≤ 0, T = g. $$
//
// Contact has a bound on the displacement and a sign of the force. Friction has two bounds
// on the force and a sign of the displacement. In the library it is the bound
// $lower = upper = 0$ on $u_x$, which gives way to a force beyond `force_limit`,
// $g_i = ∫ g φ_i$ for unknown $i$. Two solvers of the library take it:
//
// - *Active set*: guess the case of every unknown. Where it sticks $u_i = 0$ is known and
//   $T_i$ is found; where it slips $T_i = ±g_i$ is known and $u_i$ is found. An unknown
//   that violates its case changes it.
// - *Uzawa* ([chapter 34](../34_solving_the_inequality/34_solving_the_inequality.cpp)):
//   $T ←$ the nearest number to $T - ρ u_x$ in $[-g, g]$, in place of the projection onto
//   $λ ≥ 0$.
//
// ## What is discretised, and what is proved
//
// With one $g_i$ per unknown, $j$ is replaced by $j_h(v) = \sum g_i |v_i|$: the integral of
// $g$ times the interpolant of $|v_x|$ at vertices (P1) or midpoints (CR), this page's one
// new discretisation. For P1 $j_h ≥ j$: the interpolant of a convex function lies above it.
// On an edge they differ where $v_x$ changes its sign, by at most $h|v_x'|$. So on P1
// functions
//
// $$ j_h(v) - j(v) ≤ h ∫ g |v_x'| ≤ C h^{1/2} ‖v‖_1. $$
//
// (An edge's slope is that of its triangle, whose area is $∼ h^2$.) It vanishes with $h$ on
// bounded $v_h$. For CR the value at a midpoint is the edge's mean: the same bound.
//
// *Does $j$ converge?* Traces on $Γ_C$ converge strongly
// where functions of $H^1$ converge weakly (they are compact). CR's functions jump. Compare
// such a $v_h$ with the P1 function $E v_h$ whose value at a vertex is the mean of those of
// $v_h$ around it. $E v_h$ is bounded in $H^1$, and $v_h - E v_h$ is at most
// $C h^{1/2} ‖v_h‖_h$ on $Γ_C$, because the jumps have mean 0 (chapter 12's count over
// edges). So the traces of $v_h$ converge strongly, too, hence $j$ converges, as chapter 28
// asks.
//
// So friction asks no more of an element than contact: the convergence is uniform in λ
// where chapter 28's (i) to (iv) hold. (i), (iii), (iv) are proved for the three elements
// that do not lock: (i) is Korn's inequality, for CR with its jumps. (ii) is proved for
// CR. It asks for motions that keep the volume, come near a given $w$, and stay above the
// obstacle. Edge means of $w$ keep the volume, but the mean of the gap over an edge is its
// value at the midpoint and $h^2/12$ more, so they may sink in by that. Interpolate
// $w + z h^2/12$ instead, where $z$ keeps the volume, is 0 on top, and $z_y = 1$ on $Γ_C$.
// For the other two elements (ii) is neither proved nor tested.
//
// Others impose friction by Nitsche's method with hybrid elements (Chouly, Ern and Pignet
// 2020, into the incompressible limit), and certify the answer by balanced stresses as
// chapter 19 does (Fontana and Di Pietro 2024).
//
// ## Which way it slips
//
// Two things move the lower side of a pressed block sideways. A pressure $p$ on the surface
// of a half plane *draws it inwards*: $∂_x u_x = -(1 - 2ν) p / (2μ)$ there, with Poisson's
// ratio ν. For $μ = 1$ this is $-p/(2λ + 2)$: it is strong for λ = 1, and it vanishes for
// incompressible rubber. And the block, shortened by the push, *bulges outwards*, the more
// so the less it can be compressed. For small λ the first wins, for large λ the second.
// Between, they cancel.
//
// ## Coulomb's law, step by step
//
// In Coulomb's law the bound is not given: $g = F N$, with a coefficient $F$ and the force
// $N$ of the same solution. So the law is no inequality of the class (1). It is a fixed
// point: solve with $g$, put $F N$ in the place of $g$, and solve again (J. Nečas, J.
// Jarušek and J. Haslinger, *Boll. Un. Mat. Ital.* 17-B, 1980). By which factor does a step
// reduce the error of $g$?
//
// Let $u$ and $w$ be the solutions for the bounds $g$ and $q$, and $d = u - w$. Put $w$
// into the inequality of $u$, put $u$ into that of $w$, and add the two:
//
// $$ a(d, d) ≤ \sum (g_i - q_i)(|w_{x,i}| - |u_{x,i}|) ≤ \sum |g_i - q_i| |d_{x,i}|. $$
//
// By Korn's inequality $\sqrt{a(d, d)} ≤ C ‖g - q‖$, with the norm of $L^2(Γ_C)$. It
// remains to bound the change of $N$ by $d$. Continue any $v_y$ on $Γ_C$ into the block,
// with $v_x = 0$ on $Γ_C$. The change of $N$ does the work $a(d, v)$ on it, because $T$
// does none. If $v$ can be chosen without a change of its volume, then this work is at most
// $C \sqrt{a(d, d)}$ times the norm of $v_y$ in $H^{1/2}(Γ_C)$, and $C$ does not depend on
// λ. Crouzeix-Raviart has such a $v$: the interpolant of a continuation by its means over
// edges, which is the argument for (ii). This bounds the change of $N$ in the dual norm,
// which is weaker than that of $L^2$ by half a power of $h$ on functions that are constant
// per edge. So
//
// $$ ‖F N(g) - F N(q)‖ ≤ F C h^{-1/2} ‖g - q‖. $$
//
// The steps contract for $F < h^{1/2}/C$, at every λ. (J. Haslinger, *Math. Meth. Appl.
// Sci.* 5, 1983, has this for one λ.) The proof does not say whether a larger $F$ fails.
//
// P1 on parallel triangles has no such $v$ at $λ = ∞$. Those of its functions that keep all
// volumes are sums of two kinds: a diagonal of the mesh moves along itself, with
// $v_x = v_y$, or a row of vertices moves sideways (the dimension of the kernel is that of
// both together). The strain of the first kind is $ε_{xx} = -ε_{yy}$, that of the second is
// $ε_{xy}$, so that $a$ of one of each is 0. Hence the equation of the diagonal that starts
// at contact unknown $i$ is
//
// $$ N_i + T_i = c_i, $$
//
// where $c_i$ depends on the motion of the diagonals alone. This motion is given at the
// unknowns in contact, and no force acts on the others. Where all of them slip to the
// right, $T_i = -g_i$, and a step is $N_i ← c_i + F N_i$. So **as long as the same unknowns
// touch and slip, a step multiplies the error by $F$, exactly**. With $F ≥ 1$ it does not
// shrink. The locked block is a wedge that friction jams.

#include <map>

#include "antilock/core/error.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/models/bar_on_a_floor.hpp"
#include "antilock/solve/coulomb_friction.hpp"
#include "antilock/solve/uzawa.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using tutorial::Rubber;

double gap(double x) { return (x - 0.5) * (x - 0.5); }  // of the obstacle below y = 0
double g(double x) {
  return std::max(0.0, 0.2 - 5 * std::pow(x - 0.5, 2));
}  // about N/4 on the contact zone

// ### Mesh
// A `Rubber` is one of chapter 26's discretisations, but for the unstructured mesh.
//
// ### Forms
// What `friction` adds to chapter 26: the bounds of $u_x$, behind those of $u_y$.
VariationalInequality pressed(const Rubber& rubber, const VectorSpace& space,
                              const Profile& friction, double epsilon) {
  return assemble(
      PlaneStrain{
          {.gap = gap, .friction = friction, .jump_weight = rubber.jumps ? 1.0 : 0.0},
          epsilon},
      space);
}

// ### Solve
// At each λ $N$ in all, $T$ on the left half (to the right, the mean of both halves by
// symmetry), the largest slip $u_x$ of the left half, and the length that sticks. All large
// λ share one factor, and each answer starts from the zones of the one before.
void press_all(const Rubber& rubber, int cells, Table& forces) {
  const Space x(rubber.mesh, rubber.in_x), y(x, rubber.in_y);
  Sweep sweep(pressed(rubber, {x, y}, g, 1));
  for (const double lambda :
       {1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 20.0, 50.0, 1e2, 1e4, 1e6, 1e8, 1e12, 1e20, 0.0}) {
    sweep.set_compliance(lambda == 0 ? 0 : 1 / lambda);
    const Solution solution = sweep.solve();
    forces.add(tutorial::floor_row(rubber, cells, x, sweep.problem(), solution));
  }
}

void judge(const Table& checks, const Table& forces, tutorial::Report& report) {
  report.claim(
      checks.max("patch") < 1e-12,
      "(proved) patch test: a block that slips as a whole has its uniform strain to {:.0e}",
      checks.max("patch"));
  report.claim(std::max(checks.max("g = 0"), checks.max("g = 1e6")) < 1e-12,
               "(proved) g = 0 is the block without friction to {:.0e}, g = 1e6 the bonded "
               "one to {:.0e}",
               checks.max("g = 0"), checks.max("g = 1e6"));
  report.claim(checks.max("apart") < 1e-9,
               "(observed) active set and Uzawa agree to {:.0e}", checks.max("apart"));
  const Table robust = forces.filter("locks", 0);
  for (const TableEntry& element : robust.unique("element")) {
    const Table own = robust.filter("element", element);
    const auto at = [&](double lambda) {
      return own.filter_number("lambda", [=](double l) { return l == lambda; });
    };
    const Table limit = own.filter("epsilon", 0);
    report.claim(at(1).max("T") < 0 && at(1).min("slip") > 0 && limit.min("T") > 0 &&
                     limit.max("slip") < 0,
                 "(observed) {}: at lambda = 1 the left half slips inwards, T = {:.4f}; in "
                 "the limit outwards, T = {:.4f}",
                 element.text(), at(1).last("T"), limit.last("T"));
    report.claim(at(5).last("T") < 0 && at(10).last("T") > 0 &&
                     at(5).last("sticks") >
                         1.3 * std::max(at(1).last("sticks"), limit.last("sticks")),
                 "(observed) {}: T is {:.4f} at lambda = 5, {:.4f} at 10; it sticks on "
                 "{:.2f} at 1, {:.2f} at 5, {:.2f} "
                 "in the limit",
                 element.text(), at(5).last("T"), at(10).last("T"), at(1).last("sticks"),
                 at(5).last("sticks"), limit.last("sticks"));
    // $|T|$ meets $g$ continuously. An end of the stick zone that is off by a part of $h$
    // costs $h$ times a density of size $h$. The end of contact costs $N$ one cell less
    // evenly: a multiple of $h$.
    const tutorial::Supremum t =
        tutorial::supremum(own.filter("known", 1), "T off", "lambda");
    t.rows.print(element.text() +
                 ": T is off by so many per cent, the largest over lambda");
    const auto [of_t, of_n] = tutorial::off_by(own);
    const double order = t.rows.order("worst", "h"),
                 most = element == "Kouhia-Stenberg" ? 120 : 60;
    report.claim(order > 1.7 && order < 2.7 && of_t < most && of_t > most / 2,
                 "(convergence proved if (ii) holds, order observed) {}: T is off by at "
                 "most {:.0f} h^2 of itself, order "
                 "{:.2f} over four meshes",
                 element.text(), of_t, order);
    report.claim(of_n < 20 && of_n > 5,
                 "(observed) {}: N is off by at most {:.0f} h per cent at every lambda, in "
                 "{} corrections",
                 element.text(), of_n, own.max("corrections"));
  }
  const Table locked = forces.filter("locks", 1).filter("epsilon", 0);
  report.claim(locked.number("N off") > 150 && std::abs(locked.number("T")) < 1e-6 &&
                   locked.number("sticks") == 0,
               "(observed) P1 on parallel triangles locks: N is {:.0f} % too large, and "
               "all slides to one side, T = -g",
               locked.number("N off"));
}

// ### Coulomb
// `coulomb_friction` of the library calls the solver with one bound $g$ after the other.
// Here the solver notes each $g$, so that the changes can be drawn also where the steps do
// not contract and the library gives up. All steps share one factor. The rubber is
// incompressible.
void slip_by_coulomb(const Rubber& rubber, double coefficient, Table& steps) {
  const Space x(rubber.mesh, rubber.in_x), y(x, rubber.in_y);
  const auto none = [](double) { return 0.0; };
  VariationalInequality problem = pressed(rubber, {x, y}, none, 0);
  Sweep sweep(problem);
  std::vector<Eigen::VectorXd> bounds;
  const auto noted = [&](const VariationalInequality& tresca) {
    bounds.push_back(tresca.bounds.force_limit.tail(tresca.bounds.count() / 2));
    sweep.set_force_limit(tresca.bounds.force_limit);
    return sweep.solve();
  };
  bool contracts = true;
  try {
    coulomb_friction(problem, tutorial::friction_pairs(problem), {coefficient}, noted);
  } catch (const NotConverged&) {
    contracts = false;
  }
  tutorial::add_steps(rubber, coefficient, contracts, bounds, steps);
}

void judge_coulomb(const Table& steps, tutorial::Report& report) {
  const Table locked = steps.filter("locks", 1), cr = steps.filter("locks", 0);
  // the solves are exact to some 1e-10, and step 4 changes g by 1e-3 of its sum
  report.claim_within(locked.filter("F", 0.1).filter("step", 4).number("ratio"), 0.1 - 1e-5,
                      0.1 + 1e-5,
                      "(proved) locked P1, F = 0.1: step 4 multiplies the change of g by");
  for (const double coefficient : {0.1, 0.3, 1.0}) {
    const Table own = cr.filter("F", coefficient);
    report.claim(
        own.min("contracts") == 1 && own.max("ratio") < 0.6,
        "(observed) Crouzeix-Raviart, F = {}: {} steps, each multiplies the change "
        "of g by at most {:.2f}",
        coefficient, own.last("step"), own.max("ratio"));
  }
  const Table wedge = locked.filter("F", 1);
  report.claim(wedge.max("contracts") == 0,
               "(observed) locked P1, F = 1: given up after {} steps, the last of which "
               "changes g by {:.0f} % of its sum",
               wedge.last("step"), 100 * wedge.last("change"));
}

void rub(const tutorial::Options& options, tutorial::Report& report) {
  Table checks(tutorial::check_columns), forces(tutorial::floor_columns);
  std::map<std::string, Eigen::MatrixX3d> floors;  // where each sticks and slips
  for (const int n :
       {options.cells / 2, 3 * options.cells / 4, options.cells, 3 * options.cells / 2}) {
    report.stage(fmt::format("every lambda, 1/h = {}", n));
    for (const Rubber& rubber : tutorial::structured_rubbers(n))
      if (!rubber.locks || n == options.cells) press_all(rubber, n, forces);
  }
  for (const Rubber& rubber : tutorial::structured_rubbers(options.cells)) {
    report.stage(rubber.name);
    const Space x(rubber.mesh, rubber.in_x), y(x, rubber.in_y);
    const VectorSpace space{x, y};
    const auto with = [&](const Profile& friction) {
      return pressed(rubber, space, friction, options.epsilon);
    };
    const VariationalInequality problem = with(g);
    Stopwatch watch;
    const Solution solution = active_set(problem);  // at the ε asked for, from cold
    const double seconds = watch.lap();
    if (!rubber.locks) {  // Uzawa beside it, for which P1 takes 3e5 steps
      const Solution same = uzawa(problem);
      checks.add(tutorial::check_row(rubber, space, with, options.epsilon, solution,
                                     seconds, same, watch.lap()));
    }

    // ### Output
    floors[rubber.file] = tutorial::on_floor(x, problem, solution);
    if (rubber.locks) write_freefem_mesh(options.out / "mesh.freefem.msh", rubber.mesh);
  }
  Table steps(tutorial::step_columns);
  for (const double coefficient : {0.1, 0.3, 1.0})
    for (const Rubber& rubber : tutorial::structured_rubbers(options.cells)) {
      // Kouhia-Stenberg has its bounds of u_x and u_y at different places
      if (rubber.file != "p1_right" && rubber.file != "cr") continue;
      report.stage(fmt::format("Coulomb, F = {}: {}", coefficient, rubber.name));
      slip_by_coulomb(rubber, coefficient, steps);
    }
  report.finish();
  steps.filter("locks", 1)
      .filter("F", 1)
      .select({"step", "change", "ratio"})
      .print("locked P1, F = 1");
  steps.write(options.out / "coulomb.csv");
  judge_coulomb(steps, report);
  tutorial::show_friction(options.out, checks, forces, options.cells, g,
                          floors.at("p1_right"), floors.at("p1_crossed"));
  judge(checks, forces, report);
}

// ## What came out
// :output: T, by lambda
//
// (a) At λ = 1 to the *left*: the left half slips inwards, to the right, and $T$ is
// $-0.016$. In the limit to the right: it slips outwards, and $T = 0.012$. The two effects
// cancel between λ = 5 and λ = 10.
// :number: -0.016 = table "T, by lambda" 1 "element=P1 crossed triangles"
// :figure: friction_by_lambda
//
// (b) Where they cancel. P1 on crossed triangles sticks on 0.16 at λ = 1, 0.41 at 5, 0.28
// at 10, 0.22 in the limit.
// :number: 0.16 = table "sticks, by lambda" 1 "element=P1 crossed triangles"
// :number: 0.41 = table "sticks, by lambda" 5 "element=P1 crossed triangles"
// :number: 0.28 = table "sticks, by lambda" 10 "element=P1 crossed triangles"
// :number: 0.22 = table "sticks, by lambda" inf "element=P1 crossed triangles"
// :live: friction
// :output: Crouzeix-Raviart with jumps: T
//
// The three elements that do not lock have the forces of the reference at every λ, with one
// factor for all large λ and at most 2 corrections. Friction converges like $h^2$, the
// normal force less evenly. Locked P1's is 196 % too large.
// :number: 196 = table "error of the normal force" inf "element=P1 right diagonals"
// :output: active set and Uzawa
//
// The active set takes 2 to 4 steps and Uzawa some thousands. But a step of the active set
// is a solve, and one of Uzawa a product with a small matrix, once all unknowns off $Γ_C$
// are eliminated. In seconds, which depend on the machine, Uzawa took 1.1 to 2.3 times as
// long in three runs.
//
// With Coulomb's law and incompressible rubber, Crouzeix-Raviart takes 5, 7 and 11 steps
// for $F = 0.1$, 0.3 and 1. Each of them multiplies the change of $g$ by at most 0.04, 0.09
// and 0.25. Locked P1 converges with the factor 0.1 for $F = 0.1$. For $F = 1$ its $g$
// goes on changing by two thirds of its sum. Without the theory above this looks like a
// failure of the solver. It is another symptom of locking.
// :output: locked P1, F = 1
// :figure: coulomb_steps
//
// ## Exercises
//
// 1. Start Coulomb's law with $F = 1/4$ from $N$ without friction. By how much does a step
//    reduce the change of $N$?
// 2. A bar of stiffness 1 lies on a floor with $g = 1$. Its end at $x = 1$ is pulled by the
//    force 1/2. How far does it slip, and by how much does its end move? Three lines of A1,
//    one bound per node: no block is needed.
// 3. On paper: where is $T$ the multiplier of a constraint, where is it data?
//
// ## Further reading
//
// - [Chouly, Hild and Renard 2023](../guides/bibliography.md#chouly-2023): contact with
//   friction, from Tresca to Coulomb.
// - [Kikuchi and Oden 1988](../guides/bibliography.md#kikuchi-1988): friction as an
//   inequality.

#include "answers.hpp"

// Fewer than 8 cells do not tell locked from inexact.
int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "30_friction", "Nearly incompressible rubber with friction",
      {.epsilon = 1e-8,
       .epsilon_is = "the class parameter of (1), 1/lambda; 0 is incompressible",
       .least_cells = 8,
       .most_cells = 128,
       .exercises = exercises},
      rub);
}
