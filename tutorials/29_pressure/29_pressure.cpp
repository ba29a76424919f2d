// # A pressure for rubber
//
// Run: 29_pressure              five mixed methods, λ from 1 to 1e20 and infinity, 1/h from 4 to 32; some seconds
// Run: 29_pressure --exercise 1
//
// **Afterwards you can** say which pressures a mixed method determines, compute an inf-sup
// constant, and say which of its variants contact asks for.
//
// Needs: [26](../26_elasticity/26_elasticity.cpp) for the block of rubber and Taylor–Hood,
// [28](../28_mixed/28_mixed.cpp) for projected forms and Theorem 4 with its hypotheses (i)
// to (iv).
//
// **The picture.** Incompressible rubber, P1 with a pressure per vertex, beside MINI, the
// same with a bubble: *the displacements differ little, and one of the pressures is noise.*
//
// **Predict.** (a) Contact holds unknowns of a mixed method that does not lock. Does it
// lock then? (b) One of the pressures of the picture is noise. By how many per cent is the
// contact force of this method wrong at 1/h = 32?
//
// A second page of this chapter is about loads that are gradients. Its program is this one.
//
// ## The pressure as an unknown
//
// For rubber [chapter 28](../28_mixed/28_mixed.cpp)'s strain is
// $B u = \operatorname{div} u$, its class parameter is $1/λ$, and
// $p = λ P_h \operatorname{div} u$ is minus the pressure. A pressure per triangle gives the
// mean of $\operatorname{div} u$ over each triangle, which for P1 and CR is
// $\operatorname{div} u$ itself: chapter 26. A continuous P1 pressure, with the hat
// functions $φ_i$, gives one row per vertex, $∫ φ_i \operatorname{div} u / ∫ φ_i$. Its mass
// matrix is *lumped* (replaced by the sums of its rows). At $1/λ = 0$ the mass matrix is
// not used, and the methods are exactly *MINI*, P1 and a bubble for each component of $u$
// (Arnold, Brezzi and Fortin 1984), and Taylor–Hood, P2.
//
// ## Which pressures are seen?
//
// A displacement $v$ *sees* the pressure $q$ if $(q, B v) ≠ 0$: the pressure then does work
// on it. If some pressure is seen by no $v_h$, the equations do not determine it: that is
// the noise of the picture. If it is seen, but only just, then it takes a large $v_h$ to
// change the mean of $B v_h$ a little. The *inf-sup constant* measures this. It is the
// largest β with (the condition of Ladyzhenskaya, Babuška and Brezzi)
//
// $$ \max_{v_h} \frac{(q, B v_h)}{‖v_h‖} ≥ β ‖q‖ \text{ for all } q ∈ Q_h. $$
//
// What is it good for? Hypothesis (ii) asks for motions without projected strain,
// $w_h ∈ K_{0h}$, near a given $w ∈ K_0$. An interpolant $I w$ is near $w$, and it has a
// little strain: $P_h B (I w)$, which is $P_h B (I w - w)$ because $w$ has none. Take it
// away again. How large a correction does that need? By the inf-sup constant some $v_h$ has
// the same projected strain and the size $‖v_h‖ ≤ ‖P_h B (I w - w)‖/β$. Then
// $w_h = I w - v_h$ has none, and it is as near to $w$ as $I w$ is, up to the factor
// $1 + C/β$. So a β that stays above a positive number for all $h$ gives (ii).
//
// *Under contact* there is one more condition: $w_h$ must stay above the obstacle. $I w$
// does. So the correction must not push down anywhere on $Γ_C$. It is not enough that it is
// 0 where there is contact, because beside this set the gap is as small as one likes. It is
// enough that its vertical part is 0 on *all of* $Γ_C$. So for (ii) the inf-sup constant is
// taken over such $v_h$. The table also has it over all $v_h$, and over those that are 0 on
// the contact set of the solution.
//
// **The layer's stress.** The same question can be asked of it, with $B v = ∂_y v$. Measure
// $q$ there by its largest work on *all* displacements of norm 1, not on the discrete ones
// alone (the *dual norm*). Then $β = 1$ says: whatever stress some displacement sees, a
// discrete one sees as well. For CR β is at least 1 on every mesh, because chapter 08's
// interpolation keeps $(q, ∂_y v)$ and does not enlarge $|v|_1$ (Fortin's property). For P1
// on columns β is 0, since the rows of $B$ depend on each other (chapter 03: two triangles
// share each vertical edge), and yet nothing locks: a positive inf-sup constant is
// sufficient, and not necessary. [4] of the paper (Ben Belgacem, Renard and Slimane 2005)
// and, with other elements, Lovadina and Molinari (2026) build contact on such constants.

