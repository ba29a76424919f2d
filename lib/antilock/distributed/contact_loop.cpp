#include "antilock/distributed/contact_loop.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ctime>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {
namespace {

constexpr double inner = 1e-4;   // conjugate gradients: what they leave of a correction, in the energy norm
constexpr int most_sets = 2000;  // contact sets tried

double largest_entry(Vec v) {
  PetscReal value = 0;
  ok(VecNorm(v, NORM_INFINITY, &value));
  return value;
}

/// K with the rows and columns of the contact set replaced by delta^-1 times the identity, and its multigrid.
class HeldSystem {
 public:
  HeldSystem(const DistributedProblem& problem, bool direct) : problem_(problem) {
    ok(MatDuplicate(problem.k(), MAT_DO_NOT_COPY_VALUES, &held_));
    ok(KSPCreate(PETSC_COMM_WORLD, &solver_)), ok(KSPSetFromOptions(solver_));
    if (!direct) return;
    PC factor = nullptr;
    ok(KSPGetPC(solver_, &factor)), ok(PCSetType(factor, PCCHOLESKY));
    ok(PCFactorSetMatSolverType(factor, MATSOLVERMUMPS));
  }
  /// Holds the rows of the set; moves what they do to the others (K times `jump`) to the right-hand side.
  void hold(const std::vector<PetscInt>& rows, Vec jump, Vec rhs) {
    ok(MatCopy(problem_.k(), held_, SAME_NONZERO_PATTERN));
    ok(MatZeroRowsColumns(held_, static_cast<PetscInt>(rows.size()), rows.data(), 1 / problem_.delta(), jump, rhs));
    ok(KSPSetOperators(solver_, held_, held_));
  }
  void set_up() { ok(KSPSetUp(solver_)); }
  /// Conjugate gradients with an incomplete factor of each rank's own rows. They stand column by column, so it is exact
  /// along a column of the layer. Where there is no such factor, du is 0.
  void smooth(Vec rhs, Vec du, int iterations) {
    LinearSolver smoother;
    PC factor = nullptr;
    ok(KSPCreate(PETSC_COMM_WORLD, &smoother)), ok(KSPSetType(smoother, KSPCG)), ok(KSPGetPC(smoother, &factor));
    ok(PCSetType(factor, PCBJACOBI)), ok(KSPSetOperators(smoother, held_, held_));
    ok(KSPSetTolerances(smoother, 0, 1e-300, PETSC_DEFAULT, iterations)), ok(KSPSolve(smoother, rhs, du));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    ok(KSPGetConvergedReason(smoother, &reason));
    if (reason < 0 && reason != KSP_DIVERGED_ITS) ok(VecSet(du, 0));
  }
  /// The iterations that it took. Throws NotConverged.
  int solve(Vec rhs, Vec du, int most) {
    ok(KSPSetTolerances(solver_, inner, 1e-300, PETSC_DEFAULT, most));
    ok(KSPSolve(solver_, rhs, du));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    ok(KSPGetConvergedReason(solver_, &reason)), ok(KSPGetIterationNumber(solver_, &iterations));
    if (reason < 0) {
      PetscReal left = 0;
      ok(KSPGetResidualNorm(solver_, &left));
      throw NotConverged(fmt::format("petsc: conjugate gradients gave up after {} iterations ({}), residual {:.1e}",
                                     iterations, KSPConvergedReasons[reason], left),
                         left, static_cast<int>(iterations));
    }
    return static_cast<int>(iterations);
  }

 private:
  const DistributedProblem& problem_;
  Matrix held_;
  LinearSolver solver_;
};

}  // namespace

State zero_state(const DistributedProblem& problem) {
  return {Eigen::VectorXd::Zero(problem.part().size()), Eigen::VectorXd::Zero(problem.part().m.size()),
          std::vector<char>(problem.rows().owned(), 0)};
}

