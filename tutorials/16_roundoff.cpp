// Round-off: the trap that the paper does not mention, and the unknown that gets out of it.
//
// Run: 16_roundoff              epsilon from 1 to 1e-16 on 1/h = 16; half a minute
// Run: 16_roundoff --cells 64   a finer mesh: the trap closes at a larger epsilon
//
// What the table shows. Locking is a fault of the discrete space. There is a second fault that
// looks just like it and has nothing to do with the space: a solver that adds the two forms of (6)
// into one matrix,
//
//     A = A1 + epsilon^-2 B' M B        (B = d/dy on each layer triangle, M = their areas)
//
// and factors that. A double holds 16 digits. An entry of the sum that needs the digits of A1 below
// those of epsilon^-2 B' M B keeps 16 + 2 log10(epsilon) of them: at epsilon = 1e-4 half, at 1e-8
// none. What is lost is the stiffness of the layer in x; the body keeps all its digits. And the
// answer looks reasonable: at 1e-10 the contact set settles, every factorisation reports success,
// and u is flat zero on the layer. Round-off imitates Figure 7.
//
// The way out. Nothing is wrong with the problem, which has a limit (24); the large number is the
// mistake. The paper bounds a0(u, u) <= C epsilon in its class (proof of Theorem 1), so d/dy u
// tends to 0. Take one step more than the paper, and carry as an unknown of its own the layer
// stress
//
//     p = epsilon^-2 d/dy u,   finite at every epsilon:
//     A1 u + B' M p = L + lambda,   epsilon^2 p - B u = 0                              (split form)
//
// No number of the split form is large, and epsilon = 0 is a value like any other. `cure` below
// solves it in twenty lines. It factors K = A1 + delta^-1 B' M B once, with a moderate delta in
// place of epsilon^2, and uses the factor for corrections alone: each correction solves for what
// the split form leaves over (iterated penalty).
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <Eigen/CholmodSupport>
#include <cmath>

#include "antilock/core/eigenvalues.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/exhibits/summed_matrix.hpp"
#include "antilock/solve/exhibits/uzawa_cg_ilut.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/solve/penalised_matrix.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

// The cure, for a given contact set: its unknowns are held at zero like clamped ones, what is left
// is linear.
Eigen::VectorXd cure(VariationalInequality problem, const std::vector<bool>& active, double delta) {
  for (std::size_t i = 0; i < active.size(); ++i)
    if (active[i]) problem.fixed.push_back(problem.contact[i]);
  problem.contact.clear();
  const FreeNumbering free(problem);                              // numbers what is neither clamped nor in contact
  const SparseMatrix k = penalised_matrix(problem, free, delta);  // A1 + delta^-1 B' M B: delta is harmless
  const Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Upper> factor(k);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(problem.size()), p = Eigen::VectorXd::Zero(problem.b.rows());
  for (int correction = 0; correction < 12; ++correction) {
    // what the split form leaves over: no large number occurs, so no digit is lost
    const Eigen::VectorXd r1 = problem.load - problem.a1 * u - problem.b.transpose() * problem.m.cwiseProduct(p);
    const Eigen::VectorXd r2 = problem.compliance * p - problem.b * u;
    const Eigen::VectorXd r = r1 + problem.b.transpose() * problem.m.cwiseProduct(r2) / delta;
    Eigen::VectorXd du = Eigen::VectorXd::Zero(u.size());
    const Eigen::VectorXd step = factor.solve(Eigen::VectorXd(r(free.unknown)));
    du(free.unknown) = step;
    u += du;
    p += (problem.b * du - r2) / delta;
  }
  return u;
}

Table solve_all(const Method& method, const Space& space, const tutorial::Exact& exact);
Table condition_numbers(const Space& space);
void judge(const Table& results, const Table& conditions, tutorial::Report& report);