#include <cmath>
#include <numbers>

#include "antilock/analysis/inf_sup.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using std::numbers::pi;
using tutorial::Mixed;

const std::vector<Mixed> mixed_methods{
    {"P1 (pressure per triangle)", "", p1(), false},
    {"P1 (pressure per vertex)", "p1_vertex", p1(), true},
    {"MINI", "mini", p1_bubble(), true},
    {"Taylor-Hood", "", p2(), true},
    {"CR with jumps", "", crouzeix_raviart(), false}};

// ### Forms
// `inf_sup_constants`: β over all $v_h$, over those that are 0 on the contact set, and over
// those that are 0 on all of $Γ_C$.

// Two functions stand on the second page: the runs under gradients, and their verdict.
void move_by_gradients(const Mixed& way, bool on_fluxes, Table& worst, Table& by_lambda);
void judge_gradients(const Table& worst, const Table& by_lambda, tutorial::Report& report);

void judge(const Table& beta, const Table& forces, tutorial::Report& report);

void study(const tutorial::Options& options, tutorial::Report& report) {
  Table beta({"name", "h", "held", "beta"}), forces(tutorial::force_columns),
      worst({"name", "h", "moved"}), by_lambda({"name", "lambda", "moved"});
  for (const Mixed& way : mixed_methods) {
    report.stage(way.name);
    beta.add(tutorial::inf_sup_constants(way));
    for (const int n : {8, 16, 32}) forces.add(tutorial::push(way, n, options));
    if (way.name.starts_with("P1")) continue;
    for (const bool on_fluxes : {false, true})
      if (!on_fluxes || !way.element.conforming())
        move_by_gradients(way, on_fluxes, worst, by_lambda);
  }
  report.finish();
  // ### Output
  tutorial::show_pressure(options.out, beta, forces, worst, by_lambda);
  judge(beta, forces, report);
  judge_gradients(worst, by_lambda, report);
}

