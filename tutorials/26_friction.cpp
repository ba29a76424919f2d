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
// $$ \text{stick: } u_x = 0, |T| ≤ g;   \text{slip to the right: } u_x ≥ 0, T = -g;   \text{to the left: } u_x ≤ 0, T = g. $$
//
// In contact the displacement has a bound and the force a sign. In friction the force has two bounds and the
// displacement a sign. In the library a bound with $lower = upper = 0$ says $u_x = 0$; its `force_bound` $g_i = ∫ g φ_i$
// says that it gives way to more.
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
#include "antilock/measure/contact_zone.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/study/sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/slipping_patch.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

// ### Mesh
// Chapter 23's discretisations, but for the unstructured mesh.
struct Rubber {
  std::string name;
  TriangleMesh mesh;
  const Element &in_x, &in_y;
  bool jumps, locks;
};
std::vector<Rubber> make_methods(int cells) {
  const TriangleMesh right = with_free_sides(structured_mesh(cells, Domain{0}));
  const TriangleMesh crossed = with_free_sides(structured_mesh(cells, Domain{0}, Diagonal::crossed));
  return {{"P1 right diagonals", right, p1(), p1(), false, true},
          {"P1 crossed triangles", crossed, p1(), p1(), false, false},
          {"Crouzeix-Raviart with jumps", right, crouzeix_raviart(), crouzeix_raviart(), true, false},
          {"Kouhia-Stenberg", right, p1(), crouzeix_raviart(), false, false}};
}

double gap(double x) { return (x - 0.5) * (x - 0.5); }                        // of the obstacle below y = 0
double g(double x) { return std::max(0.0, 0.2 - 5 * std::pow(x - 0.5, 2)); }  // about N/4 on the contact zone

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

// N in all, |T| on one half, and the length on which it sticks though g > 0.
struct Floor {
  double normal = 0, tangential = 0, sticks = 0;
  Floor(const VariationalInequality& problem, const Solution& solution, int cells) {
    for (Eigen::Index i = 0; i < solution.lambda.size(); ++i) {
      const bool rubs = std::isfinite(problem.force_bound(i));
      (rubs ? tangential : normal) += rubs ? std::abs(solution.lambda(i)) / 2 : solution.lambda(i);
      if (rubs && solution.active[i] && problem.force_bound(i) > 0) sticks += 1.0 / cells;
    }
  }
};

Eigen::MatrixX3d on_floor(const Space& in_x, const VariationalInequality& problem, const Solution& solution);
void judge(const Table& checks, const Table& forces, const Table& errors, int cells, tutorial::Report& report);

void rub(const tutorial::Options& options, tutorial::Report& report) {
  const std::map<double, Eigen::Vector2d> reference{
      {1, {0.16034, 0.01627}}, {1e-4, {0.26073, 0.01222}}, {1e-8, {0.26077, 0.01223}}, {0, {0.26077, 0.01223}}};
  Table checks(
      {"element", "unknowns", "patch", "g = 0", "g = 1e6", "steps", "Uzawa steps", "seconds", "Uzawa s", "apart"});
  Table zones({"x", "g", "minus_g", "T_locked", "T", "u_locked", "u"});
  Eigen::MatrixX3d locked;
  Table forces({"element", "lambda", "epsilon", "N", "T", "sticks", "steps", "corrections"});
  Table errors({"element", "lambda", "epsilon", "locks", "N", "T"});
  for (const Rubber& rubber : make_methods(options.cells)) {
    report.stage(rubber.name);
    const Space x(rubber.mesh, rubber.in_x), y(rubber.mesh, rubber.in_y);
    const VectorSpace space{x, y};

    // ### Solve
    // The forces at every λ. All large λ share one factor, and each answer starts from the zones of the one before.
    Sweep sweep(pressed(rubber, space, g, 1));
    for (const double epsilon : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 1e-20, 0.0}) {
      sweep.set_compliance(epsilon);
      const Solution solution = sweep.solve();
      const Floor floor(sweep.problem(), solution, options.cells);
      forces.add({rubber.name, 1 / epsilon, epsilon, floor.normal, floor.tangential, floor.sticks,
                  solution.counters.contact, solution.counters.corrections});
      if (const auto known = reference.find(epsilon); known != reference.end())
        errors.add({rubber.name, 1 / epsilon, epsilon, rubber.locks,
                    100 * std::abs(floor.normal / known->second(0) - 1),
                    100 * std::abs(floor.tangential / known->second(1) - 1)});
    }

    // At the ε asked for, from cold. Beside it, where nothing locks: Uzawa (P1 takes 3e5 steps); $g = 0$, which is chapter
    // 23; and a great $g$, by which nothing gives way (bonded on both sides P1 cannot move at all).
    const VariationalInequality problem = pressed(rubber, space, g, options.epsilon);
    Stopwatch watch;
    const Solution solution = active_set(problem);
    const double seconds = watch.lap();
    if (!rubber.locks) {
      const Solution same = uzawa(problem);
      const double of_uzawa = watch.lap();
      const auto u_for = [&](const Profile& g) { return active_set(pressed(rubber, space, g, options.epsilon)).u; };
      VariationalInequality bonded = problem;
      bonded.force_bound.resize(0);
      const double slides = (u_for([](double) { return 0; }) - u_for({})).cwiseAbs().maxCoeff();
      const double sticks = (u_for([](double) { return 1e6; }) - active_set(bonded).u).cwiseAbs().maxCoeff();
      checks.add({rubber.name, problem.free_count(),
                  tutorial::slipping_patch_error(space, rubber.jumps ? 1 : 0, options.epsilon), slides, sticks,
                  solution.counters.contact, same.counters.contact, seconds, of_uzawa,
                  (same.u - solution.u).cwiseAbs().maxCoeff()});
    }

    // ### Output
    // Where it sticks and slips, for the two that have the same unknowns on the floor.
    const Eigen::MatrixX3d c = on_floor(x, problem, solution);
    if (rubber.locks) locked = c;
    if (rubber.locks) write_freefem_mesh(options.out / "mesh.freefem.msh", rubber.mesh);
    if (rubber.name == "P1 crossed triangles")
      for (Eigen::Index i = 0; i < c.rows(); ++i)
        zones.add({c(i, 0), g(c(i, 0)), -g(c(i, 0)), locked(i, 1), c(i, 1), locked(i, 2), c(i, 2)});
  }
  report.finish();
  checks.print("", 2);
  errors.pivot("element", "lambda", "N").print("error of the normal force in %, by lambda");
  errors.pivot("element", "lambda", "T").print("error of the friction force in %, by lambda");
  forces.pivot("element", "lambda", "sticks").print("length that sticks, by lambda");
  zones.write(options.out / "zones.csv");
  judge(checks, forces, errors, options.cells, report);
}

