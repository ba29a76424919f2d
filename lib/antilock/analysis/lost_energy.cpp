// How much energy a layer that does not follow has lost, with a proof, and without a second solve of the same size.
//
// For every v of K, J(u) <= J(v): J(u_h) - J(v) is a lower bound of the energy J(u_h) - J(u) that is lost. v is made so:
// - in the body v = u_h + w, w from a small space W: continuous, piecewise bilinear between rows of hats whose widths
//   and heights grow with the distance from Sigma (w is nearly harmonic), interpolated at the vertices of the body;
// - in the layer v has columns of its own, one under each edge of Sigma, in rows of equal height k. On such columns
//   P1 is a set of differences: with D the sum of |v(i+1, j) - v(i, j)|^2 / (x(i+1) - x(i)) on row j,
//       int (d_x v)^2 = sum_j k_j D_j, k_j = k (k / 2 for the first and the last row),
//   and d_y v on the two triangles beside a vertical segment is its difference / k: one row of B per segment.
// (22) is the same problem after y -> y / epsilon, (23). J is smallest over these v: a variational inequality with few
// unknowns. For P2 the mesh is cut once more, so that W and the columns reach as short waves as u_h; on the halves of an
// edge of Sigma u_h is affine but for a bubble 4 s (1 - s) beta, which v keeps, constant in y: 16/3 beta^2 / length of
// energy, and orthogonal to the differences.
#include "antilock/analysis/lost_energy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "antilock/analysis/detail/companion.hpp"
#include "antilock/analysis/detail/ties.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

constexpr double telling = 0.05;  // v is within a few per cent of the best: whoever has lost 10 % is told so

/// Sigma: its vertices from left to right, the place of each vertex of the mesh among them (-1: none), and its edges as
/// two places.
struct Line {
  std::vector<int> vertex, place;
  std::vector<double> x;
  std::vector<std::array<int, 2>> edge;
  double length = 0;
};

Line sigma_line(const TriangleMesh& mesh) {
  Line line;
  std::vector<int>& place = line.place;
  place.assign(mesh.vertex_count(), -1);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::sigma) continue;
    line.edge.push_back({mesh.edges(e, 0), mesh.edges(e, 1)});
    for (const int v : line.edge.back())
      if (std::exchange(place[v], 0) < 0) line.vertex.push_back(v);
  }
  const auto x = [&](int v) { return mesh.vertices(v, 0); };
  std::sort(line.vertex.begin(), line.vertex.end(), [&](int a, int b) { return x(a) < x(b); });
  for (std::size_t i = 0; i < line.vertex.size(); ++i) {
    place[line.vertex[i]] = static_cast<int>(i);
    line.x.push_back(x(line.vertex[i]));
  }
  for (auto& [left, right] : line.edge) {
    std::tie(left, right) = std::minmax({place[left], place[right]});
    line.length += line.x[right] - line.x[left];
  }
  return line;
}

