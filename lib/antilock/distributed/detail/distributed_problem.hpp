#pragma once

#include "antilock/distributed/detail/dof_map.hpp"
#include "antilock/distributed/detail/petsc.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock::distributed {

/// The choice of delta in A_delta = A1 + delta^-1 B' M B. serial_default is the rule of
/// problem/choose_penalty.hpp over all ranks, for a solver that uses A_delta alone.
/// distributed_default is 1/64 of it, for the contact loop: conjugate gradients do not have the
/// round-off of a factor (measured at 8.4 million unknowns: 59 iterations with 6e-8, 14 with 1e-9).
/// none is the compliance itself, however small, as in most codes: for comparisons.
/// mesh_width is (h / H)^2 / 256 for a layer without columns, and at least distributed_default. h^2
/// is the mean square of the shortest edge of a triangle of the layer, and H is the depth of the
/// layer. A delta far below h^2 makes the contact set change more often (measured before the
/// contact loop compared forces with the error of its solves, at 114,944 unknowns with 1e-6, 4e-8
/// and 1e-9: 1, 1 and 4 changes, 23, 22 and 41 iterations; at 460,288 unknowns with 1e-9 the set
/// did not settle). A delta near h^2 needs more corrections.
enum class PenaltyChoice { distributed_default, serial_default, none, mesh_width };

/// The problem of the class (6) (problem/variational_inequality.hpp). Each rank has the part of its
/// own triangles: A1, B, M and L of its subdomain, assembled by the forms of the library. The forms
/// of the whole problem are sums over the ranks. Only A_delta is assembled as a matrix of all
/// ranks.
class DistributedProblem {
 public:
  /// `space` is a space on the subdomain of this rank. Every rank must call it. Throws Error, on
  /// every rank, where scene and mesh do not fit, or a load or a gap is not finite.
  DistributedProblem(const Scene& scene, const Space& space,
                     PenaltyChoice penalty = PenaltyChoice::distributed_default);

  /// The forms and the load of the subdomain. rows() and lower() replace its lists of prescribed
  /// and contact unknowns, because a vertex may be on a boundary edge of another subdomain only.
  const VariationalInequality& part() const { return part_; }
  /// The space on the subdomain of this rank.
  const Space& space() const { return space_; }
  const DofMap& rows() const { return rows_; }
  /// N x N: A_delta, in which clamped rows have only their diagonal.
  const Matrix& k() const { return k_; }
  double delta() const { return delta_; }  ///< not below the compliance
  /// Per owned row: the bound, -infinity where there is none.
  const Eigen::VectorXd& lower() const { return lower_; }

  /// Returns r1 = L - A1 u - B' M p, the part of this rank, which is 0 at the clamped unknowns. u
  /// has a value per unknown of the subdomain, p one per row of B there.
  Eigen::VectorXd equilibrium(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const {
    return rows_.unclamped(part_.load - part_.a1 * u -
                           part_.b.transpose() * part_.m.cwiseProduct(p));
  }
  /// Returns r2 = compliance p - B u, whose rows belong to one rank each.
  Eigen::VectorXd compatibility(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const {
    return part_.compliance * p - part_.b * u;
  }
  /// Returns the right-hand side r1 + delta^-1 B' M r2 of A_delta du, the part of this rank.
  Eigen::VectorXd right_side(const Eigen::VectorXd& r1, const Eigen::VectorXd& r2) const {
    return rows_.unclamped(r1 + part_.b.transpose() * part_.m.cwiseProduct(r2) / delta_);
  }
  /// Returns the correction dp = (B du - r2) / delta of p.
  Eigen::VectorXd stress_step(const Eigen::VectorXd& du, const Eigen::VectorXd& r2) const {
    return (part_.b * du - r2) / delta_;
  }

 private:
  void sum_k(SparseMatrix part);
  Space space_;
  VariationalInequality part_;
  DofMap rows_;
  Matrix k_;
  double delta_ = 1;
  Eigen::VectorXd lower_;
};

}  // namespace antilock::distributed
