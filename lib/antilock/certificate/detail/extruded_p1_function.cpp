#include "antilock/certificate/detail/extruded_p1_function.hpp"

#include <algorithm>
#include <cmath>

namespace antilock {

ExtrudedP1Function::ExtrudedP1Function(TriangleMesh mesh, Eigen::VectorXd v, Eigen::VectorXd p)
    : mesh_(std::move(mesh)), v_(std::move(v)), p_(std::move(p)) {
  require_triangles(mesh_, "P1 function on columns");
  const auto begin = std::find(mesh_.region.begin(), mesh_.region.end(), Region::layer);
  first_ = static_cast<int>(begin - mesh_.region.begin());
  // extruded() puts the triangles of a column one after the other, from Sigma down: left and right
  // ends of two triangles tell the next column
  for (int t = first_; t < mesh_.triangle_count(); t += 2) {
    const double left = mesh_.vertices(mesh_.triangles(t, 0), 0),
                 right = mesh_.vertices(mesh_.triangles(t, 1), 0);
    if (columns_.empty() || columns_.back().left != left || columns_.back().right != right)
      columns_.push_back({left, right, t});
  }
  rows_ = (mesh_.triangle_count() - first_) / (2 * static_cast<int>(columns_.size()));
  std::sort(columns_.begin(), columns_.end(),
            [](const Column& a, const Column& b) { return a.left < b.left; });
}

ExtrudedP1Function::Place ExtrudedP1Function::locate(const Eigen::Vector2d& x) const {
  auto column = std::upper_bound(columns_.begin(), columns_.end(), x(0),
                                 [](double value, const Column& c) { return value < c.left; });
  if (column != columns_.begin()) --column;
  const double depth = -x(1) * rows_;
  const int row = std::clamp(static_cast<int>(depth), 0, rows_ - 1);
  const double width = column->right - column->left;
  const double s = (x(0) - column->left) / width;
  const double t = row + 1 - depth;
  return {column->triangle + 2 * row + (t > s ? 1 : 0), width, s,
          t};  // the diagonal / : the first triangle lies below it
}

// corners: low left, low right, up right below the diagonal; low left, up right, up left above it
double ExtrudedP1Function::value(const Eigen::Vector2d& x) const {
  const auto [triangle, width, s, t] = locate(x);
  const auto corner = mesh_.triangles.row(triangle);
  if (t > s) return (1 - t) * v_(corner(0)) + s * v_(corner(1)) + (t - s) * v_(corner(2));
  return (1 - s) * v_(corner(0)) + (s - t) * v_(corner(1)) + t * v_(corner(2));
}

Eigen::Vector2d ExtrudedP1Function::flux_of(int row) const {
  const int triangle = first_ + row;
  const auto corner = mesh_.triangles.row(triangle);
  const int right = 1, left = row % 2 == 0 ? 0 : 2;  // the two corners at one height
  return {(v_(corner(right)) - v_(corner(left))) /
              (mesh_.vertices(corner(right), 0) - mesh_.vertices(corner(left), 0)),
          p_(row)};
}

Eigen::Vector2d ExtrudedP1Function::flux(const Eigen::Vector2d& x) const {
  return flux_of(locate(x).triangle - first_);
}

double ExtrudedP1Function::mean(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  const Eigen::Vector2d along = b - a;
  std::vector<double> cuts{0, 1};
  const auto cut = [&](double at) {
    if (at > 0 && at < 1) cuts.push_back(at);
  };
  if (along(0) != 0) {
    const auto [low, high] = std::minmax(a(0), b(0));
    auto column = std::upper_bound(columns_.begin(), columns_.end(), low,
                                   [](double value, const Column& c) { return value < c.left; });
    for (; column != columns_.end() && column->left < high; ++column)
      cut((column->left - a(0)) / along(0));
  }
  if (along(1) != 0) {
    const auto [low, high] = std::minmax(a(1), b(1));
    for (int j = static_cast<int>(std::ceil(-high * rows_)); j <= -low * rows_; ++j)
      cut((-static_cast<double>(j) / rows_ - a(1)) / along(1));
  }
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    // inside one cell, where v is affine on both sides of the diagonal s = t
    const double from = cuts[k - 1], to = cuts[k], half = (to - from) / 2, middle = from + half;
    const Place place = locate(a + middle * along);
    const double off = place.t - place.s;
    const double change = half * (along(1) * rows_ - along(0) / place.width);
    const double crossing = std::abs(off) < std::abs(change) ? middle - off / change * half : to;
    for (const auto& [p, q] : {std::pair(from, crossing), {crossing, to}})
      sum += (q - p) * value(a + (p + q) / 2 * along);
  }
  return sum;
}

}  // namespace antilock
