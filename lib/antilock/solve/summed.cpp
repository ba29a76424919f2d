#include "antilock/solve/summed.hpp"

#include <fmt/format.h>
#include <Eigen/CholmodSupport>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/UmfPackSupport>
#include <array>
#include <set>

#include "antilock/core/eigenvalues.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/memory.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/solve/penalised_matrix.hpp"
#include "antilock/solve/uzawa.hpp"

namespace antilock {
namespace {

/// x = K^-1 b by the factor asked for (K symmetric, n x n, both triangles given); empty where the factorisation gives
/// up.
Eigen::VectorXd summed_solve(const SparseMatrix& k, const Eigen::VectorXd& b, SummedFactor kind) {
  const BlasCalls blas;
  Eigen::VectorXd x;
  if (kind == SummedFactor::cholesky) {
    Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Upper> factor;
    factor.cholmod().print = 0;
    factor.compute(k);
    if (factor.info() == Eigen::Success) x = factor.solve(b);
  } else {
    const Eigen::UmfPackLU<SparseMatrix> factor(k);
    if (factor.info() == Eigen::Success) x = factor.solve(b);
  }
  return x.allFinite() ? x : Eigen::VectorXd();
}

/// A^-1 on the free places by CG + ILUT, the paper's linear step; a run that fails is an exception.
class CgIlut {
 public:
  static constexpr double cg_tolerance = 1e-10;  // Eigen stops on the residual relative to the right-hand side
  explicit CgIlut(const SparseMatrix& upper_triangle) : a_(upper_triangle.selfadjointView<Eigen::Upper>()) {
    cg_.preconditioner().setDroptol(1e-6);
    cg_.preconditioner().setFillfactor(20);
    cg_.setTolerance(cg_tolerance);
    cg_.setMaxIterations(500);
    cg_.compute(a_);
    if (cg_.info() != Eigen::Success)
      throw NotConverged("uzawa, CG + ILUT: the incomplete factorisation broke down", 1, 0);
  }
  Eigen::VectorXd operator()(const Eigen::VectorXd& b, const Eigen::VectorXd& guess) {
    ++runs;
    Eigen::VectorXd x = cg_.solveWithGuess(b, guess);
    if (cg_.info() != Eigen::Success || !x.allFinite())
      throw NotConverged(
          fmt::format("uzawa, CG + ILUT: the conjugate gradients of linear solve {} stopped at a relative residual of "
                      "{:.1e} after {} iterations, accepted {:.0e}",
                      runs, cg_.error(), cg_.iterations(), cg_tolerance),
          cg_.error(), runs);
    return x;
  }
  int runs = 0;

