// How much energy a layer that does not follow has lost, with a proof, and without a second solve of the same size.
//
// For every v of K, J(u) <= J(v): J(u_h) - J(v) is a lower bound of the energy J(u_h) - J(u) that is lost. v is made so:
// - in the body v = u_h + w, w from a small space W, part of V_h: functions that are piecewise bilinear between rows of
//   hats whose widths and heights grow with the distance from Sigma (w is nearly harmonic), interpolated in V_h. On Sigma
//   a hat is the basis function of an unknown of u_h: v reaches as short waves as u_h, whatever its degree;
// - in the layer v has columns of its own, one under each edge of Sigma, in rows of equal height: in x polynomials as
//   those of u_h on Sigma, in y affine on each row. (d_x v)^2 is convex in y, so that on a row
//
//       int (d_x v)^2 <= height / 2 (its values at the upper and at the lower end),
//
//   and the sum over the rows takes the values at the rows' ends alone. d_y v is a difference / height. Its square is
//   summed at the ends of the edges for P1, which is not less than the integral, and as P1 has it in columns, and at
//   Gauss's points beyond.
// (22) is the same problem after y -> y / epsilon, (23). J is smallest over these v: a variational inequality with few
// unknowns.
//
// Its bounds hold at the unknowns on Sigma, from the gap as u_h has it at its own points. What v lacks between them, seen
// at 33 points per edge, is added as a function that is affine on each edge of Sigma and constant in y: v', of K.
#include "antilock/analysis/lost_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

using Indices = std::vector<int>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Sigma: the unknowns of u_h from left to right, the place of each unknown among them (-1: none), and its edges as places,
/// from left to right.
struct Line {
  Indices unknown, place;
  Eigen::VectorXd x;
  std::vector<Indices> edge;
  double length = 0;
};

Line sigma_line(const Space& space) {
  const TriangleMesh& mesh = space.mesh();
  const Eigen::MatrixX3d nodes = space.element().nodes();
  const auto by_x = [&](int a, int b) { return space.points()(a, 0) < space.points()(b, 0); };
  Line line;
  line.place.assign(space.size(), -1);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::sigma) continue;
    const int t = mesh.edge_triangles(e, 0);
    int i = 0;  // the edge's place in t
    while (mesh.triangle_edges(t, i) != e) ++i;
    Indices& edge = line.edge.emplace_back();
    for (Eigen::Index r = 0; r < nodes.rows(); ++r)
      if (nodes(r, i) == 0) edge.push_back(space.unknowns()(t, r));
    std::sort(edge.begin(), edge.end(), by_x);
    for (const int u : edge)
      if (std::exchange(line.place[u], 0) < 0) line.unknown.push_back(u);
  }
  std::sort(line.unknown.begin(), line.unknown.end(), by_x);
  line.x = space.points().col(0)(line.unknown);
  for (std::size_t i = 0; i < line.unknown.size(); ++i) line.place[line.unknown[i]] = static_cast<int>(i);
  for (Indices& edge : line.edge) {
    for (int& u : edge) u = line.place[u];
    line.length += line.x[edge.back()] - line.x[edge.front()];
  }
  std::sort(line.edge.begin(), line.edge.end());
  return line;
}

/// x among ascending points: the one on its left, but not the last, and the share of the way to the next, 0 to 1.
std::pair<int, double> among(const Eigen::VectorXd& points, double x) {
  const double *const first = points.data(), *const last = first + points.size() - 1;
  const double* const next = std::upper_bound(first + 1, last, x);
  return {static_cast<int>(next - first) - 1, std::clamp((x - next[-1]) / (next[0] - next[-1]), 0.0, 1.0)};
}

/// y at x on the chain of straight pieces from point to point, `at` ascending; level beyond its ends.
double on_chain(const Eigen::VectorXd& at, const Eigen::VectorXd& y, double x) {
  if (at.size() == 1) return y(0);
  const auto [i, s] = among(at, x);
  return s == 0 ? y(i) : s == 1 ? y(i + 1) : (1 - s) * y(i) + s * y(i + 1);
}

/// Lagrange's basis of the nodes on an edge, 0 to 1, at some points: a row per point.
struct Trace {
  Eigen::MatrixXd value, slope;
};

