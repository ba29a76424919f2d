// P2 to P6: continuous, of degree k on each triangle; the unknowns are the values at the points of
// the lattice of order k: those with barycentric coordinates (a0, a1, a2) / k, whole numbers with
// a0 + a1 + a2 = k.
#include <fmt/format.h>

#include "antilock/core/error.hpp"
#include "antilock/space/element.hpp"

namespace antilock {
namespace {

class Lagrange final : public Element {
 public:
  explicit Lagrange(int degree) : k_(degree), lattice_(dofs(), 3) {
    Eigen::Index row = 0;
    const auto add = [&](const Eigen::RowVector3i& a) { lattice_.row(row++) = a; };
    for (int i = 0; i < 3; ++i) add(k_ * Eigen::RowVector3i::Unit(i));
    for (int i = 0; i < 3; ++i)  // edge i, from its vertex i + 1 to its vertex i + 2
      for (int s = 1; s < k_; ++s)
        add((k_ - s) * Eigen::RowVector3i::Unit((i + 1) % 3) +
            s * Eigen::RowVector3i::Unit((i + 2) % 3));
    for (int a = 1; a < k_ - 1; ++a)
      for (int b = 1; a + b < k_; ++b) add({a, b, k_ - a - b});
  }
  std::string name() const override { return fmt::format("P{}", k_); }
  int degree() const override { return k_; }
  int dofs_per_vertex() const override { return 1; }
  int dofs_per_edge() const override { return k_ - 1; }
  int dofs_per_cell() const override { return (k_ - 1) * (k_ - 2) / 2; }
  Eigen::MatrixX3d support_points() const override { return lattice_.cast<double>() / k_; }

  // phi_a = s(a0, lambda_0) s(a1, lambda_1) s(a2, lambda_2), s(a, t) = prod_{m < a} (k t - m) /
  // (m + 1): 1 at t = a/k, 0 at the lattice values before it (Silvester 1969)
  Eigen::VectorXd basis(const Eigen::Vector3d& lambda) const override {
    Eigen::VectorXd phi = Eigen::VectorXd::Ones(lattice_.rows());
    for (Eigen::Index i = 0; i < phi.size(); ++i)
      for (int j = 0; j < 3; ++j) phi(i) *= factor(lattice_(i, j), lambda(j)).value;
    return phi;
  }
  Eigen::MatrixX3d derivative(const Eigen::Vector3d& lambda) const override {
    Eigen::MatrixX3d d(lattice_.rows(), 3);
    for (Eigen::Index i = 0; i < d.rows(); ++i)
      for (int j = 0; j < 3; ++j) {
        d(i, j) = factor(lattice_(i, j), lambda(j)).slope;
        for (const int other : {(j + 1) % 3, (j + 2) % 3})
          d(i, j) *= factor(lattice_(i, other), lambda(other)).value;
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
  Eigen::MatrixX3i lattice_;
};

}  // namespace

const Element& lagrange(int degree) {
  static const Lagrange two(2), three(3), four(4), five(5), six(6);
  static const Element* const instances[] = {&p1(), &two, &three, &four, &five, &six};
  if (degree < 1 || degree > 6)
    throw Error(fmt::format("element: degree {} is not accepted; 1 to 6", degree));
  return *instances[degree - 1];
}
const Element& p2() { return lagrange(2); }
const Element& p3() { return lagrange(3); }
const Element& p4() { return lagrange(4); }

}  // namespace antilock
