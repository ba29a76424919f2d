#pragma once
#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <cmath>

#include "antilock/core/eigenvalues.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/detail/penalised_matrix.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/solve/uzawa.hpp"

namespace antilock::tutorial {

/// A^-1 on the free places by CG + ILUT, the paper's linear step; a run that fails is an exception.
class CgIlut {
 public:
  static constexpr double cg_tolerance = 1e-10;  // Eigen stops on the residual relative to the right-hand side
  explicit CgIlut(const SparseMatrix& upper) : a_(upper.selfadjointView<Eigen::Upper>()) {
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

/// The paper's algorithm with the paper's linear solver (Section 4.2): A1 + compliance^-1 B' M B summed into one
/// matrix, one run of conjugate gradients preconditioned by ILUT a step. Kept to be compared against: the sum loses
/// digits, and ILUT breaks down on stiff meshes that are not aligned with the layer, which is reported, never returned
/// as an answer. Throws Error at compliance = 0, where the sum does not exist, and for options.enough: the duality gap
/// asks for the matrix condensed on Gamma_C.
inline Solution uzawa_cg_ilut(const VariationalInequality& problem, const UzawaOptions& options = {}) {
  check(problem);
  if (options.step && !(*options.step > 0))
    throw Error(fmt::format("uzawa, CG + ILUT: step = {}; accepted: a positive number", *options.step));
  require_lower_bounds(problem, "uzawa, CG + ILUT");
  if (options.enough)
    throw Error(
        "uzawa, CG + ILUT: options.enough asks for the condensed matrix; accepted: tolerance, or the solver uzawa");
  if (problem.b.rows() > 0 && problem.compliance == 0)
    throw Error(
        "uzawa, CG + ILUT: the summed matrix does not exist at epsilon = 0; accepted epsilon > 0, or the solver uzawa");
  Solution s;
  s.solver = "uzawa, CG + ILUT";
  Stopwatch watch, stage;
  const FreeNumbering numbering(problem);
  CgIlut solve(penalised_matrix(problem, numbering, problem.compliance));
  s.seconds.factor = stage.lap();

  // r = L - A u_fixed: what prescribed values leave for the free unknowns
  s.u = Eigen::VectorXd::Zero(problem.size());
  s.u(problem.fixed) = problem.fixed_values;
  Eigen::VectorXd prescribed = problem.load - problem.a1 * s.u;
  if (problem.b.rows() > 0)
    prescribed -= problem.b.transpose() * problem.m.cwiseProduct(problem.b * s.u) / problem.compliance;
  const Eigen::VectorXd load = prescribed(numbering.unknown);
  const auto c = static_cast<Eigen::Index>(problem.contact.size()), f = load.size();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(f);

  double rho = options.step.value_or(0);
  if (!options.step && c > 0) {
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
    const Eigen::VectorXd gap = x.tail(c) - problem.lower;
    const Eigen::VectorXd next = (lambda - rho * gap).cwiseMax(0.0);
    const double scale = std::max(x.cwiseAbs().maxCoeff(), problem.lower.cwiseAbs().maxCoeff());
    const double change = scale > 0 ? (next - lambda).cwiseAbs().maxCoeff() / rho / scale : 0;
    s.history.push_back(change);
    if (change <= options.tolerance) break;  // lambda and x still belong together
    lambda = next;
    const int steps = static_cast<int>(s.history.size());
    if (steps >= options.max_steps || watch.seconds() > options.max_seconds)
      throw NotConverged(
          fmt::format(
              "uzawa, CG + ILUT: not converged: relative step {:.1e} after {} steps and {:.1f} s, accepted {:.0e}",
              change, steps, watch.seconds(), options.tolerance),
          change, steps);
  }
  s.seconds.solve = stage.lap();
  s.u(numbering.unknown) = x;
  s.lambda = lambda;
  for (Eigen::Index i = 0; i < c; ++i) s.active.push_back(lambda(i) > 0);
  s.p = problem.b * s.u / problem.compliance;
  s.counters.unknowns = problem.free_count();
  s.counters.factorisations = 1;
  s.counters.solves = solve.runs;
  s.counters.contact = static_cast<int>(s.history.size());
  certify(problem, s);
  return s;
}

}  // namespace antilock::tutorial
