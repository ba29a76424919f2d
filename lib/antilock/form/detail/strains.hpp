#pragma once
#include "antilock/core/error.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/vector_space.hpp"

namespace antilock {

/// The derivatives (u_x, u_y, v_x, v_y) of the bases of both components on a triangle, at the
/// points of a rule. The constructor throws Error for an element whose gradient is projected.
class Gradients {
 public:
  Gradients(const VectorSpace& space, const Quadrature& rule)
      : space_(space), m_(space.x.element().dofs()), n_(space.y.element().dofs()) {
    require_triangles(space.x.mesh(), "strains");
    for (const Space* part : {&space.x, &space.y})
      if (!part->element().nodal() && part->element().equation().size() == 0)
        throw Error("strains: element " + part->element().name() +
                    " has no Korn inequality; accepted: an element whose unknowns are values, "
                    "or FS (fortin_soulie)");
    for (const auto point : rule.points.rowwise()) {
      of_x_.push_back(space.x.element().derivative(point));
      of_y_.push_back(space.y.element().derivative(point));
    }
  }
  /// Returns the unknown of each column, as an index of the whole vector.
  Eigen::VectorXi unknowns(int t) const {
    Eigen::VectorXi both(m_ + n_);
    both << space_.x.cell_dofs().row(t).transpose(),
        (space_.y.cell_dofs().row(t).transpose().array() + space_.x.size()).matrix();
    return both;
  }
  /// Returns the derivatives at point q (4 x (m + n)), m and n the numbers of unknowns of the two
  /// elements.
  Eigen::Matrix4Xd at(Eigen::Index q, const Eigen::Matrix<double, 3, 2>& barycentric) const {
    Eigen::Matrix4Xd d = Eigen::Matrix4Xd::Zero(4, m_ + n_);
    d.topLeftCorner(2, m_) = (of_x_[q] * barycentric).transpose();
    d.bottomRightCorner(2, n_) = (of_y_[q] * barycentric).transpose();
    return d;
  }

 private:
  const VectorSpace& space_;
  int m_, n_;
  /// The derivatives by the barycentric coordinates, the same on every triangle.
  std::vector<Eigen::MatrixX3d> of_x_, of_y_;
};

/// Assembles element matrices into a sparse matrix (size x size). `local(t)` returns the unknowns
/// of triangle t and its matrix.
template <class Local>
SparseMatrix assemble_strains(int size, int triangles, Local&& local) {
  Triplets entries;
  for (int t = 0; t < triangles; ++t) {
    const auto [unknown, matrix] = local(t);
    for (Eigen::Index i = 0; i < unknown.size(); ++i)
      for (Eigen::Index j = 0; j < unknown.size(); ++j)
        entries.emplace_back(unknown(i), unknown(j), matrix(i, j));
  }
  return from_triplets<SparseMatrix>(size, size, entries);
}

}  // namespace antilock
