// # Round-off that looks like locking
//
// Run: 16_roundoff              ε from 1 to 1e-16 on 1/h = 16; half a minute
// Run: 16_roundoff --cells 64   a finer mesh: the trap closes at a larger ε
// Run: 16_roundoff --exercise 1
//
// Needs: [03](03_by_hand.cpp) for the layer stress and the iterated penalty, [04](04_reference_solution.cpp) for
// Schur complements and condition numbers, [06](06_p1_unstructured.cpp) for locking.
// :live: roundoff
//
// **The picture.** Error against ε for five ways to solve one discrete problem, none of which locks. *Where both
// forms are summed into one matrix the digits are lost below ε = 1e-6. In split form the error does not depend on ε.*
//
// **Predict.** A double has 16 digits. (a) How many digits of $A_1$ are left in $A_1 + ε^{-2} A_0$ at ε = 1e-4, and
// at 1e-8? (b) Where is the damage seen: in the body, or in the layer?
//
// ## The trap
//
// Locking is a fault of the discrete space. A second fault looks just like it and has nothing to do with the space:
// to add the two forms of (26),
//
// $$ A = A_1 + ε^{-2} B^T M B, $$
//
// and to factor $A$. Each row of $B$ is $∂_y$ on a layer triangle, $M$ holds the areas. An entry of the sum is about
// $ε^{-2}$, rounded after 16 digits; of the entry of $A_1$ below it $16 + 2 \log_{10} ε$ digits are left. What is
// lost is the stiffness of the layer along $x$: it stands in no other entry. The body's entries are in no sum and
// keep all digits. So $u$ is wrong on the layer alone, and at last it is flat zero there: round-off imitates Figure
// 7, the contact set settles, and every factorisation reports success.
//
// The *condition number* foretells it: $κ(A) ∼ ε^{-2}$, and a solver may lose the relative error $10^{-16} κ$.
//
// ## The way out
//
// Nothing is wrong with the problem, which has a limit (24); the large number is the mistake. The paper bounds
// $a_0(u, u) ≤ C ε_c$ in its class (proof of Theorem 1). Here $ε_c = ε^2$, so $∂_y u → 0$. The large factor $ε^{-2}$
// meets the small $∂_y u$. Go one step further than the paper and keep their product, the *layer stress*, as an
// unknown:
//
// $$ p = ε^{-2} ∂_y u:   A_1 u + B^T M p = L + λ,   ε^2 p - B u = 0. $$
//
// This is the *split form*: a *saddle point* system, in which no number is large; ε = 0 is a value like any other. In
// the limit $-u_{xx} - ∂_y p = 0$ in the layer: $p$ is affine in $y$, and bounded since $u_{xx}$ is. The second
// picture shows it.
//
// `cure` solves it. It factors $K = A_1 + δ^{-1} B^T M B$ once, with a moderate δ in place of $ε^2$, and uses the
// factor only for corrections: each one solves for what the split form leaves over (*iterated penalty*). To see that
// this converges, take P1, for which $A_1$ is invertible, and eliminate $u$. The exact $p$ solves $(ε^2 + S) p = g$
// with the Schur complement $S = B A_1^{-1} B^T M$, and a correction solves $(δ + S) dp = $ residual. (For CR $A_1$
// has a kernel. It counts as $σ = ∞$: there $p$ is right after one correction.) On an eigenvector of $S$ with the
// eigenvalue $σ$ the error is multiplied by
//
// $$ 1 - \frac{ε^2 + σ}{δ + σ} = \frac{δ - ε^2}{δ + σ}. $$

#include <Eigen/CholmodSupport>

#include "antilock/solve/penalised_matrix.hpp"
#include "common/round_off.hpp"
#include "common/study.hpp"

using namespace antilock;
using Eigen::VectorXd;

