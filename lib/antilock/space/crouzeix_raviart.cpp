// Crouzeix-Raviart, Section 4.2: affine on each triangle, continuous at the edge midpoints only,
// where its unknowns sit.
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class CrouzeixRaviart final : public Element {
 public:
  std::string name() const override { return "CR"; }
  int degree() const override { return 1; }
  bool conforming() const override { return false; }
  int dofs_per_vertex() const override { return 0; }
  int dofs_per_edge() const override { return 1; }
  int dofs_per_cell() const override { return 0; }
  Eigen::MatrixX3d support_points() const override {
    return 0.5 * (Eigen::Matrix3d::Ones() - Eigen::Matrix3d::Identity());
  }

  // phi_i = 1 - 2 lambda_i: 1 on edge i, where lambda_i = 0; -1 at the opposite vertex; 0 at the
  // other midpoints
  Eigen::VectorXd basis(const Eigen::Vector3d& lambda) const override {
    return (1 - 2 * lambda.array()).matrix();
  }
  Eigen::MatrixX3d derivative(const Eigen::Vector3d&) const override {
    return -2 * Eigen::Matrix3d::Identity();
  }
};

}  // namespace

const Element& crouzeix_raviart() {
  static const CrouzeixRaviart instance;
  return instance;
}

}  // namespace antilock
