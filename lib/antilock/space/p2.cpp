// P2: continuous, quadratic on each triangle; the unknowns are the values at the vertices and the edge midpoints.
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class P2 final : public Element {
 public:
  std::string name() const override { return "P2"; }
  int degree() const override { return 2; }
  int per_vertex() const override { return 1; }
  int per_edge() const override { return 1; }
  int per_triangle() const override { return 0; }
  Eigen::MatrixX3d nodes() const override {
    Eigen::MatrixX3d n(6, 3);
    n << Eigen::Matrix3d::Identity(), 0.5 * (Eigen::Matrix3d::Ones() - Eigen::Matrix3d::Identity());
    return n;
  }

  // vertex i: lambda_i (2 lambda_i - 1); edge i, between j and k: 4 lambda_j lambda_k
  Eigen::VectorXd basis(const Eigen::Vector3d& l) const override {
    Eigen::VectorXd phi(6);
    phi << l.array() * (2 * l.array() - 1), 4 * l(1) * l(2), 4 * l(2) * l(0), 4 * l(0) * l(1);
    return phi;
  }
  Eigen::MatrixX3d derivative(const Eigen::Vector3d& l) const override {
    Eigen::MatrixX3d d = Eigen::MatrixX3d::Zero(6, 3);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      d(i, i) = 4 * l(i) - 1;
      d(3 + i, j) = 4 * l(k);
      d(3 + i, k) = 4 * l(j);
    }
    return d;
  }
};

}  // namespace

const Element& p2() {
  static const P2 page;
  return page;
}

}  // namespace antilock
