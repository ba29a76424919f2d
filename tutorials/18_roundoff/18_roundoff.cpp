// # Round-off that looks like locking
//
// Run: 18_roundoff              ε from 1 to 1e-16 on 1/h = 16; half a minute
// Run: 18_roundoff --cells 64   a finer mesh: the trap closes at a larger ε
// Run: 18_roundoff --exercise 1
//
// **Afterwards you can** predict how many digits a summed matrix loses, tell round-off from
// locking, and solve the split form.
//
// Needs: [03](../03_by_hand/03_by_hand.cpp) for the layer stress and the iterated penalty,
// [06](../06_p1_unstructured/06_p1_unstructured.cpp) for locking.
// :live: roundoff
//
// **The picture.** Error against ε for five ways to solve one discrete problem, none of
// which locks. *Where both forms are summed into one matrix the digits are lost below ε =
// 1e-6. In split form the error does not depend on ε.*
//
// **Predict.** A double has 16 digits. (a) How many digits of $A_1$ are left in
// $A_1 + ε^{-2} A_0$ at ε = 1e-4, and at 1e-8? (b) Where is the damage seen: in the body,
// or in the layer?
//
// ## The trap
//
// Locking is a fault of the discrete space. A second fault looks just like it and has
// nothing to do with the space: to add the two forms of (26),
//
// $$ A = A_1 + ε^{-2} B^T M B, $$
//
// and to factor $A$. Each row of $B$ is $∂_y$ on a layer triangle, $M$ holds the areas. An
// entry of the sum is about $ε^{-2}$, rounded after 16 digits; of the entry of $A_1$ that
// is in it $16 + 2 \log_{10} ε$ digits are left. What is lost is the stiffness of the layer
// along $x$. On the structured mesh its entries between neighbours on a horizontal line
// stay exact. But the diagonal that must balance them is rounded, on $Σ$ with the body's
// share in it. So $u$ is wrong on the layer, and through $Σ$ in the body. At last it is
// flat zero on the layer: round-off imitates Figure 7. From ε = 1e-8 down most runs show
// that something is wrong, because the factorisation fails or the contact set does not
// settle. But some of the 42 runs below, 6 of them with the BLAS of this page, settle
// without a complaint.
// :number: 42 = line "of {} runs of the sum settle"
//
// The *condition number* $κ$, the largest eigenvalue over the smallest, foretells it:
// $κ(A) ∼ ε^{-2}$, and a solver may lose the relative error $10^{-16} κ$.
//
// ## The way out
//
// Nothing is wrong with the problem, which has a limit (chapter 10; (24) in the paper). The
// large number is the mistake. The paper bounds $a_0(u, u) ≤ C ε_c$ in its class (proof of
// Theorem 1). Here $ε_c = ε^2$, so $∂_y u → 0$. The large factor $ε^{-2}$ meets the small
// $∂_y u$. Go one step further than the paper and keep their product, the *layer stress*, as
// an unknown:
//
// $$ p = ε^{-2} ∂_y u:   A_1 u + B^T M p = L + λ,   ε^2 p - B u = 0. $$
//
// This is the *split form*: a *saddle point* system, without large numbers. Its two lines
// say that $½ u^T A_1 u - (L + λ)^T u + p^T M (B u - ½ ε^2 p)$ is least in $u$ and largest
// in $p$, as a saddle is along its two directions. ε = 0 is a value like any other. In the
// limit $-u_{xx} - ∂_y p = 0$ in the layer: $p$ is affine in $y$ (second picture), bounded
// as $u_{xx}$ and the body's $∂_y u$.
//
// `cure` solves it. It factors $A_δ = A_1 + δ^{-1} B^T M B$ once, with a moderate δ in
// place of $ε^2$, and uses the factor only for corrections: each one solves for what the
// split form leaves over (*iterated penalty*). To see that this converges, take P1, for
// which $A_1$ is invertible, and eliminate $u$. The exact $p$ solves $(ε^2 + S) p = g$ with
// the Schur complement $S = B A_1^{-1} B^T M$, and a correction solves $(δ + S) dp = $
// residual. On an eigenvector of $S$ with the eigenvalue $σ$ the error is multiplied by
//
// $$ 1 - \frac{ε^2 + σ}{δ + σ} = \frac{δ - ε^2}{δ + σ}. $$
//
// (For Crouzeix–Raviart $A_1$ is singular: some functions of the layer cost nothing along
// $x$, only across. Nothing in $A_1$ resists them. So the part of $p$ that works on them is
// fixed by balance alone, whatever $δ$ is: it is a multiplier there, and not a spring. One
// correction restores the balance, and with it this part of $p$. The formula agrees: if
// $A_1$ resists them with a small energy $s$, then $σ ∼ 1/s$, and the factor above tends to
// 0 with $s$.)
// :figure: layer_stress
//
// ## Asymptotic-preserving is not locking-free
//
// Plasma physics has the same equation: heat runs along the field lines of a magnet a
// million times faster than across them. A scheme is called *asymptotic-preserving* there
// if at fixed $h$ its matrices stay regular and its solution tends to that of a discrete
// limit problem as ε falls (Degond, Deluzet and Negulescu 2010). The split form is such a
// scheme *for every element*, locked or not: its limit is (7), on $K_{0h}$. Whether (7) is
// near (2), on $K_0$, is another question, that of locking, and the space decides it. (That
// literature knows: a proof of convergence at all ε asks for an inf-sup condition as well,
// which [chapter 29](../29_pressure/29_pressure.cpp) explains, or for a stabilisation in its
// place; arXiv:1507.00879.)
//
// Field lines do not follow meshes. So let the stiff lines of the layer have the slope 2.
// Those that meet a side are held there, those from the right half of $Σ$ reach $Γ_C$ and
// move. A mesh with cells of $h × 2h$ in the layer has its diagonals along them, which are
// columns for P1. On the structured and the unstructured mesh no edge follows them.
// :figure: stiff_lines

