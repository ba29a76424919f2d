#pragma once
#include "antilock/solve/contact.hpp"
#include "antilock/solve/sparse_cholesky.hpp"

namespace antilock {

/// A contact problem condensed on its C bounded unknowns: S is dense, and small beside the whole.
class SchurComplementContact final : public ContactSystem {
 public:
  /// Both must outlive it.
  SchurComplementContact(const Eigen::MatrixXd& s, const Eigen::VectorXd& q);

  FixedStatusSolution solve(const std::vector<char>& active, const Eigen::VectorXd& prescribed) override;
  double energy_norm_squared(const Eigen::VectorXd& d) const override { return d.dot(s_ * d); }
  /// Makes the steps independent of h: the same problem, bounded at every second unknown only (the others are free and
  /// eliminated), solved the same way down to one, gives the statuses by interpolation. Elimination keeps every order
  /// of S right; interpolated functions (P' S P) would be far too stiff for a beam, whose bending energy is infinite at
  /// their corners.
  BoundStatuses nested_start(const Bounds& bounds, int max_iterations) override;

  const Eigen::MatrixXd& s() const { return s_; }
  const Eigen::VectorXd& q() const { return q_; }

 private:
  const Eigen::MatrixXd& s_;  ///< C x C
  const Eigen::VectorXd& q_;  ///< C
};

/// A contact problem on all n_free unknowns of a sparse K, for many bounds: K is factored anew with every active set,
/// without the unknowns that are active.
class SparseContact final : public ContactSystem {
 public:
  /// All must outlive it. q: n_free entries; bounded: the C places of the bounded unknowns.
  SparseContact(ConstrainedCholesky& k, const Eigen::VectorXd& q, std::vector<int> bounded)
      : ContactSystem(std::move(bounded)), k_(k), q_(q) {}

  FixedStatusSolution solve(const std::vector<char>& active, const Eigen::VectorXd& prescribed) override;
  double energy_norm_squared(const Eigen::VectorXd& d) const override { return d.dot(k_.times(d)); }
  /// A start that needs no mesh. K is coarsened by smoothed aggregation (Vanek, Mandel, Brezina 1996), the same problem
  /// solved there, in the same way down to one bound, and a bound starts with the status of all groups that its
  /// unknown depends on, where they agree. Rather too small a set than too large: a hole in it is filled in a step or
  /// two, what is too much is given up one row of cells at a time. (Groups without the smoothing take 30 steps in
  /// place of 7 at 65,025 bounds.) Aggregation supposes that constants cost no energy; where they do (beams, plates:
  /// their rotations) every second bound alone is kept, and K stays whole: right for every K, but each of the factors
  /// is of all of it.
  BoundStatuses nested_start(const Bounds& bounds, int max_iterations) override;

 private:
  ConstrainedCholesky& k_;
  const Eigen::VectorXd& q_;
};

}  // namespace antilock
