#pragma once
#include "antilock/solve/contact.hpp"
#include "antilock/solve/sparse_cholesky.hpp"

namespace antilock {

/// A contact problem condensed on its C bounded unknowns: S v = q + lambda, where S is the Schur
/// complement of the bounded unknowns in the whole matrix (static condensation). S is dense.
class SchurComplementContact final : public ContactSystem {
 public:
  /// s is C x C, and q has C entries. Both must outlive this object.
  SchurComplementContact(const Eigen::MatrixXd& s, const Eigen::VectorXd& q);

  FixedStatusSolution solve(const std::vector<char>& active,
                            const Eigen::VectorXd& prescribed) override;
  double energy_norm_squared(const Eigen::VectorXd& d) const override { return d.dot(s_ * d); }
  /// Solves the problem in which only every second unknown is bounded, recursively down to one
  /// bound, and transfers the statuses (coarse_start). With it the number of iterations hardly
  /// depends on the mesh width. The unknowns whose bounds are left out become free and are
  /// condensed out. So the S of the smaller problem is exact, also for a bending energy. The matrix
  /// P' S P, where P interpolates linearly between every second unknown, would be far too stiff for
  /// a beam, because interpolated functions have kinks and the bending energy of a kink is
  /// infinite.
  BoundStatuses nested_start(const ShiftedBounds& bounds, int max_iterations) override;

  const Eigen::MatrixXd& s() const { return s_; }
  const Eigen::VectorXd& q() const { return q_; }

 private:
  const Eigen::MatrixXd& s_;  ///< C x C
  const Eigen::VectorXd& q_;  ///< C
};

/// A contact problem on all n_free unknowns of a sparse matrix K, for many bounds. For every active
/// set K is factored on the unknowns that are not active.
class SparseContact final : public ContactSystem {
 public:
  /// q: n_free entries; bounded: the C positions of the bounded unknowns in K. k and q must outlive
  /// this object.
  SparseContact(ConstrainedCholesky& k, const Eigen::VectorXd& q, std::vector<int> bounded)
      : ContactSystem(std::move(bounded)), k_(k), q_(q) {}

  FixedStatusSolution solve(const std::vector<char>& active,
                            const Eigen::VectorXd& prescribed) override;
  double energy_norm_squared(const Eigen::VectorXd& d) const override { return d.dot(k_.times(d)); }
  /// Coarsens K by smoothed aggregation (P. Vanek, J. Mandel, M. Brezina, Computing 56, 1996),
  /// solves the contact problem of the coarse matrix P' K P by the same method, and gives each
  /// bound the status of the aggregates on which its unknown depends, if these agree. Otherwise the
  /// bound is inactive, because an active set that is too small costs less than one that is too
  /// large: missing bounds are added within one or two iterations, but excess bounds are released
  /// one row of cells per iteration. No mesh is needed. (With 65,025 bounds the iteration takes 7
  /// steps from this start, and 30 without the smoothing; measured.) Aggregation supposes that
  /// constant functions have no energy. Constant rotations of beams and plates have energy. For
  /// such a matrix the start is the solution with only every second bound (coarse_start). This is
  /// right for every K, but each of its iterations factors the whole K.
  BoundStatuses nested_start(const ShiftedBounds& bounds, int max_iterations) override;

 private:
  ConstrainedCholesky& k_;
  const Eigen::VectorXd& q_;
};

}  // namespace antilock
