#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "antilock/mesh/mesh.hpp"

namespace antilock {

/// Returns the n vertex functions N_i at xi.
template <CellKind kind>
auto vertex_functions(const Eigen::Matrix<double, reference_cell(kind).coordinates, 1>& xi) {
  if constexpr (reference_cell(kind).simplex)
    return xi;
  else
    return Eigen::Vector4d((1 - xi(0)) * (1 - xi(1)), xi(0) * (1 - xi(1)), xi(0) * xi(1),
                           (1 - xi(0)) * xi(1));
}

/// The map x = sum_i N_i(xi) x_i from the reference cell to one cell of a mesh.
template <CellKind kind>
class CellMap {
 public:
  static constexpr ReferenceCell cell = reference_cell(kind);
  static constexpr int n = cell.vertices, d = cell.dimension, c = cell.coordinates;
  using Point = Eigen::Matrix<double, d, 1>;
  using Coordinates = Eigen::Matrix<double, c, 1>;
  /// The map at one point of a rule.
  struct At {
    double factor;                         ///< int_T f is about the sum of weight * factor * f
    Eigen::Matrix<double, c, d> gradient;  ///< row j: the gradient of xi_j by x
  };

  CellMap(const Mesh& mesh, int t) {
    const int* const vertices = mesh.triangles.data() + n * t;
    for (int i = 0; i < n; ++i)
      x_.col(i) = Eigen::Map<const Point>(mesh.vertices.data() + d * vertices[i]);
  }
  /// Returns the positions of the vertices (d x n).
  const Eigen::Matrix<double, d, n>& corners() const { return x_; }
  Point point(const Coordinates& xi) const {
    const auto shape = vertex_functions<kind>(xi);
    Point x = Point::Zero();
    for (int i = 0; i < n; ++i) x += shape(i) * x_.col(i);
    return x;
  }
  /// Returns the factor and the gradients at xi. On a simplex they are the same at every xi, and
  /// the factor is its measure.
  At at(const Coordinates& xi) const {
    At here;
    if constexpr (kind == CellKind::triangle) {
      const double twice_area = (x_(0, 1) - x_(0, 0)) * (x_(1, 2) - x_(1, 0)) -
                                (x_(0, 2) - x_(0, 0)) * (x_(1, 1) - x_(1, 0));
      const double scale = 1 / twice_area;
      here.factor = 0.5 * twice_area;
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        here.gradient(i, 0) = (x_(1, j) - x_(1, k)) * scale;
        here.gradient(i, 1) = (x_(0, k) - x_(0, j)) * scale;
      }
    } else if constexpr (kind == CellKind::tetrahedron) {
      const auto normal =
          [&](int i) -> Eigen::Vector3d {  // outwards, twice the area of facet i long
        const auto& [a, b, e] = cell.facet[i];
        return (x_.col(b) - x_.col(a)).cross(x_.col(e) - x_.col(a));
      };
      const double six_volumes = normal(0).dot(x_.col(1) - x_.col(0));
      here.factor = six_volumes / 6;
      for (int i = 0; i < 4; ++i) here.gradient.row(i) = -normal(i) / six_volumes;
    } else {
      Eigen::Matrix<double, 4, 2> slope;  // of N_i by (s, t)
      slope << xi(1) - 1, xi(0) - 1, 1 - xi(1), -xi(0), xi(1), xi(0), -xi(1), 1 - xi(0);
      const Eigen::Matrix2d jacobian = x_ * slope;
      here.factor = jacobian.determinant();
      here.gradient = jacobian.inverse();
    }
    return here;
  }

 private:
  Eigen::Matrix<double, d, n> x_;
};

}  // namespace antilock
