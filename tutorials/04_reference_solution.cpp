// # The reference solution
//
// Run: 04_reference_solution                          epsilon = 1e-6, h = 1/256; about ten seconds
// Run: 04_reference_solution --epsilon 1 --cells 64
// Run: 04_reference_solution --exercise 1
// Run: 04_reference_solution --exercise 2
//
// Needs: [00](00_string_on_an_obstacle.cpp) (Uzawa, compliance, condition number), [03](03_by_hand.cpp) (split form).
//
// **The pictures.** Figure 4: a hill over the left half of the body, where the load lifts it, and a valley over the
// right half, where it presses the body on the obstacle. On the layer "its value along the normal to Σ is constant
// and nonnegative over Ω⁻" (Section 4.1). *The solution on the layer is a ridge: a function of `x` alone, 0 from
// `x = 0.702` on, where it touches, the *contact zone*.* The other pictures show how Uzawa came to it: step by step,
// and how many steps on which mesh.
//
// **Predict.** (a) For the string, halving `h` cost four times as many steps. Here the contact boundary carries a
// body that is 1 thick. At `ε = 1`, does halving `h` cost as much? (b) And at `ε = 10⁻⁶`, where the layer is rigid
// across?
//
// ## How the paper computes it
//
// "Unilateral contact problems generally do not admit analytical solution" (Section 4.1), so the paper takes P1 on a
// very fine uniform mesh, and Uzawa's algorithm: guess the contact pressure $λ ≥ 0$ on $Γ_C$, and repeat
//
// $$ a(u^k, v) = (f, v) + (λ^k, v)_{Γ_C} for all v,   λ^{k+1} = \max(0, λ^k - ρ u^k). $$
//
// This is chapter 00's loop. The operator behind it is the *compliance* of $Γ_C$: pressure in, displacement there
// out. Its inverse is the *Schur complement* of $Γ_C$: what the matrix says about these unknowns when all others are
// eliminated. Here it is formed once, so that a step costs next to nothing; the paper solves the whole system in each
// step. With the best $ρ$ the error falls by $(κ - 1)/(κ + 1)$ per step, $κ$ the condition number. An error of $tol$
// takes about $(κ/2) \ln(1/tol)$ steps.
//
// **How large is $κ$?** Press with $\sin kπx$, which has $k$ half waves. A mesh carries $k = 1$ to about $1/h$. At
// $ε = 1$ the answer goes into the depth only as far as a half wave is long. The stiffness is $≈ kπ$, so $κ$ =
// largest / smallest $~ 1/h$. As $ε → 0$ the layer cannot vary across, and its own energy along $x$, $a_x^-$,
// decides. It is the energy of a string: stiffness $≈ (kπ)^2$, and $κ ~ 1/h^2$.
//
// **The truth.** $u = 0$ at $x = 0$ and at $x = 1$, in body and layer. So write $u = ∑_k u_k(y) \sin kπx$. Inside
// body and layer (23) becomes one ordinary differential equation in $y$ per $k$, solved in closed form. Left open is
// the contact: the displacement $u$ and the pressure $λ$ on $Γ_C$, with $u ≥ 0$, $λ ≥ 0$, $λ u = 0$. This is one
// complementarity problem in $x$ alone. `lib/antilock/exact` solves it to 8 digits. No mesh is involved. Every
// discrete solution of this course is measured against it, the paper's reference solution too.

#include "antilock/solve/uzawa.hpp"
#include "common/course.hpp"

using namespace antilock;

const Method p1_structured{&p1(), structured()};

std::vector<double> uzawa_history(double epsilon, int cells, double tolerance) {  // the change of u in each step
  UzawaOptions options;
  options.tolerance = tolerance;
  return uzawa(assemble(tutorial::paper_scene(epsilon), p1_structured.on(cells).space()), options).history;
}
int uzawa_steps(double epsilon, int cells, double tolerance) {
  return static_cast<int>(uzawa_history(epsilon, cells, tolerance).size());
}