/// W: the values of its hats at the vertices of the body, a column per hat. The first row of hats is Sigma, one per
/// vertex; above, the heights are halved towards Sigma, and a hat is about as wide as it is high.
std::vector<Eigen::Triplet<double>> hats(const TriangleMesh& mesh, const Line& sigma, int& count) {
  struct Row {
    double y;
    std::vector<double> x;
    int first;
  };
  std::vector<char> in_body(mesh.vertex_count(), 0);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::body)
      for (int i = 0; i < 3; ++i) in_body[mesh.triangles(t, i)] = 1;
  double left = sigma.x.front(), right = sigma.x.back(), top = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!in_body[v]) continue;
    left = std::min(left, mesh.vertices(v, 0)), right = std::max(right, mesh.vertices(v, 0));
    top = std::max(top, mesh.vertices(v, 1));
  }
  std::vector<Row> rows{{0, sigma.x, 0}};
  for (double y = top; y > sigma.length / static_cast<double>(sigma.edge.size()); y /= 2) {
    const int cells = std::max(1, static_cast<int>(std::ceil((right - left) / y)));
    Row row{y, {}, 0};
    for (int i = 0; i <= cells; ++i) row.x.push_back(left + (right - left) * i / cells);
    rows.insert(rows.begin() + 1, std::move(row));
  }
  count = 0;
  for (Row& row : rows) row.first = std::exchange(count, count + static_cast<int>(row.x.size()));
  std::vector<Eigen::Triplet<double>> values;
  const auto add = [&](int v, const Row& row, double weight) {
    const double x = mesh.vertices(v, 0);
    if (weight == 0 || x < row.x.front() || x > row.x.back()) return;
    const auto next = std::clamp<std::ptrdiff_t>(std::upper_bound(row.x.begin(), row.x.end(), x) - row.x.begin(), 1,
                                                 static_cast<std::ptrdiff_t>(row.x.size()) - 1);
    const double s = (x - row.x[next - 1]) / (row.x[next] - row.x[next - 1]);
    if (s < 1) values.emplace_back(v, row.first + static_cast<int>(next) - 1, weight * (1 - s));
    if (s > 0) values.emplace_back(v, row.first + static_cast<int>(next), weight * s);
  };
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (!in_body[v]) continue;
    const double y = std::max(mesh.vertices(v, 1), 0.0);
    if (y == 0 || rows.size() == 1) {
      if (y == 0) add(v, rows[0], 1);
      continue;
    }
    std::size_t above = 1;
    while (above + 1 < rows.size() && rows[above].y < y) ++above;
    const double low = rows[above - 1].y, t = (y - low) / (rows[above].y - low);
    add(v, rows[above - 1], 1 - t);
    add(v, rows[above], t);
  }
  return values;
}

Stiffness layer_stiffness(const Scene& scene) {  // of a1
  const auto* thin = std::get_if<ThinLayer>(&scene.layer());
  return thin != nullptr ? Stiffness{1 / thin->epsilon, 1 / thin->epsilon} : Stiffness{1, 0};
}

/// Of u_h: what the layer's part of J is, and at the vertices of `fine` L(phi) - a+(u_h, phi).
struct Known {
  double layer_energy;
  Eigen::VectorXd force;
};

Known known(const Scene& scene, const Space& space, const Space& fine, const VariationalInequality& problem,
            const Solution& solution) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const Stiffness layer = layer_stiffness(scene);
  // P2's gradient is affine: its mean over each of the four triangles of refined() is its value at the centroid, and
  // the centroids of the three at the corners are a rule that is exact for its square
  const int children = element.degree() == 2 ? 4 : 1;
  std::vector<Eigen::MatrixX3d> derivative;
  for (int k = 0; k < children; ++k) {
    Eigen::Vector3d at = Eigen::Vector3d::Constant(k + 1 < children ? 1.0 / 6 : 1.0 / 3);
    if (k + 1 < children) at(k) = 2.0 / 3;
    derivative.push_back(element.derivative(at));
  }
  Known found{problem.compliance * solution.p.cwiseAbs2().dot(problem.m) / 2,
              children == 1 ? problem.load : load_vector(fine, scene.body().load)};
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
    const Eigen::VectorXd u = solution.u(space.unknowns().row(t));
    for (int k = 0; k < children; ++k) {
      const Eigen::Vector2d gradient = lambda.transpose() * (derivative[k].transpose() * u);
      if (mesh.region[t] == Region::layer) {
        if (k < 3)
          found.layer_energy += mesh.area(t) / std::min(children, 3) / 2 *
                                (layer.x * gradient(0) * gradient(0) + layer.y * gradient(1) * gradient(1));
        continue;
      }
      const int child = children * t + k;
      const Eigen::Vector3d work = fine.mesh().area(child) * (barycentric_gradients(fine.mesh(), child) * gradient);
      for (int i = 0; i < 3; ++i) found.force(fine.mesh().triangles(child, i)) -= work(i);
    }
  }
  return found;
}

