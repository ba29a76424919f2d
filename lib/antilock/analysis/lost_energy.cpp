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

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "antilock/analysis/detail/companion.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

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

/// A vertex of the layer alone.
bool below(const TriangleMesh& mesh, const Line& sigma, int v) {
  return sigma.place[v] < 0 && mesh.vertices(v, 1) <= 0;
}

/// W: the values of its hats at the vertices of the body, a column per hat; none for a hat that is not 0 where v is held.
/// The first row of hats is Sigma, one per vertex; above, the heights are halved towards Sigma, and a hat is about as wide
/// as it is high.
SparseMatrix hats(const TriangleMesh& mesh, const Line& sigma, const std::vector<char>& held) {
  struct Row {
    Eigen::VectorXd x;
    int first;
  };
  const double left = mesh.vertices.col(0).minCoeff(), right = mesh.vertices.col(0).maxCoeff();
  std::map<double, Row> rows;  // by height
  rows[0].x = Eigen::Map<const Eigen::VectorXd>(sigma.x.data(), static_cast<Eigen::Index>(sigma.x.size()));
  for (double y = mesh.vertices.col(1).maxCoeff(); y > sigma.length / static_cast<double>(sigma.edge.size()); y /= 2)
    rows[y].x =
        Eigen::VectorXd::LinSpaced(1 + std::max(1, static_cast<int>(std::ceil((right - left) / y))), left, right);
  int count = 0;
  for (auto& [y, row] : rows) row.first = std::exchange(count, count + static_cast<int>(row.x.size()));
  std::vector<Eigen::Triplet<double>> values;
  std::vector<char> left_out(count, 0);
  const auto add = [&](int v, const Row& row, double weight) {
    const double x = mesh.vertices(v, 0), *const first = row.x.data(), *const last = first + row.x.size();
    if (weight == 0 || x < *first || x > last[-1]) return;
    const double* const next = std::clamp(std::upper_bound(first, last, x), first + 1, last - 1);
    const double s = (x - next[-1]) / (next[0] - next[-1]);
    for (const auto& [hat, value] :
         {std::pair(next - first - 1, weight * (1 - s)), std::pair(next - first, weight * s)}) {
      const int column = row.first + static_cast<int>(hat);
      values.emplace_back(v, column, value);
      if (held[v] && value > 1e-12) left_out[column] = 1;
    }
  };
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (below(mesh, sigma, v)) continue;
    const double y = std::max(mesh.vertices(v, 1), 0.0);
    const auto above = rows.lower_bound(y);
    if (y == 0) add(v, above->second, 1);
    if (y == 0 || above == rows.end()) continue;
    const auto& [low, under] = *std::prev(above);
    add(v, under, (above->first - y) / (above->first - low));
    add(v, above->second, (y - low) / (above->first - low));
  }
  std::erase_if(values, [&](const auto& value) { return value.value() == 0 || left_out[value.col()]; });
  SparseMatrix w(mesh.vertex_count(), count);
  w.setFromTriplets(values.begin(), values.end());
  return w;
}

double own_stiffness(const Scene& scene) {
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  return stiff != nullptr ? stiff->s : 1;
}

/// The form of the layer on its triangles that have a vertex on Sigma.
SparseMatrix layer_at(const Line& sigma, const TriangleMesh& mesh, const Scene& scene) {
  const auto* thin = std::get_if<ThinLayer>(&scene.layer());
  Eigen::Vector2d root(std::sqrt(own_stiffness(scene)), 0);
  if (thin != nullptr) root.setConstant(std::sqrt(1 / thin->epsilon));
  std::vector<Eigen::Triplet<double>> values;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::RowVector3i v = mesh.triangles.row(t);
    if (mesh.region[t] == Region::body || std::max({sigma.place[v(0)], sigma.place[v(1)], sigma.place[v(2)]}) < 0)
      continue;
    const Eigen::Matrix<double, 3, 2> half =
        std::sqrt(mesh.area(t)) * barycentric_gradients(mesh, t) * root.asDiagonal();
    const Eigen::Matrix3d form = half * half.transpose();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) values.emplace_back(v(i), v(j), form(i, j));
  }
  SparseMatrix layer(mesh.vertex_count(), mesh.vertex_count());
  layer.setFromTriplets(values.begin(), values.end());
  return layer;
}