void judge(const Table& checks, const Table& forces, const Table& errors, int cells, tutorial::Report& report) {
  report.claim(checks.most("patch") < 1e-12,
               "patch test: a block that slips as a whole has its uniform strain to {:.0e}", checks.most("patch"));
  report.claim(std::max(checks.most("g = 0"), checks.most("g = 1e6")) < 1e-12,
               "g = 0 is the block without friction to {:.0e}, g = 1e6 the bonded one to {:.0e}", checks.most("g = 0"),
               checks.most("g = 1e6"));
  report.claim(checks.most("apart") < 1e-9 && checks.most("steps") <= 10,
               "active set and Uzawa agree to {:.0e}: {} steps at most against {:.0f} or more", checks.most("apart"),
               checks.most("steps"), checks.least("Uzawa steps"));
  const Table robust = errors.where("locks", 0);
  double corrections = 0, drift = 0;
  for (const Entry& element : robust.different("element")) {
    const Table own = forces.where("element", element);
    const Table limit = own.where_number("epsilon", [](double epsilon) { return epsilon <= 1e-8; });
    corrections = std::max(corrections, own.most("corrections"));
    drift = std::max(drift, limit.most("T") / limit.least("T") - 1);
  }
  report.claim(corrections <= 5 && drift < 1e-6,
               "at most {} corrections at any lambda; from lambda = 1e8 to infinity T moves by {:.0e}, like 1/lambda",
               corrections, drift);
  report.claim(robust.most("N") < 20.0 / cells, "N is off by {:.2f} % at most, at any lambda of the table",
               robust.most("N"));
  // in the cell at either end of the stick zone |T| is between 0 and g: h g / 2, where g = 0.15 and T = 0.0122 in all
  report.claim(robust.most("T") < 615.0 / cells, "T is off by {:.1f} % at most (half a cell at its end: {:.0f} %)",
               robust.most("T"), 615.0 / cells);
  const Table locked = forces.where("element", "P1 right diagonals").where("epsilon", 0);
  report.claim(locked.number("N") > 2 * 0.2608 && locked.number("T") > 2 * 0.0122,
               "P1 locks: its contact zone slides to one side; N = {:.2f} and T = {:.4f} are more than twice too large",
               locked.number("N"), locked.number("T"));
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

// By x: where the unknown is, T per length, and the slip.
Eigen::MatrixX3d on_floor(const Space& in_x, const VariationalInequality& problem, const Solution& solution) {
  const Eigen::VectorXd lengths = contact_lengths(in_x);
  Eigen::MatrixX3d curves(lengths.size(), 3);
  curves.col(0) = in_x.points().col(0)(in_x.contact());
  curves.col(1) = solution.lambda.tail(lengths.size()).cwiseQuotient(lengths);
  curves.col(2) = solution.u(problem.contact).tail(lengths.size());
  return curves;
}
