// P1, Section 4.1: continuous, affine on each triangle; the unknowns are the values at the
// vertices.
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class P1 final : public Element {
 public:
  std::string name() const override { return "P1"; }
  int degree() const override { return 1; }
  int dofs_per_vertex() const override { return 1; }
  int dofs_per_edge() const override { return 0; }
  int dofs_per_cell() const override { return 0; }
  Eigen::MatrixX3d support_points() const override { return Eigen::Matrix3d::Identity(); }

  // phi_i = lambda_i
  Eigen::VectorXd basis(const Eigen::Vector3d& lambda) const override { return lambda; }
  Eigen::MatrixX3d derivative(const Eigen::Vector3d&) const override {
    return Eigen::Matrix3d::Identity();
  }
};

}  // namespace

const Element& p1() {
  static const P1 instance;
  return instance;
}

}  // namespace antilock