// ### Solve
// For a given contact set: its unknowns are held at zero like clamped ones, and what is left is linear. `split` is
// true but in the exercise.
VectorXd cure(VariationalInequality problem, const std::vector<bool>& active, double delta, bool split = true) {
  for (std::size_t i = 0; i < active.size(); ++i)
    if (active[i]) problem.fixed.push_back(problem.contact[i]);
  problem.contact.clear();
  const FreeNumbering free(problem);  // numbers what is neither clamped nor in contact
  const Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Upper> factor(penalised_matrix(problem, free, delta));
  const SparseMatrix sum =
      problem.a1 + SparseMatrix(problem.b.transpose() * (problem.m / problem.compliance).asDiagonal() * problem.b);
  VectorXd u = VectorXd::Zero(problem.size()), p = VectorXd::Zero(problem.b.rows()), du = u;
  for (int correction = 0; correction < 12; ++correction) {
    // What the split form leaves over: no large number occurs, so no digit is lost.
    VectorXd r1 = problem.load - problem.a1 * u - problem.b.transpose() * problem.m.cwiseProduct(p);
    VectorXd r2 = problem.compliance * p - problem.b * u;
    if (!split) r1 = problem.load - sum * u, r2.setZero();
    const VectorXd r = r1 + problem.b.transpose() * problem.m.cwiseProduct(r2) / delta;
    du(free.unknown) = factor.solve(VectorXd(r(free.unknown)));
    u += du;
    p += (problem.b * du - r2) / delta;
  }
  return u;
}

void judge(const Table& results, tutorial::Report& report);

void roundoff(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  // None on which P1 locks: whatever goes wrong below is round-off.
  const std::vector<Method> settings{
      {&p1(), structured()}, {&crouzeix_raviart(), structured()}, {&crouzeix_raviart(), unstructured()}};
  std::vector<Discretisation> on;  // the same mesh at every ε
  on.reserve(settings.size());
  for (const Method& method : settings) on.push_back(method.on(options.cells));
  // ### Forms
  // `compare_solvers` assembles (23) at each $ε$ and hands it to every solver.
  Table results({"solver", "element", "mesh", "epsilon", "error", "ended", "wrong", "refused", "seconds", "apart"});
  for (const double epsilon :
       {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-14, 1e-16}) {
    const tutorial::Exact exact(tutorial::paper_scene(epsilon), 14);
    for (std::size_t i = 0; i < settings.size(); ++i)
      results.add(tutorial::compare_solvers(
          settings[i], on[i].space(), exact,
          [](const auto& problem, const auto& active, double delta) { return cure(problem, active, delta); }));
  }
  const Table conditions = tutorial::condition_numbers(on.front().space());
  // ### Output
  tutorial::show_round_off(options.out, results, conditions);
  tutorial::judge_split_form(results, conditions, report);
  judge(results, report);
}

void judge(const Table& results, tutorial::Report& report) {
  report.claim(results.where("solver", "cure in 20 lines").most("apart") < 1e-8,
               "the cure in twenty lines agrees with the library");
  const Table naive = tutorial::sums(results);
  const Table below = naive.where_number("epsilon", [](double epsilon) { return epsilon < 0.9e-8; });
  report.claim(below.where("wrong", 0).size() == 0,
               "below epsilon = 1e-8 all {} answers of the sum are wrong or missing", below.size());
  const Table wrong = naive.where("wrong", 1), settled = wrong.where("ended", "settled; refused");
  report.claim(settled.size() > 0, "{} wrong answers came with a settled contact set and no complaint", settled.size());
  report.claim(wrong.where("refused", 0).size() == 0, "every wrong answer is refused by the checks in split form");
}

// ## What came out
//
// (a) 8 digits at 1e-4, none at 1e-8: the sum is right where its condition number times 1e-16 is small, and wrong or
// without an answer where it is large. (b) In the layer: at ε = 1e-10 Cholesky settles on $u = 0$ there, error 0.045,
// the whole ridge, and does not complain. The paper's conjugate gradients with ILUT (an incomplete factorisation that
// drops small entries) give up from ε = 1e-3 on. The split form has the same error to 1 % from 1e-3 to 1e-16, and
// `cure` agrees with the library to 5e-13. The condition number of $K$ is 1e8 from ε = 1e-4 down.
//
// ## Exercises
//
// 1. Iterative refinement, as textbooks have it: factor the sum itself, take $r = L - (A_1 + ε^{-2} B^T M B) u$,
//    correct. Does it bring the digits back, at ε = 1e-7?
// 2. On paper: with δ = 1e-6 and $σ ∼ h^2$ on 1/h = 64, how many corrections give 12 digits?

#include "answers/16_roundoff.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "16_roundoff", "Round-off: why the two forms must not be added, and what to do",
                       {.takes_epsilon = false, .cells = 16, .exercises = exercises}, roundoff);
}
