#include "antilock/analysis/detail/lift.hpp"

#include <algorithm>
#include <limits>

namespace antilock {
namespace {

/// Raises `lift` at the ends of an edge so far that it is at least `lack` at s. Both ends that are
/// free are raised by the same amount.
void raise_ends(Eigen::VectorXd& lift, const std::vector<int>& edge, const std::vector<char>& held,
                double s, double lack, double tolerance) {
  const int left = edge.front();
  const int right = edge.back();
  // what the function with the value 1 at the free ends has at s
  const double reach_of_left = held[left] ? 0 : 1 - s;
  const double reach_of_right = held[right] ? 0 : s;
  const double reach = reach_of_left + reach_of_right;
  const double negligible = reach > 0 ? 0 : tolerance;
  if (lack <= negligible) return;
  const double height = reach > 0 ? lack / reach : std::numeric_limits<double>::infinity();
  for (const int end : {left, right})
    if (!held[end] || reach == 0) lift(end) = std::max(lift(end), height);
}

/// Makes a function affine on an edge between the values at its ends.
void interpolate_between_ends(Eigen::VectorXd& lift, const std::vector<int>& edge) {
  for (std::size_t i = 1; i + 1 < edge.size(); ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(edge.size() - 1);
    lift(edge[i]) = (1 - s) * lift(edge.front()) + s * lift(edge.back());
  }
}

}  // namespace

Eigen::VectorXd lift_above(const InterfaceLine& sigma, const EdgeBasis& basis,
                           const Eigen::VectorXd& v, const Profile& obstacle,
                           const std::vector<char>& held, double tolerance) {
  Eigen::VectorXd lift = Eigen::VectorXd::Zero(v.size());
  const Eigen::Index intervals = basis.value.rows() - 1;
  for (const std::vector<int>& edge : sigma.edges) {
    const Eigen::VectorXd on_edge = basis.value * v(edge);
    for (Eigen::Index q = 0; q <= intervals; ++q) {
      const double s = static_cast<double>(q) / static_cast<double>(intervals);
      const double lack = obstacle(sigma.left_end(edge) + s * sigma.edge_length(edge)) - on_edge(q);
      raise_ends(lift, edge, held, s, lack, tolerance);
    }
  }
  for (const std::vector<int>& edge : sigma.edges) interpolate_between_ends(lift, edge);
  return lift;
}

Eigen::VectorXd lift_into_k(const InterfaceLine& sigma, const EdgeBasis& basis,
                            const Eigen::VectorXd& v, const UnilateralContact& contact,
                            const std::vector<char>& held, double tolerance) {
  const auto lower = [&](double x) { return -contact.gap(x); };
  Eigen::VectorXd lift = lift_above(sigma, basis, v, lower, held, tolerance);
  if (!contact.upper_obstacle || !lift.allFinite()) return lift;
  // below the upper obstacle: above its mirror image, upside down
  const auto mirrored = [&](double x) { return -contact.upper_obstacle(x); };
  lift -= lift_above(sigma, basis, -v - lift, mirrored, held, tolerance);
  const Eigen::VectorXd lack = lift_above(sigma, basis, v + lift, lower, held, tolerance);
  if (!(lack.maxCoeff() <= tolerance)) lift(0) = std::numeric_limits<double>::infinity();
  return lift;
}

}  // namespace antilock
