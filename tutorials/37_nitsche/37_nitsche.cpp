// # Nitsche's contact condition
//
// Run: 37_nitsche                          ε from 1 to 1e-8, 1/h = 32; half a minute
// Run: 37_nitsche --gamma-0 2.5            near the bound, which is 2
// Run: 37_nitsche --exercise 1
// Run: 37_nitsche --exercise 2
//
// Needs: [01](../01_domain/01_domain.cpp) (contact conditions),
// [03](../03_by_hand/03_by_hand.cpp) (the stress $p$ as an unknown),
// [05](../05_p1_structured/05_p1_structured.cpp) (P1 on columns).
//
// **The picture.** Displacement of $Γ_C$ at ε = 1e-3, by P1 on the structured mesh, where
// P1 does not lock. The contact condition is not imposed on the unknowns but put into the
// form, in the way of Nitsche. *Only the parameters of the method differ. One choice is
// right. With another one $Γ_C$ penetrates the obstacle, and with the third it does not
// follow the body.*
//
// :figure: nitsche
//
// **Predict.** Nitsche's method has a parameter γ. Chouly and Hild choose $γ = γ_0/h$ with
// a number $γ_0$ that is large enough (their parameter is $1/γ$). (a) With $γ_0 = 1$ in its
// simplest variant (θ = 0 below) the error at $ε = 1$ is that of P1. Is it so at
// $ε = 10^{-3}$? (b) Newton's method converges in some 14 steps to a function that
// satisfies the discrete equation to round-off. Is that a reason to trust it?
// :number: 14 = table "Newton steps" 0.001 "method=gamma_0 = 1, theta = 1"
//
// ## Contact as one equation
//
// Let $λ$ be the pressure of the obstacle on $Γ_C$.
// [Chapter 01](../01_domain/01_domain.cpp) has the conditions $u ≥ 0$, $λ ≥ 0$ and
// $λ u = 0$. With $[x]_+ = \max(x, 0)$ they are one equation, for any number $γ > 0$:
//
// $$ λ = [λ - γ u]_+. $$
//
// (If $u > 0$, then λ must be 0, since $λ = λ - γ u$ is impossible. If $u = 0$, it says
// $λ = [λ]_+$. If $u < 0$, it is impossible.) The pressure is the normal stress of the
// layer, with the outward normal $(0, -1)$:
//
// $$ λ(u) = - ε^{-2} ∂_y u. $$
//
// An active set method treats λ as an unknown. *Nitsche's method* computes it from $u$, so
// that there is no multiplier and no bound on unknowns. Chouly and Hild apply it to
// contact: in $a(u, v) = (f, v) + ∫_{Γ_C} λ v$ the pressure is replaced by
// $[λ(u) - γ u]_+$. With a number θ they write
//
// $$ a(u, v) - \frac{θ}{γ} ∫_{Γ_C} λ(u) λ(v)
//   + \frac{1}{γ} ∫_{Γ_C} [λ(u) - γ u]_+ (θ λ(v) - γ v) = (f, v)   \text{for all } v. $$
//
// The exact solution satisfies this: its $[·]_+$ is λ, and the terms with θ cancel. For θ =
// 1 the derivative of the left side is symmetric, and the equation says that an energy is
// stationary. θ = 0 gives the fewest terms. θ = -1 needs no condition on γ, as follows.
//
// ## How large γ has to be
//
// Let $d$ be the difference of two discrete functions, δ that of their $[λ - γ u]_+$ at a
// point, and $λ_d = λ(d)$. Insert $v = d$. As $[·]_+$ grows and has a slope of at most 1,
// $δ (λ_d - γ d) ≥ δ^2$. So the part on $Γ_C$ is
//
// $$ \frac{1}{γ} ∫ \left( -θ λ_d^2 + δ (λ_d - γ d) - (1 - θ) δ λ_d \right)
//   ≥ \frac{1}{γ} ∫ \left( -θ λ_d^2 + δ^2 - (1 - θ) δ λ_d \right)
//   ≥ - \frac{(1 + θ)^2}{4 γ} ∫ λ_d^2. $$
//
// (The last step completes the square: $θ + (1 - θ)^2/4 = (1 + θ)^2/4$.) The form $a(d, d)$
// must be larger. Let $T$ be the triangle at an edge $E$ of $Γ_C$. Its slope is constant,
// so
//
// $$ ∫_E λ_d^2 = |E|\, ε^{-4} (∂_y d)^2
//   = ε^{-2} \frac{|E|}{|T|} \left( ε^{-2} |T| (∂_y d)^2 \right), $$
//
// and the bracket is the share of $T$ in $ε^{-2} a_y^-(d, d)$. Therefore the method is
// strongly monotone, and has one solution, if
//
// $$ γ > \frac{(1 + θ)^2}{4}\, ε^{-2} \max \frac{|E|}{|T|}. $$
//
// Chouly, Hild and Renard prove the same with an unknown constant: $1/γ$ must be small
// enough unless θ = -1. In their experiments it is proportional
// to $h$ and to 1 over Young's modulus, so that it contains the stiffness of the body. Here
// the constant is known: $|E|/|T| = 2/h$ on the structured mesh.
// **The parameter must contain the stiffness of the layer,** $γ = γ_0 ε^{-2}/h$, with
// $γ_0 > 2$ for θ = 1 and $γ_0 > ½$ for θ = 0. For θ = -1 every γ > 0 will do.
//
// **What goes wrong below it.** Let θ = 1 and $γ_0 = 1$. A vertical edge that ends at an
// inner vertex of $Γ_C$ has two triangles with the area $h^2$ together and the same slope.
// Their part of the stiff form is $ε^{-2} h^2 (∂_y u)^2$. One of them has an edge on $Γ_C$,
// with $∫ λ^2/γ = ε^{-2} h^2 (∂_y u)^2$: *the same.* Where nothing touches, this is
// subtracted, so that the lowest row of edges has no stiffness. The vertices on $Γ_C$ are
// no longer coupled to the body. Only $a_x^-$ acts on them, as in a string without load, so
// $Γ_C$ is straight there. And where does the method find contact? Let $u_1$ be the
// displacement of the vertex above. Then $∂_y u = (u_1 - u)/h$ on the edge, and
//
// $$ λ(u) - γ u = -ε^{-2} \left( \frac{u_1 - u}{h} + \frac{u}{h} \right)
//   = -\frac{ε^{-2}}{h} u_1 $$
//
// up to the difference between neighbouring edges. *The method imposes contact on the
// second row of vertices.* Newton's method finds this solution, because it is one.
//
// **The other mistake** is to forget $ε^{-2}$. Where the layer touches, insert
// $[P]_+ = λ(u) - γ u$ with $P = λ(u) - γ u > 0$. What remains on $Γ_C$ is linear:
//
// $$ - ∫ λ(u) v - θ ∫ u λ(v) + γ ∫ u v. $$
//
// If $θ ≠ 0$, the second term contains $ε^{-2}$ and makes $u$ small whatever γ is. For
// θ = 0 only the last term acts on $u$. Take for $v$ the hat function of the vertex $i$ of
// $Γ_C$, and let $λ_i$ be the pressure of the vertical line above it. The stiff form gives
// $h λ_i$. The first term contains the pressures of the triangles at the two edges beside
// the vertex. Each of them has the line at its right (the diagonals are all parallel), so
// that it gives $h (λ_i + λ_{i+1})/2$. The difference is left to γ:
//
// $$ γ h u_i ≈ γ ∫ u v ≈ \frac{h}{2} (λ_{i+1} - λ_i) ≈ \frac{h^2}{2} λ',
//   u_i ≈ \frac{h λ'}{2 γ}. $$
//
// (The part of $a_x^-$ on the lowest row has the further factor $h^2$.) With $γ = γ_0/h$
// this is $h^2 λ'/(2 γ_0)$, and the pressure tends to that of the limit. So *there is an
// error that does not depend on ε.* It is negative where the pressure falls from left to
// right, and it falls like $h^2$: the method converges, but with a larger constant. With
// $γ = γ_0 ε^{-2}/h$ it has the factor $ε^2$.
//
// ## The stress as an unknown
//
// In a computer $λ(u) = -ε^{-2} ∂_y u$ is a difference of two values that agree to $ε^2$,
// divided by $ε^2$: it has no correct digit for small ε. But $p = ε^{-2} ∂_y u$ is an
// unknown of the split form (chapter 03), finite as $ε → 0$, and $λ(u) = -p$ on the
// triangle. With $γ = s\, ε^{-2}$, $s = γ_0/h$, the factor of the test function,
// $γ^{-1} λ(v) = - s^{-1} ∂_y v$, is not large either. So the equations are, with
// $P = -p - γ u$ on $Γ_C$ and a stress $q$ that tests the second one,
//
// $$ a_1(u, v) + (p, ∂_y v)
//   - ∫_{Γ_C} \left( \frac{θ}{s} (p + [P]_+) ∂_y v + [P]_+ v \right) = (f, v), $$
//
// $$ (∂_y u, q) = ε^2 (p, q). $$
//
// Where $P > 0$, the sum $p + [P]_+$ is $-γ u$. The program writes it in this way, because
// the sum itself would cancel. Newton's method is *semismooth* here: $[·]_+$ has the slope
// 0 or 1. At ε = 0 the parameter is infinite, and Nitsche's condition becomes $u ≥ 0$ at
// the points of the quadrature.

