#include "antilock/distributed/contact_loop.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ctime>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {
namespace {

constexpr double inner =
    1e-4;  // conjugate gradients: what they leave of a correction, in the energy norm
constexpr int most_sets = 2000;  // contact sets tried

double largest_entry(Vec v) {
  PetscReal value = 0;
  ok(VecNorm(v, NORM_INFINITY, &value));
  return value;
}

/// K with the rows and columns of the contact set replaced by delta^-1 times the identity, and its
/// multigrid.
class HeldSystem {
 public:
  HeldSystem(const DistributedProblem& problem, bool direct) : problem_(problem) {
    ok(MatDuplicate(problem.k(), MAT_DO_NOT_COPY_VALUES, &held_));
    ok(KSPCreate(PETSC_COMM_WORLD, &solver_));
    ok(KSPSetFromOptions(solver_));
    if (!direct) return;
    PC factor = nullptr;
    ok(KSPGetPC(solver_, &factor));
    ok(PCSetType(factor, PCCHOLESKY));
    ok(PCFactorSetMatSolverType(factor, MATSOLVERMUMPS));
  }
  /// Holds the rows of the set; moves what they do to the others (K times `jump`) to the right-hand
  /// side.
  void hold(const std::vector<PetscInt>& rows, Vec jump, Vec rhs) {
    ok(MatCopy(problem_.k(), held_, SAME_NONZERO_PATTERN));
    ok(MatZeroRowsColumns(held_, static_cast<PetscInt>(rows.size()), rows.data(),
                          1 / problem_.delta(), jump, rhs));
    ok(KSPSetOperators(solver_, held_, held_));
  }
  void set_up() { ok(KSPSetUp(solver_)); }
  /// Conjugate gradients with an incomplete factor of each rank's own rows. They stand column by
  /// column, so it is exact along a column of the layer. Where there is no such factor, du is 0.
  void smooth(Vec rhs, Vec du, int iterations) {
    LinearSolver smoother;
    PC factor = nullptr;
    ok(KSPCreate(PETSC_COMM_WORLD, &smoother));
    ok(KSPSetType(smoother, KSPCG));
    ok(KSPGetPC(smoother, &factor));
    ok(PCSetType(factor, PCBJACOBI));
    ok(KSPSetOperators(smoother, held_, held_));
    ok(KSPSetTolerances(smoother, 0, 1e-300, PETSC_DEFAULT, iterations));
    ok(KSPSolve(smoother, rhs, du));
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
    ok(KSPGetConvergedReason(solver_, &reason));
    ok(KSPGetIterationNumber(solver_, &iterations));
    if (reason < 0) {
      PetscReal left = 0;
      ok(KSPGetResidualNorm(solver_, &left));
      throw NotConverged(
          fmt::format(
              "petsc: conjugate gradients gave up after {} iterations ({}), residual {:.1e}",
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

/// The contact set of this rank and how far the iterate is from a solution: the largest values over
/// all ranks.
struct ContactStep {
  std::vector<PetscInt> held;  ///< rows of the set, those of this rank
  long long changed = 0;       ///< rows that entered or left the set, of all ranks
  double scale = 0;            ///< the largest |u|
  double unbalanced = 0;       ///< the largest |r1| off the set, relative to the largest force
};

/// The loop and its iterate (u, p). The formulas are those of contact_loop.
class ContactLoop {
 public:
  ContactLoop(const DistributedProblem& problem, State& state, const LoopOptions& options)
      : problem_(problem),
        rows_(problem.rows()),
        state_(state),
        options_(options),
        u_(rows_.vector()),
        r1_(rows_.vector()),
        rhs_(rows_.vector()),
        du_(rows_.vector()),
        jump_(rows_.vector()),
        system_(problem, options.direct) {
    rows_.owned_part(state.u, u_);
    state.u = rows_.local(u_);
    rows_.summed(rows_.unclamped(problem.part().load), rhs_);  // a clamp bears any
    load_ = largest_entry(rhs_);
  }

  LoopReport run() {
    int since_change = 0;
    for (int step = 0;; ++step, ++since_change) {
      const Eigen::VectorXd r2 = compute_residuals();
      const ContactStep set = propose_set(step == 0);
      notify(step);
      if (set.changed > 0) {
        ++report_.set_changes;
        since_change = 0;
      }
      if (step > 0 && set.changed == 0 && is_settled(set)) return report_;
      require_progress(set, step, since_change);
      correct(set, r2, step == 0);
    }
  }

 private:
  /// Sets r1 and the right-hand side. Returns r2, the part of this rank.
  Eigen::VectorXd compute_residuals() {
    const Eigen::VectorXd r1_part = problem_.equilibrium(state_.u, state_.p);
    Eigen::VectorXd r2 = problem_.compatibility(state_.u, state_.p);
    rows_.summed(r1_part, r1_);
    rows_.summed(problem_.right_side(r1_part, r2), rhs_);
    return r2;
  }

  /// The contact set that (u, lambda = -r1) proposes: kept where it presses, entered where u is
  /// below the bound. The first set is that of the start. `jump` becomes bound - u on the set.
  ContactStep propose_set(bool first) {
    const Eigen::VectorXd& lower = problem_.lower();
    ContactStep set;
    double force = load_;
    {
      Entries value(u_);
      Entries residual(r1_);
      Entries gap(jump_);
      for (int i = 0; i < rows_.owned(); ++i) {
        const bool was = state_.active[i] != 0;
        const bool presses = residual[i] < 0;
        const bool is_below = value[i] < lower(i);
        bool is = was ? presses : is_below;
        if (first) is = was;
        if (!std::isfinite(lower(i))) is = false;
        set.changed += is != was;
        state_.active[i] = is ? 1 : 0;
        gap[i] = is ? lower(i) - value[i] : 0;
        set.scale = std::max(set.scale, std::abs(value[i]));
        if (is) {
          force = std::max(force, std::abs(residual[i]));
          set.held.push_back(rows_.first() + i);
        } else {
          set.unbalanced = std::max(set.unbalanced, std::abs(residual[i]));
        }
      }
    }
    set.changed = sum(set.changed);
    set.scale = largest(set.scale);
    force = largest(force);
    set.unbalanced = largest(set.unbalanced);
    if (force > 0) set.unbalanced /= force;
    return set;
  }

  /// Reports to the hook. One rank that stops stops all of them: each must throw.
  void notify(int step) const {
    const double reached = step > 0 ? report_.change : 1;
    const Progress now{"corrections", step, reached, options_.tolerance};
    const bool stop = options_.progress && !options_.progress(now);
    if (largest(stop ? 1 : 0) > 0)
      antilock::notify_or_throw([](const Progress&) { return false; }, now, "petsc");
  }

  bool is_settled(const ContactStep& set) const {
    return report_.change <= options_.tolerance && set.unbalanced <= options_.residual;
  }

  void require_progress(const ContactStep& set, int step, int since_change) const {
    const bool finite = std::isfinite(set.scale + set.unbalanced);
    if (finite && since_change <= options_.max_corrections && report_.set_changes <= most_sets)
      return;
    throw NotConverged(
        fmt::format(
            "petsc: relative change {:.1e} and residual {:.1e} after {} corrections and {} contact "
            "sets, asked for {:.1e} and {:.1e}",
            report_.change, set.unbalanced, step, report_.set_changes, options_.tolerance,
            options_.residual),
        std::max(report_.change, set.unbalanced), step);
  }

  /// Sets up the system on the set where it is due, and solves for du off the set, where the known
  /// du is added afterwards: solved for inexactly, it would be off.
  void solve_on_set(const ContactStep& set, bool first) {
    const bool new_set = first || set.changed > 0;
    const bool smooth = first && options_.smoothings > 0;
    if (new_set) system_.hold(set.held, jump_, rhs_);
    {
      Entries right(rhs_);
      for (const PetscInt row : set.held) right[row - rows_.first()] = 0;
    }
    if (!smooth && (new_set || report_.setups == 0)) {
      system_.set_up();
      ++report_.setups;
    }
    report_.seconds_setup += watch_.lap();
    int iterations = 0;
    if (smooth)
      system_.smooth(rhs_, du_, options_.smoothings);
    else
      iterations = system_.solve(rhs_, du_, options_.max_iterations);
    report_.linear_iterations += iterations;
    report_.max_iterations = std::max(report_.max_iterations, iterations);
    ++report_.corrections;
  }

  /// Corrects u and p.
  void correct(const ContactStep& set, const Eigen::VectorXd& r2, bool first) {
    watch_.lap();
    solve_on_set(set, first);
    ok(VecAXPY(du_, 1, jump_));
    ok(VecAXPY(u_, 1, du_));
    const Eigen::VectorXd du_here = rows_.local(du_);
    state_.u += du_here;
    state_.p += problem_.stress_step(du_here, r2);
    const double moved = largest_entry(du_);
    const double size = largest_entry(u_);
    report_.change = size > 0 ? moved / size : 0;
    report_.seconds_solve += watch_.lap();
  }

  const DistributedProblem& problem_;
  const DofMap& rows_;
  State& state_;
  const LoopOptions& options_;
  Vector u_;
  Vector r1_;
  Vector rhs_;
  Vector du_;
  Vector jump_;  ///< bound - u on the contact set, 0 off it
  HeldSystem system_;
  double load_ = 0;  ///< the largest entry of the load
  LoopReport report_;
  Stopwatch watch_;
};

}  // namespace

State zero_state(const DistributedProblem& problem) {
  return {Eigen::VectorXd::Zero(problem.part().size()),
          Eigen::VectorXd::Zero(problem.part().m.size()),
          std::vector<char>(problem.rows().owned(), 0)};
}

LoopReport contact_loop(const DistributedProblem& problem, State& state,
                        const LoopOptions& options) {
  ContactLoop loop(problem, state, options);
  const std::clock_t before = std::clock();
  LoopReport report = loop.run();
  report.processor = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  return report;
}

}  // namespace antilock::distributed
