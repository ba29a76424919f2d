#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "antilock/core/eigen_memory.hpp"
#include "antilock/solve/bound_status.hpp"

namespace antilock {

/// Numbers that measure how well a solution satisfies the KKT conditions of the inequality. All are
/// relative. kkt.hpp defines them and their scales.
struct Kkt {
  double min_gap = 0;  ///< the smallest distance from a bound; >= 0 up to round-off
  /// The smallest force, positive in the direction in which its bound can push; >= 0 up to
  /// round-off.
  double min_pressure = 0;
  double complementarity = 0;  ///< the largest |force times distance| of a bound
  /// The larger one of the residuals of A1 u + B' M p = L + E' lambda and of compliance p = B u.
  double residual = 0;
};

/// The operations of a solve. They are counted so that a test can assert that a layer or a contact
/// which a scene does not contain costs nothing.
struct Counters {
  int unknowns = 0;            ///< free unknowns
  int factorisations = 0;      ///< numeric sparse Cholesky factorisations (or ILUT)
  int solves = 0;              ///< sparse triangular solves (or CG runs)
  int contact_iterations = 0;  ///< active sets tried in one correction, or Uzawa steps
  int corrections = 0;         ///< corrections of the iterated penalty after the first solve
};

struct SolveSeconds {
  double analyse = 0, factor = 0, contact = 0, solve = 0;  ///< wall seconds by stage
  double total() const { return analyse + factor + contact + solve; }
};

/// The result of a solver.
struct Solution {
  std::string solver;
  Eigen::VectorXd u;  ///< N, the prescribed unknowns included
  /// R: the multiplier compliance^-1 B u (in a layer its stress), finite at compliance = 0.
  Eigen::VectorXd p;
  /// C contact forces, >= 0 at a lower bound and <= 0 at an upper one. measure/ turns them into
  /// densities.
  Eigen::VectorXd lambda;
  BoundStatuses status;      ///< C; empty where the solver has no statuses
  std::vector<bool> active;  ///< C: in contact with either bound, is_active(status[i])
  /// The largest |u| of the problem with the penalty delta in place of a smaller compliance. It
  /// serves as the size that u has without locking. 0 where it is not known.
  double penalised_max_u = 0;
  /// The estimated forward error of u: the largest |u - exact u| over the largest |u|, where exact
  /// u solves the discrete problem. It is the sum of five terms: the corrections to come, with the
  /// measured contraction; the residual of B u = compliance p; the two errors of
  /// add_conditioning_error (forward_error.hpp); and eps / 2 for the rounding of u to doubles. It
  /// is 0 where there is no estimate, or where the other four terms are 0. It assumes that the
  /// contact set is right, and does not contain the error that Uzawa's steps leave.
  ///
  /// It is an estimate. Of 24,000 random problems one had 15 times the estimated error, and all
  /// others at most 10 times; the worst known case has 24 times. It exceeds the tolerance where u
  /// has locked to less than 2e-6 of penalised_max_u, because 1e-10 of such a u is below the
  /// round-off of the unlocked one. It is infinite where u is 0 and something is left to correct.
  double error = 0;
  Kkt kkt;
  Counters counters;
  SolveSeconds seconds;
  std::vector<double> history;  ///< relative change in each correction, or Uzawa step
  std::string warning;          ///< empty, or one line with the reason to distrust the solution
};

}  // namespace antilock