#include "course/course.hpp"
#include "support.hpp"

#include <CLI/CLI.hpp>

using namespace antilock;
using tutorial::Nitsche;
using tutorial::NitscheProblem;
using tutorial::NitscheSolution;

// A choice of the parameters. `with_stiffness`: γ is $γ_0 ε^{-2}/h$; else it is $γ_0/h$.
struct Choice {
  std::string name;
  double gamma_0, theta;
  bool with_stiffness;

  Nitsche method(double epsilon, int cells) const {
    return {gamma_0 * cells * (with_stiffness ? 1 : epsilon * epsilon), theta};
  }
};
double asked_gamma_0 = 10, asked_theta = 1;  // --gamma-0, --theta
std::vector<Choice> right() {
  std::vector<Choice> choices{{"asked", asked_gamma_0, asked_theta, true},
                              {"gamma_0 = 10, theta = 0", 10, 0, true},
                              {"gamma_0 = 10, theta = -1", 10, -1, true}};
  choices[0].name = fmt::format("gamma_0 = {:g}, theta = {:g}", asked_gamma_0, asked_theta);
  if (choices[0].name == choices[1].name || choices[0].name == choices[2].name)
    choices[0].name += " (asked)";
  return choices;
}
const Choice not_coercive{"gamma_0 = 1, theta = 1", 1, 1, true};
const Choice drifts{"gamma_0 = 1, theta = 0, without epsilon", 1, 0, false},
    drifts_less{"gamma_0 = 10, theta = 0, without epsilon", 10, 0, false},
    safe{"gamma_0 = 1, theta = -1, without epsilon", 1, -1, false};