void roundoff(const tutorial::Options& options, tutorial::Report& report) {
  const std::vector<Method> settings{
      {&p1(), structured()}, {&crouzeix_raviart(), structured()}, {&crouzeix_raviart(), unstructured()}};
  Table results({"solver", "element", "mesh", "epsilon", "max_at_unknowns", "kkt_residual", "status", "seconds",
                 "ended", "wrong", "refused"});
  report.stage("four solvers and the cure, fifteen epsilons, three settings");
  for (const double epsilon :
       {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-14, 1e-16}) {
    const tutorial::Exact exact(epsilon);
    for (const Method& method : settings) results.add(solve_all(method, method.on(options.cells).space(), exact));
  }
  report.stage("condition numbers (P1 structured)");
  const Table conditions = condition_numbers(settings.front().on(options.cells).space());
  report.finish();
  conditions.print("condition number of the sum, and of the K that is factored", 2);
  for (const Method& method : settings)
    results.where("element", method.element->name())
        .where("mesh", method.family.name)
        .pivot("epsilon", "solver", "ended")
        .print(method.name() + ": maximum error at the unknowns, and how it ended");
  results.select({"solver", "element", "mesh", "epsilon", "max_at_unknowns", "kkt_residual", "status", "seconds"})
      .write(options.out / "results.csv");
  conditions.write(options.out / "conditions.csv");
  judge(results, conditions, report);
}

void judge(const Table& results, const Table& conditions, tutorial::Report& report) {
  const Table stable = results.where("solver", "split form"), cured = results.where("solver", "cure in 20 lines");
  Table naive = results.where("solver", "sum: Cholesky");
  naive.add(results.where("solver", "sum: LU"));
  // 1e-3 and below: from there on the truth itself changes by less than a percent of the error
  double flattest = 0;
  for (const Entry& element : stable.different("element"))
    for (const Entry& mesh : stable.different("mesh")) {
      const Table small =
          stable.where("element", element).where("mesh", mesh).where_number("epsilon", [](double epsilon) {
            return epsilon <= 1e-3;
          });
      if (small.size() > 0)
        flattest = std::max(flattest, small.most("max_at_unknowns") / small.least("max_at_unknowns") - 1);
    }
  report.claim(flattest < 0.01, "split form: below epsilon = 1e-3 the error is flat to {:.2g} %", 100 * flattest);
  report.claim(cured.most("kkt_residual") < 1e-8, "the cure in twenty lines agrees with the library to {:.1e}",
               cured.most("kkt_residual"));

  const Table below = naive.where_number("epsilon", [](double epsilon) { return epsilon < 0.9e-8; });
  const Table wrong = naive.where("wrong", 1), settled = wrong.where("status", "settled; refused");
  report.claim(
      below.where("wrong", 1).size() == below.size(),
      "the summed matrix: {} of {} answers below epsilon = 1e-8 are wrong or missing (more than twice the right "
      "error)",
      below.where("wrong", 1).size(), below.size());
  report.claim(settled.size() > 0, "{} wrong answers came with a settled contact set and no complaint", settled.size());
  report.claim(wrong.where("refused", 0).size() == 0, "every wrong answer was refused by the checks in split form");

  // What the condition number foretells: with 1.1e-16 in front it bounds the relative error, up to
  // a factor.
  bool foretold = true;
  for (const Entry& epsilon : conditions.different("epsilon")) {
    const double lost = 1.1e-16 * conditions.where("epsilon", epsilon).number("summed");
    const Table here = naive.where("element", "P1").where("epsilon", epsilon);
    if (lost > 10) foretold = foretold && here.where("wrong", 0).size() == 0;
    if (lost < 0.05) foretold = foretold && here.where("wrong", 1).size() == 0;
  }
  report.claim(foretold, "P1: the sum's answers are right where 1.1e-16 condition < 0.05, wrong or missing where > 10");
  const Table small = conditions.where_number("epsilon", [](double epsilon) { return epsilon <= 1e-4; });
  report.claim(small.most("factored") < 1.01 * small.least("factored"),
               "condition number of K: {:.0e} from epsilon = 1e-4 to 1e-16, that of the sum {:.0e} to {:.0e}",
               small.most("factored"), small.least("summed"), small.most("summed"));
  const auto sum = [](const Table& table) {
    double s = 0;
    for (double x : table.numbers("seconds")) s += x;
    return s;
  };
  fmt::print("  what it costs: split form {:.2f} s in all, Cholesky of the sum {:.2f} s\n", sum(stable),
             sum(naive.where("solver", "sum: Cholesky")));
}

