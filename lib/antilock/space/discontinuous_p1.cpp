// Discontinuous P1: affine on each triangle, without any continuity. The basis is that of
// Crouzeix-Raviart, but no unknown is shared: the mean of a function over an edge is one unknown
// on each side, and the mean of its jump is their difference.
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class DiscontinuousP1 final : public Element {
 public:
  std::string name() const override { return "P1dc"; }
  int degree() const override { return 1; }
  bool conforming() const override { return false; }
  int dofs_per_vertex() const override { return 0; }
  int dofs_per_edge() const override { return 0; }
  int dofs_per_cell() const override { return 3; }
  ReferencePoints support_points() const override { return crouzeix_raviart().support_points(); }
  Eigen::VectorXd basis(const ReferencePoint& lambda) const override {
    return crouzeix_raviart().basis(lambda);
  }
  ReferencePoints derivative(const ReferencePoint& lambda) const override {
    return crouzeix_raviart().derivative(lambda);
  }
};

}  // namespace

const Element& discontinuous_p1() {
  static const DiscontinuousP1 instance;
  return instance;
}

}  // namespace antilock