// ### Mesh
Space columns_of(int cells) { return Method{&p1(), structured()}.space(cells); }

// The largest error on $Γ_C$ and the smallest u there, both over the height of the ridge.
struct OnContact {
  double error, lowest;
};
OnContact on_contact(const Space& space, const Eigen::VectorXd& u,
                     const tutorial::Exact& exact) {
  OnContact found{0, 0};
  for (const int i : space.contact_dofs()) {
    found.error = std::max(
        found.error, std::abs(u(i) - exact.table.value(space.dof_coordinates()(i, 0), -1)));
    found.lowest = std::min(found.lowest, u(i));
  }
  const double height = exact.solution.max_on_contact();
  return {found.error / height, found.lowest / height};
}

// ### Solve
// All choices at one ε, beside the active set on the same mesh.
Table compare(double epsilon, int cells) {
  Table rows({"epsilon", "method", "error", "lowest", "steps", "converged"});
  const tutorial::Exact exact(tutorial::paper_scene(epsilon), 14);
  const Space space = columns_of(cells);
  // ### Forms
  const NitscheProblem columns = tutorial::nitsche_problem(exact.scene, space);
  const Solution strong = active_set(columns.problem);
  const OnContact known = on_contact(space, strong.u, exact);
  rows.add({epsilon, "active set", known.error, known.lowest,
            strong.counters.contact_iterations, 1});
  std::vector<Choice> choices = right();
  choices.insert(choices.end(), {not_coercive, drifts, drifts_less, safe});
  for (const Choice& choice : choices) {
    const NitscheSolution solution =
        tutorial::solve_nitsche(columns, choice.method(epsilon, cells));
    const OnContact found = on_contact(space, solution.u, exact);
    rows.add({epsilon, choice.name, found.error, found.lowest, solution.steps,
              solution.converged ? 1 : 0});
  }
  return rows;
}

// The steepest fall of the pressure from left to right, $\max(-λ')$, by the forces of the
// active set. At the clamped end the pressure is 0.
double steepest_fall(const Space& space, const Solution& strong, double h) {
  std::map<double, double> pressures{{1.0, 0.0}};
  for (const int i : space.contact_dofs())
    pressures[space.dof_coordinates()(i, 0)] = strong.lambda(i) / h;
  double fall = 0, before = 0;
  for (const auto& [x, pressure] : pressures) {
    fall = std::max(fall, (before - pressure) / h);
    before = pressure;
  }
  return fall;
}

