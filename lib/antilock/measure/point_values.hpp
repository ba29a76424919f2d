#pragma once
#include <Eigen/Core>
#include <optional>
#include <unsupported/Eigen/BVH>

#include "antilock/space/space.hpp"

namespace antilock {

/// Where a point lies in a mesh, and what a discrete function is there.
class PointValues {
 public:
  explicit PointValues(const Space& space);

  /// The triangle that holds x (up to `outside` of its size beyond its edges counts as in it) and its barycentric coordinates there;
  /// empty outside the mesh. On an edge: the triangle of the smallest number.
  struct Location {
    int triangle;
    Eigen::Vector3d lambda;
  };
  std::optional<Location> locate(const Eigen::Vector2d& x, double outside = 1e-12) const;

  /// u: N values, one per unknown. Crouzeix-Raviart is the value in the located triangle.
  double value(const Eigen::VectorXd& u, const Location& at) const;
  Eigen::Vector2d gradient(const Eigen::VectorXd& u, const Location& at) const;

 private:
  Space space_;
  Eigen::KdBVH<double, 2, int> tree_;  ///< the triangles, by their boxes
};

}  // namespace antilock