/// The law of bending: one wave over the length of Sigma moves the layer and the body, at the price `soft`, and the
/// interpolant of that wave has slopes in y, which cost x times that. The share that is lost is then x / (1 + x).
double by_bending(const Scene& scene, const Space& space) {
  const bool thin = std::holds_alternative<ThinLayer>(scene.layer());
  const double epsilon = *scene.epsilon(), length = sigma_line(space.mesh()).length, c = 2 * std::numbers::pi / length;
  const Eigen::VectorXd wave = (c * space.points().col(0)).array().sin();
  const double soft = (c * c + c) * length / 2, slopes = wave.dot(gradient_form(space, {0, 0}, {0, 1}) * wave);
  return slopes / (slopes + soft * (thin ? epsilon : epsilon * epsilon));
}

}  // namespace

std::optional<double> LostEnergy::share() const {
  constexpr double negligible = 1e-8;  // the square of what the solvers leave of u, 1e-10 by default, with room
  if (!(motion > negligible * scale)) return 0;
  if (lost < -telling * motion || (lost < telling * motion && lost + doubt > telling * motion)) return {};
  return std::clamp(lost / motion, 0.0, 1.0);
}

LostEnergy lost_energy(const Scene& scene, const Space& space, const VariationalInequality& problem,
                       const Solution& solution) {
  const Element& element = space.element();
  const auto epsilon = scene.epsilon();
  if (!epsilon || !(scene.layer_depth() > 0) || !element.conforming() || element.degree() > 2)
    throw Error("lost energy: accepted: P1 or P2 on a mesh with a layer");
  const int corners = space.mesh().vertex_count();
  std::optional<TriangleMesh> cut;
  std::optional<Space> linear;
  if (element.degree() == 2) linear.emplace(cut.emplace(refined(space.mesh())), p1());
  const Space& fine = linear ? *linear : space;  // its vertices are the unknowns of u_h, in their order
  const TriangleMesh& mesh = fine.mesh();
  const Line sigma = sigma_line(mesh);
  const auto points = static_cast<int>(sigma.x.size());

  // the unknowns: W, and rows 1 to `rows` of columns below Sigma; all are differences to u_h, on Sigma and constant in y
  constexpr int most_rows = 8;  // k = 1/8: what a wave over the depth loses by it, (pi / 8)^2 / 12, is 1.3 %
  const auto layer = std::count(space.mesh().region.begin(), space.mesh().region.end(), Region::layer);
  const auto edges = std::count(space.mesh().edge_tag.begin(), space.mesh().edge_tag.end(), EdgeTag::sigma);
  // as many as make square cells in the layer of thickness epsilon, but no more than the mesh has: a coarse layer is no
  // locked one
  const int rows = std::clamp(static_cast<int>(std::ceil(*epsilon * double(edges) / sigma.length - 1e-9)), 1,
                              std::clamp(static_cast<int>(layer / (2 * edges)), 1, most_rows));
  const double height = 1.0 / rows;
  int hat_count = 0;
  const auto values = hats(mesh, sigma, hat_count);
  const int size = hat_count + rows * points;
  const auto unknown = [&](int i, int row) { return row == 0 ? i : hat_count + (row - 1) * points + i; };
  const auto base = [&](int i) { return solution.u(sigma.vertex[i]); };
  std::vector<char> held(mesh.vertex_count(), 0), fixed(size, 0);
  for (const int v : problem.fixed) held[v] = 1;
  for (const auto& entry : values)  // a hat that is not 0 where v is prescribed is left out
    if (held[entry.row()] && entry.value() > 1e-12) fixed[entry.col()] = 1;
  for (int i = 0; i < points; ++i)
    for (int row = 0; row <= rows && held[sigma.vertex[i]]; ++row) fixed[unknown(i, row)] = 1;

  const Known of_u = known(scene, space, fine, problem, solution);
  VariationalInequality strip;
  SparseMatrix w(mesh.vertex_count(), size), differences(size, size);
  w.setFromTriplets(values.begin(), values.end());
  strip.load = w.transpose() * of_u.force;
  std::vector<Eigen::Triplet<double>> a1, b;
  // hats may reach no vertex, or be dependent at the few that they reach: a little energy more makes w unique, and v no
  // better than it is
  for (int i = 0; i < hat_count; ++i) a1.emplace_back(i, i, 1e-10);
  std::vector<Chord> chords;
  Eigen::VectorXd width = Eigen::VectorXd::Zero(points);
  double base_energy = 0;  // of the layer that is constant in y, with the values of u_h on Sigma
  for (const auto& [i, j] : sigma.edge) {
    const double dx = sigma.x[j] - sigma.x[i], jump = base(j) - base(i);
    double bubble = 0;
    if (const int middle = std::max(sigma.vertex[i], sigma.vertex[j]) - corners; middle >= 0) {
      const auto ends = space.mesh().edges.row(middle);
      bubble = (solution.u(corners + middle) - (solution.u(ends(0)) + solution.u(ends(1))) / 2) / 4;
    }
    width(i) += dx / 2, width(j) += dx / 2;
    base_energy += (jump * jump + 16.0 / 3 * bubble * bubble) / dx / 2;
    for (int row = 0; row <= rows; ++row) {
      const double weight = (row == 0 || row == rows ? 0.5 : 1.0) * height / dx;
      const int p = unknown(i, row), q = unknown(j, row);
      a1.insert(a1.end(), {{p, p, weight}, {q, q, weight}, {p, q, -weight}, {q, p, -weight}});
      strip.load(p) += weight * jump, strip.load(q) -= weight * jump;
    }
    const auto place = [&, &i = i, &j = j](int end) { return held[sigma.vertex[end]] ? -1 : end; };
    chords.push_back({{place(i), place(j)}, {sigma.x[i], sigma.x[j]}, {base(i), base(j)}, bubble});
  }
  strip.m.resize(static_cast<Eigen::Index>(points) * rows);
  for (int i = 0; i < points; ++i)
    for (int row = 0; row < rows; ++row) {
      const int segment = row * points + i;
      b.emplace_back(segment, unknown(i, row), 1 / height);
      b.emplace_back(segment, unknown(i, row + 1), -1 / height);
      strip.m(segment) = width(i) * height;
    }
  // a+ of W: for P1 that is a1 less what the layer's triangles have between vertices of Sigma
  const Stiffness soft = layer_stiffness(scene);
  for (int t = 0; t < mesh.triangle_count() && !linear; ++t) {
    const Eigen::RowVector3i v = mesh.triangles.row(t);
    if (mesh.region[t] != Region::layer || std::max({sigma.place[v(0)], sigma.place[v(1)], sigma.place[v(2)]}) < 0)
      continue;
    const Eigen::Matrix<double, 3, 2> lambda = std::sqrt(mesh.area(t)) * barycentric_gradients(mesh, t);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (const int p = sigma.place[v(i)], q = sigma.place[v(j)]; p >= 0 && q >= 0)
          a1.emplace_back(p, q, -soft.x * lambda(i, 0) * lambda(j, 0) - soft.y * lambda(i, 1) * lambda(j, 1));
  }
  differences.setFromTriplets(a1.begin(), a1.end());
  const SparseMatrix body = linear ? SparseMatrix(gradient_form(fine, {1, 1}, {0, 0}) * w) : problem.a1 * w;
  strip.a1 = SparseMatrix(w.transpose() * body) + differences;
  strip.b.resize(strip.m.size(), size);
  strip.b.setFromTriplets(b.begin(), b.end());
  strip.compliance = *epsilon * *epsilon;
  for (int i = 0; i < size; ++i)
    if (fixed[i]) strip.fixed.push_back(i);
  strip.fixed_values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(strip.fixed.size()));
  std::vector<double> raised;  // by how much the bounds lie above the obstacle at their points
  if (scene.contact()) {
    const Eigen::VectorXd lower = admissible_bounds(*scene.contact(), chords, points);
    std::vector<double> bounds;
    for (int i = 0; i < points; ++i) {
      if (held[sigma.vertex[i]]) continue;
      strip.contact.push_back(unknown(i, rows)), bounds.push_back(lower(i) - base(i));
      raised.push_back(lower(i) + scene.contact()->gap(sigma.x[i]));
    }
    strip.lower = Eigen::Map<const Eigen::VectorXd>(bounds.data(), static_cast<Eigen::Index>(bounds.size()));
  }

  LostEnergy found;
  found.unknowns = strip.free_count();
  found.scale = std::abs(energy(problem, solution));
  if (found.unknowns == 0) return found;
  const Solution moved = active_set(strip);
  // v_0: the layer at 0, the body as the few hats above Sigma make it best
  Eigen::VectorXd still = Eigen::VectorXd::Zero(size);
  for (int i = 0; i < points; ++i)
    for (int row = 0; row <= rows; ++row) still(unknown(i, row)) = -base(i);
  std::vector<int> above, number(size, -1);
  for (int i = points; i < hat_count; ++i)
    if (!fixed[i]) number[i] = static_cast<int>(above.size()), above.push_back(i);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(above.size()), above.size());
  for (const int i : above)
    for (SparseMatrix::InnerIterator entry(strip.a1, i); entry; ++entry)
      if (const int row = number[entry.row()]; row >= 0) a(row, number[i]) = entry.value();
  const Eigen::VectorXd residual = strip.load - strip.a1 * still;
  if (!above.empty()) {
    const Eigen::VectorXd solved = Cholesky(std::move(a)).solve(Eigen::VectorXd(residual(above)));
    still(above) = solved;
  }
  const double j = energy(strip, moved), j_still = still.dot(strip.a1 * still) / 2 - strip.load.dot(still);
  const Eigen::VectorXd way = moved.u - still;
  for (std::size_t i = 0; i < raised.size(); ++i) found.doubt += moved.lambda(Eigen::Index(i)) * raised[i];
  found.lost = of_u.layer_energy - base_energy - j;
  found.motion =
      std::max(j_still - j, way.dot(strip.a1 * way) / 2 + strip.compliance * moved.p.cwiseAbs2().dot(strip.m) / 2);
  return found;
}