void judge(const Table& beta, const Table& forces, tutorial::Report& report) {
  const double cr = tutorial::layer_inf_sup({&crouzeix_raviart(), unstructured()}, 8),
               p1_columns = tutorial::layer_inf_sup({&p1(), structured()}, 8);
  report.claim(cr > 1 - 1e-9 && p1_columns == 0,
               "(proved) the layer's stress: beta = {:.4f} for CR, at least 1; {} for P1",
               cr, p1_columns);
  // Not less than 0.9 of the coarsest mesh's on four meshes: a number that settles.
  for (const char* name : {"MINI", "Taylor-Hood", "CR with jumps"})
    for (const char* held : {"contact set", "all of Gamma_C"}) {
      const Table own = beta.filter("name", name).filter("held", held);
      report.claim(own.min("beta") > 0.9 * own.first("beta"),
                   "(observed) {}, {} held: beta loses less than a tenth, {:.3f} to {:.3f}",
                   name, held, own.first("beta"), own.last("beta"));
    }
  const Table locked = beta.filter("name", "P1 (pressure per triangle)");
  report.claim_orders(locked.filter("held", "nothing"), "beta", 0.95, 1.1,
                      "P1 (pressure per triangle), beta");
  report.claim(beta.filter("name", "P1 (pressure per vertex)").max("beta") == 0 &&
                   locked.filter("held", "all of Gamma_C").max("beta") == 0,
               "(observed) P1 (pressure per vertex), and per triangle with all of Gamma_C "
               "held: beta is 0");
  // The end of contact is known to a cell: an error of first order, that jumps from mesh to
  // mesh. Its largest multiple of $h$ over three meshes and six λ, in per cent:
  for (const auto& [name, most] :
       {std::pair{"MINI", 40.0}, {"Taylor-Hood", 15.0}, {"CR with jumps", 20.0}}) {
    double multiple = 0;
    for (const Table& row : forces.filter("name", name).rows())
      multiple = std::max(multiple, std::abs(row.number("percent")) / row.number("h"));
    report.claim(multiple < most && multiple > most / 4,
                 "(observed) {}: the contact force is right to {:.0f} h per cent at every "
                 "lambda, in {} corrections",
                 name, multiple, forces.filter("name", name).max("corrections"));
  }
  report.claim(forces.filter("name", "P1 (pressure per triangle)")
                       .filter("epsilon", 0)
                       .min("percent") > 150,
               "(observed) P1 (pressure per triangle): it locks, force {:.0f} % too large "
               "at 1/h = 8, {:.0f} % at 1/32",
               forces.filter("name", "P1 (pressure per triangle)")
                   .filter("epsilon", 0)
                   .first("percent"),
               forces.filter("name", "P1 (pressure per triangle)")
                   .filter("epsilon", 0)
                   .last("percent"));
}

// ## What came out
//
// :output: inf-sup constant, held: all of Gamma_C
//
// (a) No. Where β settles without contact it settles with it, on these four meshes: with
// all of $Γ_C$ held it is 0.186 for MINI, 0.280 for Taylor–Hood and 0.58 for CR. (Exercise
// 1 shows a block in which contact destroys it.) P1 with a pressure per triangle has
// $β = 0$ there, and loses it like $h$ where nothing is held: it locks, and its force is
// wrong by 177 %.
// :number: 177 = line "too large at 1/h = 8, {} % at 1/32"
// :number: 0.186 = table "inf-sup constant, held: all" 0.0625 name=MINI
// :number: 0.280 = table "inf-sup constant, held: all" 0.0625 name=Taylor-Hood
// :number: 0.58 = table "inf-sup constant, held: all" 0.0625 "name=CR with jumps"
//
// (b) By less than 1 %. P1 with a pressure per vertex has $β = 0$ even where nothing is
// held. Its largest pressure is 3.7 where Taylor–Hood has 1.0, and yet its force is right
// to 0.9 % at 1/h = 32: a force does not show the noise. The numbers of unknowns differ: P1
// has 2112, MINI and CR 6208, Taylor–Hood 8320.
// :number: 3.7 = table incompressible pressure "name=P1 (pressure per vertex)"
// :number: 1.0 = table incompressible pressure name=Taylor-Hood
// :number: 0.9 = table "error of the contact force" 0 "name=P1 (pressure per vertex)"
// :number: 8320 = table incompressible unknowns name=Taylor-Hood
//
// :figure: inf_sup
//
// ## Exercises
//
// 1. Hold the rubber's sides too. What becomes of β while the groove of the obstacle fills
//    up, and of the solution at $1/λ = 0$ after that?
//
// ## Further reading
//
// - [Boffi, Brezzi and Fortin 2013](../guides/bibliography.md#boffi-2013): pressures as
//   unknowns, and inf-sup conditions.
// - [Chouly, Hild and Renard 2023](../guides/bibliography.md#chouly-2023): contact in
//   elasticity.

