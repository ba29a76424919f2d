// The jump of u across an interface of two meshes that do not match: a mean of differences of two
// traces at common points, jump = means * (trace of the slave - trace of the master).
#include "antilock/form/mortar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/mesh/quadrature.hpp"

namespace antilock {
namespace {

/// The largest distance between two places that count as one, as a share of the length of the slave
/// side: mesh generators place corners to 1e-12 of it, formats with few digits to 1e-8.
constexpr double slack = 1e-6;

/// A straight line with a coordinate t along it.
struct Line {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
  double length = 0;  ///< of the slave side

  Eigen::Vector2d normal() const { return {direction(1), -direction(0)}; }
  double coordinate(const Eigen::Vector2d& x) const { return direction.dot(x - origin); }
  double distance(const Eigen::Vector2d& x) const { return normal().dot(x - origin); }
  Eigen::Vector2d at(double t) const { return origin + t * direction; }
};

/// An edge on the line, with the triangle beside it. `first` and `second` are the coordinates of
/// its local vertices opposite + 1 and opposite + 2.
struct Segment {
  int triangle, opposite;
  double first, second;

  double from() const { return std::min(first, second); }
  double to() const { return std::max(first, second); }
  double length() const { return to() - from(); }
  /// The coordinate s of mesh/quadrature.hpp: on_edge.
  double local(double t) const { return std::clamp((t - first) / (second - first), 0.0, 1.0); }
};

std::vector<int> edges_with(const TriangleMesh& mesh, EdgeTag tag, const std::string& side) {
  std::vector<int> edges;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == tag) edges.push_back(e);
  if (edges.empty())
    throw Error("interface: no edge is on the " + side + " side; accepted: one or more");
  return edges;
}

/// The line through the ends of the slave side, in the direction of x, or of y where it is
/// vertical.
Line line_through(const TriangleMesh& mesh, const std::vector<int>& edges) {
  const auto vertex = [&](int v) { return Eigen::Vector2d(mesh.vertices.row(v)); };
  const auto farthest_from = [&](const Eigen::Vector2d& x) {
    Eigen::Vector2d farthest = x;
    for (const int e : edges)
      for (const int v : mesh.edges.row(e))
        if ((vertex(v) - x).norm() > (farthest - x).norm()) farthest = vertex(v);
    return farthest;
  };
  Eigen::Vector2d from = farthest_from(vertex(mesh.edges(edges.front(), 0)));
  Eigen::Vector2d to = farthest_from(from);
  const Eigen::Vector2d along = to - from;
  const bool is_vertical = std::abs(along(0)) <= slack * along.norm();
  if (along(is_vertical ? 1 : 0) < 0) std::swap(from, to);
  return {from, (to - from).normalized(), (to - from).norm()};
}

/// The edges as segments of the line, ascending. Throws Error for an edge that is off the line.
std::vector<Segment> segments_on(const TriangleMesh& mesh, const std::vector<int>& edges,
                                 const Line& line, const std::string& side) {
  std::vector<Segment> segments;
  for (const int e : edges) {
    for (const int v : mesh.edges.row(e))
      if (const double off = std::abs(line.distance(mesh.vertices.row(v)));
          off > slack * line.length)
        throw Error(fmt::format(
            "interface: the {} edge at {} is {:.3g} off the line through the ends of the slave "
            "side; accepted: both sides on one straight line",
            side, mesh.location_text(v), off));
    const int t = mesh.edge_triangles(e, 0), i = local_edge(mesh, t, e);
    const auto coordinate = [&](int corner) {
      return line.coordinate(mesh.vertices.row(mesh.triangles(t, corner % 3)));
    };
    segments.push_back({t, i, coordinate(i + 1), coordinate(i + 2)});
  }
  std::sort(segments.begin(), segments.end(),
            [](const Segment& a, const Segment& b) { return a.from() < b.from(); });
  return segments;
}

/// The side of the line, 1 or -1, on which the triangles beside the segments lie; 0 for both.
int side_of(const TriangleMesh& mesh, const std::vector<Segment>& segments, const Line& line) {
  int sum = 0;
  for (const auto& [t, opposite, first, second] : segments)
    sum += line.distance(mesh.vertices.row(mesh.triangles(t, opposite))) > 0 ? 1 : -1;
  const int count = static_cast<int>(segments.size());
  return std::abs(sum) == count ? sum / count : 0;
}

/// Both sides of an interface on their common line.
struct Interface {
  const Space& space;
  Line line;
  std::vector<Segment> slave, master;

