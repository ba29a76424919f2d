// How much energy a layer that does not follow has lost, with a proof, and without a second solve of the same size.
//
// For every v of K, J(u) <= J(v): J(u_h) - J(v) is a lower bound of the energy J(u_h) - J(u) that is lost. v is made so:
// - in the body v = u_h + w, w from a small space W: continuous, piecewise bilinear between rows of hats whose widths
//   and heights grow with the distance from Sigma (w is nearly harmonic), interpolated at the vertices of the body;
// - in the layer v has columns of its own, one under each edge of Sigma, in rows of equal height k. On such columns
//   P1 is a set of differences: with D the sum of |v(i+1, j) - v(i, j)|^2 / (x(i+1) - x(i)) on row j,
//       int (d_x v)^2 = sum_j k_j D_j, k_j = k (k / 2 for the first and the last row),
//   and d_y v on the two triangles beside a vertical segment is its difference / k: one row of B per segment. A trace
//   of degree 2 on Sigma keeps its bubble beta 4 s (1 - s) per edge, constant in y: it adds 16/3 beta^2 / length to the
//   energy, and is orthogonal to P1. (22) is the same problem after y -> y / epsilon, (23).
// J is smallest over these v: a variational inequality with few unknowns. Body and layer enter as differences, so that
// nothing of the size of J cancels but J(u_h)'s own layer part.
#include "antilock/analysis/lost_energy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "antilock/analysis/detail/companion.hpp"
#include "antilock/analysis/detail/ties.hpp"
#include "antilock/core/error.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

/// Sigma from left to right: its vertices, and the edges between them as the places of their ends.
struct Line {
  std::vector<int> vertex;
  std::vector<double> x;
  std::vector<std::array<int, 2>> edge;
  std::vector<int> mesh_edge;
};

Line sigma_line(const TriangleMesh& mesh) {
  Line line;
  std::vector<int> place(mesh.vertex_count(), -1);
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::sigma) {
      line.mesh_edge.push_back(e);
      for (int end = 0; end < 2; ++end)
        if (const int v = mesh.edges(e, end); place[v] < 0) place[v] = 0, line.vertex.push_back(v);
    }
  std::sort(line.vertex.begin(), line.vertex.end(),
            [&](int a, int b) { return mesh.vertices(a, 0) < mesh.vertices(b, 0); });
  for (std::size_t i = 0; i < line.vertex.size(); ++i) {
    place[line.vertex[i]] = static_cast<int>(i);
    line.x.push_back(mesh.vertices(line.vertex[i], 0));
  }
  for (const int e : line.mesh_edge) {
    std::array<int, 2> ends{place[mesh.edges(e, 0)], place[mesh.edges(e, 1)]};
    if (ends[0] > ends[1]) std::swap(ends[0], ends[1]);
    line.edge.push_back(ends);
  }
  return line;
}

/// One row of hats: where they sit, and the number of each one's unknown (-1: left out).
struct Row {
  double y;
  std::vector<double> x;
  std::vector<int> unknown;
};

using Weights = std::array<std::pair<int, double>, 4>;  // unknown (-1: none) and value of its hat at a vertex

