#pragma once
#include <Eigen/Core>
#include <optional>
#include <unsupported/Eigen/BVH>
#include <variant>

#include "antilock/space/space.hpp"

namespace antilock {

/// Locates points in a mesh of triangles or of tetrahedra and evaluates discrete functions there.
/// Points and gradients have three coordinates; in the plane z is 0.
class PointValues {
 public:
  /// Throws Error for a mesh of quadrilaterals.
  explicit PointValues(const Space& space);

  /// The cell that contains a point, and the barycentric coordinates of the point in it.
  struct Location {
    int triangle;
    ReferencePoint lambda;
  };
  /// Returns the location of x, and nothing outside the mesh. A point beyond a facet by at most the
  /// fraction `outside` of the size of the cell counts as inside. A point on a facet is located in
  /// that one of its cells which has the smallest number.
  std::optional<Location> locate(const Eigen::Vector3d& x, double outside = 1e-12) const;

  /// Returns the value of the function with the N unknowns u; for Crouzeix-Raviart that in the
  /// located cell.
  double value(const Eigen::VectorXd& u, const Location& at) const;
  /// Returns its gradient in the located cell.
  Eigen::Vector3d gradient(const Eigen::VectorXd& u, const Location& at) const;

 private:
  template <int d>
  using Tree = Eigen::KdBVH<double, d, int>;

  Space space_;
  std::variant<Tree<2>, Tree<3>> tree_;  ///< the cells, by their boxes
};

}  // namespace antilock