Trace trace_at(const Eigen::VectorXd& nodes, const Eigen::VectorXd& points) {
  Trace trace{Eigen::MatrixXd::Ones(points.size(), nodes.size()), Eigen::MatrixXd::Zero(points.size(), nodes.size())};
  for (Eigen::Index i = 0; i < nodes.size(); ++i)
    for (Eigen::Index j = 0; j < nodes.size(); ++j) {
      if (i == j) continue;
      const Eigen::ArrayXd factor = (points.array() - nodes(j)) / (nodes(i) - nodes(j));
      trace.slope.col(i) = trace.slope.col(i).array() * factor + trace.value.col(i).array() / (nodes(i) - nodes(j));
      trace.value.col(i).array() *= factor;
    }
  return trace;
}

/// W: the values of its hats at the unknowns in the body, a column per hat. The first row of hats is Sigma, one per
/// unknown; above, the heights are halved towards Sigma, and a hat is about as wide as it is high.
RowMatrix hats(const Points& at, const Line& sigma, const std::vector<char>& in_body) {
  struct Row {
    Eigen::VectorXd x;
    int first;
  };
  const double left = at.col(0).minCoeff(), right = at.col(0).maxCoeff();
  std::map<double, Row> rows;  // by height
  rows[0].x = sigma.x;
  const double top = at.col(1).maxCoeff(), edge = sigma.length / static_cast<double>(sigma.x.size() - 1);
  for (double y = top; y == top || y > edge; y /= 2)
    rows[y].x =
        Eigen::VectorXd::LinSpaced(1 + std::max(1, static_cast<int>(std::ceil((right - left) / y))), left, right);
  int count = 0;
  for (auto& [y, row] : rows) row.first = std::exchange(count, count + static_cast<int>(row.x.size()));
  Indices begin{0}, column;
  std::vector<double> value;
  column.reserve(4 * at.rows()), value.reserve(4 * at.rows());
  const auto add = [&](int v, const Row& row, double weight) {
    const auto [hat, s] = among(row.x, at(v, 0));
    for (const int side : {0, 1})
      if (const double here = weight * (side == 0 ? 1 - s : s); here != 0)
        column.push_back(row.first + hat + side), value.push_back(here);
  };
  for (int v = 0; v < at.rows(); ++v) {
    const double y = std::max(at(v, 1), 0.0);
    if (in_body[v] && sigma.place[v] >= 0) {
      column.push_back(sigma.place[v]), value.push_back(1);
    } else if (in_body[v]) {
      const auto above = y > 0 ? rows.lower_bound(y) : std::next(rows.begin()), under = std::prev(above);
      const double s = (y - under->first) / (above->first - under->first);
      add(v, under->second, 1 - s);
      add(v, above->second, s);
    }
    begin.push_back(static_cast<int>(column.size()));
  }
  return Eigen::Map<const RowMatrix>(at.rows(), count, begin.back(), begin.data(), column.data(), value.data());
}

/// Entries of the layer's part of A1 in the rows of Sigma.
std::vector<Eigen::Triplet<double>> layer_at(const Line& sigma, const Space& space, const Eigen::Vector2d& stiffness) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = strain_rule(space.element());
  std::vector<Eigen::Triplet<double>> values;
  std::vector<Eigen::MatrixX3d> derivative;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    derivative.push_back(space.element().derivative(rule.points.row(q)));
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const auto corner = mesh.triangles.row(t);
    if (mesh.region[t] == Region::body ||
        std::max({sigma.place[corner(0)], sigma.place[corner(1)], sigma.place[corner(2)]}) < 0)
      continue;
    const auto unknown = space.unknowns().row(t);
    const Eigen::Matrix<double, 3, 2> root =
        barycentric_gradients(mesh, t) * (mesh.area(t) * stiffness).cwiseSqrt().asDiagonal();
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::MatrixX2d half = std::sqrt(rule.weights(q)) * derivative[q] * root;
      for (Eigen::Index i = 0; i < half.rows(); ++i)
        for (Eigen::Index j = 0; j < half.rows() && sigma.place[unknown(i)] >= 0; ++j)
          values.emplace_back(unknown(i), unknown(j), half.row(i).dot(half.row(j)));
    }
  }
  return values;
}

