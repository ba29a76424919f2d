#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "antilock/core/eigen_memory.hpp"
#include "antilock/solve/bound_status.hpp"

namespace antilock {

/// How well the conditions of the inequality hold, each relative and scale-free (see kkt.hpp for the scales).
struct Kkt {
  double min_gap = 0;          ///< smallest distance from a bound / scale of u; >= 0 up to round-off
  double min_pressure = 0;     ///< smallest push of a bound / scale of the forces; >= 0 up to round-off
  double complementarity = 0;  ///< largest |push times distance| / (the two scales)
  double residual = 0;  ///< split form: A1 u + B' M p - L - lambda = 0 and compliance p = B u, the larger of the two
};

/// What the solve did: counted, so that a test can assert that an absent effect costs nothing.
struct Counters {
  int unknowns = 0;            ///< solved for: not in dirichlet_dofs
  int factorisations = 0;      ///< numeric sparse Cholesky factorisations (or ILUT)
  int solves = 0;              ///< sparse triangular solves (or CG runs)
  int contact_iterations = 0;  ///< steps of the contact iteration (active sets tried, Uzawa steps)
  int corrections = 0;         ///< corrections of the iterated penalty after the first solve
};

struct SolveSeconds {
  double analyse = 0, factor = 0, contact = 0, solve = 0;  ///< wall seconds by stage
  double total() const { return analyse + factor + contact + solve; }
};

/// The answer of every solver.
struct Solution {
  std::string solver;
  Eigen::VectorXd u;           ///< N, every unknown, the fixed ones too
  Eigen::VectorXd p;           ///< R, the layer stress compliance^-1 B u (finite at compliance = 0), a row of B
  Eigen::VectorXd lambda;      ///< C contact forces, one per bound (a force; measure/ turns it to a density): >= 0 at a
                               ///< lower bound, <= 0 at an upper one
  BoundStatuses status;        ///< C: the status of each bound; empty where the solver knows none
  std::vector<bool> active;    ///< C: in contact, with either bound: is_active(status[i])
  double penalised_max_u = 0;  ///< largest |u| with the penalty in place of the compliance: the size of u before
                               ///< it locks, where it is known (0: it is not)
  /// Forward error of u in the maximum norm, relative to the largest |u|; 0: none is claimed, or there was nothing left
  /// to correct. The sum of what the next corrections would add, with the contraction that was measured, of what is
  /// left of B u = compliance p, and of the rounding of u to doubles, eps / 2. An estimate: of 24,000 random problems
  /// one was off by 15 times what it claims, all others by 10 times at most; the worst that is known, by 24 times. It
  /// is above the tolerance where u has locked to less than 2e-6 of `penalised_max_u`: such a u is the round-off of its
  /// size before. It is infinite where u is 0 and something is left to correct. It holds for the contact set found, and
  /// knows nothing of what Uzawa's steps leave.
  double error = 0;
  Kkt kkt;
  Counters counters;
  SolveSeconds seconds;
  std::vector<double> history;  ///< relative change of every iteration (corrections, or Uzawa steps)
  std::string warning;          ///< empty, or one line: how far above the trusted level the KKT report is
};

}  // namespace antilock