void reference_solution(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  const Discretisation fine = p1_structured.on(options.cells);
  // ### Forms
  const VariationalInequality problem = assemble(tutorial::paper_scene(options.epsilon), fine.space());

  // ### Solve
  // The tolerance is far below the error of the mesh.
  report.stage("Uzawa, 1/h = " + std::to_string(options.cells));
  PenaltyFactor factor(problem);
  UzawaOptions uzawa_options;
  uzawa_options.tolerance = 1e-8;
  const Solution solution = uzawa(problem, factor, uzawa_options);
  const Solution direct = active_set(problem, factor);
  const double difference = (solution.u - direct.u).cwiseAbs().maxCoeff() / direct.u.cwiseAbs().maxCoeff();
  const Errors errors = tutorial::Exact(tutorial::paper_scene(options.epsilon)).errors(fine.space(), solution);
  Table steps({"epsilon", "cells", "h", "steps"}), history({"epsilon", "step", "change"});
  for (const double epsilon : {1.0, 1e-6}) {
    for (int n = 16; n <= std::min(128, options.cells); n *= 2)
      steps.add({epsilon, n, 1.0 / n, uzawa_steps(epsilon, n, 1e-12)});
    const std::vector<double> changes = uzawa_history(epsilon, std::min(64, options.cells), 1e-8);
    for (std::size_t i = 0; i < changes.size(); i += 1 + i / 50) history.add({epsilon, i + 1, changes[i]});
  }

  // ### Output
  report.finish();
  tutorial::present(options.out, fine.space(), problem, solution, "reference solution", errors);
  fmt::print("  Uzawa took {} steps, the active set {}\n", solution.counters.contact, direct.counters.contact);
  steps.print("Uzawa steps against 1/h");
  history.write(options.out / "history.csv");
  steps.write(options.out / "steps.csv");

  const double h = 1.0 / options.cells, lowest = solution.u(problem.contact).minCoeff();
  report.claim_within(errors.max_at_unknowns / (h * h), 0, 1, "error of the reference solution / h^2:");
  // Uzawa's step in the gap bounds its error up to the few contact points that it still moves: a factor 10.
  report.claim_within(difference, 0, 10 * uzawa_options.tolerance, "Uzawa and the active set differ by (relative)");
  report.claim(lowest >= -1e-7, "nonnegative on Gamma_C (smallest value {:.1e})", lowest);
  if (options.cells < 64) return report.not_judged("how the steps grow: three meshes from 1/h = 16 on tell");
  // kappa ~ h^-1 and h^-2. The logarithm takes 0.25 off the second: the slowest wave is as long as a cell, and its
  // share of the error falls itself, like h^(7/2). The rest is room for three meshes.
  report.claim_within(-steps.where("epsilon", 1.0).order("steps", "h"), 0.8, 1.1,
                      "epsilon = 1: steps grow like 1/h to the");
  report.claim_within(-steps.where("epsilon", 1e-6).order("steps", "h"), 1.6, 2, "epsilon = 1e-6: like 1/h to the");
}

// ## What came out
//
// (a) No: at $ε = 1$ halving $h$ doubles the steps. (b) At $ε = 10^{-6}$ it makes them 3.5 times as many, almost
// four: 48,303 steps at $1/h = 256$, where the active set needs a handful. Uzawa restarts with each correction of
// chapter 03: the teeth in the picture of its history.
//
// ## Exercises
//
// 1. At $ε = 1$, $1/h = 64$: what do two further digits cost, from $10^{-8}$ to $10^{-10}$, and to $10^{-12}$?
// 2. The steps on $1/h = 32$ are known, at $ε = 1$ and at $10^{-6}$. How many on $1/h = 64$?
// 3. Replace `uzawa` by `uzawa_cg_ilut` (`solve/exhibits`): the paper's own linear solver, conjugate gradients with an
//    incomplete factorisation (ILUT, chapter 16). Try `--epsilon 1 --cells 16`, then `1e-6`.

#include "answers/04_reference_solution.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "04_reference_solution",
                       "Figure 4: the reference solution by Uzawa on a very fine mesh",
                       {.cells = 256, .exercises = exercises}, reference_solution);
}