/// The form of the body on W and a force, of which the hats above Sigma are eliminated. What those gain alone is
/// left out: u_h is at rest there, and v no better than it is.
struct Sunk {
  Eigen::MatrixXd form;
  Eigen::VectorXd force;
  std::vector<char> held;  ///< hats that are not 0 where v is held: they are left out
};

Sunk sunk_to_sigma(const VariationalInequality& problem, const Line& sigma, const RowMatrix& w,
                   const std::vector<Eigen::Triplet<double>>& layer, const Eigen::VectorXd& on_body) {
  const Eigen::Index all = w.cols(), low = sigma.x.size(), above = all - low;
  std::vector<char> held(all, 0);
  for (const int u : problem.fixed)
    for (RowMatrix::InnerIterator hat(w, u); hat; ++hat)
      if (hat.value() > 1e-12) held[hat.col()] = 1;
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(all, all);  // W' A1 W, of whose two halves one is summed
  for (int u = 0; u < problem.size(); ++u) {
    if (w.row(u).nonZeros() == 0) continue;  // in the layer
    for (SparseMatrix::InnerIterator a(problem.a1, u); a && a.row() <= u; ++a)
      for (RowMatrix::InnerIterator left(w, u); left; ++left) {
        const double here = (a.row() < u ? 1 : 0.5) * a.value() * left.value();
        for (RowMatrix::InnerIterator right(w, a.row()); right; ++right)
          form(right.col(), left.col()) += here * right.value();
      }
  }
  form += Eigen::MatrixXd(form.transpose());
  for (const auto& value : layer)
    if (const int j = sigma.place[value.col()]; j >= 0) form(sigma.place[value.row()], j) -= value.value();
  Eigen::VectorXd force = w.transpose() * on_body;
  // hats may reach no vertex, or be dependent at the few that they reach: a little energy more makes w unique, and v no
  // better than it is
  form.diagonal().array() += 1e-10 * form.diagonal().maxCoeff();
  for (Eigen::Index i = 0; i < all; ++i)
    if (held[i]) form.row(i).setZero(), form.col(i).setZero(), form(i, i) = 1, force(i) = 0;
  const Cholesky upper(form.bottomRightCorner(above, above));
  const Eigen::MatrixXd half = upper.half_solve(Eigen::MatrixXd(form.bottomLeftCorner(above, low)));
  const Eigen::VectorXd pull = upper.half_solve(Eigen::VectorXd(force.tail(above)));
  return {form.topLeftCorner(low, low) - half.transpose() * half, force.head(low) - half.transpose() * pull, held};
}

/// How far v must be lifted at the points of Sigma, affine on each edge, to lie above `obstacle` at the points of `trace`;
/// infinity where what would have to move is held.
Eigen::VectorXd lift(const Line& sigma, const Trace& trace, const Eigen::VectorXd& v, const Profile& obstacle,
                     const std::vector<char>& held_at, double near) {
  Eigen::VectorXd most = Eigen::VectorXd::Zero(v.size());
  const auto end = trace.value.rows() - 1;
  for (const Indices& edge : sigma.edge) {
    const Eigen::VectorXd on_edge = trace.value * v(edge);
    const double x = sigma.x[edge.front()], dx = sigma.x[edge.back()] - x;
    for (Eigen::Index q = 0; q <= end; ++q) {
      const double s = static_cast<double>(q) / static_cast<double>(end), lack = obstacle(x + s * dx) - on_edge(q);
      const bool left = !held_at[edge.front()], right = !held_at[edge.back()];
      const double room = (left ? 1 - s : 0) + (right ? s : 0);
      if (lack <= (room > 0 ? 0 : near)) continue;
      for (const auto& [place, free] : {std::pair(edge.front(), left), std::pair(edge.back(), right)})
        if (free || room == 0) most(place) = std::max(most(place), room > 0 ? lack / room : infinity);
    }
  }
  for (const Indices& edge : sigma.edge)
    for (std::size_t i = 1; i + 1 < edge.size(); ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(edge.size() - 1);
      most(edge[i]) = (1 - s) * most(edge.front()) + s * most(edge.back());
    }
  return most;
}

}  // namespace

double LostEnergy::share(double energy) const { return motion > 0 ? std::clamp(energy / motion, 0.0, 1.0) : 0; }