// :page: 29_gradients
// # Rubber that a gradient loads
//
// **Afterwards you can** say why a load that is a gradient moves a discrete block of
// rubber, tell this from locking, and repair it in the load alone.
//
// Needs: [29](../29_pressure/29_pressure.cpp) for the pressure as an unknown and the five
// methods, [26](../26_elasticity/26_elasticity.cpp) for the block of rubber.
//
// **The picture.** A block under one gradient, without contact: *the larger λ is, the less
// the exact block moves, but three discrete blocks stop becoming stiffer.*
//
// :figure: gradients
//
// **Predict.** (a) Halve $h$. By which factor does the motion of MINI fall, if each mesh
// has its own worst gradient? (b) CR can be made to move as the exact block does. How many
// more unknowns does that take?
//
// ## A second kind of locking
//
// Let rubber be incompressible, without an obstacle, under a load $f = ∇ψ$ with $ψ = 0$ on
// its free sides. By parts $(f, v) = -(ψ, \operatorname{div} v)$: the load does no work on
// any motion that keeps the volume. So the block does not move, and its pressure takes up
// ψ. If λ is finite, it moves by the order of $1/λ$ (exercise 3).
//
// But a discrete $v_h$ keeps the volume in the mean only, that is,
// $(q_h, \operatorname{div} v_h) = 0$ for all discrete pressures $q_h$. So the load does
// the work
//
// $$ (∇ψ, v_h) = -(ψ, \operatorname{div} v_h) = -(ψ - q_h, \operatorname{div} v_h) $$
//
// on it, with any $q_h$. (For CR the jumps of $v_h$ add a term of the same order, because
// their means over edges are 0.) With the $q_h$ nearest to ψ this is at most
// $C h ‖∇ψ‖ |v_h|$, and in general it is not 0. At $1/λ = 0$ put $v_h = u_h$. By Korn's
// inequality $|u_h|^2 ≤ C a_1(u_h, u_h) = C (∇ψ, u_h)$. So $u_h$ moves by at most the
// order of $h$. As $λ → ∞$ the discrete solutions tend to this motion, which in general is
// not 0. So their ratio to the exact motion grows like λ. This is not the locking of
// Theorem 4: the absolute error tends to 0 uniformly. A method without this growth is
// *gradient-robust* (Linke 2014 for fluids; Fu, Lehrenfeld, Linke and Streckenbach 2021
// for elasticity).
//
// ## Another load
//
// CR needs only another load. In $(f, v_h)$ replace $v_h$ by a field that keeps the volume
// exactly,
//
// $$ (Π v_h)(x) = \sum_e \frac{\int_e v_h·n}{2 |T|} (x - x_e)   \text{ on each triangle } T, $$
//
// where $x_e$ is the corner opposite the edge $e$ (Raviart and Thomas). $Π v_h$ has the
// same flux through each edge as $v_h$ and a continuous normal component. So
// $\operatorname{div} Π v_h = \operatorname{div} v_h$, it is 0 exactly, and so is
// $(∇ψ, Π v_h)$.
//
// Which gradient is the worst? The load is a sum of waves. $u_h$ is linear in its
// coefficients $c$, so $|u_h|^2$ is $c^T Q c$ with a symmetric matrix $Q$. Among all $c$ of
// length 1 it is largest for the eigenvector of the largest eigenvalue of $Q$. The Lanczos
// iteration finds it by products with $Q$ alone, that is by solves
// ([17](../17_families_of_loads/17_families_of_loads.cpp) does the same).

// ### Solve
// The worst motion in the norm of $a_1$ at $1/λ = 0$, without contact; and under one wave
// at other λ. The loads $∇ψ$ have the norm 1 and are orthogonal:
// $ψ ∼ \sin kπx \sin (m - ½) πy$, $k, m ≤ 1/(2h)$; on the field Π for CR if asked.
void move_by_gradients(const Mixed& way, bool on_fluxes, Table& worst, Table& by_lambda) {
  const std::string name = way.name + (on_fluxes ? ", load on fluxes" : "");
  for (const int n : {8, 12, 16, 24}) {
    const Space space(tutorial::block(n), way.element);
    const VariationalInequality pressed = tutorial::rubber(way, space, 0);
    Sweep sweep(
        equality_constrained(pressed, std::vector<bool>(pressed.bounds.unknowns.size())));
    const Eigen::MatrixXd loads = tutorial::gradient_loads(space, n / 2, on_fluxes);
    const auto answer = [&](const Eigen::VectorXd& f) {
      sweep.set_load(loads * f);
      return sweep.solve().u;
    };
    const auto work = [&](const Eigen::VectorXd& f) {
      return Eigen::VectorXd(loads.transpose() * answer(f));
    };
    worst.add({name, 1.0 / n,
               std::sqrt(std::abs(largest_eigenvalue(work, loads.cols(), 1e-4, 20)))});
    for (const double epsilon : {1.0, 1e-2, 1e-4, 1e-6, 1e-8}) {
      if (n != 16) continue;
      sweep.set_compliance(epsilon);
      const Eigen::VectorXd u = answer(Eigen::VectorXd::Unit(loads.cols(), 0));
      by_lambda.add({name, 1 / epsilon, std::sqrt(u.dot(sweep.problem().a1 * u))});
    }
  }
}