#include <Eigen/CholmodSupport>

#include "antilock/problem/choose_penalty.hpp"
#include "support.hpp"

using namespace antilock;
using Eigen::VectorXd;

// ### Solve
// For a given contact set: its unknowns are held at zero like clamped ones, and what is
// left is linear. `split` is true but in the exercise.
VectorXd cure(VariationalInequality problem, const std::vector<bool>& active, double delta,
              bool split = true) {
  for (std::size_t i = 0; i < active.size(); ++i)
    if (active[i]) problem.dirichlet_dofs.push_back(problem.bounds.unknowns[i]);
  problem.bounds = {};
  const DofOrdering free(problem);  // numbers what is neither clamped nor in contact
  const Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Upper> factor(
      penalised_matrix(problem, free, delta));
  const SparseMatrix sum =
      problem.a1 + SparseMatrix(problem.b.transpose() *
                                (problem.m / problem.compliance).asDiagonal() * problem.b);
  VectorXd u = VectorXd::Zero(problem.size()), p = VectorXd::Zero(problem.b.rows()), du = u;
  for (int correction = 0; correction < 12; ++correction) {
    // What the split form leaves over: no large number occurs, so no digit is lost.
    VectorXd r1 =
        problem.load - problem.a1 * u - problem.b.transpose() * problem.m.cwiseProduct(p);
    VectorXd r2 = problem.compliance * p - problem.b * u;
    if (!split) r1 = problem.load - sum * u, r2.setZero();
    const VectorXd r = r1 + problem.b.transpose() * problem.m.cwiseProduct(r2) / delta;
    const VectorXd r_free = r(free.dof),
                   du_free = factor.solve(r_free);  // a vector of its own, then its places
    du(free.dof) = du_free;
    u += du;
    p += (problem.b * du - r2) / delta;
  }
  return u;
}

void judge(const Table& results, const Table& conditions, const Table& lines,
           tutorial::Report& report);

