#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/element.hpp"

namespace antilock {

/// The space V_h: an element on a mesh, with its global numbering (vertices, edges, faces, cells).
/// A space shares its mesh with its copies and with the spaces that are made from it. A copy also
/// shares the numbering, so that copies are cheap.
class Space {
 public:
  /// Copies the mesh, unless it is moved: Space(std::move(mesh), element). Each constructor throws
  /// Error where the element is one of another kind of cells.
  Space(TriangleMesh mesh, const Element& element);
  Space(std::shared_ptr<const TriangleMesh> mesh, const Element& element);
  /// Makes a space with another element on the mesh of `other`.
  Space(const Space& other, const Element& element);

  const TriangleMesh& mesh() const { return *mesh_; }
  const std::shared_ptr<const TriangleMesh>& shared_mesh() const { return mesh_; }
  const Element& element() const { return *element_; }
  /// N, the number of unknowns, including prescribed ones.
  int size() const { return static_cast<int>(numbering_->dof_coordinates.rows()); }
  /// N x d, the position of each unknown.
  const Points& dof_coordinates() const { return numbering_->dof_coordinates; }
  /// Returns the global unknown of each local one (T x m).
  const Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& cell_dofs() const {
    return numbering_->cell_dofs;
  }
  /// Returns the unknowns with a prescribed value, ascending.
  const std::vector<int>& dirichlet_dofs() const { return numbering_->dirichlet_dofs; }
  /// Returns the unknowns on Gamma_C, the contact boundary, that are not prescribed, ordered by x
  /// and, in space, by y.
  const std::vector<int>& contact_dofs() const { return numbering_->contact_dofs; }
  int free_count() const { return size() - static_cast<int>(dirichlet_dofs().size()); }

 private:
  /// The numbers of the first unknowns on edges, on faces and in cells. Those at vertices are
  /// first.
  struct FirstDofs {
    int on_edges = 0, on_faces = 0, in_cells = 0;
  };
  struct Numbering {
    Numbering(const TriangleMesh& mesh, const Element& element);
    template <CellKind kind>
    void number_cells(const TriangleMesh& mesh, const Element& element, const FirstDofs& first,
                      const CellEdges& edges);
    void mark_boundary(const TriangleMesh& mesh, const Element& element);
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

/// Returns the value of a field at a point in the plane or in space.
double field_value(const Field& v, const Position& x);
/// Returns the values of the unknowns of a function v (N): v at the position of each unknown, or
/// its weighted mean where the unknowns are means (Element::functional). The second function
/// returns those of the unknowns `dofs` alone, in their order.
Eigen::VectorXd dof_values(const Space& space, const Field& v);
Eigen::VectorXd dof_values(const Space& space, const std::vector<int>& dofs, const Field& v);
/// Returns the value of local unknown i of cell t for a function v of the position.
double dof_value(const Space& space, int t, Eigen::Index i,
                 const std::function<double(const Position&)>& v);
/// Returns the value of u_h at the position of each unknown (N), from the N unknowns u. It is u
/// itself for an element whose unknowns are values. On an edge it is the mean of the values in the
/// triangles beside it.
Eigen::VectorXd values_at_dofs(const Space& space, const Eigen::VectorXd& u);

/// Returns the gradients of the barycentric coordinates of a triangle (3 x 2). They are constant on
/// it. Throws Error for another cell.
Eigen::Matrix<double, 3, 2> barycentric_gradients(const TriangleMesh& mesh, int triangle);
/// Returns the mean of the vertices of a cell; z = 0 in the plane.
Eigen::Vector3d centroid(const TriangleMesh& mesh, int cell);
/// Returns the point xi of the reference cell, mapped to a cell; z = 0 in the plane.
Eigen::Vector3d position(const TriangleMesh& mesh, int cell, const ReferencePoint& xi);
/// Returns the point of a triangle with the barycentric coordinates lambda. Throws Error for
/// another cell.
Eigen::Vector2d point_in(const TriangleMesh& mesh, int triangle, const Eigen::Vector3d& lambda);

}  // namespace antilock
