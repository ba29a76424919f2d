#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/element.hpp"

namespace antilock {

/// V_h: an element on a mesh, with its global numbering (vertices, then edges, then triangles).
/// The mesh must outlive the space.
class Space {
 public:
  Space(const TriangleMesh& mesh, const Element& element);
  Space(TriangleMesh&&, const Element&) = delete;

  const TriangleMesh& mesh() const { return *mesh_; }
  const Element& element() const { return *element_; }
  int size() const { return static_cast<int>(dof_coordinates_.rows()); }  ///< unknowns N, the clamped ones too
  const Points& dof_coordinates() const { return dof_coordinates_; }      ///< N x 2, where each unknown sits
  /// T x m: the global unknown behind each local one.
  const Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& cell_dofs() const { return cell_dofs_; }
  const std::vector<int>& dirichlet_dofs() const { return dirichlet_dofs_; }  ///< unknowns where u is given, ascending
  const std::vector<int>& contact_dofs() const {
    return contact_dofs_;
  }  ///< unknowns on Gamma_C that are not clamped, by x
  int free_count() const { return size() - static_cast<int>(dirichlet_dofs_.size()); }

 private:
  const TriangleMesh* mesh_;
  const Element* element_;
  Points dof_coordinates_;
  Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> cell_dofs_;
  std::vector<int> dirichlet_dofs_, contact_dofs_;
};

/// The gradients of the barycentric coordinates of a triangle, 3 x 2, constant on it.
Eigen::Matrix<double, 3, 2> barycentric_gradients(const TriangleMesh& mesh, int triangle);
/// The point of a triangle with barycentric coordinates lambda.
Eigen::Vector2d point_in(const TriangleMesh& mesh, int triangle, const Eigen::Vector3d& lambda);

}  // namespace antilock
