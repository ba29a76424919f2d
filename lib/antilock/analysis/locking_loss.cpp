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
// Its bounds hold at the bottom of the columns, below the unknowns on Sigma. They are interpolated
// from the bounds of u_h at its own points. Where v is below the obstacle between these points, as
// seen at 33 points per edge, a function is added that is affine on each edge of Sigma and constant
// in y. The sum is v', in K.
#include "antilock/analysis/locking_loss.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unsupported/Eigen/KroneckerProduct>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/form/edge_forms.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/measure/result.hpp"
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
  const Eigen::MatrixX3d nodes = space.element().support_points();
  const auto x = [&](int u) { return space.dof_coordinates()(u, 0); };
  Line line;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::sigma) continue;
    const int t = mesh.edge_triangles(e, 0);
    int i = 0;  // the edge's place in t
    while (mesh.triangle_edges(t, i) != e) ++i;
    Indices& edge = line.edge.emplace_back();
    for (Eigen::Index r = 0; r < nodes.rows(); ++r)
      if (nodes(r, i) == 0) edge.push_back(space.cell_dofs()(t, r));
    std::sort(edge.begin(), edge.end(), [&](int a, int b) { return x(a) < x(b); });
    line.length += x(edge.back()) - x(edge.front());
  }
  std::sort(line.edge.begin(), line.edge.end(), [&](const auto& a, const auto& b) { return x(a[0]) < x(b[0]); });
  line.place.assign(space.size(), -1);
  for (Indices& edge : line.edge)
    for (int& u : edge) {
      if (line.place[u] < 0) {
        line.place[u] = static_cast<int>(line.unknown.size());
        line.unknown.push_back(u);
      }
      u = line.place[u];
    }
  line.x = space.dof_coordinates().col(0)(line.unknown);
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

/// The basis of u_h on an edge of Sigma, s from 0 to 1: a row per point, a column per unknown from left to right.
struct Trace {
  Eigen::MatrixXd value, slope;
};

Trace trace_at(const Element& element, const Eigen::VectorXd& points) {
  const Eigen::MatrixX3d nodes = element.support_points();
  Indices on_edge;
  for (Eigen::Index r = 0; r < nodes.rows(); ++r)
    if (nodes(r, 0) == 0) on_edge.push_back(static_cast<int>(r));
  std::sort(on_edge.begin(), on_edge.end(), [&](int a, int b) { return nodes(a, 2) < nodes(b, 2); });
  Trace trace{Eigen::MatrixXd(points.size(), on_edge.size()), Eigen::MatrixXd(points.size(), on_edge.size())};
  for (Eigen::Index q = 0; q < points.size(); ++q) {
    const Eigen::Vector3d lambda(0, 1 - points(q), points(q));
    trace.value.row(q) = element.basis(lambda)(on_edge);
    trace.slope.row(q) = (element.derivative(lambda) * Eigen::Vector3d(0, -1, 1))(on_edge);
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
  RowMatrix w(at.rows(), count);
  w.reserve(4 * at.rows());
  for (int v = 0; v < at.rows(); ++v) {
    w.startVec(v);
    if (!in_body[v]) continue;
    if (sigma.place[v] >= 0) {
      w.insertBack(v, sigma.place[v]) = 1;
      continue;
    }
    const double y = std::max(at(v, 1), 0.0);
    const auto above = y > 0 ? rows.lower_bound(y) : std::next(rows.begin()), under = std::prev(above);
    const double s = (y - under->first) / (above->first - under->first);
    for (const auto& [row, share] : {std::pair(&under->second, 1 - s), {&above->second, s}}) {
      const auto [hat, t] = among(row->x, at(v, 0));
      w.insertBack(v, row->first + hat) = share * (1 - t);
      w.insertBack(v, row->first + hat + 1) = share * t;
    }
  }
  w.finalize();
  return w;
}

/// The layer's part of A1, N x N: of its triangles with a corner on Sigma, so that the rows of Sigma are whole.
SparseMatrix layer_at(const Line& sigma, const Space& space, const Eigen::Vector2d& stiffness) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = strain_quadrature(space.element());
  Triplets entries;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const auto corner = mesh.triangles.row(t);
    if (mesh.region[t] == Region::body ||
        std::max({sigma.place[corner(0)], sigma.place[corner(1)], sigma.place[corner(2)]}) < 0)
      continue;
    const auto unknown = space.cell_dofs().row(t);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::MatrixX2d gradient = space.element().derivative(rule.points.row(q)) * barycentric_gradients(mesh, t);
      const Eigen::MatrixXd local =
          gradient * (rule.weights(q) * mesh.area(t) * stiffness).asDiagonal() * gradient.transpose();
      for (Eigen::Index i = 0; i < local.rows(); ++i)
        for (Eigen::Index j = 0; j < local.cols(); ++j) entries.emplace_back(unknown(i), unknown(j), local(i, j));
    }
  }
  return from_triplets<SparseMatrix>(space.size(), space.size(), entries);
}

