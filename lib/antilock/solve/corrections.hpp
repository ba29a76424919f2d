#pragma once
#include <string>

#include "antilock/solve/anderson.hpp"
#include "antilock/solve/iterated_penalty.hpp"
#include "antilock/solve/kkt.hpp"

namespace antilock {

/// The loop of the iterated penalty, one member function per step:
///
///     loop: rescue (where it has not settled in time), residual, correct, and out if settled; else accelerate
///
/// For one solve; `problem` and `factor` must outlive it.
class Corrections {
 public:
  Corrections(const VariationalInequality& problem, PenaltyFactor& factor, const CorrectionOptions& options,
              std::string name);

  /// Runs the loop. Throws NotConverged.
  Solution solve(const ContactSolver& contact);

 private:
  /// What a correction changed.
  struct Change {
    Eigen::VectorXd u, p;      ///< N, R
    bool same_contact = true;  ///< the contact set is the one of the correction before
  };

  /// Changes the means where they have not been enough for `patience` corrections (rescue.cpp).
  void rescue();
  /// r1, r2 with the forces known so far, in double, or in long double where that has been found necessary.
  SplitResidual residual() const;
  /// K du = r1 + delta^-1 B' M r2 + dlambda on the free places, dp; u, p and the contact forces follow.
  Change correct(SplitResidual r, const ContactSolver& contact);
  /// Whether u is right to the tolerance, judged by the change, and compliance p = B u holds.
  bool settled(const Change& change);
  /// Whether a bound, or a row of B u = compliance p, is violated by more than the round-off of the forces explains.
  /// What is large elsewhere hides neither. Asks for a solve only where something looks wrong.
  bool hides_a_violation(const Change& change, const ContactSolver& contact);
  /// Throws NotConverged where no u meets the bounds, the prescribed values and B u = 0: the same problem without its
  /// load, beside which a violation may be less than round-off.
  void require_an_admissible_u(const ContactSolver& contact);
  /// Whether a locked u, which tends to 0, has come down to its round-off: du no longer falls, and the round-off of the
  /// forces explains it, and the report would not refuse it. Leaves a warning where u has fewer than nine digits left.
  bool drowned(const Change& change);
  bool zero_is_admissible() const;
  /// What the round-off of the forces, all of one sign, would displace: K^-1 (64 eps (|L| + |A1| |u| + |B'| M |p|)).
  void note_round_off();
  /// Anderson's mix of the last corrections: the start of the next.
  void accelerate();
  /// The KKT report of u, p and the contact forces as they are.
  void report_conditions();
  /// What the counters and the report say of the answer.
  Solution finished();

  void refactor(double delta);
  /// du on all unknowns, with the contact problem on Gamma_C solved on the way.
  Eigen::VectorXd solve_with_factor(Eigen::VectorXd r, const ContactSolver& contact);
  /// The same on the sparse road.
  Eigen::VectorXd solve_holding(Eigen::VectorXd r, const ContactSolver& contact);

  const VariationalInequality& problem_;
  PenaltyFactor& factor_;
  const CorrectionOptions options_;
  Solution s_;                      ///< u, p and what is counted
  ContactAnswer contact_;           ///< of the last correction: forces, contact set
  const Eigen::VectorXd row_sums_;  ///< R, absolute_row_sums of B
  Eigen::MatrixXd schur_;           ///< C x C, S = L_C L_C', of the factor as it is now; empty on the sparse road
  Anderson acceleration_{6};        ///< the past that the mix and the contraction are read from
  int correction_ = 0;
  int since_rescue_ = 0;      ///< corrections with the means as they are
  bool long_double_ = false;  ///< residuals in long double
  double least_delta_ = 0;    ///< of which a factor is known; a smaller one lost its pivots
  Eigen::VectorXd
      noise_;  ///< N, the least round-off noted so far (that of an infeasible problem grows); empty at first
  Eigen::VectorXd noise_c_;  ///< C, what the contact problem is told of it
  double u_first_ = 0;       ///< max |u| after the first correction: its size before it locks
  double u_scale_ = 0;       ///< what is large for u
  double error_ = 1;         ///< estimated relative error of u left behind
  double gap_ = 1;           ///< to which compliance p = B u holds, in units of strain
};

}  // namespace antilock
