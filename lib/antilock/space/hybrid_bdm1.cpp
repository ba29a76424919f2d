// The hybrid form of BDM1 (Brezzi, Douglas and Marini 1985; Arnold and Brezzi 1985). It is also the
// hybrid high-order method with affine functions on the edges and constants on the triangles (Di
// Pietro and Ern 2015). Its gradient needs no stabilisation here. Scenes may call it M2, the
// member of order 2 of the family whose first member is Crouzeix-Raviart.
//
// Edge j, opposite vertex j, runs from vertex j+1 (-) to vertex j+2 (+). The seven unknowns of v
// are weighted means:
//
//     v_T = mean of v over T
//     a-_j = (2 / |E_j|) int_{E_j} v lambda_{j+1},   a+_j = (2 / |E_j|) int_{E_j} v lambda_{j+2}
//
// The gradient G v is affine on T. It follows from these numbers by integration by parts, for every
// q affine on T:
//
//     int_T G v . q = - v_T int_T div q + sum_j int_{E_j} v_j q.n
//
// Here v_j is the affine function on E_j with the means a-_j, a+_j.
//
// So G v is the L2 projection of grad v for every v in H1. The seven basis functions span P2 and
// the cubic (l_0 - l_1)(l_1 - l_2)(l_2 - l_0). The load and the pictures use them. The forms use G
// alone.
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class HybridBdm1 final : public Element {
 public:
  std::string name() const override { return "BDM1-hybrid"; }
  int degree() const override { return 2; }  // G is affine
  int basis_degree() const override { return 3; }
  bool conforming() const override { return false; }
  bool nodal() const override { return false; }
  int dofs_per_vertex() const override { return 0; }
  int dofs_per_edge() const override { return 2; }
  int dofs_per_cell() const override { return 1; }

  // The mean of an affine function with the weight 2 lambda_{j+1} is its value at one third of the
  // edge.
  ReferencePoints support_points() const override {
    Eigen::MatrixX3d points(7, 3);
    points << 0, 2, 1,  //
        0, 1, 2,        //
        1, 0, 2,        //
        2, 0, 1,        //
        2, 1, 0,        //
        1, 2, 0,        //
        1, 1, 1;
    return points / 3;
  }

  DofFunctional functional(int i) const override { return i < 6 ? hat_mean(i / 2, i % 2) : mean(); }

  Eigen::VectorXd basis(const ReferencePoint& l) const override {
    const double cubic = (l(0) - l(1)) * (l(1) - l(2)) * (l(2) - l(0));
    Eigen::VectorXd phi(7);
    for (int j = 0; j < 3; ++j) {
      const double even = 0.5 - 3 * l(j) * (1 - l(j));
      const double odd = (l((j + 2) % 3) - l((j + 1) % 3)) * (1 - 3 * l(j)) + 5 * cubic;
      phi(2 * j) = even - odd;
      phi(2 * j + 1) = even + odd;
    }
    phi(6) = 4 - 6 * l.squaredNorm();
    return phi;
  }

  // G v = 6 sum_j [ (v_T - (a-_j + a+_j) / 2) (1 - 2 l_j) + (a+_j - a-_j) (l_{j+1} - l_{j+2}) ]
  // grad l_j
  ReferencePoints derivative(const ReferencePoint& l) const override {
    Eigen::MatrixX3d d = Eigen::MatrixX3d::Zero(7, 3);
    for (int j = 0; j < 3; ++j) {
      const double even = 1 - 2 * l(j);
      const double odd = l((j + 1) % 3) - l((j + 2) % 3);
      d(2 * j, j) = -3 * even - 6 * odd;
      d(2 * j + 1, j) = -3 * even + 6 * odd;
      d(6, j) = 6 * even;
    }
    return d;
  }

 private:
  /// The mean over edge j with its hat function as weight, that of vertex j+1 (end 0) or of j+2
  /// (end 1). Four Gauss points are exact for v of degree 6.
  static DofFunctional hat_mean(int j, int end) {
    const auto [places, weights] = gauss_rule(4);
    DofFunctional functional{ReferencePoints(places.size(), 3), Eigen::VectorXd(places.size())};
    for (Eigen::Index q = 0; q < places.size(); ++q) {
      const double hat = end == 0 ? 1 - places(q) : places(q);
      functional.points.row(q) = on_edge(j, places(q)).transpose();
      functional.weights(q) = 2 * weights(q) * hat;
    }
    return functional;
  }

  /// The mean over the triangle, exact for degree 5.
  static DofFunctional mean() { return {radon_rule().points, radon_rule().weights}; }
};

}  // namespace

const Element& hybrid_bdm1() {
  static const HybridBdm1 instance;
  return instance;
}

}  // namespace antilock
