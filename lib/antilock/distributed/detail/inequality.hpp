#pragma once
#include <optional>

#include "antilock/distributed/detail/petsc.hpp"
#include "antilock/distributed/detail/rows.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock::distributed {

/// The class's problem (6), each rank with the part of its own triangles: a1, B, M and L of the piece, assembled by the
/// library's forms. Whole forms are sums over the ranks; only K = A1 + delta^-1 B' M B is ever a matrix of all ranks.
class Inequality {
 public:
  /// Every rank must call it. Throws Error, on every rank, where scene and mesh do not fit or a load or a gap is not
  /// finite. `summed`: delta is the compliance itself, however small, as in most codes; for exhibits.
  Inequality(const Scene& scene, const MeshPart& piece, const Space& space, bool summed = false);

  const VariationalInequality& part() const { return part_; }  ///< without fixed and contact unknowns
  const Rows& rows() const { return rows_; }
  const Matrix& k() const { return k_; }                   ///< N x N
  double delta() const { return delta_; }                  ///< max(compliance, h^2 / 256): it must follow the mesh
  bool stiff() const { return stiff_; }                    ///< whether any rank has a row of B
  const Eigen::VectorXd& lower() const { return lower_; }  ///< per owned row: the bound, -infinity where there is none

  /// r1 = L - A1 u - B' M p, the part of this rank. u at the unknowns of the piece, p at its rows of B.
  Eigen::VectorXd equilibrium(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const;
  /// r2 = compliance p - B u; never shared.
  Eigen::VectorXd compatibility(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const;

 private:
  void sum_k(const SparseMatrix& part);
  VariationalInequality part_;
  Rows rows_;
  Matrix k_;
  double delta_ = 1;
  bool stiff_ = false;
  Eigen::VectorXd lower_;
};

}  // namespace antilock::distributed
