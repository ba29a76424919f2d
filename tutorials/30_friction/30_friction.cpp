// # Rubber that rubs
//
// Run: 30_friction                          ε = 1/λ = 1e-8, 32 cells, four discretisations; λ from 1 to infinity
// Run: 30_friction --epsilon 0 --cells 16   incompressible
// Run: 30_friction --exercise 1
// Run: 30_friction --exercise 2
//
// Needs: [00](../00_string_on_an_obstacle/00_string_on_an_obstacle.cpp) for the inequality,
// the active set and Uzawa, [26](../26_elasticity/26_elasticity.cpp) for the block and its
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
// $g_i = ∫ g φ_i$ for unknown $i$. Both solvers of chapter 00 go on:
//
// - *Active set*: guess the case of every unknown. Where it sticks $u_i = 0$ is known and
//   $T_i$ is found; where it
// slips $T_i = ±g_i$ is known and $u_i$ is found. An unknown that violates its case changes
// it.
// - *Uzawa*: $T ←$ the nearest number to $T - ρ u_x$ in $[-g, g]$, in place of chapter 00's
//   projection onto $λ ≥ 0$.
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

#include <map>

#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/models/bar_on_a_floor.hpp"
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
  report.finish();
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
// :figure: friction_by_lambda
//
// (b) Where they cancel. P1 on crossed triangles sticks on 0.16 at λ = 1, 0.41 at 5, 0.28
// at 10, 0.22 in the limit.
// :live: friction
// :output: Crouzeix-Raviart with jumps: T
//
// The three elements that do not lock have the forces of the reference at every λ, with one
// factor for all large λ and at most 2 corrections. Friction converges like $h^2$, the
// normal force less evenly. Locked P1's is 196 % too large.
// :output: active set and Uzawa
//
// The active set takes 2 to 4 steps and Uzawa some thousands. But a step of the active set
// is a solve, and one of Uzawa a product with a small matrix, once all unknowns off $Γ_C$
// are eliminated. In seconds, which depend on the machine, Uzawa took 1.1 to 2.3 times as
// long in three runs.
//
// ## Exercises
//
// 1. In Coulomb's law the bound is $g = F N$, and $N$ is not known before. Start from $N$
//    without friction and put $F$ times the last $N$ into $g$, $F = 1/4$. By how much does a step reduce the change of $N$?
// 2. A bar of stiffness 1 lies on a floor with $g = 1$. Its end at $x = 1$ is pulled by the
//    force 1/2. How far does it slip, and by how much does its end move? Three lines of A1, one bound per node: no block is needed.
// 3. On paper: where is $T$ the multiplier of a constraint, where is it data?

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
