#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// A P1 function on a layer in columns (mesh/layered.hpp). It can be evaluated at every point of
/// the layer, so also at the points of another mesh.
class ExtrudedP1Function {
 public:
  /// `mesh` is a mesh made by extruded(), v has V values at its vertices, and p has one layer
  /// stress per layer triangle.
  ExtrudedP1Function(TriangleMesh mesh, Eigen::VectorXd v, Eigen::VectorXd p);

  double value(const Eigen::Vector2d& x) const;
  /// Returns (d_x v, p) at a point.
  Eigen::Vector2d flux(const Eigen::Vector2d& x) const;
  /// Returns the mean of v over the segment from a to b, exactly.
  double mean(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

  const TriangleMesh& mesh() const { return mesh_; }
  const Eigen::VectorXd& v() const { return v_; }
  const Eigen::VectorXd& p() const { return p_; }
  /// Returns (d_x v, p) on the layer triangle `row`, counted among the layer triangles.
  Eigen::Vector2d flux_of(int row) const;
  int first_triangle() const { return first_; }  ///< of the layer: those before are the body's

 private:
  struct Column {
    double left, right;
    int triangle;  ///< its first, at the top
  };
  struct Place {
    int triangle;
    double width;  ///< of its column
    double s, t;   ///< in its cell, from the left and from below, 0 to 1
  };
  Place locate(const Eigen::Vector2d& x) const;

  TriangleMesh mesh_;
  Eigen::VectorXd v_, p_;
  std::vector<Column> columns_;  ///< from left to right
  int first_ = 0, rows_ = 0;
};

}  // namespace antilock