LoopReport contact_loop(const DistributedProblem& problem, State& state, const LoopOptions& options) {
  const DofMap& rows = problem.rows();
  const Eigen::VectorXd& lower = problem.lower();
  const Vector u = rows.vector(), r1 = rows.vector(), rhs = rows.vector(), du = rows.vector(), jump = rows.vector();
  rows.owned_part(state.u, u);
  state.u = rows.local(u);
  rows.summed(rows.unclamped(problem.part().load), rhs);  // a clamp bears any
  const double load = largest_entry(rhs);
  HeldSystem system(problem, options.direct);
  LoopReport report;
  Stopwatch watch;
  const std::clock_t before = std::clock();
  for (int step = 0, since_change = 0;; ++step, ++since_change) {
    const Eigen::VectorXd r1_part = problem.equilibrium(state.u, state.p), r2 = problem.compatibility(state.u, state.p);
    rows.summed(r1_part, r1);
    rows.summed(problem.right_side(r1_part, r2), rhs);

    // the contact set that (u, lambda = -r1) proposes: kept where it presses, entered where u is below the bound
    std::vector<PetscInt> held;
    double scale = 0, unbalanced = 0, force = load;
    long long changed = 0;
    {
      Entries value(u), residual(r1), gap(jump);
      for (int i = 0; i < rows.owned(); ++i) {
        const bool was = state.active[i] != 0;
        const bool is = std::isfinite(lower(i)) && (step == 0 ? was : was ? residual[i] < 0 : value[i] < lower(i));
        changed += is != was;
        state.active[i] = is ? 1 : 0;
        gap[i] = is ? lower(i) - value[i] : 0;
        scale = std::max(scale, std::abs(value[i]));
        if (!is) unbalanced = std::max(unbalanced, std::abs(residual[i]));
        if (!is) continue;
        force = std::max(force, std::abs(residual[i]));
        held.push_back(rows.first() + i);
      }
    }
    changed = sum(changed);
    const Progress now{"corrections", step, step > 0 ? report.change : 1, options.tolerance};
    const bool stop = options.progress && !options.progress(now);
    if (largest(stop ? 1 : 0) > 0) antilock::notify_or_throw([](const Progress&) { return false; }, now, "petsc");
    scale = largest(scale), force = largest(force), unbalanced = largest(unbalanced);
    if (force > 0) unbalanced /= force;
    if (changed > 0) ++report.set_changes, since_change = 0;
    const bool settled = report.change <= options.tolerance && unbalanced <= options.residual;
    if (step > 0 && changed == 0 && settled) break;
    if (!std::isfinite(scale + unbalanced) || since_change > options.max_corrections || report.set_changes > most_sets)
      throw NotConverged(
          fmt::format("petsc: relative change {:.1e} and residual {:.1e} after {} corrections and {} contact "
                      "sets, asked for {:.1e} and {:.1e}",
                      report.change, unbalanced, step, report.set_changes, options.tolerance, options.residual),
          std::max(report.change, unbalanced), step);

    watch.lap();
    const bool new_set = step == 0 || changed > 0, smooth = step == 0 && options.smoothings > 0;
    if (new_set) system.hold(held, jump, rhs);
    {
      Entries right(rhs);  // solved for inexactly, the known du on the set would be off; so it is added afterwards
      for (const PetscInt row : held) right[row - rows.first()] = 0;
    }
    const bool due = !smooth && (new_set || report.setups == 0);
    if (due) system.set_up();
    report.setups += due;
    report.seconds_setup += watch.lap();
    if (smooth) system.smooth(rhs, du, options.smoothings);
    const int iterations = smooth ? 0 : system.solve(rhs, du, options.max_iterations);
    report.linear_iterations += iterations;
    report.max_iterations = std::max(report.max_iterations, iterations);
    ++report.corrections;
    ok(VecAXPY(du, 1, jump)), ok(VecAXPY(u, 1, du));
    const Eigen::VectorXd step_here = rows.local(du);
    state.u += step_here;
    state.p += problem.stress_step(step_here, r2);
    const double moved = largest_entry(du), size = largest_entry(u);
    report.change = size > 0 ? moved / size : 0;
    report.seconds_solve += watch.lap();
  }
  report.processor = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  return report;
}

}  // namespace antilock::distributed
