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

/// x = K^-1 b by the factor asked for (K symmetric, n x n, both triangles given); empty where the
/// factorisation gives up.
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
  static constexpr double cg_tolerance =
      1e-10;  // Eigen stops on the residual relative to the right-hand side
  explicit CgIlut(const SparseMatrix& upper_triangle)
      : a_(upper_triangle.selfadjointView<Eigen::Upper>()) {
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
      throw NotConverged(fmt::format("uzawa, CG + ILUT: the conjugate gradients of linear solve {} "
                                     "stopped at a relative residual of "
                                     "{:.1e} after {} iterations, accepted {:.0e}",
                                     runs, cg_.error(), cg_.iterations(), cg_tolerance),
                         cg_.error(), runs);
    return x;
  }
  int runs = 0;

 private:
  SparseMatrix a_;
  Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper, Eigen::IncompleteLUT<double>>
      cg_;
};

/// The solution x of K x = load + forces of the bounds, with the active unknowns at their lower
/// bounds and no force at the others. It is empty where the factorisation gives up. `k` is K with
/// both triangles.
Eigen::VectorXd solve_with_active(const VariationalInequality& problem, const SummedSystem& system,
                                  const SparseMatrix& k, const std::vector<bool>& active,
                                  SummedFactor kind) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.load.size());
  std::vector<int> inactive;
  for (int i = 0; i < static_cast<int>(x.size()); ++i) {
    const int bound = i - system.ordering.interior;
    if (bound >= 0 && active[bound])
      x(i) = problem.bounds.lower(bound);
    else
      inactive.push_back(i);
  }
  SparseMatrix chosen(x.size(), static_cast<Eigen::Index>(inactive.size()));
  for (std::size_t i = 0; i < inactive.size(); ++i)
    chosen.insert(inactive[i], static_cast<Eigen::Index>(i)) = 1;
  const Eigen::VectorXd rest =
      system.load - system.upper_triangle.selfadjointView<Eigen::Upper>() * x;
  const Eigen::VectorXd x_inactive =
      summed_solve(chosen.transpose() * k * chosen, rest(inactive), kind);
  if (x_inactive.size() == 0) return {};
  x(inactive) = x_inactive;
  return x;
}

/// Sets lambda to the forces of the active bounds. Then releases the active bounds that pull and
/// activates the others that are violated. Returns whether there is none. `x` and `force` have one
/// entry per bound.
bool update_active(Solution& s, const Eigen::VectorXd& lower, const Eigen::VectorXd& x,
                   const Eigen::VectorXd& force) {
  bool converged = true;
  s.lambda.setZero();
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (s.active[i]) s.lambda(i) = force(i);
    const double gap = x(i) - lower(i);
    const bool is_wrong = s.active[i] ? force(i) < 0 : gap < 0;
    if (!is_wrong) continue;
    s.active[i] = !s.active[i];
    converged = false;
  }
  return converged;
}

/// Refuses the options that this method does not have.
void check_options(const UzawaOptions& options, const std::string& who) {
  if (options.step_length && !(*options.step_length > 0))
    throw Error(fmt::format("{}: step_length = {}; accepted: a positive number", who,
                            *options.step_length));
  if (options.stop_at)
    throw Error(who +
                ": options.stop_at needs for the condensed matrix; accepted: tolerance, or the "
                "solver uzawa");
}

/// The step length 1.9 / mu, mu the largest eigenvalue of the compliance of the C bounded unknowns
/// (the last C ones). The estimate of mu is from below, hence 1.9 < 2.
double longest_step(CgIlut& solve, Eigen::Index unknowns, Eigen::Index bounded) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(unknowns);
  const auto compliance = [&](const Eigen::VectorXd& force) {
    Eigen::VectorXd b = zero;
    b.tail(bounded) = force;
    return Eigen::VectorXd(solve(b, zero).tail(bounded));
  };
  return 1.9 / largest_eigenvalue(compliance, bounded, 1e-2, 10);
}

/// An iterate of uzawa_cg_ilut.
struct UzawaIterate {
  Eigen::VectorXd x;       ///< u at the free unknowns
  Eigen::VectorXd lambda;  ///< C
};

/// Iterates lambda <- max(0, lambda - rho (x - lower)), K x = load + lambda, until the step is
/// within the tolerance. Then lambda and x belong together. Appends the relative steps to
/// `history`.
UzawaIterate iterate(CgIlut& solve, const Eigen::VectorXd& load, const Eigen::VectorXd& lower,
                     double rho, const UzawaOptions& options, const Stopwatch& watch,
                     std::vector<double>& history) {
  const Eigen::Index bounded = lower.size();
  UzawaIterate now{Eigen::VectorXd::Zero(load.size()), Eigen::VectorXd::Zero(bounded)};
  while (true) {
    Eigen::VectorXd b = load;
    b.tail(bounded) += now.lambda;
    now.x = solve(b, now.x);
    if (bounded == 0) return now;
    const Eigen::VectorXd gap = now.x.tail(bounded) - lower;
    const Eigen::VectorXd next = (now.lambda - rho * gap).cwiseMax(0.0);
    const double scale = std::max(now.x.cwiseAbs().maxCoeff(), lower.cwiseAbs().maxCoeff());
    const double change = scale > 0 ? (next - now.lambda).cwiseAbs().maxCoeff() / rho / scale : 0;
    history.push_back(change);
    if (change <= options.tolerance) return now;
    now.lambda = next;
    const int steps = static_cast<int>(history.size());
    if (steps >= options.max_iterations || watch.seconds() > options.max_seconds)
      throw NotConverged(fmt::format("uzawa, CG + ILUT: not converged: relative step {:.1e} after "
                                     "{} steps and {:.1f} s, accepted {:.0e}",
                                     change, steps, watch.seconds(), options.tolerance),
                         change, steps);
  }
}

}  // namespace