/// W: hats on rows over the body. Row 0 is Sigma with a hat per vertex.
class Hats {
 public:
  Hats(const TriangleMesh& mesh, const Line& sigma, const std::vector<char>& in_body, const std::vector<char>& held) {
    double left = 1e300, right = -1e300, top = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      if (!in_body[v]) continue;
      left = std::min(left, mesh.vertices(v, 0)), right = std::max(right, mesh.vertices(v, 0));
      top = std::max(top, mesh.vertices(v, 1));
    }
    const double h = (sigma.x.back() - sigma.x.front()) / static_cast<double>(sigma.x.size() - 1);
    rows_.push_back({0, sigma.x, std::vector<int>(sigma.x.size(), 0)});
    for (double y = top; y > h; y /= ratio) {
      const int cells = std::max(1, static_cast<int>(std::ceil((right - left) / (width * y))));
      Row row{y, {}, std::vector<int>(cells + 1, 0)};
      for (int i = 0; i <= cells; ++i) row.x.push_back(left + (right - left) * i / cells);
      rows_.insert(rows_.begin() + 1, std::move(row));
    }
    // a hat that is not 0 at a vertex with a prescribed value is left out
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (in_body[v] && held[v])
        visit(mesh.vertices.row(v), [](int& unknown, double weight) {
          if (weight > 1e-12) unknown = -1;
        });
    for (Row& row : rows_)
      for (int& unknown : row.unknown)
        if (unknown == 0) unknown = count_++;
  }
  int count() const { return count_; }  ///< unknowns; those of Sigma come first
  const Row& sigma() const { return rows_.front(); }
  Weights at(const Eigen::RowVector2d& point) {
    Weights weights;
    std::size_t n = 0;
    weights.fill({-1, 0.0});
    visit(point, [&](int unknown, double weight) { weights[n++] = {unknown, weight}; });
    return weights;
  }

 private:
  static constexpr double ratio = 2, width = 1;

  template <class Visit>
  void visit(const Eigen::RowVector2d& point, const Visit& seen) {
    std::size_t above = 1;
    while (above + 1 < rows_.size() && rows_[above].y < point(1)) ++above;
    if (above >= rows_.size()) {
      if (point(1) <= 0) visit_row(rows_[0], point(0), 1, seen);
      return;
    }
    const double low = rows_[above - 1].y, high = rows_[above].y;
    const double t = std::clamp((point(1) - low) / (high - low), 0.0, 1.0);
    visit_row(rows_[above - 1], point(0), 1 - t, seen);
    visit_row(rows_[above], point(0), t, seen);
  }
  template <class Visit>
  static void visit_row(Row& row, double x, double scale, const Visit& seen) {
    if (x < row.x.front() || x > row.x.back()) return;
    const auto right = std::clamp<std::ptrdiff_t>(std::upper_bound(row.x.begin(), row.x.end(), x) - row.x.begin(), 1,
                                                  static_cast<std::ptrdiff_t>(row.x.size()) - 1);
    const double s = (x - row.x[right - 1]) / (row.x[right] - row.x[right - 1]);
    seen(row.unknown[right - 1], scale * (1 - s));
    seen(row.unknown[right], scale * s);
  }

  std::vector<Row> rows_;
  int count_ = 0;
};

/// A symmetric matrix as it is summed up: few entries per row, those on and below the diagonal.
class Sum {
 public:
  explicit Sum(int size) : rows_(size) {}
  void add(int i, int j, double value) {
    auto& row = rows_[std::max(i, j)];
    const int column = std::min(i, j);
    for (auto& entry : row)
      if (entry.first == column) return void(entry.second += value);
    row.emplace_back(column, value);
  }
  SparseMatrix matrix() const {
    std::vector<Eigen::Triplet<double>> all;
    for (int i = 0; i < static_cast<int>(rows_.size()); ++i)
      for (const auto& [j, value] : rows_[i]) {
        all.emplace_back(i, j, value);
        if (j != i) all.emplace_back(j, i, value);
      }
    const auto size = static_cast<Eigen::Index>(rows_.size());
    SparseMatrix matrix(size, size);
    matrix.setFromTriplets(all.begin(), all.end());
    return matrix;
  }

 private:
  std::vector<std::vector<std::pair<int, double>>> rows_;
};

/// Of u_h, in the body and in the layer, and of what W can do with it.
struct Reduced {
  Eigen::VectorXd force;    ///< L(w) - a+(u_h, w)
  double layer_energy = 0;  ///< of u_h
};

/// int f times the hat function of each vertex, from the load on the unknowns of a conforming space.
Eigen::VectorXd load_on_vertices(const Space& space, const Eigen::VectorXd& load) {
  const Eigen::MatrixX3d nodes = space.element().nodes();
  Eigen::VectorXd at_vertices = Eigen::VectorXd::Zero(space.mesh().vertex_count());
  std::vector<char> seen(space.size(), 0);
  for (Eigen::Index t = 0; t < space.unknowns().rows(); ++t)
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
      const int unknown = space.unknowns()(t, i);
      if (std::exchange(seen[unknown], 1) != 0) continue;
      for (int k = 0; k < 3; ++k) at_vertices(space.mesh().triangles(t, k)) += nodes(i, k) * load(unknown);
    }
  return at_vertices;
}

