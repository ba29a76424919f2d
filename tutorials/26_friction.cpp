// # Rubber that rubs
//
// Run: 26_friction                          ε = 1/λ = 1e-8, 32 cells, four discretisations
// Run: 26_friction --epsilon 0 --cells 16   incompressible
// Run: 26_friction --exercise 1
// Run: 26_friction --exercise 2
//
// Needs: [00](00_string_on_an_obstacle.cpp) for the inequality, the active set and Uzawa, [23](23_elasticity.cpp) for
// the block and its elements. **Here ε is the parameter of the class (1) itself**, $ε = 1/λ$.
//
// **The picture.** The block of chapter 23 is pressed on its obstacle, and the obstacle rubs. *Left: the tangential
// force $T$ of the floor stays between $-g$ and $g$. Right: where $|T| < g$ the rubber sticks. Where $T$ has reached
// $g$ or $-g$ it slips, outwards on both sides. P1 on parallel triangles can only shear along its diagonals: its whole
// contact zone slides to the right and sticks nowhere.*
//
// **Predict.** (a) Pressed rubber spreads to both sides. In which direction does the floor pull its left half? (b)
// Incompressible rubber ($λ → ∞$) spreads more than rubber with $λ = 1$. Does it stick on a longer or a shorter piece?
//
// ## From the energy to stick and slip
//
// A floor with *Tresca's friction* resists sliding with a force per length of at most $g(x)$, which is given. To slide
// by $u_x$ against it takes the work $g |u_x|$ per length. So the block minimises
//
// $$ J(v) = ½ a(v, v) + j(v),   j(v) = ∫_{Γ_C} g |v_x|,   K = \{ v = (0, -0.1) \text{ on top}, v_y ≥ -\text{gap} \}, $$
//
// where $a$ is chapter 23's form with $λ$. $j$ is convex and has a corner at 0. Compare $J(u)$ with $J(u + t (v - u))$
// as in chapter 00. Convexity gives $j(u + t(v - u)) ≤ (1 - t) j(u) + t j(v)$. Divide by $t$ and let $t → 0$:
//
// $$ u ∈ K:   a(u, v - u) + j(v) - j(u) ≥ 0   \text{ for all } v ∈ K. $$
//
// Let $N$ and $T$ be the forces per length of the floor on the block, upwards and to the right:
// $a(u, v) = ∫_{Γ_C} N v_y + T v_x$ for all $v$ that are 0 on top. Change $u_x$ alone, near one point. There
// $T (s - u_x) + g |s| - g |u_x| ≥ 0$ for every number $s$. With $s = 0$ and $s = 2 u_x$ this says $T u_x = -g |u_x|$.
// What is left, $T s + g |s| ≥ 0$, says $|T| ≤ g$. So there are three cases:
//
// $$ \text{stick: } u_x = 0, |T| ≤ g;   \text{slip right: } u_x ≥ 0, T = -g;   \text{slip left: } u_x ≤ 0, T = g. $$
//
// Contact has a bound on the displacement and a sign of the force. Friction has two bounds on the force and a sign of
// the displacement. In the library it is the bound $lower = upper = 0$ on $u_x$, which gives way to a force beyond
// `force_bound`, $g_i = ∫ g φ_i$ for unknown $i$. Both solvers of chapter 00 go on:
//
// - *Active set*: guess the case of every unknown. Where it sticks $u_i = 0$ is known and $T_i$ is found; where it
// slips $T_i = ±g_i$ is known and $u_i$ is found. An unknown that violates its case changes it.
// - *Uzawa*: $T ←$ the nearest number to $T - ρ u_x$ in $[-g, g]$, in place of chapter 00's projection onto $λ ≥ 0$.
//
// Theorem 4 is stated without $j$. This page measures whether what is uniform in $λ$ without friction is so with it.

#include <algorithm>
#include <cmath>
#include <map>

#include "antilock/io/writers.hpp"
#include "antilock/solve/uzawa.hpp"
#include "common/friction.hpp"

using namespace antilock;
using tutorial::Rubber;

double gap(double x) { return (x - 0.5) * (x - 0.5); }                        // of the obstacle below y = 0
double g(double x) { return std::max(0.0, 0.2 - 5 * std::pow(x - 0.5, 2)); }  // about N/4 on the contact zone

// ### Mesh
// A `Rubber` is one of chapter 23's discretisations, but for the unstructured mesh.
//
// ### Forms
// What `friction` adds to chapter 23: the bounds of $u_x$, behind those of $u_y$.
VariationalInequality pressed(const Rubber& rubber, const VectorSpace& space, const Profile& friction, double epsilon) {
  PlaneStrain scene;
  scene.epsilon = epsilon;
  scene.gap = gap;
  scene.friction = friction;
  scene.jump_weight = rubber.jumps ? 1 : 0;
  return assemble(scene, space);
}

