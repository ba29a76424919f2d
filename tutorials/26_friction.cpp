// # Rubber that rubs
//
// Run: 26_friction                          ε = 1/λ = 1e-8, 32 cells, four discretisations
// Run: 26_friction --epsilon 0 --cells 16   incompressible
// Run: 26_friction --exercise 1
// Run: 26_friction --exercise 2
//
// Needs: [00](00_string_on_an_obstacle.cpp) for the inequality, the active set and Uzawa,
// [23](23_elasticity.cpp) for the block and its elements. **Here ε is the parameter of the class (1) itself**,
// $ε = 1/λ$.
//
// **The picture.** The block of chapter 23 is pressed on its obstacle, and the obstacle rubs. *Left: the tangential
// force stays between $-g$ and $g$. Right: where it is smaller in size the rubber sticks; where it has reached $g$ or
// $-g$ the rubber slips against it, outwards on both sides. P1 on parallel triangles can only shear along its
// diagonals: its whole contact zone slides to the right and sticks nowhere.*
//
// **Predict.** (a) Pressed rubber spreads to both sides. In which direction does the floor pull its left half?
// (b) Incompressible rubber ($λ → ∞$) spreads more than at $λ = 1$. Does it stick on a longer or a shorter piece?
//
// ## From the energy to stick and slip
//
// A floor with *Tresca's friction* resists sliding with a force per length of at most $g(x)$, which is given. To slide
// by $u_x$ takes the work $g |u_x|$ per length. The block minimises
//
// $$ J(v) = ½ a(v, v) + j(v),   j(v) = ∫_{Γ_C} g |v_x|,   K = \{ v = (0, -0.1) \text{ on top}, v_y ≥ -\text{gap} \}. $$
//
// $j$ is convex and has a corner at 0. Compare $J(u)$ with $J(u + t (v - u))$ as in chapter 00. Convexity gives
// $j(u + t(v - u)) ≤ (1 - t) j(u) + t j(v)$; divide by $t$ and let $t → 0$:
//
// $$ u ∈ K:   a(u, v - u) + j(v) - j(u) ≥ 0   \text{ for all } v ∈ K. $$
//
// Let $N$ and $T$ be the forces of the floor on the block: $a(u, v) = ∫ N v_y + T v_x$. Vary $v_x$ alone, at one
// point: $T (v_x - u_x) + g |v_x| - g |u_x| ≥ 0$ for every number $v_x$. With $v_x = 0$ and $v_x = 2 u_x$ it says
// $T u_x = -g |u_x|$. What is left, $T v_x + g |v_x| ≥ 0$, says $|T| ≤ g$. So there are three cases:
//
// $$ \text{stick: } u_x = 0, |T| ≤ g;   \text{slip right: } u_x ≥ 0, T = -g;   \text{slip left: } u_x ≤ 0, T = g. $$
//
// In contact the displacement has a bound and the force a sign. In friction the force has two bounds and the
// displacement a sign. In the library a bound with $lower = upper = 0$ says $u_x = 0$; its `force_bound`
// $g_i = ∫ g φ_i$ says that it gives way to more.
//
// - *Active set*: guess the case of every unknown. Where it sticks $u_i = 0$ is known and $T_i$ is found, where it
// slips $T_i = ±g_i$ is known and $u_i$ is found. What violates its case changes it. It is the loop of chapter 00 with
// two more cases.
// - *Uzawa*: $T ←$ the nearest number to $T - ρ u_x$ in $[-g, g]$.
//
// λ stands in $a$ alone. Theorem 4 is stated without $j$, and the paper names [4] and [25] for mixed methods with
// friction. This page measures whether what is uniform without friction is so with it.

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
// What `friction` adds to chapter 23: behind the bounds of $u_y$ those of $u_x$, with $lower = upper = 0$ and
// `force_bound` $= ∫ g φ_i$.
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
    // Drawn are the two that have the same unknowns on the floor.
    floors[rubber.file] = tutorial::on_floor(x, problem, solution);
    if (rubber.locks) write_freefem_mesh(options.out / "mesh.freefem.msh", rubber.mesh);
  }
  report.finish();
  tutorial::show_friction(options.out, checks, forces, g, floors.at("p1_right"), floors.at("p1_crossed"));
  tutorial::judge_friction(checks, forces, options.cells, report);
}

// ## What came out
//
// (a) To the right, inwards: $T > 0$ on the left, where the rubber slips to the left. (b) On a longer one. At λ = 1 it
// sticks on 0.16, in the limit on 0.22, though more rubber has to go aside: its pressure holds the middle in place.
//
// Three elements have the forces of the reference (P2 and a continuous P1 pressure, `freefem/26_friction.edp`) at every
// λ, by the factor of chapter 23 and in at most 2 corrections. $N$ is right to 0.3 %, $T$ to 4 to 7 %: an end of the
// stick zone is known to a cell. The active set takes 2 or 3 steps, Uzawa 4000 to 9000. A step of Uzawa is a product
// with a small dense matrix, so on 32 cells both take 0.01 to 0.05 s, most of it the factor. Locked P1 slides to one
// side: its $T$ is $-g$ throughout, more than twice the true friction.
//
// ## Exercises
//
// Predict first. `--exercise N` prints the prediction and its outcome; the answers are in `answers/`.
//
// 1. In Coulomb's law the bound is $g = F N$, and $N$ is not known before. Start from $N$ without friction and put $F$
//    times the last $N$ into $g$, $F = 1/4$. By how much does a step reduce the change of $N$?
// 2. A bar of stiffness 1 lies on a floor with $g = 1$. Its end at $x = 1$ is pulled by the force 1/2. How far does it
//    slip, and by how much does its end move? Three lines of A1, one bound per node: no block is needed.
// 3. On paper: in which of the cases stick and slip is $T$ the multiplier of a constraint, and in which is it data?

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