// The depth of the penetration without $ε^{-2}$ at ε = 1e-3, and $h^2 \max(-λ')/(2 γ_0)$,
// both over the height of the ridge.
Table depth_by_h(const std::vector<int>& cells) {
  Table rows({"gamma_0", "h", "depth", "derived"});
  const tutorial::Exact exact(tutorial::paper_scene(1e-3), 14);
  const double height = exact.solution.max_on_contact();
  for (const int n : cells) {
    const Space space = columns_of(n);
    const NitscheProblem columns = tutorial::nitsche_problem(exact.scene, space);
    const double h = 1.0 / n, fall = steepest_fall(space, active_set(columns.problem), h);
    for (const Choice& choice : {drifts, drifts_less}) {
      const NitscheSolution solution =
          tutorial::solve_nitsche(columns, choice.method(1e-3, n));
      rows.add({choice.gamma_0, h, -on_contact(space, solution.u, exact).lowest,
                h * h * fall / (2 * choice.gamma_0) / height});
    }
  }
  return rows;
}

// The picture: three choices and the exact solution along $Γ_C$.
Table curves(double epsilon, int cells) {
  Table points({"x", "exact", "right", "penetrates", "loose"});
  const tutorial::Exact exact(tutorial::paper_scene(epsilon), 14);
  const Space space = columns_of(cells);
  const NitscheProblem columns = tutorial::nitsche_problem(exact.scene, space);
  const auto u = [&](const Choice& choice) {
    return tutorial::solve_nitsche(columns, choice.method(epsilon, cells)).u;
  };
  const Eigen::VectorXd correct = u(right()[0]), penetrates = u(drifts),
                        loose = u(not_coercive);
  points.add({0.0, 0.0, 0.0, 0.0, 0.0});
  for (const int i : space.contact_dofs()) {
    const double x = space.dof_coordinates()(i, 0);
    points.add({x, exact.table.value(x, -1), correct(i), penetrates(i), loose(i)});
  }
  points.add({1.0, 0.0, 0.0, 0.0, 0.0});
  return points;
}

void judge(const Table& all, const Table& depths, tutorial::Report& report) {
  const auto of = [&](const std::string& name) { return all.filter("method", name); };
  const Table strong = of("active set");
  for (const Choice& choice : right()) {
    double worst = 0;
    for (const Table& row : of(choice.name).rows())
      worst = std::max(worst,
                       row.number("error") /
                           strong.filter("epsilon", row.entry("epsilon")).number("error"));
    report.claim(worst < 1.1 && of(choice.name).min("converged") == 1,
                 "{}: at every epsilon the error is at most {:.3f} times that of the "
                 "active set (observed)",
                 choice.name, worst);
  }
  const auto small = [](double epsilon) { return epsilon <= 0.1; };
  const Table nonsense =
      of(not_coercive.name).filter_number("epsilon", small).filter("converged", 1);
  report.claim(
      nonsense.size() >= 3 && nonsense.min("error") > 0.8 && nonsense.max("error") < 1.2,
      "{}: where Newton's method converges, the error is {:.2f} to {:.2f} of the "
      "ridge (observed)",
      not_coercive.name, nonsense.min("error"), nonsense.max("error"));
  const Table drift = of(drifts.name).filter_number("epsilon", [](double epsilon) {
    return epsilon <= 1e-2;
  });
  report.claim(
      drift.max("lowest") < -0.05 && drift.min("error") > 0.05 &&
          drift.max("error") < 1.05 * drift.min("error"),
      "{}: an error of {:.3f} to {:.3f} of the ridge, whatever epsilon is (observed)",
      drifts.name, drift.min("error"), drift.max("error"));
  report.claim(of(drifts_less.name).last("error") < 0.3 * drift.last("error"),
               "gamma_0 = 10 in place of 1 makes it {:.3f} (observed)",
               of(drifts_less.name).last("error"));
  // The derivation drops terms of relative size h and gamma_0 h; 14 % is seen at 1/h = 64.
  for (const Choice& choice : {drifts, drifts_less}) {
    const Table own = depths.filter("gamma_0", choice.gamma_0);
    report.claim_within(own.last("depth") / own.last("derived"), 0.8, 1.25,
                        fmt::format("{}: depth / h^2 max(-lambda') / (2 gamma_0), on the "
                                    "finest mesh (derived):",
                                    choice.name));
  }
  Table depth({"epsilon", "depth"});
  for (const Table& row : of(right()[0].name).filter_number("epsilon", small).rows())
    depth.add({row.number("epsilon"), -row.number("lowest")});
  report.claim_order(depth, "depth", "epsilon", 1.8, 2.2,
                     "the right gamma penetrates like epsilon^2 (observed)");
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  // The parameters of the run must be above the bound. (Both sides of it contain the same
  // $ε^{-2}$.)
  tutorial::check_monotone(
      tutorial::nitsche_problem(tutorial::paper_scene(1), columns_of(options.cells)),
      right()[0].method(1, options.cells));
  Table all({"epsilon", "method", "error", "lowest", "steps", "converged"});
  for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8})
    all.add(compare(epsilon, options.cells));
  // ### Output
  Table shown({"epsilon", "method", "error"});
  for (const Table& row : all.rows()) {
    TableEntry error = row.entry("error");
    if (row.number("converged") == 0) error = "-";
    shown.add({row.entry("epsilon"), row.entry("method"), error});
  }
  shown.pivot("method", "epsilon", "error")
      .print("largest error on Gamma_C over the height of the ridge; -: no convergence", 3);
  all.pivot("method", "epsilon", "steps").print("Newton steps from u = 0, by epsilon");
  const Table depths = depth_by_h({16, 32, 64});
  depths.print("gamma without epsilon^-2: depth of the penetration", 3);
  all.write(options.out / "nitsche.csv");
  curves(1e-3, options.cells).write(options.out / "contact.csv");
  judge(all, depths, report);
}