Reduced reduce(const Scene& scene, const Space& space, const VariationalInequality& problem, const Solution& solution,
               Hats& hats, Sum& a1) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const auto* thin = std::get_if<ThinLayer>(&scene.layer());
  const Stiffness layer = thin != nullptr ? Stiffness{1 / thin->epsilon, 1 / thin->epsilon} : Stiffness{1, 0};
  const Quadrature& rule = strain_rule(element);
  std::vector<Eigen::MatrixX3d> derivative;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) derivative.push_back(element.derivative(rule.points.row(q)));

  Reduced reduced;
  reduced.force = Eigen::VectorXd::Zero(hats.count());
  const Eigen::VectorXd load = load_on_vertices(space, problem.load);
  std::vector<Weights> weights(mesh.vertex_count());
  std::vector<char> known(mesh.vertex_count(), 0);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
    const Eigen::VectorXd u = solution.u(space.unknowns().row(t));
    const double area = mesh.area(t);
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // of grad u_h
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d gradient = lambda.transpose() * (derivative[q].transpose() * u);
      mean += rule.weights(q) * gradient;
      if (mesh.region[t] == Region::layer)
        reduced.layer_energy +=
            rule.weights(q) * area / 2 * (layer.x * gradient(0) * gradient(0) + layer.y * gradient(1) * gradient(1));
    }
    if (mesh.region[t] == Region::layer) continue;
    std::array<std::pair<int, Eigen::Vector2d>, 12> hat;  // the hats that are not 0 here, and their gradients
    std::size_t count = 0;
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles(t, k);
      if (std::exchange(known[v], 1) == 0) {
        weights[v] = hats.at(mesh.vertices.row(v));
        for (const auto& [unknown, weight] : weights[v])
          if (unknown >= 0) reduced.force(unknown) += weight * load(v);
      }
      for (const auto& [unknown, weight] : weights[v]) {
        if (unknown < 0 || weight == 0) continue;
        std::size_t at = 0;
        while (at < count && hat[at].first != unknown) ++at;
        if (at == count) hat[count++] = {unknown, Eigen::Vector2d::Zero()};
        hat[at].second += weight * lambda.row(k).transpose();
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      reduced.force(hat[i].first) -= area * mean.dot(hat[i].second);
      for (std::size_t j = 0; j <= i; ++j) a1.add(hat[i].first, hat[j].first, area * hat[i].second.dot(hat[j].second));
    }
  }
  reduced.layer_energy += problem.compliance * solution.p.cwiseAbs2().dot(problem.m) / 2;
  return reduced;
}

double at_rest(const VariationalInequality& problem, const Eigen::VectorXd& u, const Eigen::VectorXd& p) {
  return u.dot(problem.a1 * u) / 2 + problem.compliance * p.cwiseAbs2().dot(problem.m) / 2 - problem.load.dot(u);
}

}  // namespace

double LostEnergy::share() const {
  constexpr double negligible = 1e-8;  // the square of what the solvers leave of u, 1e-10 by default, with room
  if (!(motion > negligible * scale)) return 0;
  return std::clamp(lost / motion, 0.0, 1.0);
}