SummedSystem summed_system(const VariationalInequality& problem, const std::string& who,
                           const char* instead) {
  check(problem);
  require_lower_bounds(problem.bounds, who);
  if (problem.b.rows() > 0 && problem.compliance == 0)
    throw Error(
        fmt::format("{}: the summed matrix does not exist at epsilon = 0; accepted epsilon > 0, or "
                    "the solver {}",
                    who, instead));
  if (problem.fixed_compliances.size() > 0)
    throw Error(fmt::format(
        "{}: rows of B with fixed compliances are not summed; accepted: a problem without them, or "
        "the solver {}",
        who, instead));
  DofOrdering ordering(problem);
  SparseMatrix upper_triangle =
      penalised_matrix(problem, ordering, problem.compliance);  // the sum, and the fault
  Eigen::VectorXd u = Eigen::VectorXd::Zero(problem.size());
  u(problem.dirichlet_dofs) = problem.dirichlet_values;
  Eigen::VectorXd load = problem.load - problem.a1 * u;
  if (problem.b.rows() > 0)
    load -= problem.b.transpose() * problem.m.cwiseProduct(problem.b * u) / problem.compliance;
  load = Eigen::VectorXd(load(ordering.dof));
  return {std::move(ordering), std::move(upper_triangle), std::move(load), std::move(u)};
}

std::string to_string(ConvergedReason reason) {
  return std::array{"settled", "cycled", "refused", "step cap"}[static_cast<std::size_t>(reason)];
}

NaiveResult naive_summed_solve(const VariationalInequality& problem, SummedFactor kind,
                               int max_iterations) {
  const Stopwatch watch;
  const SummedSystem system = summed_system(problem, "naive", "active_set");
  const SparseMatrix k = system.upper_triangle.selfadjointView<Eigen::Upper>();
  const auto bounded = static_cast<Eigen::Index>(problem.bounds.unknowns.size());
  NaiveResult result;
  Solution& s = result.solution;
  s.solver = kind == SummedFactor::cholesky ? "naive, Cholesky of the sum" : "naive, LU of the sum";
  s.u = system.u;
  s.lambda = Eigen::VectorXd::Zero(bounded);
  s.active.assign(bounded, false);

  std::set<std::vector<bool>> tried;
  result.reason = ConvergedReason::max_iterations;
  while (s.counters.contact_iterations < max_iterations) {
    if (!tried.insert(s.active).second) {
      result.reason = ConvergedReason::cycled;
      break;
    }
    const Eigen::VectorXd x = solve_with_active(problem, system, k, s.active, kind);
    ++s.counters.factorisations;
    ++s.counters.solves;
    ++s.counters.contact_iterations;
    if (x.size() == 0) {
      result.reason = ConvergedReason::linear_solve_failed;
      break;
    }
    const Eigen::VectorXd force =
        (system.upper_triangle.selfadjointView<Eigen::Upper>() * x - system.load).tail(bounded);
    const bool converged = update_active(s, problem.bounds.lower, x.tail(bounded), force);
    s.u(system.ordering.dof) = x;
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
  check_options(options, who);
  const Stopwatch watch;
  Stopwatch stage;
  const SummedSystem system = summed_system(problem, who, "uzawa");
  CgIlut solve(system.upper_triangle);
  Solution s;
  s.solver = who;
  s.seconds.factor = stage.lap();
  s.u = system.u;
  const auto bounded = static_cast<Eigen::Index>(problem.bounds.unknowns.size());
  double rho = options.step_length.value_or(0);
  if (!options.step_length && bounded > 0) rho = longest_step(solve, system.load.size(), bounded);

  UzawaIterate last =
      iterate(solve, system.load, problem.bounds.lower, rho, options, watch, s.history);
  s.seconds.solve = stage.lap();
  s.u(system.ordering.dof) = last.x;
  s.lambda = std::move(last.lambda);
  for (Eigen::Index i = 0; i < bounded; ++i) s.active.push_back(s.lambda(i) > 0);
  s.p = problem.b * s.u / problem.compliance;
  s.counters.unknowns = problem.free_count();
  s.counters.factorisations = 1;
  s.counters.solves = solve.runs;
  s.counters.contact_iterations = static_cast<int>(s.history.size());
  check_kkt(problem, s);
  return s;
}

}  // namespace antilock
