#include "antilock/adapt/marking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "antilock/adapt/bisection.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/space.hpp"

namespace antilock {
namespace {

constexpr double negligible = 1e-3;  // of the integral of f^2, on one triangle
constexpr double seen_enough =
    0.1;  // of what is sampled, on one triangle as on all of them together

/// f^2 and f |f| at a point of triangle t.
Eigen::Array2d signed_squares(const TriangleMesh& mesh, int t, const Eigen::Vector3d& lambda,
                              const Field& load) {
  const Eigen::Vector2d x = point_in(mesh, t, lambda);
  const double f = load(x(0), x(1));
  return Eigen::Array2d(f * f, f * std::abs(f));
}

/// Their means on triangle t, by the centroids of a triangular grid with `per_side` samples per
/// side.
Eigen::Array2d sampled_means(const TriangleMesh& mesh, int t, int per_side, const Field& load) {
  Eigen::Array2d sum(0, 0);
  for (int i = 0; i < per_side; ++i)
    for (int j = 0; i + j < per_side; ++j) {
      const double a = (i + 1.0 / 3) / per_side;
      const double b = (j + 1.0 / 3) / per_side;
      sum += signed_squares(mesh, t, {a, b, 1 - a - b}, load);
    }
  sum *= 2.0 / (per_side * (per_side + 1));
  return sum;
}

/// Their means on triangle t, by the quadrature rule.
Eigen::Array2d quadrature_means(const TriangleMesh& mesh, int t, const Field& load) {
  const Quadrature& rule = radon_rule();
  Eigen::Array2d sum(0, 0);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    sum += rule.weights(q) * signed_squares(mesh, t, rule.points.row(q), load);
  return sum;
}

/// The quadrature errors of f^2 on the triangles of meshes that are bisected. A triangle is sampled
/// once: it is known by its corners, whose numbers bisection keeps.
class LoadSampler {
 public:
  explicit LoadSampler(const Field& load) : load_(load) {}

  /// Returns the quadrature error per triangle; 0 where it is not above seen_enough.
  Eigen::ArrayXd errors(const TriangleMesh& mesh) {
    constexpr int most_samples = 1 << 20;  // of a round: they take no longer than its solve would
    const double affordable = std::sqrt(2 * most_samples / mesh.triangle_count());
    const int per_side = std::clamp(static_cast<int>(affordable), 8, 64);
    Eigen::ArrayXd errors = Eigen::ArrayXd::Zero(mesh.triangle_count());
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.region[t] != Region::body) continue;
      std::array<int, 3> corners{mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)};
      std::sort(corners.begin(), corners.end());
      const auto [place, fresh] = known_.try_emplace(corners, 0);
      if (fresh) place->second = error_on(mesh, t, per_side);
      errors(t) = place->second;
    }
    first_round_ = false;
    return errors;
  }
  /// The integral of f^2 over the mesh of the first round.
  double total() const { return total_; }

 private:
  double error_on(const TriangleMesh& mesh, int t, int per_side) {
    const Eigen::Array2d sampled = sampled_means(mesh, t, per_side, load_);
    const Eigen::Array2d seen = quadrature_means(mesh, t, load_);
    const double largest = std::max(sampled(0), seen(0));
    const double off = (sampled - seen).abs().maxCoeff();
    if (first_round_) total_ += mesh.area(t) * largest;
    return off > seen_enough * largest ? mesh.area(t) * off : 0;
  }

  const Field& load_;
  std::map<std::array<int, 3>, double> known_;
  bool first_round_ = true;
  double total_ = 0;
};

/// The numbers of the triangles, the one with the largest error first.
std::vector<int> order_by(const Eigen::ArrayXd& errors) {
  std::vector<int> order(errors.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return errors(a) > errors(b); });
  return order;
}

/// The edges of the body on Sigma, in the order in which extruded() makes the columns below them.
std::vector<int> sigma_edges(const TriangleMesh& body) {
  std::vector<int> sigma;
  for (int e = 0; e < body.edge_count(); ++e)
    if (body.edge_tag[e] == EdgeTag::contact) sigma.push_back(e);
  return sigma;
}

}  // namespace

