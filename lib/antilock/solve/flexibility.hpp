#pragma once
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/penalised_cholesky.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// A problem condensed on its C bounded values s = bounded_values(u) (problem/bounds.hpp). Without
/// the bounds themselves, forces lambda (C) at them lead to
///
///     s = w + F lambda
///
/// F is the flexibility matrix of the bounds, symmetric and positive semidefinite. A locked problem
/// at compliance 0 has F = 0.
struct Flexibility {
  Eigen::VectorXd w;  ///< C
  Eigen::MatrixXd f;  ///< C x C
  /// C: the largest |u| by the force 1 at bound i, with the penalty delta in place of a smaller
  /// compliance. It is the size that column i of F has without locking.
  Eigen::VectorXd unlocked;
  Solution free;  ///< the solution without bounds and forces

  /// Returns whether no force moves s_i: F_ii is below 1e-12 of unlocked_i. F is known to about
  /// 2e-16 of it (ForwardError), so that a larger F_ii has three digits.
  bool is_fixed(Eigen::Index i) const { return !(f(i, i) > 1e-12 * unlocked(i)); }
};

/// Solves a problem without its bounds, for given forces at them: a linear problem, by the iterated
/// penalty method (active_set.hpp).
class LinearResponse {
 public:
  /// `factor` is one of the problem without its bounds (`bounds` is {}). It and
  /// `problem` must outlive this object. Every solve throws as active_set does.
  LinearResponse(const VariationalInequality& problem, PenalisedCholesky& factor,
                 const CorrectionOptions& corrections = {});

  /// Returns u and p for the forces lambda (C), without the KKT conditions of the bounds.
  Solution solve(const Eigen::VectorXd& lambda);
  /// Computes w by one solve, and F by C solves with the forces 1 at one bound each.
  Flexibility flexibility();

 private:
  const VariationalInequality& problem_;
  VariationalInequality linear_;       ///< without bounds
  VariationalInequality homogeneous_;  ///< the same, with prescribed values 0
  PenalisedCholesky& factor_;
  ActiveSetOptions options_;
};

}  // namespace antilock
