#pragma once
#include <span>

#include "antilock/core/detail/eigen_memory.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// A Field that knows its values at many points at once, as a formula does. `at` takes all x, then all y.
struct BlockField {
  std::function<void(std::span<const double> points, std::span<double> values)> at;
  double operator()(double x, double y) const {
    const double point[] = {x, y};
    double value = 0;
    at(point, {&value, 1});
    return value;
  }
};

/// The values of any field at the columns (x, y), at once where it is a BlockField.
inline void evaluate(const Field& f, const Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>& points,
                     Eigen::VectorXd& values) {
  const auto n = static_cast<std::size_t>(points.cols());
  values.resize(points.cols());
  if (const auto* block = f.target<BlockField>()) return block->at({points.data(), 2 * n}, {values.data(), n});
  for (Eigen::Index q = 0; q < values.size(); ++q) values(q) = f(points(0, q), points(1, q));
}

}  // namespace antilock