std::vector<bool> dorfler_mark(const Eigen::VectorXd& indicator, const Marking& marking) {
  std::vector<Eigen::Index> order(indicator.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return indicator(a) > indicator(b); });
  const double enough = marking.theta * indicator.sum();
  const auto least =
      static_cast<std::size_t>(std::ceil(marking.min_fraction * static_cast<double>(order.size())));
  const std::size_t max_marked =
      marking.max_marked > 0 ? static_cast<std::size_t>(marking.max_marked) : order.size() + 1;
  std::vector<bool> marks(indicator.size(), false);
  double sum = 0;
  std::size_t k = 0;
  for (; k < std::min(max_marked, order.size()) && (sum < enough || k < least); ++k) {
    marks[order[k]] = true;
    sum += indicator(order[k]);
  }
  if (max_marked > order.size() &&
      static_cast<double>(k) > marking.uniform_above * static_cast<double>(order.size()))
    marks.assign(order.size(), true);
  return marks;
}

AdaptiveMesh refine_marked(const AdaptiveMesh& last, RefinementStrategy strategy, double epsilon,
                           const Eigen::VectorXd& indicator, const Marking& marking) {
  AdaptiveMesh next;
  if (strategy == RefinementStrategy::bisect) {
    const std::vector<bool> all = dorfler_mark(indicator, marking);
    next.marks = static_cast<int>(std::count(all.begin(), all.end(), true));
    next.mesh = bisected(last.mesh, all);
    return next;
  }
  // extruded() has the body's triangles first, then the columns
  const TriangleMesh& body = last.body;
  const int in_body = body.triangle_count();
  const std::vector<int> sigma = sigma_edges(body);
  const auto columns = static_cast<int>(sigma.size());
  const int per_column = (last.mesh.triangle_count() - in_body) / columns;
  Eigen::VectorXd together(in_body + columns);
  together.head(in_body) = indicator.head(in_body);
  for (int c = 0; c < columns; ++c)
    together(in_body + c) = indicator.segment(in_body + c * per_column, per_column).sum();
  const std::vector<bool> all = dorfler_mark(together, marking);
  const std::vector<bool> triangles(all.begin(), all.begin() + in_body);
  std::vector<bool> edges(body.edge_count(), false);
  for (int c = 0; c < columns; ++c) edges[sigma[c]] = all[in_body + c];
  next.marks = static_cast<int>(std::count(all.begin(), all.end(), true));
  next.body = bisected(body, triangles, edges);
  next.mesh = extruded(next.body, epsilon);
  return next;
}

std::string resolve_load(TriangleMesh& mesh, const Field& load, int most_triangles) {
  require_triangles(mesh, "resolution of a load");
  constexpr int most_rounds = 16;
  LoadSampler sampler(load);
  for (int round = 0;; ++round) {
    const Eigen::ArrayXd errors = sampler.errors(mesh);
    const double total = sampler.total();
    const std::vector<int> order = order_by(errors);
    std::vector<bool> missed(mesh.triangle_count(), false);
    const double all = errors.sum();
    double left = 0;  // the errors on the triangles that are missed
    for (const int t : order) {
      if (errors(t) <= negligible * total && all - left <= seen_enough * total) break;
      missed[t] = true;
      left += errors(t);
    }
    if (left == 0) return {};
    const auto marks = std::count(missed.begin(), missed.end(), true);
    if (round == most_rounds || mesh.triangle_count() + 3 * marks > most_triangles) {
      const Eigen::Vector2d x = point_in(mesh, order.front(), Eigen::Vector3d::Constant(1.0 / 3));
      return fmt::format(
          "the load varies between the points of the quadrature near ({:.4g}, {:.4g}), by {:.1e} "
          "of its square: the "
          "certificate holds for the load as sampled",
          x(0), x(1), left / total);
    }
    mesh = bisected(mesh, missed);
  }
}

}  // namespace antilock
