#pragma once
#include <vector>

#include "antilock/distributed/detail/dof_map.hpp"
#include "antilock/distributed/detail/petsc.hpp"

namespace antilock::distributed {

/// Returns, per unknown of the subdomain, whether any rank marks it (1, else 0, in `mark`). Every
/// rank must call it.
std::vector<char> marked_by_any(const DofMap& rows, const Eigen::VectorXd& mark);

/// The coarse functions of a layer on any mesh: P1 in the body, continued into the layer by the hat
/// functions of x of the vertices of Sigma. So a coarse function is, with `rows` = 0,
///
///     in the body:   the hat function of a vertex that is not clamped,
///     in the layer:  the hat function of x of a vertex of Sigma, constant in y.
///
/// With `rows` > 0 it is in the layer the product of a hat function of x and one of y on that many
/// equal rows, so that a vertex of Sigma has rows + 1 coarse functions. An unknown of P1 takes the
/// value of a coarse function, one of Crouzeix-Raviart its mean over the edge. For rows = 0 the
/// means lie in the kernel of B exactly: the mean of d_y v_h over a triangle is that of d_y v.
class CoarseSpace {
 public:
  /// `space` is a space of P1 or Crouzeix-Raviart on the subdomain of this rank, and `dofs` has its
  /// rows. Every rank must call it. Throws NotConverged, on every rank, where the layer has no
  /// Sigma above it, or where it follows the normals of a curved Sigma.
  CoarseSpace(const Space& space, const DofMap& dofs, int rows);

  /// N x size(): the unknowns of each coarse function. Clamped rows are empty.
  const Matrix& interpolation() const { return interpolation_; }
  long long size() const { return size_; }  ///< number of coarse functions, of all ranks

 private:
  Matrix interpolation_;
  long long size_ = 0;
};

}  // namespace antilock::distributed