void judge_gradients(const Table& worst, const Table& by_lambda, tutorial::Report& report) {
  const Table on_fluxes = worst.filter("name", "CR with jumps, load on fluxes");
  report.claim(on_fluxes.max("moved") < 1e-9,
               "(proved) gradient loads do not move CR with the load on fluxes: {:.0e}",
               on_fluxes.max("moved"));
  for (const char* name : {"MINI", "Taylor-Hood", "CR with jumps"}) {
    report.claim_orders(worst.filter("name", name), "moved", 0.6, 1.05,
                        fmt::format("gradient loads move {}", name));
    const Table own = by_lambda.filter("name", name);
    const double stays = own.last("moved") / own.filter("lambda", 1e6).number("moved");
    report.claim(std::abs(stays - 1) < 0.01,
                 "(observed) and by the same at lambda = 1e6 and 1e8: ratio {:.4f}", stays);
  }
  const Table robust = by_lambda.filter("name", "CR with jumps, load on fluxes");
  report.claim_within(
      100 * robust.last("moved") / robust.filter("lambda", 1e6).number("moved"), 0.999,
      1.001,
      "(observed) with the load on fluxes it moves like 1/lambda: 100 times the ratio");
}

// ## What came out
//
// :output: moved by the worst gradient
//
// (a) By 1.7 from 1/8 to 1/16: the motion of MINI falls from 0.0086 to 0.0052. The orders
// in $h$ are 0.7 to 0.8 and still grow, and CR's are 0.94 to 0.98. The bound $C h$ allows
// no order that stays below 1. CR, which has the largest β, moves most: a large β does not
// make a method gradient-robust.
// :number: 0.0086 = table "moved by the worst" 0.125 name=MINI
// :number: 0.0052 = table "moved by the worst" 0.0625 name=MINI
// :number: 0.7 = line "gradient loads move MINI: orders in h {}"
// :number: 0.94 = line "gradient loads move CR with jumps: orders in h {}"
//
// :output: moved by one gradient
//
// (b) None. MINI, Taylor–Hood and CR move by the same at λ = 1e6 and at 1e8. With its load
// on the fluxes CR moves like $1/λ$, as the exact block does. That is one loop of the
// assembly.
//
// ## Exercises
//
// 2. On paper: $Π v_h$ and $v_h$ have the same fluxes through edges. Why does
//    $\operatorname{div} Π v_h = \operatorname{div} v_h$ follow, and why is
//    $(∇ψ, Π v_h) = 0$ although $Π v_h$ is not in $H^1$?
// 3. On paper: why does the exact block move by at most the order of $1/λ$? Take the
//    inf-sup constant β of the exact problem for granted.
//
// ## Further reading
//
// - [Boffi, Brezzi and Fortin 2013](../guides/bibliography.md#boffi-2013): the fields of
//   Raviart and Thomas.
// - [Babuška and Suri 1992b](../guides/bibliography.md#babuska-1992b): locking of nearly
//   incompressible materials, in the sense of chapter 13.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "29_pressure",
      "Mixed methods of rubber: which pressures are seen, and which loads move it",
      {.takes_epsilon = false, .least_cells = 32, .most_cells = 32, .exercises = exercises},
      study);
}