LostEnergy lost_energy(const Scene& scene, const Space& space, const VariationalInequality& problem,
                       const Solution& solution) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const auto epsilon = scene.epsilon();
  if (!epsilon || !(scene.layer_depth() > 0) || !element.conforming() || mesh.curved())
    throw Error("lost energy: accepted: P1 to P6 on a mesh with a layer below y = 0");
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  const double s = stiff != nullptr ? stiff->s : 1;
  const Line sigma = sigma_line(space);
  const auto points = static_cast<int>(sigma.x.size());
  const Eigen::VectorXd on_sigma = solution.u(sigma.unknown);
  std::vector<char> in_body(space.size(), 0), held_at(points, 0);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (Eigen::Index r = 0; r < space.unknowns().cols() && mesh.region[t] == Region::body; ++r)
      in_body[space.unknowns()(t, r)] = 1;
  for (std::size_t k = 0; k < problem.fixed.size(); ++k) {
    const int u = problem.fixed[k];
    if (sigma.place[u] >= 0) held_at[sigma.place[u]] = 1;
    const double more =
        problem.fixed_values(static_cast<Eigen::Index>(k)) - on_chain(sigma.x, on_sigma, space.points()(u, 0));
    if (!in_body[u] && std::abs(more) > 1e-9 * on_sigma.cwiseAbs().maxCoeff())
      throw Error("lost energy: accepted: a layer whose sides have the value of Sigma's end above them");
  }

  for (int e = 0; e < mesh.edge_count(); ++e)
    if (const EdgeTag tag = mesh.edge_tag[e]; group_of(tag) >= 0 && !is_held(tag) &&
                                              mesh.region[mesh.edge_triangles(e, 0)] == Region::layer &&
                                              scene.edges()[group_of(tag)].kind != EdgeCondition::Kind::free)
      throw Error("lost energy: accepted: no traction and no spring on the layer");

  // v_0: straight in the layer, affine between given values of the outer ends of Sigma, level to an end that is free
  const double left = held_at.front() ? on_sigma(0) : held_at.back() ? on_sigma(points - 1) : on_sigma.mean();
  const double right = held_at.back() ? on_sigma(points - 1) : left;
  const double slope = (right - left) / (sigma.x(points - 1) - sigma.x(0));
  const Eigen::VectorXd still = left + slope * (space.points().col(0).array() - sigma.x(0));
  const double ulp = std::numeric_limits<double>::epsilon() * solution.u.cwiseAbs().maxCoeff();
  const Eigen::VectorXd w = solution.u - still, middle = still + w / 2, base = w(sigma.unknown);

  // force: what u_h leaves of the forces on the body, whose form is A1 less the layer's part at Sigma. left_in_layer: in the
  // layer, J(v_0 + w) - J(v_0) = a(w, v_0 + w / 2) - L(w), with w = u_h - v_0. (Beside given values U the square of u_h itself
  // has round-off of s U^2.) Its round-off: a row of A1 has sum 0, and leaves of values U some ulp of U times its entries.
  const auto layer =
      layer_at(sigma, space, stiff != nullptr ? Eigen::Vector2d(s, 0) : Eigen::Vector2d::Constant(1 / *epsilon));
  Eigen::VectorXd force = problem.load;
  double left_in_layer = problem.compliance * solution.p.cwiseAbs2().dot(problem.m) / 2, round_off = 0;
  for (int u = 0; u < space.size(); ++u)
    if (in_body[u]) {
      force(u) -= problem.a1.col(u).dot(solution.u);
    } else {
      force(u) = 0;
      left_in_layer += w(u) * (problem.a1.col(u).dot(middle) - problem.load(u));
      round_off += 2 * ulp * std::abs(w(u)) * problem.a1.coeff(u, u);
    }
  for (const auto& value : layer) {
    force(value.row()) += value.value() * solution.u(value.col());
    left_in_layer += w(value.row()) * value.value() * middle(value.col());
  }

  const Sunk body = sunk_to_sigma(problem, sigma, hats(space.points(), sigma, in_body), layer, force);

  // the unknowns: Sigma, and rows 1 to `rows` of columns below it; all are differences to u_h, on Sigma and constant in y
  constexpr int most_rows = 8;  // a wave over the depth loses (pi / 8)^2 / 12 = 1.3 % by the height 1/8
  const auto degree = static_cast<int>(sigma.edge.front().size()) - 1, edges = static_cast<int>(sigma.edge.size());
  const auto in_layer = static_cast<int>(std::count(mesh.region.begin(), mesh.region.end(), Region::layer));
  // as many rows as make square cells in the layer of thickness epsilon, but no more than the mesh has: a coarse layer is no
  // locked one
  const int rows = std::clamp(static_cast<int>(std::ceil(*epsilon * degree * edges / sigma.length - 1e-9)), 1,
                              std::clamp(degree * in_layer / (2 * edges), 1, most_rows));
  const double height = 1.0 / rows;
  const int size = (rows + 1) * points;
  const auto unknown = [&](int i, int row) { return row * points + i; };

  VariationalInequality strip;
  strip.load = Eigen::VectorXd::Zero(size);
  strip.load.head(points) = body.force;
  std::vector<Eigen::Triplet<double>> a1, b;
  a1.reserve(static_cast<std::size_t>(points) * points + 2 * (degree + 1) * (degree + 1) * edges * rows);
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) a1.emplace_back(i, j, (body.form(i, j) + body.form(j, i)) / 2);
  const Eigen::VectorXd nodes = Eigen::VectorXd::LinSpaced(degree + 1, 0, 1);
  auto [at, weights] = gauss_rule(degree + 1);
  // a row of B per end of an edge, of which two edges have a half each; else one per point and edge
  const bool at_ends = degree == 1;
  if (at_ends) at = nodes, weights << 0.5, 0.5;
  const Trace trace = trace_at(nodes, at);
  const Eigen::MatrixXd form = trace.slope.transpose() * weights.asDiagonal() * trace.slope;
  const int b_rows = at_ends ? points : edges * (degree + 1);
  strip.m = Eigen::VectorXd::Zero(rows * b_rows);
  for (int e = 0; e < edges; ++e) {
    const Indices& edge = sigma.edge[e];
    const double dx = sigma.x[edge.back()] - sigma.x[edge.front()];
    const Eigen::VectorXd pull = s / dx * form * on_sigma(edge);
    left_in_layer -= base(edge).dot(pull - s / dx / 2 * form * base(edge));
    for (int row = 0; row < rows; ++row) {
      for (const int end : {row, row + 1})
        for (int i = 0; i <= degree; ++i) {
          strip.load(unknown(edge[i], end)) -= height / 2 * pull(i);
          for (int j = 0; j <= degree; ++j)
            a1.emplace_back(unknown(edge[i], end), unknown(edge[j], end), height / 2 * s / dx * form(i, j));
        }
      for (int q = 0; q <= degree; ++q) {
        const int at_row = row * b_rows + (at_ends ? edge[q] : e * (degree + 1) + q);
        for (int i = 0; i <= degree && strip.m(at_row) == 0; ++i) {
          b.emplace_back(at_row, unknown(edge[i], row), rows * trace.value(q, i));
          b.emplace_back(at_row, unknown(edge[i], row + 1), -rows * trace.value(q, i));
        }
        strip.m(at_row) += s * height * dx * weights(q);
      }
    }
  }
  if (stiff != nullptr && stiff->load) {  // at the points where u_h has it
    const Quadrature& rule = load_rule(element);
    std::vector<Eigen::VectorXd> basis;
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) basis.push_back(element.basis(rule.points.row(q)));
    std::vector<const Indices*> below(points);  // the edge on the right of a point of Sigma
    for (const Indices& edge : sigma.edge)
      for (int i = 0; i < degree; ++i) below[edge[i]] = &edge;
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (Eigen::Index q = 0; q < rule.weights.size() && mesh.region[t] == Region::layer; ++q) {
        const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
        const Indices& edge = *below[among(sigma.x, x(0)).first];
        const double on_edge = (x(0) - sigma.x[edge.front()]) / (sigma.x[edge.back()] - sigma.x[edge.front()]);
        const int row = std::min(static_cast<int>(-x(1) * rows), rows - 1);
        const double low = -x(1) * rows - row;
        const double pull = mesh.area(t) * rule.weights(q) * stiff->load(x(0), x(1));
        for (int i = 0; i <= degree; ++i) {
          double f = pull;
          for (int j = 0; j <= degree; ++j) f *= i == j ? 1 : (degree * on_edge - j) / (i - j);  // Lagrange's basis
          left_in_layer += f * base(edge[i]);
          strip.load(unknown(edge[i], row)) += (1 - low) * f;
          strip.load(unknown(edge[i], row + 1)) += low * f;
        }
        for (Eigen::Index r = 0; r < basis[q].size(); ++r)  // what u_h has on Sigma is in the body's force
          if (const int place = sigma.place[space.unknowns()(t, r)]; place >= 0) {
            left_in_layer -= pull * basis[q](r) * base(place);
            if (!body.held[place]) strip.load(place) -= pull * basis[q](r);
          }
      }
  }
  strip.a1.resize(size, size);
  strip.a1.setFromTriplets(a1.begin(), a1.end());
  strip.b.resize(strip.m.size(), size);
  strip.b.setFromTriplets(b.begin(), b.end());
  strip.compliance = *epsilon * *epsilon;
  for (int row = 0; row <= rows; ++row)
    for (int i = 0; i < points; ++i) {
      const bool fixed = held_at[i] || (row == 0 && body.held[i]);
      if (fixed) strip.fixed.push_back(unknown(i, row));
      if (!fixed && row == rows && !problem.contact.empty()) strip.contact.push_back(unknown(i, rows));
    }
  strip.fixed_values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(strip.fixed.size()));
  const Eigen::VectorXd bottom = space.points().col(0)(problem.contact);
  const auto seen = [&](const Eigen::VectorXd& bounds) {
    Eigen::VectorXd here(static_cast<Eigen::Index>(bounds.size() > 0 ? strip.contact.size() : 0)), above_still;
    if (bounds.size() > 0) above_still = bounds - still(problem.contact);
    for (Eigen::Index k = 0; k < here.size(); ++k) {
      const int i = strip.contact[k] - unknown(0, rows);
      here(k) = on_chain(bottom, above_still, sigma.x(i)) - base(i);
    }
    return here;
  };
  strip.lower = seen(problem.lower), strip.upper = seen(problem.upper);

  LostEnergy lost;
  if (strip.free_count() == 0) return lost;
  const Solution moved = active_set(strip);
  const Eigen::VectorXd back = (-base).replicate(rows + 1, 1);  // from u_h to v_0
  const double j = energy(strip, moved), j_still = back.dot(strip.a1 * back) / 2 - strip.load.dot(back);
  const Eigen::VectorXd way = moved.u - back;
  lost.found = lost.proved = left_in_layer - j;
  lost.motion =
      std::max(j_still - j, way.dot(strip.a1 * way) / 2 + strip.compliance * moved.p.cwiseAbs2().dot(strip.m) / 2);
  // the forces on Sigma, of body and layer, are what is left of stiffness times U: where all is at rest the motion that they
  // seem to be worth is at most 2.2 ulp of that (LostEnergy.HasNoMotionWhereAllIsAtRest), and ten times as much is room
  round_off += 20 * ulp * way.head(points).cwiseAbs().dot(Eigen::VectorXd(strip.a1.diagonal().head(points)));
  if (lost.motion < round_off / LostEnergy::telling) lost.motion = 0;  // else round-off could be the share that is told
  if (!scene.contact()) return lost;

  const Trace fine = trace_at(nodes, Eigen::VectorXd::LinSpaced(33, 0, 1));
  const Eigen::VectorXd moves = moved.u.segment(unknown(0, rows), points), v = on_sigma + moves;
  const auto& contact = *scene.contact();
  const Profile& ceiling = contact.ceiling;
  const Profile floor = [&](double x) { return -contact.gap(x); }, roof = [&](double x) { return -ceiling(x); };
  const double near =
      1e-10 * (base + moves).cwiseAbs().maxCoeff() + 20 * ulp;  // what the solvers leave of v - v_0, with room
  Eigen::VectorXd up = lift(sigma, fine, v, floor, held_at, near);
  if (ceiling && up.allFinite()) {
    up -= lift(sigma, fine, -v - up, roof, held_at, near);
    if (!(lift(sigma, fine, v + up, floor, held_at, near).maxCoeff() <= near))
      up(0) = infinity;  // no room for v between the two
  }
  const Eigen::VectorXd lifted = up.replicate(rows + 1, 1);
  const bool can = up.allFinite() && lifted(strip.fixed).isZero(0);
  lost.proved -= can ? lifted.dot(strip.a1 * (moved.u + lifted / 2) - strip.load) : infinity;
  return lost;
}

}  // namespace antilock