/// The form of the body on W and a force, of which the hats above Sigma are eliminated. What those gain alone is
/// left out: u_h is at rest there, and v no better than it is.
struct Sunk {
  Eigen::MatrixXd form;
  Eigen::VectorXd force;
  std::vector<char> held;  ///< hats that are not 0 where v is held: they are left out
};

Sunk sunk_to_sigma(const SparseMatrix& body, const Eigen::VectorXd& on_body, const Indices& fixed, const RowMatrix& w,
                   Eigen::Index low) {
  const Eigen::Index all = w.cols(), above = all - low;
  std::vector<char> held(all, 0);
  for (const int u : fixed)
    for (RowMatrix::InnerIterator hat(w, u); hat; ++hat)
      if (hat.value() > 1e-12) held[hat.col()] = 1;
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(all, all);
  for (int u = 0; u < body.cols(); ++u)
    for (SparseMatrix::InnerIterator a(body, u); a; ++a)
      for (RowMatrix::InnerIterator left(w, u); left; ++left)
        for (RowMatrix::InnerIterator right(w, a.row()); right; ++right)
          form(right.col(), left.col()) += a.value() * left.value() * right.value();
  Eigen::VectorXd force = w.transpose() * on_body;
  // hats may reach no vertex, or be dependent at the few that they reach: a little energy more makes w unique, and v no
  // better than it is
  for (double& own : form.diagonal()) own = own > 0 ? (1 + 1e-10) * own : 1;
  for (Eigen::Index i = 0; i < all; ++i)
    if (held[i]) form.row(i).setZero(), form.col(i).setZero(), form(i, i) = 1, force(i) = 0;
  const Cholesky upper(form.bottomRightCorner(above, above));
  const Eigen::MatrixXd half = upper.forward(Eigen::MatrixXd(form.bottomLeftCorner(above, low)));
  const Eigen::VectorXd pull = upper.forward(Eigen::VectorXd(force.tail(above)));
  const Eigen::MatrixXd left = form.topLeftCorner(low, low) - half.transpose() * half;
  return {(left + left.transpose()) / 2, force.head(low) - half.transpose() * pull, held};
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

double LockingLoss::share(double energy) const { return reference > 0 ? std::clamp(energy / reference, 0.0, 1.0) : 0; }

LockingLoss locking_loss(const Scene& scene, const Result& result) {
  const Space& space = result.space;
  const VariationalInequality& problem = result.problem;
  const Solution& solution = result.solution;
  if ((problem.fixed_compliances.array() > 0).any()) return locking_loss(scene, assemble_fixed_rows(result));
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
    for (Eigen::Index r = 0; r < space.cell_dofs().cols() && mesh.region[t] == Region::body; ++r)
      in_body[space.cell_dofs()(t, r)] = 1;
  for (std::size_t k = 0; k < problem.dirichlet_dofs.size(); ++k) {
    const int u = problem.dirichlet_dofs[k];
    if (sigma.place[u] >= 0) held_at[sigma.place[u]] = 1;
    const double more = problem.dirichlet_values(static_cast<Eigen::Index>(k)) -
                        on_chain(sigma.x, on_sigma, space.dof_coordinates()(u, 0));
    if (!in_body[u] && std::abs(more) > 1e-9 * on_sigma.cwiseAbs().maxCoeff())
      throw Error("lost energy: accepted: a layer whose sides have the value of Sigma's end above them");
  }

  for (int e = 0; e < mesh.edge_count(); ++e)
    if (const EdgeTag tag = mesh.edge_tag[e]; tag.group >= 0 && !is_dirichlet(tag) &&
                                              mesh.region[mesh.edge_triangles(e, 0)] == Region::layer &&
                                              scene.edges()[tag.group].kind != BoundaryCondition::Kind::free)
      throw Error("lost energy: accepted: no traction and no spring on the layer");

  // v_0: straight in the layer, affine between given values of the outer ends of Sigma, level to an end that is free
  const double left = held_at.front() ? on_sigma(0) : held_at.back() ? on_sigma(points - 1) : on_sigma.mean();
  const double right = held_at.back() ? on_sigma(points - 1) : left;
  const double slope = (right - left) / (sigma.x(points - 1) - sigma.x(0));
  const Eigen::VectorXd still = left + slope * (space.dof_coordinates().col(0).array() - sigma.x(0));
  const double ulp = std::numeric_limits<double>::epsilon() * solution.u.cwiseAbs().maxCoeff();
  const Eigen::VectorXd w = solution.u - still, middle = still + w / 2, base = w(sigma.unknown);

  // force: what u_h leaves of the forces on the body, whose form is A1 less the layer's part. left_in_layer: in the
  // layer, J(v_0 + w) - J(v_0) = a(w, v_0 + w / 2) - L(w), with w = u_h - v_0. (Beside given values U the square of u_h
  // itself has round-off of s U^2.) Its round-off: a row of A1 has sum 0, and leaves of values U some ulp of U times its
  // entries.
  const SparseMatrix layer =
      layer_at(sigma, space, stiff != nullptr ? Eigen::Vector2d(s, 0) : Eigen::Vector2d::Constant(1 / *epsilon));
  const SparseMatrix on_body = problem.a1 - layer;
  const bool pressed = stiff != nullptr && stiff->load;
  const Eigen::VectorXd layer_load =
      pressed ? load_vector(space, stiff->load, Region::layer) : Eigen::VectorXd(Eigen::VectorXd::Zero(space.size()));
  Eigen::VectorXd force = problem.load - layer_load - on_body * solution.u;
  double left_in_layer = problem.compliance * solution.p.cwiseAbs2().dot(problem.m) / 2 - w.dot(layer_load),
         round_off = 0;
  for (int u = 0; u < space.size(); ++u) {
    left_in_layer += w(u) * (in_body[u] ? layer : problem.a1).col(u).dot(middle);
    if (in_body[u]) continue;
    force(u) = 0;
    round_off += 2 * ulp * std::abs(w(u)) * problem.a1.coeff(u, u);
  }

  // the unknowns: Sigma, and rows 1 to `rows` of columns below it; all are differences to u_h, on Sigma and constant in y
  constexpr int most_rows = 8;  // a wave over the depth loses (pi / 8)^2 / 12 = 1.3 % by the height 1/8
  const auto degree = static_cast<int>(sigma.edge.front().size()) - 1, edges = static_cast<int>(sigma.edge.size());
  const auto in_layer = static_cast<int>(std::count(mesh.region.begin(), mesh.region.end(), Region::layer));
  // as many rows as make square cells in the layer of thickness epsilon, but no more than the mesh has: a coarse layer is no
  // locked one
  const int rows = std::clamp(static_cast<int>(std::ceil(*epsilon * degree * edges / sigma.length - 1e-9)), 1,
                              std::clamp(degree * in_layer / (2 * edges), 1, most_rows));
  const int size = (rows + 1) * points;

  // Products of forms in x (a_x, the rows of B with their weights) and in y (the trapezoidal rule, differences). For P1
  // the rows of B stand at the ends of the edges, else at Gauss's points.
  auto [at, weights] = gauss_rule(degree + 1);
  if (degree == 1) at << 0, 1;
  const Trace trace = trace_at(element, at);
  const Eigen::MatrixXd form = trace.slope.transpose() * weights.asDiagonal() * trace.slope;
  std::vector<Eigen::Triplet<double>> of_form, of_value;
  Eigen::VectorXd weight(edges * (degree + 1));
  for (int e = 0; e < edges; ++e) {
    const Indices& edge = sigma.edge[e];
    const double dx = sigma.x[edge.back()] - sigma.x[edge.front()];
    for (int i = 0; i <= degree; ++i) {
      const int row = e * (degree + 1) + i;
      weight(row) = s * dx * weights(i);
      for (int j = 0; j <= degree; ++j) {
        of_form.emplace_back(edge[i], edge[j], s / dx * form(i, j));
        of_value.emplace_back(row, edge[j], trace.value(i, j));
      }
    }
  }
  SparseMatrix a_x(points, points);
  a_x.setFromTriplets(of_form.begin(), of_form.end());
  RowMatrix value(weight.size(), points), difference(rows, rows + 1);
  value.setFromTriplets(of_value.begin(), of_value.end());
  Eigen::VectorXd depth = Eigen::VectorXd::Constant(rows + 1, 1.0 / rows);
  depth(0) = depth(rows) = 0.5 / rows;
  for (int row = 0; row < rows; ++row) difference.insert(row, row) = rows, difference.insert(row, row + 1) = -rows;

  const Sunk body =
      sunk_to_sigma(on_body, force, problem.dirichlet_dofs, hats(space.dof_coordinates(), sigma, in_body), points);
  VariationalInequality strip;
  SparseMatrix on_sigma_form = body.form.sparseView();
  on_sigma_form.conservativeResize(size, size);
  strip.a1 = Eigen::kroneckerProduct(SparseMatrix(depth.asDiagonal()), a_x);
  strip.a1 += on_sigma_form;
  strip.b = Eigen::kroneckerProduct(difference, value);
  strip.a1.makeCompressed();
  strip.b.makeCompressed();
  strip.m = weight.replicate(rows, 1) / rows;
  strip.compliance = *epsilon * *epsilon;
  strip.load = Eigen::kroneckerProduct(depth, a_x * -on_sigma);
  strip.load.head(points) += body.force;
  left_in_layer -= base.dot(a_x * (on_sigma - base / 2));
  if (pressed) {  // at the points where u_h has it
    const Quadrature& rule = load_rule(element);
    std::vector<const Indices*> below(points);  // the edge on the right of a point of Sigma
    for (const Indices& edge : sigma.edge)
      for (int i = 0; i < degree; ++i) below[edge[i]] = &edge;
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (Eigen::Index q = 0; q < rule.weights.size() && mesh.region[t] == Region::layer; ++q) {
        const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
        const Indices& edge = *below[among(sigma.x, x(0)).first];
        const double left_end = sigma.x[edge.front()], on_edge = (x(0) - left_end) / (sigma.x[edge.back()] - left_end);
        const int row = std::min(static_cast<int>(-x(1) * rows), rows - 1);
        const double low = -x(1) * rows - row;
        const Eigen::VectorXd pull = mesh.area(t) * rule.weights(q) * stiff->load(x(0), x(1)) *
                                     trace_at(element, Eigen::VectorXd::Constant(1, on_edge)).value.row(0);
        left_in_layer += pull.dot(base(edge));
        strip.load.segment(row * points, points)(edge) += (1 - low) * pull;
        strip.load.segment((row + 1) * points, points)(edge) += low * pull;
      }
  }
  for (int k = 0; k < size; ++k)
    if (held_at[k % points] || (k < points && body.held[k]))
      strip.dirichlet_dofs.push_back(k);
    else if (k >= rows * points && !problem.contact.empty())
      strip.contact.push_back(k);
  strip.dirichlet_values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(strip.dirichlet_dofs.size()));
  const Eigen::VectorXd bottom = space.dof_coordinates().col(0)(problem.contact);
  const auto seen = [&](const Eigen::VectorXd& bounds) {
    if (bounds.size() == 0) return bounds;
    const Eigen::VectorXd above_still = bounds - still(problem.contact);
    Eigen::VectorXd here(static_cast<Eigen::Index>(strip.contact.size()));
    for (Eigen::Index k = 0; k < here.size(); ++k) {
      const int i = strip.contact[k] - rows * points;
      here(k) = on_chain(bottom, above_still, sigma.x(i)) - base(i);
    }
    return here;
  };
  strip.lower = seen(problem.lower), strip.upper = seen(problem.upper);

  LockingLoss lost;
  if (strip.free_count() == 0) return lost;
  const Solution moved = active_set(strip);
  const Eigen::VectorXd back = (-base).replicate(rows + 1, 1);  // from u_h to v_0
  const double j = energy(strip, moved), j_still = back.dot(strip.a1 * back) / 2 - strip.load.dot(back);
  const Eigen::VectorXd way = moved.u - back;
  lost.estimate = lost.lower_bound = left_in_layer - j;
  lost.reference =
      std::max(j_still - j, way.dot(strip.a1 * way) / 2 + strip.compliance * moved.p.cwiseAbs2().dot(strip.m) / 2);
  // the forces on Sigma, of body and layer, are what is left of stiffness times U: where all is at rest the motion that they
  // seem to be worth is at most 2.2 ulp of that (LockingLoss.HasNoMotionWhereAllIsAtRest), and ten times as much is
  // room
  round_off += 20 * ulp * way.head(points).cwiseAbs().dot(Eigen::VectorXd(strip.a1.diagonal().head(points)));
  // below this the round-off alone would be a share that is reported
  if (lost.reference < round_off / significance) lost.reference = 0;
  if (!scene.contact()) return lost;

  const Trace fine = trace_at(element, Eigen::VectorXd::LinSpaced(33, 0, 1));
  const Eigen::VectorXd moves = moved.u.tail(points), v = on_sigma + moves;
  const auto& contact = *scene.contact();
  const Profile& upper_obstacle = contact.upper_obstacle;
  const Profile floor = [&](double x) { return -contact.gap(x); }, roof = [&](double x) { return -upper_obstacle(x); };
  const double near =
      1e-10 * (base + moves).cwiseAbs().maxCoeff() + 20 * ulp;  // what the solvers leave of v - v_0, with room
  Eigen::VectorXd up = lift(sigma, fine, v, floor, held_at, near);
  if (upper_obstacle && up.allFinite()) {
    up -= lift(sigma, fine, -v - up, roof, held_at, near);
    if (!(lift(sigma, fine, v + up, floor, held_at, near).maxCoeff() <= near))
      up(0) = infinity;  // no room for v between the two
  }
  const Eigen::VectorXd lifted = up.replicate(rows + 1, 1);
  const bool can = up.allFinite() && lifted(strip.dirichlet_dofs).isZero(0);
  lost.lower_bound -= can ? lifted.dot(strip.a1 * (moved.u + lifted / 2) - strip.load) : infinity;
  return lost;
}

}  // namespace antilock