// Three things to try:
// - print u on Sigma for the summed Cholesky at epsilon = 1e-10 beside the locked u of tutorial 06:
//   they look the same.
// - in `cure`, form r from the summed matrix in place of the split form: the corrections then
//   correct nothing.
// - set delta = problem.compliance in `cure` at epsilon = 1e-6: fewer corrections, fewer digits.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.cells = 16;
  return tutorial::run(argc, argv, "16_roundoff", "Round-off: why the two forms must not be added, and what to do",
                       options, roundoff);
}

// Every solver on one discrete problem. The naive ones report what they found, and this library's
// checks in split form (certify) what that is worth.
Table solve_all(const Method& method, const Space& space, const tutorial::Exact& exact) {
  const VariationalInequality problem = assemble(tutorial::paper_scene(exact.epsilon), space);
  Table rows({"solver", "element", "mesh", "epsilon", "max_at_unknowns", "kkt_residual", "status", "seconds", "ended",
              "wrong", "refused"});
  double right = 0;  // the error of the split form
  const auto add = [&](const std::string& solver, const Eigen::VectorXd& u, double residual, const std::string& status,
                       double seconds) {
    double error = u.size() == 0 ? std::nan("") : 0;
    for (int i = 0; i < u.size(); ++i)
      error = std::max(error, std::abs(u(i) - exact.table.value(space.points()(i, 0), space.points()(i, 1))));
    if (solver == "split form") right = error;
    rows.add({solver, method.element->name(), method.family.name, exact.epsilon, error, residual, status, seconds,
              fmt::format("{:.2e} {}", error, status), !(error <= 2 * right),
              status == "no answer" || status.ends_with("refused")});
  };
  const auto checked = [&](Solution solution) {
    try {
      certify(problem, solution);
      return solution.warning.empty() ? "trusted" : "warned";
    } catch (const NotConverged&) {
      return "refused";
    }
  };

  Stopwatch watch;
  PenaltyFactor factor(problem);
  const Solution stable = active_set(problem, factor);
  add("split form", stable.u, stable.kkt.residual, stable.warning.empty() ? "trusted" : "warned", watch.lap());
  const Eigen::VectorXd u = cure(problem, stable.active, factor.delta());
  add("cure in 20 lines", u, (u - stable.u).lpNorm<Eigen::Infinity>() / stable.u.lpNorm<Eigen::Infinity>(), "",
      watch.lap());
  for (const auto& [kind, name] : {std::pair{SummedFactor::cholesky, "sum: Cholesky"}, {SummedFactor::lu, "sum: LU"}}) {
    watch.lap();
    const NaiveAnswer naive = naive_summed_solve(problem, kind);
    const double seconds = watch.lap();
    const bool answered = naive.end != NaiveEnd::refused;  // else the factorisation itself gave up
    add(name, answered ? naive.solution.u : Eigen::VectorXd(), naive.solution.kkt.residual,
        answered ? to_string(naive.end) + "; " + checked(naive.solution) : "no answer", seconds);
  }
  watch.lap();
  UzawaOptions patience;
  patience.max_steps = 600;  // steps, not seconds: the same picture on every machine
  try {
    const Solution cg = uzawa_cg_ilut(problem, patience);
    add("sum: CG + ILUT", cg.u, cg.kkt.residual, cg.warning.empty() ? "trusted" : "warned", watch.lap());
  } catch (const NotConverged&) {  // the paper's own linear solver gives up, and says so
    add("sum: CG + ILUT", {}, std::nan(""), "no answer", watch.lap());
  }
  return rows;
}

// The condition numbers of the sum and of the K that `cure` factors. Both have the same smallest
// eigenvalue but for a few percent (it belongs to a smooth function of the kernel of B), and the
// one of the sum could not be computed where it matters: it would have to be factored.
Table condition_numbers(const Space& space) {
  Table conditions({"epsilon", "summed", "factored"});
  for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 1e-16}) {
    const VariationalInequality problem = assemble(tutorial::paper_scene(epsilon), space);
    const FreeNumbering free(problem);
    const SparseMatrix k = penalised_matrix(problem, free, PenaltyFactor(problem).delta());
    const double smallest = smallest_eigenvalue(k);
    const SparseMatrix sum = penalised_matrix(problem, free, problem.compliance);
    conditions.add({epsilon, largest_eigenvalue(sum) / smallest, largest_eigenvalue(k) / smallest});
  }
  return conditions;
}