LostEnergy lost_energy(const Scene& scene, const Space& space, const VariationalInequality& problem,
                       const Solution& solution) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const auto epsilon = scene.epsilon();
  if (!epsilon || !(scene.layer_depth() > 0) || !element.conforming() || element.degree() > 2)
    throw Error("lost energy: accepted: P1 or P2 on a mesh with a layer");
  const Line sigma = sigma_line(mesh);
  std::vector<char> in_body(mesh.vertex_count(), 0), held(mesh.vertex_count(), 0);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::body)
      for (int i = 0; i < 3; ++i) in_body[mesh.triangles(t, i)] = 1;
  for (const int i : problem.fixed)
    if (i < mesh.vertex_count()) held[i] = 1;  // unknowns at vertices come first
  Hats hats(mesh, sigma, in_body, held);
  // the layer: rows 1 to `rows` of columns below the free vertices of Sigma
  const auto points = static_cast<int>(sigma.x.size());
  double length = 0;
  for (const auto& [left, right] : sigma.edge) length += sigma.x[right] - sigma.x[left];
  const double cells = *epsilon * static_cast<double>(sigma.edge.size()) / length;  // epsilon / h
  const int rows = std::clamp(static_cast<int>(std::ceil(cells - 1e-9)), 1, 8);
  const double height = 1.0 / rows;
  std::vector<int> free(points, -1);  // the free vertices of Sigma
  int columns = 0;
  for (int i = 0; i < points; ++i)
    if (held[sigma.vertex[i]] == 0) free[i] = columns++;
  const auto unknown = [&](int i, int row) {
    if (free[i] < 0) return -1;
    return row == 0 ? hats.sigma().unknown[i] : hats.count() + (row - 1) * columns + free[i];
  };

  VariationalInequality strip;
  const int size = hats.count() + rows * columns;
  Sum a1(size);
  // a hat may reach no vertex of the body, or no more than its neighbours do: a little energy more makes it unique, and
  // v no better than it is
  for (int i = 0; i < hats.count(); ++i) a1.add(i, i, 1e-10);
  const Reduced reduced = reduce(scene, space, problem, solution, hats, a1);
  std::vector<Eigen::Triplet<double>> b;
  strip.load = Eigen::VectorXd::Zero(size);
  strip.load.head(hats.count()) = reduced.force;
  Eigen::VectorXd width = Eigen::VectorXd::Zero(points);
  const auto base = [&](int i) { return solution.u(sigma.vertex[i]); };
  std::vector<double> bubble(sigma.edge.size(), 0);
  double base_energy = 0;  // of the layer that is constant in y, with the values of u_h on Sigma
  for (std::size_t e = 0; e < sigma.edge.size(); ++e) {
    const auto [i, j] = sigma.edge[e];
    const double dx = sigma.x[j] - sigma.x[i], jump = base(j) - base(i);
    width(i) += dx / 2, width(j) += dx / 2;
    if (element.degree() == 2)
      bubble[e] = solution.u(mesh.vertex_count() + sigma.mesh_edge[e]) - (base(i) + base(j)) / 2;
    base_energy += (jump * jump + 16.0 / 3 * bubble[e] * bubble[e]) / dx / 2;
    for (int row = 0; row <= rows; ++row) {
      const double weight = (row == 0 || row == rows ? 0.5 : 1.0) * height / dx;
      const int p = unknown(i, row), q = unknown(j, row);
      if (p >= 0) a1.add(p, p, weight), strip.load(p) += weight * jump;
      if (q >= 0) a1.add(q, q, weight), strip.load(q) -= weight * jump;
      if (p >= 0 && q >= 0) a1.add(p, q, -weight);
    }
  }
  strip.m.resize(static_cast<Eigen::Index>(columns) * rows);
  for (int i = 0; i < points; ++i) {
    if (free[i] < 0) continue;
    for (int row = 0; row < rows; ++row) {
      const int segment = row * columns + free[i];
      b.emplace_back(segment, unknown(i, row), 1 / height);
      b.emplace_back(segment, unknown(i, row + 1), -1 / height);
      strip.m(segment) = width(i) * height;
    }
  }
  strip.a1 = a1.matrix();
  strip.b.resize(strip.m.size(), size);
  strip.b.setFromTriplets(b.begin(), b.end());
  strip.compliance = *epsilon * *epsilon;
  if (scene.contact()) {
    std::vector<Chord> chords;
    for (std::size_t e = 0; e < sigma.edge.size(); ++e) {
      const auto [i, j] = sigma.edge[e];
      chords.push_back({{free[i], free[j]}, {sigma.x[i], sigma.x[j]}, {0, 0}, bubble[e]});
    }
    strip.lower = admissible_bounds(*scene.contact(), chords, columns);
    for (int i = 0; i < points; ++i)
      if (free[i] >= 0) strip.contact.push_back(unknown(i, rows)), strip.lower(free[i]) -= base(i);
  }

  LostEnergy energy;
  energy.unknowns = size;
  if (columns == 0) return energy;
  const Solution moved = active_set(strip);
  const double j_moved = base_energy + at_rest(strip, moved.u, moved.p);

  // v_0: the layer at 0, the body as W makes it best
  VariationalInequality clamped = strip;
  clamped.contact.clear(), clamped.lower.resize(0);
  clamped.b.resize(0, size), clamped.m.resize(0);
  std::vector<double> values;
  for (int i = 0; i < points; ++i)
    if (free[i] >= 0) clamped.fixed.push_back(unknown(i, 0)), values.push_back(-base(i));
  for (int row = 1; row <= rows; ++row)
    for (int i = 0; i < points; ++i)
      if (free[i] >= 0) clamped.fixed.push_back(unknown(i, row)), values.push_back(-base(i));
  clamped.fixed_values = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  Eigen::VectorXd still = Eigen::VectorXd::Zero(size);
  if (clamped.free_count() > 0)
    still = active_set(clamped).u;
  else
    still(clamped.fixed) = clamped.fixed_values;
  const double j_still = base_energy + at_rest(clamped, still, Eigen::VectorXd::Zero(0));

  const Eigen::VectorXd way = moved.u - still;
  energy.lost = reduced.layer_energy - j_moved;
  energy.motion = std::max(j_still - j_moved,
                           way.dot(strip.a1 * way) / 2 + strip.compliance * moved.p.cwiseAbs2().dot(strip.m) / 2);
  energy.scale = std::abs(antilock::energy(problem, solution));
  return energy;
}