std::optional<LayerReport> report_layer(const Scene& scene, const Space& space, const VariationalInequality& problem,
                                        const Solution& solution) {
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
  if (const std::string beyond = scene.beyond_the_paper(); !beyond.empty()) {
    report.diagnosis += "; what it costs is not asked of a scene with " + beyond;
    return report;
  }
  try {
    const LostEnergy energy = lost_energy(scene, space, problem, solution);
    report.lost = energy.share(), report.motion = energy.motion;
  } catch (const Error& error) {  // the answer stands, whatever becomes of what is told about it
    report.diagnosis += std::string("; what it costs is not known: ") + error.what();
    return report;
  }
  const double share = report.lost ? *report.lost : by_bending(scene, space);
  const double least = report.lost ? telling : 2 * telling;  // the law is an upper bound: it names who has lost a tenth
  if (share < least) {
    report.diagnosis +=
        fmt::format("; at epsilon = {:g} this costs less than {:.0f} % of the energy", *scene.epsilon(), 100 * least);
    return report;
  }
  report.diagnosis += fmt::format("; at epsilon = {:g} it locks", *scene.epsilon());
  report.warning = fmt::format(
      "{} locks in this layer: it loses {} {:.0f} % of the energy that the layer's motion releases ({}); "
      "remedy: element = \"CR\", or a layer in columns (kind = \"layered\")",
      element.name(), report.lost ? "at least" : "about", std::floor(100 * share),
      report.lost ? "proved" : "by the law of bending");
  return report;
}

}  // namespace antilock