void roundoff(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  // None on which P1 locks: whatever goes wrong below is round-off.
  const std::vector<Method> settings{{&p1(), structured()},
                                     {&crouzeix_raviart(), structured()},
                                     {&crouzeix_raviart(), unstructured()}};
  std::vector<Space> spaces;  // the same mesh at every ε
  spaces.reserve(settings.size());
  for (const Method& method : settings) spaces.push_back(method.space(options.cells));
  // ### Forms
  // `compare_solvers` assembles (23) at each $ε$ and hands it to every solver.
  Table results(tutorial::solver_columns);
  for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9,
                               1e-10, 1e-11, 1e-12, 1e-14, 1e-16}) {
    const tutorial::Exact exact(tutorial::paper_scene(epsilon), 14);
    for (std::size_t i = 0; i < settings.size(); ++i)
      results.add(tutorial::compare_solvers(
          settings[i], spaces[i], exact,
          [](const auto& problem, const auto& active, double delta) {
            return cure(problem, active, delta);
          }));
  }
  const Table conditions = tutorial::condition_numbers(spaces.front());
  // Without contact, at the penalty that the library would choose: the deepest $u$ on Σ at
  // each ε (our load presses the right half down), and how far $u$ is from the method's own
  // limit, which it reaches with order 2 (chapter 11).
  const Table lines = tutorial::turn_the_lines(options.cells, [](const auto& problem) {
    return cure(problem, {}, penalty_parameter(problem));
  });
  // ### Output
  tutorial::show_round_off(options.out, results, conditions);
  lines.pivot("epsilon", "method", "u")
      .print("stiff lines of slope 2: the deepest u on Sigma", 3);
  lines.pivot("epsilon", "method", "from_limit")
      .print("stiff lines of slope 2: how far from the discrete limit", 2);
  judge(results, conditions, lines, report);
}

void judge(const Table& results, const Table& conditions, const Table& lines,
           tutorial::Report& report) {
  report.claim(results.filter("solver", "cure in 20 lines").max("apart") < 1e-8,
               "the cure in twenty lines agrees with the library (observed)");
  // From 1e-3 on the truth changes by less than a percent of the error: (epsilon / h)^2 of
  // it.
  const Table small =
      results.filter("solver", "split form").filter_number("epsilon", [](double e) {
        return e <= 1e-3;
      });
  for (const TableEntry& element : small.unique("element"))
    for (const TableEntry& mesh : small.filter("element", element).unique("mesh")) {
      const Table own = small.filter("element", element).filter("mesh", mesh);
      report.claim(
          own.max("error") < 1.01 * own.min("error"),
          "{} {}: split form, error {:.2e} to {:.2e} below epsilon = 1e-3 (observed)",
          element.text(), mesh.text(), own.min("error"), own.max("error"));
    }
  // What the condition number foretells: 1.1e-16 of it bounds the relative error, up to a
  // factor of 10 each way.
  Table naive = results.filter("solver", "sum: Cholesky");
  naive.add(results.filter("solver", "sum: LU"));
  for (const Table& row : conditions.rows()) {
    const double lost = 1.1e-16 * row.number("summed");
    const Table here =
        naive.filter("element", "P1").filter("epsilon", row.entry("epsilon"));
    if (lost > 10 || lost < 0.05)
      report.claim(
          here.filter("wrong", lost > 10 ? 0 : 1).size() == 0,
          "epsilon = {:g}: round-off times condition is {:.0e}, the sum is {} (observed)",
          row.number("epsilon"), lost, lost > 10 ? "wrong" : "right");
  }
  const Table stiff =
      conditions.filter_number("epsilon", [](double epsilon) { return epsilon <= 1e-4; });
  report.claim(stiff.max("factored") < 1.01 * stiff.min("factored"),
               "condition number of A_delta: {:.0e} from epsilon = 1e-4 on (observed)",
               stiff.max("factored"));
  // Cholesky and LU on three settings. Which runs settle depends on the BLAS, so no exact
  // number is asked for.
  const Table lost =
      naive.filter_number("epsilon", [](double epsilon) { return epsilon < 1.1e-8; });
  const int settled = lost.filter("ended", "settled; refused").size();
  report.claim(settled >= 1 && settled <= lost.size() / 3,
               "from 1e-8 down {} of {} runs of the sum settle without a complaint, the "
               "others do not (observed)",
               settled, lost.size());
  // Round-off imitates Figure 7: what Cholesky answers it answers without a complaint, at
  // last a flat zero.
  const Table answers = naive.filter("solver", "sum: Cholesky").filter("wrong", 1);
  const Table silent = answers.filter("ended", "settled; refused"),
              loud = answers.filter("ended", "cycled; refused");
  const Table flat =
      silent.filter_number("epsilon", [](double epsilon) { return epsilon < 0.9e-9; });
  report.claim(silent.size() >= 3 && silent.size() >= 4 * loud.size() &&
                   (flat.size() == 0 || flat.max("flat") < 0.1),
               "Cholesky of the sum: {} wrong answers settled without a complaint, {} did "
               "not settle; below 1e-9 at most "
               "{:.3f} of the ridge is left (observed)",
               silent.size(), loud.size(), flat.size() == 0 ? 0 : flat.max("flat"));
  report.claim(naive.filter("wrong", 1).filter("refused", 0).size() == 0,
               "every wrong answer is refused by the checks in split form (observed)");
  const Table at = lines.filter("epsilon", 1e-6),
              limit = lines.filter_number("epsilon",
                                          [](double e) { return e < 2e-3 && e > 2e-5; });
  const double exact_solution = at.filter("method", "P1 along, 4 times finer").number("u");
  for (const Table& row : at.rows()) {
    const std::string name = row.entry("method").text();
    const Table two = limit.filter("method", name);
    report.claim_within(
        two.order("from_limit", "epsilon"), 1.8, 2.1,
        name + ": asymptotic-preserving, order in epsilon to its own limit (proved: 2)");
    if (name == "P1 structured" ||
        name == "P1 unstructured")  // what is kept falls like epsilon^2 (chapter 06)
      report.claim_within(two.order("u", "epsilon"), 1.95, 2.01,
                          name + ": and locked, u itself falls with order (proved: 2)");
    else
      report.claim_within(row.number("u") / exact_solution, 0.95,
                          name.starts_with("CR") ? 1.4 : 1.05,
                          name + ": and free, of the true u (observed)");
  }
}