  /// A place of the mesh at the coordinate t, as text.
  std::string location_text(double t) const {
    const Eigen::Vector2d x = line.at(t);
    return fmt::format("({:.6g}, {:.6g})", x(0), x(1));
  }
  /// The master segments that meet the interval (from, to).
  std::vector<Segment> opposite_to(double from, double to) const {
    const auto first = std::partition_point(master.begin(), master.end(),
                                            [&](const Segment& s) { return s.to() <= from; });
    const auto last =
        std::find_if(first, master.end(), [&](const Segment& s) { return s.from() >= to; });
    return {first, last};
  }
};

void check_sides(const Interface& interface) {
  const TriangleMesh& mesh = interface.space.mesh();
  const int of_slave = side_of(mesh, interface.slave, interface.line);
  const int of_master = side_of(mesh, interface.master, interface.line);
  if (of_slave == 0 || of_slave + of_master != 0)
    throw Error(
        "interface: the slave and the master are on one side of their line; accepted: a body on "
        "each side");
  for (const Segment& edge : interface.slave) {
    double covered = 0;
    for (const Segment& other : interface.opposite_to(edge.from(), edge.to()))
      covered += std::min(edge.to(), other.to()) - std::max(edge.from(), other.from());
    // an edge that is shorter than the slack must meet the master, or its mean is 0 / 0
    const double allowed = std::min(slack * interface.line.length, edge.length() / 2);
    if (std::abs(covered - edge.length()) > allowed)
      throw Error(fmt::format(
          "interface: the master edges cover {:.6g} of the slave edge from {} to {}, {:.6g} long; "
          "accepted: a master side that covers the slave side once (the shorter side is the slave)",
          covered, interface.location_text(edge.from()), interface.location_text(edge.to()),
          edge.length()));
  }
}

Interface make_interface(const Space& space, EdgeTag slave, EdgeTag master) {
  const bool accepted = &space.element() == &p1() || &space.element() == &crouzeix_raviart();
  if (!accepted)
    throw Error("interface: element " + space.element().name() + " is not accepted; P1, CR");
  if (slave == master)
    throw Error("interface: slave and master are one group; accepted: two groups");
  const TriangleMesh& mesh = space.mesh();
  const std::vector<int> slave_edges = edges_with(mesh, slave, "slave");
  const std::vector<int> master_edges = edges_with(mesh, master, "master");
  const Line line = line_through(mesh, slave_edges);
  Interface interface {
    space, line, segments_on(mesh, slave_edges, line, "slave"),
        segments_on(mesh, master_edges, line, "master")
  };
  check_sides(interface);
  return interface;
}

/// The entries of row `row` for factor * u at the coordinate t, by the trace from the triangle of
/// the segment.
void add_trace(Triplets& entries, int row, const Interface& interface, const Segment& segment,
               double t, double factor) {
  const Eigen::VectorXd basis =
      interface.space.element().basis(on_edge(segment.opposite, segment.local(t)));
  for (Eigen::Index k = 0; k < basis.size(); ++k)
    entries.emplace_back(row, interface.space.cell_dofs()(segment.triangle, k), factor * basis(k));
}

/// The slave unknowns on an edge, in the order of its ends for P1, with a row for those that are
/// not prescribed.
class SlaveUnknowns {
 public:
  explicit SlaveUnknowns(const Interface& interface)
      : space_(interface.space), row_(space_.size(), no_row) {
    std::vector<std::pair<double, int>> order;  // coordinate, unknown
    const std::vector<int>& prescribed = space_.dirichlet_dofs();
    for (const Segment& segment : interface.slave)
      for (const int unknown : on(segment)) {
        const double t = interface.line.coordinate(space_.dof_coordinates().row(unknown));
        if (!std::binary_search(prescribed.begin(), prescribed.end(), unknown))
          order.emplace_back(t, unknown);
      }
    std::sort(order.begin(), order.end());
    order.erase(std::unique(order.begin(), order.end()), order.end());
    if (order.empty())
      throw Error("interface: every slave unknown is prescribed; accepted: one or more free");
    for (const auto& [t, unknown] : order) {
      row_[unknown] = static_cast<int>(unknowns_.size());
      unknowns_.push_back(unknown);
    }
  }

  /// Two for P1, the ends opposite + 1 and opposite + 2; one for CR.
  std::vector<int> on(const Segment& segment) const {
    const auto unknown = [&](int local) { return space_.cell_dofs()(segment.triangle, local); };
    if (space_.element().dofs_per_edge() == 1) return {unknown(segment.opposite)};
    return {unknown((segment.opposite + 1) % 3), unknown((segment.opposite + 2) % 3)};
  }
  std::optional<int> row(int unknown) const {
    return row_[unknown] == no_row ? std::nullopt : std::optional(row_[unknown]);
  }
  const std::vector<int>& all() const { return unknowns_; }
  int count() const { return static_cast<int>(unknowns_.size()); }

