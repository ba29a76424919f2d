// Fortin and Soulie's element (1983): parabolas on each triangle, continuous at the two Gauss
// points of each edge. On an edge these two values of a parabola are those of its L2 projection on
// affine functions, which the two means of hybrid_bdm1 determine. So the space is the one of
// hybrid_bdm1 with one equation per triangle, for the means a-_j, a+_j on edge j:
//
//     sum_j (a+_j - a-_j) = 0
//
// For a parabola v, a+_j - a-_j is a third of the derivative of v along edge j at its midpoint,
// times the length of the edge. The sum of these derivatives round the triangle is 0 for
// v = lambda_i and for v = lambda_i lambda_k, hence for every parabola. Only v = 0 has seven means
// that are 0. So the means of the parabolas have dimension 6, and are all solutions of the
// equation. The gradient of hybrid_bdm1, a projection, is then the gradient of v.
//
// Korn's inequality holds with one constant on shape-regular meshes, because the jumps are
// orthogonal to the affine functions on each edge (S. C. Brenner, Math. Comp. 73, 2004).
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class FortinSoulie final : public Element {
 public:
  std::string name() const override { return "FS"; }
  int degree() const override { return 2; }
  int basis_degree() const override { return hybrid_bdm1().basis_degree(); }
  bool conforming() const override { return false; }
  bool nodal() const override { return false; }
  int dofs_per_vertex() const override { return 0; }
  int dofs_per_edge() const override { return 2; }
  int dofs_per_cell() const override { return 1; }
  ReferencePoints support_points() const override { return hybrid_bdm1().support_points(); }
  DofFunctional functional(int i) const override { return hybrid_bdm1().functional(i); }
  Eigen::VectorXd basis(const ReferencePoint& l) const override { return hybrid_bdm1().basis(l); }
  ReferencePoints derivative(const ReferencePoint& l) const override {
    return hybrid_bdm1().derivative(l);
  }
  Eigen::VectorXd equation() const override { return Eigen::VectorXd{{-1, 1, -1, 1, -1, 1, 0}}; }
};

}  // namespace

const Element& fortin_soulie() {
  static const FortinSoulie instance;
  return instance;
}

}  // namespace antilock