// ## What came out
//
// :output: P1 structured: error at the unknowns
//
// (a) 8 digits at 1e-4, none at 1e-8: the sum is right where its condition number times
// 1e-16 is small, and wrong or without an answer where it is large. (b) In the layer, and
// through $Σ$ in the body: where Cholesky gives an answer it settles, and its last answer
// is $u = 0$ on the layer, error 0.045, the whole ridge. The paper's conjugate gradients
// with ILUT (an incomplete factorisation that drops small entries) give up from ε = 1e-3
// on. The split form has the same error to 1 % from 1e-3 to 1e-16, and `cure` agrees with
// the library. $κ(A_δ)$ is 3e+09 from ε = 1e-4 down. So one solve keeps 6 to 7 digits, and
// each correction adds as many.
// :number: 3e+09 = line "condition number of A_delta: {} from"
// :output: stiff lines of slope 2: the deepest u on Sigma
//
// Every method tends to a limit of its own with order 2 in ε: all are
// asymptotic-preserving. P1 off the lines tends to 0: it locks. P1 along the lines is
// right. Crouzeix–Raviart needs no line: it does not lock, and halving $h$ brings it
// nearer, though slowly. The reason is a kink of $u$ along the line from the lower left
// corner, between what is held and what moves, which no edge follows.
//
// ## Exercises
//
// 1. Iterative refinement, as textbooks have it: factor the sum itself, take
//    $r = L - (A_1 + ε^{-2} B^T M B) u$, correct. Does it bring the digits back, at ε = 1e-7?
// 2. On paper: with δ = 1e-6 and $σ ∼ h^2$ on 1/h = 64, how many corrections give 12
//    digits?
//
// ## Further reading
//
// - [Higham 2002](../guides/bibliography.md#higham-2002): condition numbers, and what
//   iterative refinement can do.
// - [Boffi, Brezzi and Fortin 2013](../guides/bibliography.md#boffi-2013): saddle points,
//   and the iterated penalty method.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "18_roundoff",
                       "Round-off: why the two forms must not be added, and what to do",
                       {.takes_epsilon = false, .cells = 16, .exercises = exercises},
                       roundoff);
}