 private:
  static constexpr int no_row = -1;
  const Space& space_;
  std::vector<int> row_;
  std::vector<int> unknowns_;
};

/// Throws Error for an unknown of both sides: its jump is 0 whatever the bodies do.
void check_no_common_unknown(const Interface& interface, const SlaveUnknowns& unknowns) {
  for (const Segment& segment : interface.master)
    for (const int unknown : unknowns.on(segment))
      if (unknowns.row(unknown)) {
        const double t = interface.line.coordinate(interface.space.dof_coordinates().row(unknown));
        throw Error("interface: the vertex at " + interface.location_text(t) +
                    " is on both sides; accepted: two bodies without a common vertex");
      }
}

/// The values of the functions psi of a slave edge at its local coordinate s, with their rows.
std::vector<std::pair<int, double>> dual_basis(const SlaveUnknowns& unknowns,
                                               const Segment& segment, double s) {
  const std::vector<int> of_edge = unknowns.on(segment);
  std::vector<int> rows;
  for (const int unknown : of_edge)
    if (const auto row = unknowns.row(unknown)) rows.push_back(*row);
  if (rows.size() == 2) return {{rows[0], 2 - 3 * s}, {rows[1], 3 * s - 1}};
  if (rows.size() == 1) return {{rows[0], 1.0}};
  return {};
}

/// Fills means, points, lengths and jump.
void fill_mortar(InterfaceConstraints& constraints, const Interface& interface,
                 const SlaveUnknowns& unknowns) {
  // degree 7: exact for the products of psi and a trace, and for a gap of degree 6
  const auto [gauss_points, gauss_weights] = gauss_rule(4);
  Triplets means, traces;
  std::vector<Eigen::Vector2d> points;
  constraints.lengths = Eigen::VectorXd::Zero(unknowns.count());
  for (const Segment& edge : interface.slave)
    for (const Segment& other : interface.opposite_to(edge.from(), edge.to())) {
      const double from = std::max(edge.from(), other.from());
      const double length = std::min(edge.to(), other.to()) - from;
      for (Eigen::Index q = 0; q < gauss_points.size(); ++q) {
        const double t = from + length * gauss_points(q);
        const int column = static_cast<int>(points.size());
        points.push_back(interface.line.at(t));
        add_trace(traces, column, interface, edge, t, 1);
        add_trace(traces, column, interface, other, t, -1);
        for (const auto& [row, psi] : dual_basis(unknowns, edge, edge.local(t))) {
          const double weight = length * gauss_weights(q) * psi;
          means.emplace_back(row, column, weight);
          constraints.lengths(row) += weight;
        }
      }
    }
  const auto count = static_cast<Eigen::Index>(points.size());
  constraints.points.resize(count, 2);
  for (Eigen::Index q = 0; q < count; ++q) constraints.points.row(q) = points[q];
  constraints.means = constraints.lengths.cwiseInverse().asDiagonal() *
                      from_triplets<RowMatrix>(unknowns.count(), count, means);
  constraints.jump =
      constraints.means * from_triplets<RowMatrix>(count, interface.space.size(), traces);
}

void fill_node_to_segment(InterfaceConstraints& constraints, const Interface& interface,
                          const SlaveUnknowns& unknowns) {
  const int count = unknowns.count();
  Triplets entries;
  for (int row = 0; row < count; ++row) {
    entries.emplace_back(row, unknowns.all()[row], 1.0);
    const double t = interface.line.coordinate(constraints.places.row(row));
    // the trace of CR has two values at a vertex: their mean
    const double near = slack * interface.line.length;
    const std::vector<Segment> at_t = interface.opposite_to(t - near, t + near);
    const double share = 1.0 / static_cast<double>(at_t.size());
    for (const Segment& other : at_t) add_trace(entries, row, interface, other, t, -share);
  }
  constraints.lengths = Eigen::VectorXd::Zero(count);
  for (const Segment& edge : interface.slave) {
    const std::vector<int> of_edge = unknowns.on(edge);
    for (const int unknown : of_edge)
      if (const auto row = unknowns.row(unknown))
        constraints.lengths(*row) += edge.length() / static_cast<double>(of_edge.size());
  }
  constraints.points = constraints.places;
  constraints.means.resize(count, count);
  constraints.means.setIdentity();
  constraints.jump = from_triplets<RowMatrix>(count, interface.space.size(), entries);
}

}  // namespace

InterfaceConstraints interface_constraints(const Space& space, EdgeTag slave, EdgeTag master,
                                           InterfaceMethod method) {
  require_triangles(space.mesh(), "contact of two bodies");
  const Interface interface = make_interface(space, slave, master);
  const SlaveUnknowns unknowns(interface);
  check_no_common_unknown(interface, unknowns);
  InterfaceConstraints constraints;
  constraints.places = space.dof_coordinates()(unknowns.all(), Eigen::indexing::all);
  constraints.normal =
      -side_of(space.mesh(), interface.slave, interface.line) * interface.line.normal();
  if (method == InterfaceMethod::mortar)
    fill_mortar(constraints, interface, unknowns);
  else
    fill_node_to_segment(constraints, interface, unknowns);
  // entries of cancelled functions, as those of CR's third edge in the mean over an edge
  constraints.jump.prune(1.0, 1e-14);
  constraints.jump.makeCompressed();
  return constraints;
}

RowMatrix component_jump(const RowMatrix& jump, const Eigen::Vector2d& direction) {
  Triplets entries;
  for (Eigen::Index row = 0; row < jump.rows(); ++row)
    for (RowMatrix::InnerIterator entry(jump, row); entry; ++entry)
      for (int k = 0; k < 2; ++k)
        if (direction(k) != 0)
          entries.emplace_back(static_cast<int>(row),
                               static_cast<int>(entry.col() + k * jump.cols()),
                               direction(k) * entry.value());
  return from_triplets<RowMatrix>(jump.rows(), 2 * jump.cols(), entries);
}

}  // namespace antilock
