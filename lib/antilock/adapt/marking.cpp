#include "antilock/adapt/marking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "antilock/adapt/bisection.hpp"
#include "antilock/form/quadrature.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

std::vector<bool> dorfler_mark(const Eigen::VectorXd& indicator, const Marking& marking) {
  std::vector<Eigen::Index> order(indicator.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return indicator(a) > indicator(b); });
  const double enough = marking.theta * indicator.sum();
  const auto least = static_cast<std::size_t>(std::ceil(marking.min_fraction * static_cast<double>(order.size())));
  const std::size_t max_marked =
      marking.max_marked > 0 ? static_cast<std::size_t>(marking.max_marked) : order.size() + 1;
  std::vector<bool> marks(indicator.size(), false);
  double sum = 0;
  std::size_t k = 0;
  for (; k < std::min(max_marked, order.size()) && (sum < enough || k < least); ++k) {
    marks[order[k]] = true;
    sum += indicator(order[k]);
  }
  if (max_marked > order.size() && static_cast<double>(k) > marking.uniform_above * static_cast<double>(order.size()))
    marks.assign(order.size(), true);
  return marks;
}

AdaptiveMesh refine_marked(const AdaptiveMesh& last, RefinementStrategy strategy, double epsilon,
                           const Eigen::VectorXd& indicator, const Marking& marking) {
  const TriangleMesh &mesh = last.mesh, &body = last.body;
  AdaptiveMesh next;
  if (strategy == RefinementStrategy::bisect) {
    const std::vector<bool> all = dorfler_mark(indicator, marking);
    next.marks = static_cast<int>(std::count(all.begin(), all.end(), true));
    next.mesh = bisected(mesh, all);
    return next;
  }
  // extruded() has the body's triangles first, then the columns in the order of the body's edges on Sigma
  const int in_body = body.triangle_count();
  std::vector<int> sigma;
  for (int e = 0; e < body.edge_count(); ++e)
    if (body.edge_tag[e] == EdgeTag::contact) sigma.push_back(e);
  const auto columns = static_cast<int>(sigma.size()), per_column = (mesh.triangle_count() - in_body) / columns;
  Eigen::VectorXd together(in_body + columns);
  together.head(in_body) = indicator.head(in_body);
  for (int c = 0; c < columns; ++c)
    together(in_body + c) = indicator.segment(in_body + c * per_column, per_column).sum();
  const std::vector<bool> all = dorfler_mark(together, marking);
  std::vector<bool> edges(body.edge_count(), false);
  for (int c = 0; c < columns; ++c) edges[sigma[c]] = all[in_body + c];
  next.marks = static_cast<int>(std::count(all.begin(), all.end(), true));
  next.body = bisected(body, std::vector<bool>(all.begin(), all.begin() + in_body), edges);
  next.mesh = extruded(next.body, epsilon);
  return next;
}

std::string resolve_load(TriangleMesh& mesh, const Field& load, int most_triangles) {
  constexpr int most_rounds = 16, most_samples = 1 << 20;  // of a round: they take no longer than its solve would
  constexpr double negligible = 1e-3;                      // of the integral of f^2, on one triangle
  constexpr double seen_enough = 0.1;  // of what is sampled, on one triangle as on all of them together
  const Quadrature& rule = radon_rule();
  std::map<std::array<int, 3>, double> known;  // by corners, whose numbers bisection keeps
  double total = 0;
  for (int round = 0;; ++round) {
    const int per_side = std::clamp(static_cast<int>(std::sqrt(2 * most_samples / mesh.triangle_count())), 8, 64);
    Eigen::ArrayXd difference = Eigen::ArrayXd::Zero(mesh.triangle_count());
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.region[t] != Region::body) continue;
      std::array<int, 3> corners{mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)};
      std::sort(corners.begin(), corners.end());
      const auto [place, fresh] = known.try_emplace(corners, 0);
      difference(t) = place->second;
      if (!fresh) continue;
      const auto square = [&](const Eigen::Vector3d& lambda) {  // f^2, and with the sign of f
        const Eigen::Vector2d x = point_in(mesh, t, lambda);
        const double f = load(x(0), x(1));
        return Eigen::Array2d(f * f, f * std::abs(f));
      };
      Eigen::Array2d sampled(0, 0), seen(0, 0);
      for (int i = 0; i < per_side; ++i)
        for (int j = 0; i + j < per_side; ++j) {
          const double a = (i + 1.0 / 3) / per_side, b = (j + 1.0 / 3) / per_side;
          sampled += square({a, b, 1 - a - b});
        }
      sampled *= 2.0 / (per_side * (per_side + 1));
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) seen += rule.weights(q) * square(rule.points.row(q));
      const double largest = std::max(sampled(0), seen(0)), off = (sampled - seen).abs().maxCoeff();
      if (round == 0) total += mesh.area(t) * largest;
      if (off > seen_enough * largest) difference(t) = place->second = mesh.area(t) * off;
    }
    std::vector<int> order(mesh.triangle_count());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return difference(a) > difference(b); });
    std::vector<bool> missed(mesh.triangle_count(), false);
    const double all = difference.sum();
    double left = 0;
    for (const int t : order) {
      if (difference(t) <= negligible * total && all - left <= seen_enough * total) break;
      missed[t] = true;
      left += difference(t);
    }
    if (left == 0) return {};
    const auto marks = std::count(missed.begin(), missed.end(), true);
    if (round == most_rounds || mesh.triangle_count() + 3 * marks > most_triangles) {
      const Eigen::Vector2d x = point_in(mesh, order.front(), Eigen::Vector3d::Constant(1.0 / 3));
      return fmt::format(
          "the load varies between the points of the quadrature near ({:.4g}, {:.4g}), by {:.1e} of its square: the "
          "certificate holds for the load as sampled",
          x(0), x(1), left / total);
    }
    mesh = bisected(mesh, missed);
  }
}

}  // namespace antilock
