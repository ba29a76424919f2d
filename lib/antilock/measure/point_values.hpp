#pragma once
#include <Eigen/Core>
#include <optional>
#include <unsupported/Eigen/BVH>

#include "antilock/space/space.hpp"

namespace antilock {

/// Locates points in a mesh and evaluates discrete functions there.
class PointValues {
 public:
  explicit PointValues(const Space& space);

  /// The triangle that contains a point, and the barycentric coordinates of the point in it.
  struct Location {
    int triangle;
    Eigen::Vector3d lambda;
  };
  /// Returns the location of x, and nothing outside the mesh. A point beyond an edge by at most the
  /// fraction `outside` of the size of the triangle counts as inside. A point on an edge is located
  /// in that one of its triangles which has the smallest number.
  std::optional<Location> locate(const Eigen::Vector2d& x, double outside = 1e-12) const;

  /// Returns the value of the function with the N unknowns u; for Crouzeix-Raviart that in the
  /// located triangle.
  double value(const Eigen::VectorXd& u, const Location& at) const;
  /// Returns its gradient in the located triangle.
  Eigen::Vector2d gradient(const Eigen::VectorXd& u, const Location& at) const;

 private:
  Space space_;
  Eigen::KdBVH<double, 2, int> tree_;  ///< the triangles, by their boxes
};

}  // namespace antilock
