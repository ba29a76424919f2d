#pragma once
#include <memory>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/element.hpp"

namespace antilock {

/// The space V_h: an element on a mesh, with its global numbering (vertices, then edges, then
/// triangles). A space shares its mesh with its copies and with the spaces that are made from it. A
/// copy also shares the numbering, so that copies are cheap.
class Space {
 public:
  /// Copies the mesh, unless it is moved: Space(std::move(mesh), element).
  Space(TriangleMesh mesh, const Element& element);
  Space(std::shared_ptr<const TriangleMesh> mesh, const Element& element);
  /// Makes a space with another element on the mesh of `other`.
  Space(const Space& other, const Element& element);

  const TriangleMesh& mesh() const { return *mesh_; }
  const std::shared_ptr<const TriangleMesh>& shared_mesh() const { return mesh_; }
  const Element& element() const { return *element_; }
  /// N, the number of unknowns, including prescribed ones.
  int size() const { return static_cast<int>(numbering_->dof_coordinates.rows()); }
  /// N x 2, the position of each unknown.
  const Points& dof_coordinates() const { return numbering_->dof_coordinates; }
  /// Returns the global unknown of each local one (T x m).
  const Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& cell_dofs() const {
    return numbering_->cell_dofs;
  }
  /// Returns the unknowns with a prescribed value, ascending.
  const std::vector<int>& dirichlet_dofs() const { return numbering_->dirichlet_dofs; }
  /// Returns the unknowns on Gamma_C, the contact boundary, that are not prescribed, ordered by x.
  const std::vector<int>& contact_dofs() const { return numbering_->contact_dofs; }
  int free_count() const { return size() - static_cast<int>(dirichlet_dofs().size()); }

 private:
  struct Numbering {
    Numbering(const TriangleMesh& mesh, const Element& element);
    Points dof_coordinates;
    Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> cell_dofs;
    std::vector<int> dirichlet_dofs, contact_dofs;
  };
  std::shared_ptr<const TriangleMesh> mesh_;
  const Element* element_;
  std::shared_ptr<const Numbering> numbering_;
};

/// Returns whether two spaces have the same mesh: a shared one, or two that are equal in vertices,
/// triangles, regions and tags.
bool have_one_mesh(const Space& a, const Space& b);

/// Returns the gradients of the barycentric coordinates of a triangle (3 x 2). They are constant on
/// it.
Eigen::Matrix<double, 3, 2> barycentric_gradients(const TriangleMesh& mesh, int triangle);
/// Returns the point of a triangle with the barycentric coordinates lambda.
Eigen::Vector2d point_in(const TriangleMesh& mesh, int triangle, const Eigen::Vector3d& lambda);

}  // namespace antilock
