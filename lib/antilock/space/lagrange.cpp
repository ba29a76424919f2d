// P2 to P6: continuous, of degree k on each simplex; the unknowns are the values at the points of
// the lattice of order k: those with barycentric coordinates a / k, where a are whole numbers with
// the sum k. On tetrahedra k is 2.
#include <fmt/format.h>

#include "antilock/core/error.hpp"
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class Lagrange final : public Element {
 public:
  explicit Lagrange(int degree, CellKind kind = CellKind::triangle)
      : Element(kind), k_(degree), n_(reference_cell(kind).vertices), lattice_(dofs(), n_) {
    const ReferenceCell& cell = reference_cell(kind);
    lattice_.setZero();
    Eigen::Index row = 0;
    for (int i = 0; i < n_; ++i) lattice_(row++, i) = k_;
    for (int i = 0; i < cell.edges; ++i)
      for (int s = 1; s < k_; ++s) {
        lattice_(row, cell.edge[i][0]) = k_ - s;
        lattice_(row++, cell.edge[i][1]) = s;
      }
    if (kind != CellKind::triangle) return;
    for (int a = 1; a < k_ - 1; ++a)
      for (int b = 1; a + b < k_; ++b) lattice_.row(row++) << a, b, k_ - a - b;
  }
  std::string name() const override { return fmt::format("P{}", k_); }
  int degree() const override { return k_; }
  int dofs_per_vertex() const override { return 1; }
  int dofs_per_edge() const override { return k_ - 1; }
  int dofs_per_cell() const override { return (k_ - 1) * (k_ - 2) / 2; }  // 0 for k = 2
  ReferencePoints support_points() const override { return lattice_.cast<double>() / k_; }

  // phi_a = prod_j s(a_j, lambda_j), s(a, t) = prod_{m < a} (k t - m) / (m + 1): 1 at t = a/k, 0 at
  // the lattice values before it (Silvester 1969)
  Eigen::VectorXd basis(const ReferencePoint& lambda) const override {
    Eigen::VectorXd phi = Eigen::VectorXd::Ones(lattice_.rows());
    for (Eigen::Index i = 0; i < phi.size(); ++i)
      for (int j = 0; j < n_; ++j) phi(i) *= factor(lattice_(i, j), lambda(j)).value;
    return phi;
  }
  ReferencePoints derivative(const ReferencePoint& lambda) const override {
    ReferencePoints d(lattice_.rows(), n_);
    for (Eigen::Index i = 0; i < d.rows(); ++i)
      for (int j = 0; j < n_; ++j) {
        d(i, j) = factor(lattice_(i, j), lambda(j)).slope;
        for (int step = 1; step < n_; ++step) {
          const int other = (j + step) % n_;
          d(i, j) *= factor(lattice_(i, other), lambda(other)).value;
        }
      }
    return d;
  }

 private:
  struct Factor {
    double value = 1, slope = 0;
  };
  Factor factor(int a, double t) const {
    Factor s;
    for (int m = 0; m < a; ++m) {
      s.slope = (s.slope * (k_ * t - m) + s.value * k_) / (m + 1);
      s.value *= (k_ * t - m) / (m + 1);
    }
    return s;
  }
  int k_;
  int n_;  ///< vertices of the cell
  Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, Eigen::Dynamic, 4> lattice_;
};

}  // namespace

const Element& lagrange(int degree, CellKind kind) {
  static const Lagrange two(2), three(3), four(4), five(5), six(6);
  static const Lagrange two_in_space(2, CellKind::tetrahedron);
  static const Element* const instances[] = {&p1(), &two, &three, &four, &five, &six};
  const int most = kind == CellKind::triangle ? 6 : 2;
  if (degree < 1 || degree > most)
    throw Error(fmt::format("element: degree {} is not accepted; 1 to {}", degree, most));
  if (degree == 1) return p1(kind);
  if (kind == CellKind::triangle) return *instances[degree - 1];
  if (kind == CellKind::tetrahedron) return two_in_space;
  throw Error("element: P2 on a quadrilateral; accepted: Q1");
}
const Element& p2(CellKind kind) { return lagrange(2, kind); }
const Element& p3() { return lagrange(3); }
const Element& p4() { return lagrange(4); }

}  // namespace antilock
