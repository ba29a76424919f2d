#include "antilock/measure/point_values.hpp"

#include <algorithm>
#include <limits>

namespace antilock {
namespace {

using Box = Eigen::AlignedBox2d;

/// Asked by Eigen's walk through the boxes: the triangle of the smallest number that holds x.
struct Search {
  const TriangleMesh& mesh;
  Eigen::Vector2d x;
  double outside, beyond;  ///< of a triangle's size, and of its box
  PointValues::Location found{-1, {}};

  /// The rounding of the coordinates, which far from the origin is more than `outside`.
  double ulp() const { return std::numeric_limits<double>::epsilon() * x.lpNorm<1>(); }

  bool intersectVolume(const Box& box) const {
    return box.exteriorDistance(x) <= beyond * box.diagonal().norm() + ulp() * 4;
  }
  bool intersectObject(int t) {
    const Eigen::Vector2d corner = mesh.vertices.row(mesh.triangles(t, 0));
    const auto slopes = barycentric_gradients(mesh, t);
    Eigen::Vector3d lambda = slopes * (x - corner);
    lambda(0) += 1;
    if (lambda.minCoeff() >= -outside - ulp() * slopes.cwiseAbs().maxCoeff() &&
        (found.triangle < 0 || t < found.triangle))
      found = {t, lambda};
    return false;  // on to the next
  }
};

}  // namespace

PointValues::PointValues(const Space& space) : space_(space) {
  const TriangleMesh& mesh = space.mesh();
  require_triangles(mesh, "values at points");
  std::vector<int> triangles(std::max(2, mesh.triangle_count()));  // a tree has two leaves or more
  std::vector<Box> boxes(triangles.size());
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    triangles[k] = std::min(static_cast<int>(k), mesh.triangle_count() - 1);
    for (const int v : mesh.triangles.row(triangles[k]))
      boxes[k].extend(mesh.vertices.row(v).transpose());
  }
  tree_.init(triangles.begin(), triangles.end(), boxes.begin(), boxes.end());
}

std::optional<PointValues::Location> PointValues::locate(const Eigen::Vector2d& x,
                                                         double outside) const {
  // a point with lambda >= -outside lies at most 2 outside diameters beyond the triangle, and
  // lambda is rounded
  Search search{space_.mesh(), x, outside, 2 * outside + 1e-9};
  Eigen::BVIntersect(tree_, search);
  return search.found.triangle >= 0 ? std::optional(search.found) : std::nullopt;
}

double PointValues::value(const Eigen::VectorXd& u, const Location& at) const {
  return space_.element().basis(at.lambda).dot(u(space_.cell_dofs().row(at.triangle)));
}

Eigen::Vector2d PointValues::gradient(const Eigen::VectorXd& u, const Location& at) const {
  const Eigen::MatrixX3d derivative = space_.element().derivative(at.lambda);
  const Eigen::MatrixX2d slopes = derivative * barycentric_gradients(space_.mesh(), at.triangle);
  return slopes.transpose() * u(space_.cell_dofs().row(at.triangle));
}

}  // namespace antilock
