#pragma once
#include <memory>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/element.hpp"

namespace antilock {

/// V_h: an element on a mesh, with its global numbering (vertices, then edges, then triangles). A space shares its mesh
/// with its copies and with the spaces made from it, and a copy shares the numbering, too: it costs two pointers.
class Space {
 public:
  /// A mesh that is passed by its name is copied; `std::move(mesh)` hands it over.
  Space(TriangleMesh mesh, const Element& element);
  Space(std::shared_ptr<const TriangleMesh> mesh, const Element& element);
  /// Another element on the mesh of `other`.
  Space(const Space& other, const Element& element);

  const TriangleMesh& mesh() const { return *mesh_; }
  const std::shared_ptr<const TriangleMesh>& shared_mesh() const { return mesh_; }
  const Element& element() const { return *element_; }
  int size() const { return static_cast<int>(numbering_->dof_coordinates.rows()); }  ///< unknowns N, clamped ones too
  const Points& dof_coordinates() const { return numbering_->dof_coordinates; }      ///< N x 2, where each unknown sits
  /// T x m: the global unknown behind each local one.
  const Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& cell_dofs() const {
    return numbering_->cell_dofs;
  }
  /// The unknowns where u is given, ascending.
  const std::vector<int>& dirichlet_dofs() const { return numbering_->dirichlet_dofs; }
  /// The unknowns on Gamma_C that are not clamped, by x.
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

/// Whether two spaces have one mesh: a shared one, or equal ones (vertices, triangles, regions and tags).
bool have_one_mesh(const Space& a, const Space& b);

/// The gradients of the barycentric coordinates of a triangle, 3 x 2, constant on it.
Eigen::Matrix<double, 3, 2> barycentric_gradients(const TriangleMesh& mesh, int triangle);
/// The point of a triangle with barycentric coordinates lambda.
Eigen::Vector2d point_in(const TriangleMesh& mesh, int triangle, const Eigen::Vector3d& lambda);

}  // namespace antilock
