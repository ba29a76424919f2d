#pragma once
#include "antilock/core/error.hpp"
#include "antilock/form/elasticity_forms.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/cell_map.hpp"
#include "antilock/space/vector_space.hpp"

namespace antilock {

/// The derivatives (u_x, u_y, v_x, v_y) of the bases of both components on a cell of the plane, at
/// the points of a rule. The constructor throws Error for an element whose gradient is projected.
class Gradients {
 public:
  Gradients(const VectorSpace& space, const Quadrature& rule)
      : space_(space), rule_(rule), m_(space.x.element().dofs()), n_(space.y.element().dofs()) {
    require_plane(space.x.mesh(), "strains");
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
  /// elements. `coordinates` are the gradients of xi by x and y.
  template <int c>
  Eigen::Matrix4Xd at(Eigen::Index q, const Eigen::Matrix<double, c, 2>& coordinates) const {
    using Derivative = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, c>>;
    Eigen::Matrix4Xd d = Eigen::Matrix4Xd::Zero(4, m_ + n_);
    d.topLeftCorner(2, m_) = (Derivative(of_x_[q].data(), m_, c) * coordinates).transpose();
    d.bottomRightCorner(2, n_) = (Derivative(of_y_[q].data(), n_, c) * coordinates).transpose();
    return d;
  }
  /// act(weight, factor, derivatives) at each point of the rule on cell t: the integral of f is
  /// the sum of weight * factor * f.
  template <class Act>
  void at_points(int t, Act&& act) const {
    if (space_.x.mesh().kind == CellKind::triangle)
      at_points_of<CellKind::triangle>(t, act);
    else
      at_points_of<CellKind::quadrilateral>(t, act);
  }

 private:
  template <CellKind kind, class Act>
  void at_points_of(int t, Act&& act) const {
    const CellMap<kind> map(space_.x.mesh(), t);
    for (Eigen::Index q = 0; q < rule_.weights.size(); ++q) {
      const auto here = map.at(rule_.points.row(q).transpose());
      act(rule_.weights(q), here.factor, at<CellMap<kind>::c>(q, here.gradient));
    }
  }

  const VectorSpace& space_;
  const Quadrature& rule_;
  int m_, n_;
  /// The derivatives by the coordinates of the reference cell, the same on every cell.
  std::vector<ReferencePoints> of_x_, of_y_;
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