/// a+(u_h, phi) for u_h of P2 and the P1 functions phi of the mesh cut once more. A quadratic's gradient is affine: its
/// mean over each of the four triangles is its value at the centroid.
Eigen::VectorXd work_of_quadratics(const Space& space, const TriangleMesh& cut, const Eigen::VectorXd& u) {
  std::array<Eigen::MatrixX3d, 4> derivative;
  for (int k = 0; k < 4; ++k) {
    Eigen::Vector3d at = Eigen::Vector3d::Constant(k < 3 ? 1.0 / 6 : 1.0 / 3);
    if (k < 3) at(k) = 2.0 / 3;
    derivative[k] = space.element().derivative(at);
  }
  Eigen::VectorXd work = Eigen::VectorXd::Zero(cut.vertex_count());
  for (int t = 0; t < cut.triangle_count(); ++t) {
    if (cut.region[t] != Region::body) continue;
    const Eigen::VectorXd of_t = u(space.unknowns().row(t / 4));
    const Eigen::Vector2d gradient =
        barycentric_gradients(space.mesh(), t / 4).transpose() * (derivative[t % 4].transpose() * of_t);
    work(cut.triangles.row(t)) += cut.area(t) * (barycentric_gradients(cut, t) * gradient);
  }
  return work;
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
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  if ((stiff != nullptr && stiff->load) || (element.degree() == 2 && !scene.beyond_the_paper().empty()))
    throw Error("lost energy: accepted: a layer without a load, with P2 the scenes of the paper; this has " +
                scene.beyond_the_paper());
  const double s = own_stiffness(scene);
  const int corners = space.mesh().vertex_count();
  std::optional<TriangleMesh> cut;
  std::optional<Space> linear;
  if (element.degree() == 2) linear.emplace(cut.emplace(refined(space.mesh())), p1());
  const Space& fine = linear ? *linear : space;  // its vertices are the unknowns of u_h, in their order
  const TriangleMesh& mesh = fine.mesh();
  const Line sigma = sigma_line(mesh);
  const auto points = static_cast<int>(sigma.x.size());
  const Eigen::VectorXd at_sigma = solution.u(sigma.vertex);
  const auto base = [&](int i) { return at_sigma(i); };
  std::vector<char> held(mesh.vertex_count(), 0);
  for (std::size_t k = 0; k < problem.fixed.size(); ++k) {
    held[problem.fixed[k]] = 1;
    if (below(mesh, sigma, problem.fixed[k]) && problem.fixed_values(static_cast<Eigen::Index>(k)) != 0)
      throw Error("lost energy: accepted: a layer whose sides are held at 0 or free");
  }

  // the unknowns: W, and rows 1 to `rows` of columns below Sigma; all are differences to u_h, on Sigma and constant in y
  constexpr int most_rows = 8;  // k = 1/8: what a wave over the depth loses by it, (pi / 8)^2 / 12, is 1.3 %
  const auto layer = std::count(space.mesh().region.begin(), space.mesh().region.end(), Region::layer);
  const auto edges = std::count(space.mesh().edge_tag.begin(), space.mesh().edge_tag.end(), EdgeTag::sigma);
  // as many as make square cells in the layer of thickness epsilon, but no more than the mesh has: a coarse layer is no
  // locked one
  const int rows = std::clamp(static_cast<int>(std::ceil(*epsilon * double(edges) / sigma.length - 1e-9)), 1,
                              std::clamp(static_cast<int>(layer / (2 * edges)), 1, most_rows));
  const double height = 1.0 / rows;
  SparseMatrix w = hats(mesh, sigma, held);
  const auto hat_count = static_cast<int>(w.cols()), size = hat_count + rows * points;
  w.conservativeResize(w.rows(), size);
  const auto unknown = [&](int i, int row) { return row == 0 ? i : hat_count + (row - 1) * points + i; };

  // J(u_h) in the layer, and what u_h leaves of the forces on the body. For P1 the body's form is a1 less what the layer's
  // triangles have at Sigma; its rows below are not read
  SparseMatrix body_of_u = linear ? gradient_form(space, {1, 1}, {0, 0}) : problem.a1;
  if (!linear) body_of_u -= layer_at(sigma, mesh, scene);
  Eigen::VectorXd work = body_of_u * solution.u;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (below(mesh, sigma, v)) work(v) = 0;
  const double layer_energy = energy(problem, solution) - solution.u.dot(work / 2 - problem.load);
  const SparseMatrix body = linear ? gradient_form(fine, {1, 1}, {0, 0}) : std::move(body_of_u);
  VariationalInequality strip;
  strip.load =
      w.transpose() * (linear ? load_vector(fine, scene.body().load) - work_of_quadratics(space, mesh, solution.u)
                              : problem.load - work);

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
    base_energy += s * (jump * jump + 16.0 / 3 * bubble * bubble) / dx / 2;
    for (int row = 0; row <= rows; ++row) {
      const double weight = s * (row == 0 || row == rows ? 0.5 : 1.0) * height / dx;
      const int p = unknown(i, row), q = unknown(j, row);
      a1.insert(a1.end(), {{p, p, weight}, {q, q, weight}, {p, q, -weight}, {q, p, -weight}});
      strip.load(p) += weight * jump, strip.load(q) -= weight * jump;
    }
    const auto place = [&](int end) { return held[sigma.vertex[end]] ? -1 : end; };
    chords.push_back({{place(i), place(j)}, {sigma.x[i], sigma.x[j]}, {base(i), base(j)}, bubble});
  }
  strip.m = (s * height * width).replicate(rows, 1);
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < points; ++i) {
      b.emplace_back(row * points + i, unknown(i, row), rows);
      b.emplace_back(row * points + i, unknown(i, row + 1), -rows);
    }
  SparseMatrix differences(size, size);
  differences.setFromTriplets(a1.begin(), a1.end());
  strip.a1 = SparseMatrix(w.transpose() * SparseMatrix(body * w)) + differences;
  strip.b.resize(strip.m.size(), size);
  strip.b.setFromTriplets(b.begin(), b.end());
  strip.compliance = *epsilon * *epsilon;
  for (int row = 0; row <= rows; ++row)
    for (int i = 0; i < points; ++i)  // held by the layer's side, or its hat was left out
      if (held[sigma.vertex[i]] || (row == 0 && w.col(i).nonZeros() == 0)) strip.fixed.push_back(unknown(i, row));
  strip.fixed_values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(strip.fixed.size()));
  std::vector<int> free;  // points with bounds
  Eigen::VectorXd raised = Eigen::VectorXd::Zero(0);
  strip.lower = raised;
  if (const auto& contact = scene.contact()) {
    // v of K between the points, too; `raised`: how far its bounds lie above the obstacle
    const auto bounds = [&](const Profile& gap, double sign) {
      std::vector<Chord> seen = chords;
      for (Chord& chord : seen) chord.near = {sign * chord.near[0], sign * chord.near[1]}, chord.bubble *= sign;
      UnilateralContact side = *contact;
      side.gap = gap;
      return admissible_bounds(side, seen, points);
    };
    const Eigen::VectorXd lower = bounds(contact->gap, 1),
                          upper = contact->ceiling ? bounds(contact->ceiling, -1) : lower;
    for (int i = 0; i < points; ++i)
      if (!held[sigma.vertex[i]]) strip.contact.push_back(unknown(i, rows)), free.push_back(i);
    strip.lower = (lower - at_sigma)(free);
    raised = lower(free);
    for (std::size_t k = 0; k < free.size(); ++k) raised(Eigen::Index(k)) += contact->gap(sigma.x[free[k]]);
    if (contact->ceiling) strip.upper = (-upper - at_sigma)(free);
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
  if (const int above = hat_count - points; above > 0) {
    const Eigen::VectorXd residual = strip.load - strip.a1 * still;
    still.segment(points, above) = Cholesky(Eigen::MatrixXd(strip.a1.block(points, points, above, above)))
                                       .solve(residual.segment(points, above).eval());
  }
  const double j = energy(strip, moved), j_still = still.dot(strip.a1 * still) / 2 - strip.load.dot(still);
  const Eigen::VectorXd way = moved.u - still;
  found.doubt = moved.lambda.cwiseMax(0).dot(raised);
  found.lost = layer_energy - base_energy - j;
  found.motion =
      std::max(j_still - j, way.dot(strip.a1 * way) / 2 + strip.compliance * moved.p.cwiseAbs2().dot(strip.m) / 2);
  return found;
}

}  // namespace antilock