// ## What came out
//
// :output: largest error on Gamma_C
//
// (a) No. The parameter $1/h$ is right for a layer as soft as the body. For a stiff one it
// is too small, and $Γ_C$ penetrates by some 7 % of the ridge at every small ε. A finer
// mesh helps, a smaller ε does not. The last column is the depth that is derived above:
// :number: 7 = 100 * table "largest error" 1e-06 "method=gamma_0 = 1, theta = 0, without epsilon"
//
// :output: gamma without epsilon^-2
//
// :live: nitsche
//
// (b) No. It solves the discrete equation, but it is far from the solution of the problem:
// the proof that both are close needs a γ above the bound. At smaller ε the matrix
// is singular up to round-off, and Newton's method does not converge. *The bound can
// be computed before anything is solved*, as the kernel can.
//
// θ = -1 is right with both parameters. Without $ε^{-2}$ the factor $1/s$ is
// $ε^{-2} h/γ_0$, so that round-off ends the convergence at $ε = 10^{-8}$.
//
// :output: Newton steps
//
// ## Exercises
//
// 1. Take $γ_0 = 1$ and θ = 1, and let the program check its own bound. What does it say?
// 2. θ = 0 and $γ_0 = 1$ with the right scale: is it above its bound, and how large is the
//    error?
// 3. On paper: the bound is for any mesh. Show that on columns half of it is enough.
// 4. On paper: what is the bound on γ for Crouzeix-Raviart with the stress of the triangle
//    at $Γ_C$?
// 5. On paper: show that for θ = 1 the solution makes the energy
//    $½ a(u, u) - (f, u) + \frac{1}{2γ} ∫ ([λ(u) - γ u]_+^2 - λ(u)^2)$ stationary.
//
// ## Further reading
//
// - F. Chouly and P. Hild, *A Nitsche-based method for unilateral contact problems:
//   numerical analysis*, SIAM J. Numer. Anal. 51 (2013), 1295-1307,
//   [10.1137/12088344X](https://doi.org/10.1137/12088344X).
// - F. Chouly, P. Hild and Y. Renard, *Symmetric and non-symmetric variants of Nitsche's
//   method for contact problems in elasticity: theory and numerical experiments*, Math.
//   Comp. 84 (2015), 1089-1112,
//   [10.1090/S0025-5718-2014-02913-X](https://doi.org/10.1090/S0025-5718-2014-02913-X).
//   This page runs their method for P1, with the pressure of the triangle at $Γ_C$, three
//   Gauss points per edge and exact integrals elsewhere. They give an example in which the
//   method with θ = 1 has no solution or infinitely many.

#include "answers.hpp"

int main(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--gamma-0", asked_gamma_0, "gamma is gamma_0 epsilon^-2 / h")
        ->check(CLI::PositiveNumber);
    line.add_option("--theta", asked_theta, "1: symmetric; 0; -1")
        ->check(CLI::Range(-1.0, 1.0));
  };
  return tutorial::run(
      argc, argv, "37_nitsche",
      "Nitsche's contact condition: its parameter contains the layer's stiffness",
      {.takes_epsilon = false,
       .least_cells = 16,
       .most_cells = 64,
       .add = add,
       .exercises = exercises},
      study);
}
