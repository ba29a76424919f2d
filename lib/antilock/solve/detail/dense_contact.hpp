#pragma once
#include "antilock/solve/contact.hpp"

namespace antilock {

/// A contact problem condensed on its C bounded unknowns: S is dense, and small beside the whole.
class DenseContact final : public ContactSystem {
 public:
  /// Both must outlive it.
  DenseContact(const Eigen::MatrixXd& s, const Eigen::VectorXd& q);

  Equilibrium solve(const std::vector<char>& held, const Eigen::VectorXd& given) override;
  double square(const Eigen::VectorXd& d) const override { return d.dot(s_ * d); }
  /// Makes the steps independent of h: the same problem, bounded at every second unknown only (the others are free and
  /// eliminated), solved the same way down to one, gives the pieces by interpolation. Elimination keeps every order of S
  /// right; interpolated functions (P' S P) would be far too stiff for a beam, whose bending energy does not take their
  /// corners.
  Pieces nested_start(const Stairs& stairs, int max_steps) override;

  const Eigen::MatrixXd& s() const { return s_; }
  const Eigen::VectorXd& q() const { return q_; }

 private:
  const Eigen::MatrixXd& s_;  ///< C x C
  const Eigen::VectorXd& q_;  ///< C
};

}  // namespace antilock
