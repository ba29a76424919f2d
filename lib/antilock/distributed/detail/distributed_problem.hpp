#pragma once

#include "antilock/distributed/detail/dof_map.hpp"
#include "antilock/distributed/detail/petsc.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock::distributed {

/// delta of A_delta, by the rule of problem/choose_penalty.hpp over all ranks. One 64th of it for the contact loop:
/// conjugate gradients leave no round-off of a factor (measured at 8.4 million unknowns: with 6e-8 59 iterations, with
/// 1e-9 14). The rule's own for a solver that sees A_delta alone. The compliance itself, however small, as in most
/// codes: for exhibits.
enum class PenaltyChoice { distributed_default, serial_default, none };

/// The class's problem (6), each rank with the part of its own triangles: a1, B, M and L of the subdomain, assembled
/// by the library's forms. Whole forms are sums over the ranks; only A_delta = A1 + delta^-1 B' M B is ever a matrix
/// of all ranks.
class DistributedProblem {
 public:
  /// `space`: on the subdomain of this rank. Every rank must call it. Throws Error, on every rank, where scene and
  /// mesh do not fit or a load or a gap is not finite.
  DistributedProblem(const Scene& scene, const Space& space,
                     PenaltyChoice penalty = PenaltyChoice::distributed_default);

  const VariationalInequality& part() const { return part_; }  ///< without fixed and contact unknowns
  const DofMap& rows() const { return rows_; }
  const Matrix& k() const { return k_; }                   ///< N x N, clamped rows with their diagonal alone
  double delta() const { return delta_; }                  ///< the compliance at least
  const Eigen::VectorXd& lower() const { return lower_; }  ///< per owned row: the bound, -infinity where there is none

  /// r1 = L - A1 u - B' M p, the part of this rank; 0 at the clamped unknowns. u at the unknowns of the subdomain, p
  /// at its rows of B.
  Eigen::VectorXd equilibrium(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const {
    return rows_.unclamped(part_.load - part_.a1 * u - part_.b.transpose() * part_.m.cwiseProduct(p));
  }
  /// r2 = compliance p - B u; never shared.
  Eigen::VectorXd compatibility(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const {
    return part_.compliance * p - part_.b * u;
  }
  /// A correction of both: A_delta du = r1 + delta^-1 B' M r2, the part of this rank,
  Eigen::VectorXd right_side(const Eigen::VectorXd& r1, const Eigen::VectorXd& r2) const {
    return rows_.unclamped(r1 + part_.b.transpose() * part_.m.cwiseProduct(r2) / delta_);
  }
  /// and dp = (B du - r2) / delta.
  Eigen::VectorXd stress_step(const Eigen::VectorXd& du, const Eigen::VectorXd& r2) const {
    return (part_.b * du - r2) / delta_;
  }

 private:
  void sum_k(SparseMatrix part);
  VariationalInequality part_;
  DofMap rows_;
  Matrix k_;
  double delta_ = 1;
  Eigen::VectorXd lower_;
};

}  // namespace antilock::distributed
