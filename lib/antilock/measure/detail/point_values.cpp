#include "antilock/measure/detail/point_values.hpp"

#include <algorithm>
#include <cmath>

namespace antilock {

PointValues::PointValues(const Space& space) : space_(&space) {
  const TriangleMesh& mesh = space.mesh();
  // as many strips as the square root of the triangles: each holds about as many again
  const int strips = std::max(1, static_cast<int>(std::sqrt(double(mesh.triangle_count()))));
  left_ = mesh.vertices.col(0).minCoeff();
  width_ = (mesh.vertices.col(0).maxCoeff() - left_) / strips;
  strips_.resize(static_cast<std::size_t>(strips));
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    double from = mesh.vertices(mesh.triangles(t, 0), 0), to = from;
    for (int i = 1; i < 3; ++i) {
      const double x = mesh.vertices(mesh.triangles(t, i), 0);
      from = std::min(from, x), to = std::max(to, x);
    }
    // one strip more on both sides: a point on an edge may be rounded across it
    for (int s = std::max(0, column(from) - 1); s <= std::min(strips - 1, column(to) + 1); ++s)
      strips_[static_cast<std::size_t>(s)].push_back(t);
  }
}

int PointValues::column(double x) const {
  return std::clamp(static_cast<int>((x - left_) / width_), 0, static_cast<int>(strips_.size()) - 1);
}

std::optional<PointValues::Place> PointValues::locate(const Eigen::Vector2d& x, double outside) const {
  const TriangleMesh& mesh = space_->mesh();
  for (const int t : strips_[static_cast<std::size_t>(column(x(0)))]) {
    const Eigen::Vector2d corner = mesh.vertices.row(mesh.triangles(t, 0));
    Eigen::Vector3d lambda = barycentric_gradients(mesh, t) * (x - corner);
    lambda(0) += 1;
    if (lambda.minCoeff() >= -outside) return Place{t, lambda};
  }
  return {};
}

double PointValues::value(const Eigen::VectorXd& u, const Place& at) const {
  return space_->element().basis(at.lambda).dot(u(space_->unknowns().row(at.triangle)));
}

Eigen::Vector2d PointValues::gradient(const Eigen::VectorXd& u, const Place& at) const {
  const Eigen::MatrixX2d slopes =
      space_->element().derivative(at.lambda) * barycentric_gradients(space_->mesh(), at.triangle);
  return slopes.transpose() * u(space_->unknowns().row(at.triangle));
}

}  // namespace antilock
