// Crouzeix-Raviart, Section 4.2: affine on each simplex, continuous at the centroids of the facets
// only, where its unknowns sit. On triangles these are the edge midpoints.
#include "antilock/core/error.hpp"
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class CrouzeixRaviart final : public Element {
 public:
  explicit CrouzeixRaviart(CellKind kind) : Element(kind), d_(reference_cell(kind).dimension) {}
  std::string name() const override { return "CR"; }
  int degree() const override { return 1; }
  bool conforming() const override { return false; }
  int dofs_per_vertex() const override { return 0; }
  int dofs_per_edge() const override { return kind() == CellKind::triangle ? 1 : 0; }
  int dofs_per_face() const override { return 1; }
  int dofs_per_cell() const override { return 0; }
  ReferencePoints support_points() const override {
    const ReferencePoints vertices = ReferencePoints::Identity(dofs(), dofs());
    return (1.0 / d_) * (ReferencePoints::Ones(dofs(), dofs()) - vertices);
  }

  // phi_i = 1 - d lambda_i: 1 on facet i, where lambda_i = 0; 1 - d at the opposite vertex; 0 at
  // the other centroids
  Eigen::VectorXd basis(const ReferencePoint& lambda) const override {
    return (1 - d_ * lambda.array()).matrix();
  }
  ReferencePoints derivative(const ReferencePoint&) const override {
    return -d_ * ReferencePoints::Identity(dofs(), dofs());
  }

 private:
  double d_;  ///< the dimension of the cell
};

}  // namespace

const Element& crouzeix_raviart(CellKind kind) {
  static const CrouzeixRaviart on_triangles(CellKind::triangle);
  static const CrouzeixRaviart on_tetrahedra(CellKind::tetrahedron);
  if (!reference_cell(kind).simplex) throw Error("element: CR on a quadrilateral; accepted: Q1");
  return kind == CellKind::triangle ? on_triangles : on_tetrahedra;
}

}  // namespace antilock
