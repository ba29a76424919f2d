// P1, Section 4.1: continuous, affine on each simplex; the unknowns are the values at the vertices.
#include "antilock/core/error.hpp"
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class P1 final : public Element {
 public:
  explicit P1(CellKind kind) : Element(kind) {}
  std::string name() const override { return "P1"; }
  int degree() const override { return 1; }
  int dofs_per_vertex() const override { return 1; }
  int dofs_per_edge() const override { return 0; }
  int dofs_per_cell() const override { return 0; }
  ReferencePoints support_points() const override {
    return ReferencePoints::Identity(dofs(), dofs());
  }

  // phi_i = lambda_i
  Eigen::VectorXd basis(const ReferencePoint& lambda) const override { return lambda; }
  ReferencePoints derivative(const ReferencePoint&) const override {
    return ReferencePoints::Identity(dofs(), dofs());
  }
};

}  // namespace

const Element& p1(CellKind kind) {
  static const P1 on_triangles(CellKind::triangle);
  static const P1 on_tetrahedra(CellKind::tetrahedron);
  if (!reference_cell(kind).simplex) throw Error("element: P1 on a quadrilateral; accepted: Q1");
  return kind == CellKind::triangle ? on_triangles : on_tetrahedra;
}

}  // namespace antilock
