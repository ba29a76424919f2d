// P1 and a bubble, the element of MINI (Arnold, Brezzi and Fortin 1984): continuous, affine on each
// triangle but for a cubic that is 0 on its edges; the unknowns are the values at the vertices and
// at the centroid.
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class P1Bubble final : public Element {
 public:
  std::string name() const override { return "P1+bubble"; }
  int degree() const override {
    return 3;
  }  // of the bubble: it reproduces polynomials of degree 1 alone
  int dofs_per_vertex() const override { return 1; }
  int dofs_per_edge() const override { return 0; }
  int dofs_per_cell() const override { return 1; }
  ReferencePoints support_points() const override {
    Eigen::MatrixX3d n(4, 3);
    n << Eigen::Matrix3d::Identity(), Eigen::RowVector3d::Constant(1.0 / 3);
    return n;
  }

  // centroid: b = 27 lambda_0 lambda_1 lambda_2; vertex i: lambda_i - b/3, 0 at the centroid
  Eigen::VectorXd basis(const ReferencePoint& xi) const override {
    const Eigen::Vector3d l = xi;
    const double b = 27 * l.prod();
    return Eigen::Vector4d(l(0) - b / 3, l(1) - b / 3, l(2) - b / 3, b);
  }
  ReferencePoints derivative(const ReferencePoint& xi) const override {
    const Eigen::Vector3d l = xi;
    const Eigen::RowVector3d b = 27 * Eigen::RowVector3d(l(1) * l(2), l(2) * l(0), l(0) * l(1));
    Eigen::MatrixX3d d(4, 3);
    d << Eigen::Matrix3d::Identity().rowwise() - b / 3, b;
    return d;
  }
};

}  // namespace

const Element& p1_bubble() {
  static const P1Bubble instance;
  return instance;
}

}  // namespace antilock