 private:
  SparseMatrix a_;
  Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper, Eigen::IncompleteLUT<double>> cg_;
};

}  // namespace

SummedSystem summed_system(const VariationalInequality& problem, const std::string& who, const char* instead) {
  check(problem);
  require_lower_bounds(problem.bounds, who);
  if (problem.b.rows() > 0 && problem.compliance == 0)
    throw Error(fmt::format(
        "{}: the summed matrix does not exist at epsilon = 0; accepted epsilon > 0, or the solver {}", who, instead));
  if (problem.fixed_compliances.size() > 0)
    throw Error(
        fmt::format("{}: rows of B with fixed compliances are not summed; accepted: a problem without them, or "
                    "the solver {}",
                    who, instead));
  DofOrdering ordering(problem);
  SparseMatrix upper_triangle = penalised_matrix(problem, ordering, problem.compliance);  // the sum, and the fault
  Eigen::VectorXd u = Eigen::VectorXd::Zero(problem.size());
  u(problem.dirichlet_dofs) = problem.dirichlet_values;
  Eigen::VectorXd load = problem.load - problem.a1 * u;
  if (problem.b.rows() > 0) load -= problem.b.transpose() * problem.m.cwiseProduct(problem.b * u) / problem.compliance;
  load = Eigen::VectorXd(load(ordering.dof));
  return {std::move(ordering), std::move(upper_triangle), std::move(load), std::move(u)};
}

std::string to_string(ConvergedReason reason) {
  return std::array{"settled", "cycled", "refused", "step cap"}[static_cast<std::size_t>(reason)];
}

NaiveResult naive_summed_solve(const VariationalInequality& problem, SummedFactor kind, int max_iterations) {
  const Stopwatch watch;
  const auto [ordering, k, b, given] = summed_system(problem, "naive", "active_set");
  const SparseMatrix both_triangles = k.selfadjointView<Eigen::Upper>();
  const int size = static_cast<int>(b.size()), c = static_cast<int>(problem.bounds.unknowns.size());
  NaiveResult result;
  Solution& s = result.solution;
  s.solver = kind == SummedFactor::cholesky ? "naive, Cholesky of the sum" : "naive, LU of the sum";
  s.u = given;
  s.lambda = Eigen::VectorXd::Zero(c);
  s.active.assign(c, false);

  std::set<std::vector<bool>> tried;
  result.reason = ConvergedReason::max_iterations;
  while (s.counters.contact_iterations < max_iterations) {
    if (!tried.insert(s.active).second) {
      result.reason = ConvergedReason::cycled;
      break;
    }
    // the active unknowns stand at their bounds and leave the system
    Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
    std::vector<int> inactive;
    for (int i = 0; i < size; ++i)
      if (const int contact = i - ordering.interior; contact >= 0 && s.active[contact])
        x(i) = problem.bounds.lower(contact);
      else
        inactive.push_back(i);
    SparseMatrix chosen(size, static_cast<Eigen::Index>(inactive.size()));
    for (std::size_t i = 0; i < inactive.size(); ++i) chosen.insert(inactive[i], static_cast<Eigen::Index>(i)) = 1;
    const Eigen::VectorXd rest = b - k.selfadjointView<Eigen::Upper>() * x;
    const Eigen::VectorXd found = summed_solve(chosen.transpose() * both_triangles * chosen, rest(inactive), kind);
    ++s.counters.factorisations;
    ++s.counters.solves;
    ++s.counters.contact_iterations;
    if (found.size() == 0) {
      result.reason = ConvergedReason::linear_solve_failed;
      break;
    }
    x(inactive) = found;
    const Eigen::VectorXd force = (k.selfadjointView<Eigen::Upper>() * x - b).tail(c);
    bool converged = true;
    s.lambda.setZero();
    for (int i = 0; i < c; ++i) {
      if (s.active[i]) s.lambda(i) = force(i);
      const double gap = x(ordering.interior + i) - problem.bounds.lower(i);
      if (!(s.active[i] ? force(i) < 0 : gap < 0)) continue;
      s.active[i] = !s.active[i];
      converged = false;
    }
    s.u(ordering.dof) = x;
    if (converged) {
      result.reason = ConvergedReason::converged;
      break;
    }
  }
  s.seconds.factor = watch.seconds();
  s.p = problem.b * s.u / problem.compliance;
  s.counters.unknowns = problem.free_count();
  s.kkt = kkt_report(problem, s);
  return result;
}

Solution uzawa_cg_ilut(const VariationalInequality& problem, const UzawaOptions& options) {
  const std::string who = "uzawa, CG + ILUT";
  if (options.step_length && !(*options.step_length > 0))
    throw Error(fmt::format("{}: step_length = {}; accepted: a positive number", who, *options.step_length));
  if (options.stop_at)
    throw Error(who + ": options.stop_at needs for the condensed matrix; accepted: tolerance, or the solver uzawa");
  Stopwatch watch, stage;
  const auto [ordering, upper_triangle, load, given] = summed_system(problem, who, "uzawa");
  CgIlut solve(upper_triangle);
  Solution s;
  s.solver = who;
  s.seconds.factor = stage.lap();
  s.u = given;
  const auto c = static_cast<Eigen::Index>(problem.bounds.unknowns.size()), f = load.size();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(f);

  double rho = options.step_length.value_or(0);
  if (!options.step_length && c > 0) {
    const auto compliance = [&](const Eigen::VectorXd& force) {
      Eigen::VectorXd b = zero;
      b.tail(c) = force;
      return Eigen::VectorXd(solve(b, zero).tail(c));
    };
    rho = 1.9 / largest_eigenvalue(compliance, c, 1e-2, 10);  // 1.9 < 2: the estimate is from below
  }

  Eigen::VectorXd x = zero, lambda = Eigen::VectorXd::Zero(c);
  while (true) {
    Eigen::VectorXd b = load;
    b.tail(c) += lambda;
    x = solve(b, x);
    if (c == 0) break;
    const Eigen::VectorXd gap = x.tail(c) - problem.bounds.lower;
    const Eigen::VectorXd next = (lambda - rho * gap).cwiseMax(0.0);
    const double scale = std::max(x.cwiseAbs().maxCoeff(), problem.bounds.lower.cwiseAbs().maxCoeff());
    const double change = scale > 0 ? (next - lambda).cwiseAbs().maxCoeff() / rho / scale : 0;
    s.history.push_back(change);
    if (change <= options.tolerance) break;  // lambda and x still belong together
    lambda = next;
    const int steps = static_cast<int>(s.history.size());
    if (steps >= options.max_iterations || watch.seconds() > options.max_seconds)
      throw NotConverged(
          fmt::format(
              "uzawa, CG + ILUT: not converged: relative step {:.1e} after {} steps and {:.1f} s, accepted {:.0e}",
              change, steps, watch.seconds(), options.tolerance),
          change, steps);
  }
  s.seconds.solve = stage.lap();
  s.u(ordering.dof) = x;
  s.lambda = lambda;
  for (Eigen::Index i = 0; i < c; ++i) s.active.push_back(lambda(i) > 0);
  s.p = problem.b * s.u / problem.compliance;
  s.counters.unknowns = problem.free_count();
  s.counters.factorisations = 1;
  s.counters.solves = solve.runs;
  s.counters.contact_iterations = static_cast<int>(s.history.size());
  check_kkt(problem, s);
  return s;
}

}  // namespace antilock
