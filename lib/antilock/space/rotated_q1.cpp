// The rotated bilinear element: R. Rannacher and S. Turek, Numer. Methods Partial Differ. Equ. 8,
// 1992, the version whose unknowns are the means over the edges. With S = 2 s - 1 and T = 2 t - 1
// the functions of the reference square are
//
//     1, S, T, S^2 - T^2    and, in rotated_q1_plus,    S T.
//
// The first four contain the affine functions of x and y where the map is affine, on a
// parallelogram. On another quadrilateral x and y are bilinear in s and t, so that S T is needed.
// This fifth function has the mean 0 over each edge. Z. Cai, J. Douglas, J. E. Santos, D. Sheen and
// X. Ye added it to an element of this kind (Nonconforming quadrilateral finite elements: a
// correction, Calcolo 37, 2000).
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class RotatedQ1 final : public Element {
 public:
  explicit RotatedQ1(bool plus) : Element(CellKind::quadrilateral), plus_(plus) {}
  std::string name() const override { return plus_ ? "Q1rot+" : "Q1rot"; }
  int degree() const override { return 1; }  // the order of its errors
  int basis_degree() const override { return 2; }
  bool conforming() const override { return false; }
  bool nodal() const override { return false; }
  int dofs_per_vertex() const override { return 0; }
  int dofs_per_edge() const override { return 1; }
  int dofs_per_cell() const override { return plus_ ? 1 : 0; }

  /// The midpoints of the edges and the centre.
  ReferencePoints support_points() const override {
    ReferencePoints points(5, 2);
    points << 0.5, 0, 1, 0.5, 0.5, 1, 0, 0.5, 0.5, 0.5;
    return points.topRows(dofs());
  }

  DofFunctional functional(int i) const override { return i < 4 ? edge_mean(i) : cell_unknown(); }

  // The mean of S^2 - T^2 is -2/3 over the edges T = -1 and 1, and 2/3 over S = -1 and 1. The sum
  // of the five functions is 1, as that of the first four.
  Eigen::VectorXd basis(const ReferencePoint& xi) const override {
    const double s = 2 * xi(0) - 1, t = 2 * xi(1) - 1;
    const double rotated = 0.375 * (s * s - t * t);
    Eigen::VectorXd phi(dofs());
    phi.head(4) << 0.25 - 0.5 * t - rotated, 0.25 + 0.5 * s + rotated, 0.25 + 0.5 * t - rotated,
        0.25 - 0.5 * s + rotated;
    if (plus_) {
      phi.head(4).array() -= 0.25 * s * t;
      phi(4) = s * t;
    }
    return phi;
  }
  ReferencePoints derivative(const ReferencePoint& xi) const override {
    const double s = 2 * xi(0) - 1, t = 2 * xi(1) - 1;
    ReferencePoints slopes(dofs(), 2);  // by xi, twice those by s and t
    slopes.topRows(4) << -1.5 * s, -1 + 1.5 * t, 1 + 1.5 * s, -1.5 * t, -1.5 * s, 1 + 1.5 * t,
        -1 + 1.5 * s, -1.5 * t;
    if (plus_) {
      slopes.topRows(4).rowwise() -= 0.5 * Eigen::RowVector2d(t, s);
      slopes.row(4) << 2 * t, 2 * s;
    }
    return slopes;
  }

 private:
  /// Adds the mean over edge i, times a factor. Four Gauss points are exact for degree 7.
  static void add_edge_mean(DofFunctional& functional, Eigen::Index row, int i, double factor) {
    const Quadrature rule = facet_rule(CellKind::quadrilateral, 6);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      functional.points.row(row + q) =
          on_facet(CellKind::quadrilateral, i, rule.points.row(q)).transpose();
      functional.weights(row + q) = factor * rule.weights(q);
    }
  }
  static DofFunctional edge_mean(int i) {
    DofFunctional functional{ReferencePoints(4, 2), Eigen::VectorXd(4)};
    add_edge_mean(functional, 0, i, 1);
    return functional;
  }
  /// The coefficient of S T, which the values at the corners give, plus the mean over the boundary.
  /// So the weights sum to 1.
  static DofFunctional cell_unknown() {
    DofFunctional functional{ReferencePoints(20, 2), Eigen::VectorXd(20)};
    for (int i = 0; i < 4; ++i) {
      add_edge_mean(functional, 4 * i, i, 0.25);
      functional.points.row(16 + i) = reference_vertex(CellKind::quadrilateral, i).transpose();
      functional.weights(16 + i) = i % 2 == 0 ? 0.25 : -0.25;
    }
    return functional;
  }

  bool plus_;
};

}  // namespace

const Element& rotated_q1() {
  static const RotatedQ1 instance(false);
  return instance;
}

const Element& rotated_q1_plus() {
  static const RotatedQ1 instance(true);
  return instance;
}

}  // namespace antilock