void rub(const tutorial::Options& options, tutorial::Report& report) {
  Table checks(tutorial::check_columns), forces(tutorial::floor_columns);
  std::map<std::string, Eigen::MatrixX3d> floors;  // where each sticks and slips
  for (const Rubber& rubber : tutorial::structured_rubbers(options.cells)) {
    report.stage(rubber.name);
    const Space x(rubber.mesh, rubber.in_x), y(rubber.mesh, rubber.in_y);
    const VectorSpace space{x, y};

    // ### Solve
    // At every λ: $N$ in all, $|T|$ on one half, the length that sticks. All large λ share one factor, and each answer
    // starts from the zones of the one before.
    Sweep sweep(pressed(rubber, space, g, 1));
    for (const double epsilon : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 1e-20, 0.0}) {
      sweep.set_compliance(epsilon);
      const Solution solution = sweep.solve();
      forces.add(tutorial::floor_row(rubber, epsilon, sweep.problem(), solution, options.cells));
    }

    // At the ε asked for, from cold. Beside it, where nothing locks: Uzawa (P1 takes 3e5 steps); $g = 0$, which is
    // chapter 23; and a great $g$, by which nothing gives way (bonded on both sides P1 cannot move at all).
    const auto with = [&](const Profile& friction) { return pressed(rubber, space, friction, options.epsilon); };
    const VariationalInequality problem = with(g);
    Stopwatch watch;
    const Solution solution = active_set(problem);
    const double seconds = watch.lap();
    if (!rubber.locks) {
      const Solution same = uzawa(problem);
      const double of_uzawa = watch.lap();
      const auto [none, bonded] = tutorial::extremes_of_friction(with);
      const double patch = tutorial::slipping_patch_error(space, rubber.jumps ? 1 : 0, options.epsilon);
      checks.add({rubber.name, problem.free_count(), patch, none, bonded, solution.counters.contact,
                  same.counters.contact, seconds, of_uzawa, (same.u - solution.u).cwiseAbs().maxCoeff()});
    }

    // ### Output
    floors[rubber.file] = tutorial::on_floor(x, problem, solution);
    if (rubber.locks) write_freefem_mesh(options.out / "mesh.freefem.msh", rubber.mesh);
  }
  report.finish();
  tutorial::show_friction(options.out, checks, forces, g, floors.at("p1_right"), floors.at("p1_crossed"));
  tutorial::judge_friction(checks, forces, options.cells, report);
}

// ## What came out
//
// (a) To the right, inwards: $T > 0$ on the left, where the rubber slips to the left. (b) On a longer one. At λ = 1 P1
// on crossed triangles sticks on 0.16, in the limit on 0.22, though more rubber has to go aside: its pressure holds the
// middle in place.
//
// The three elements that do not lock have the forces of the reference (Taylor–Hood on a graded mesh,
// `freefem/26_friction.edp`) at every λ, with one factor for all large λ and at most 2 corrections. Their normal force
// is right to 0.3 %. Their friction force is right to 1 % at λ = 1 and to 4 to 7 % in the limit, since an end of the
// stick zone is known to a cell only. The active set takes 2 or 3 steps, Uzawa 3500 to 8000. Locked P1 slides to one
// side. Its normal force is 196 % too large; its $T$ is $-g$ throughout, 117 % too large.
//
// ## Exercises
//
// 1. In Coulomb's law the bound is $g = F N$, and $N$ is not known before. Start from $N$ without friction and put $F$
//    times the last $N$ into $g$, $F = 1/4$. By how much does a step reduce the change of $N$?
// 2. A bar of stiffness 1 lies on a floor with $g = 1$. Its end at $x = 1$ is pulled by the force 1/2. How far does it
//    slip, and by how much does its end move? Three lines of A1, one bound per node: no block is needed.
// 3. On paper: where is $T$ the multiplier of a constraint, where is it data? (Where it sticks; where it slips.)

#include "answers/26_friction.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "26_friction",
                       "Nearly incompressible elasticity with friction: active set and Uzawa",
                       {.epsilon = 1e-8,
                        .epsilon_is = "the class parameter of (1), 1/lambda; 0 is incompressible",
                        .least_cells = 8,  // fewer do not tell locked from inexact
                        .most_cells = 128,
                        .exercises = exercises},
                       rub);
}