std::optional<LayerReport> report_layer(const Scene& scene, const Space& space, const VariationalInequality& problem,
                                        const Solution& solution) {
  constexpr double telling = 0.05;  // v is within a few per cent of the best: whoever has lost 10 % is told so
  const Element& element = space.element();
  const TriangleMesh& mesh = space.mesh();
  if (!scene.epsilon()) return std::nullopt;
  if (!(scene.layer_depth() > 0)) return LayerReport{"no layer mesh: nothing here can lock", {}, ""};
  if (!element.conforming())
    return LayerReport{
        element.name() + " does not lock: half a motion without strain per layer triangle, on any mesh (Theorem 7)",
        {},
        ""};
  if (in_columns(mesh))
    return LayerReport{element.name() + " does not lock here: the columns of the layer are free of each other", {}, ""};
  LayerReport report;
  const int groups = tied_groups(mesh);
  report.diagnosis = fmt::format(
      "below {} edges of Sigma the layer's triangles are tied into {} group{} by edges that are not vertical; without "
      "strain {} is one polynomial of degree {} in x on each",
      std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), EdgeTag::sigma), groups, groups == 1 ? "" : "s",
      element.name(), element.degree());
  if (element.degree() > 2) return report;
  try {
    report.lost = lost_energy(scene, space, problem, solution).share();
  } catch (const Error& error) {  // the answer stands, whatever becomes of what is told about it
    report.diagnosis += std::string("; what it costs is not known: ") + error.what();
    return report;
  }
  if (*report.lost < telling) {
    report.diagnosis +=
        fmt::format("; at epsilon = {:g} this costs less than {:.0f} % of the energy", *scene.epsilon(), 100 * telling);
    return report;
  }
  report.diagnosis += fmt::format("; at epsilon = {:g} it locks", *scene.epsilon());
  report.warning = fmt::format(
      "{} locks in this layer: it loses at least {:.0f} % of the energy that the layer's motion releases (proved); "
      "remedy: element = \"CR\", or a layer in columns (kind = \"layered\")",
      element.name(), std::floor(100 * *report.lost));
  return report;
}

}  // namespace antilock
