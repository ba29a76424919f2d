// Q1: continuous, bilinear on the reference square; the unknowns are the values at the vertices.
// Its forms are integrated by one of three choices of points.
#include "antilock/space/cell_map.hpp"
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class Q1 final : public Element {
 public:
  explicit Q1(Integration integration)
      : Element(CellKind::quadrilateral), integration_(integration) {}
  std::string name() const override {
    if (integration_ == Integration::full) return "Q1";
    return integration_ == Integration::selective ? "Q1-selective" : "Q1-reduced";
  }
  int degree() const override { return 1; }  // in s and in t
  int gradient_degree() const override { return integration_ == Integration::reduced ? 1 : 2; }
  int strain_degree() const override { return integration_ == Integration::full ? 2 : 1; }
  int dofs_per_vertex() const override { return 1; }
  int dofs_per_edge() const override { return 0; }
  int dofs_per_cell() const override { return 0; }
  ReferencePoints support_points() const override {
    ReferencePoints corners(4, 2);
    corners << 0, 0, 1, 0, 1, 1, 0, 1;
    return corners;
  }

  // phi_i = N_i, the vertex functions of the square
  Eigen::VectorXd basis(const ReferencePoint& xi) const override {
    return vertex_functions<CellKind::quadrilateral>(xi);
  }
  ReferencePoints derivative(const ReferencePoint& xi) const override {
    const double s = xi(0), t = xi(1);
    ReferencePoints slopes(4, 2);
    slopes << t - 1, s - 1, 1 - t, -s, t, s, -t, 1 - s;
    return slopes;
  }

 private:
  Integration integration_;
};

}  // namespace

const Element& q1(Integration integration) {
  static const Q1 full(Integration::full), selective(Integration::selective),
      reduced(Integration::reduced);
  if (integration == Integration::full) return full;
  return integration == Integration::selective ? selective : reduced;
}

}  // namespace antilock
