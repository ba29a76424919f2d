#include "antilock/mesh/triangle_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

template <class Thrown = Error, class... Values>
[[noreturn]] void refuse(const std::string& where, fmt::format_string<const Values&...> why,
                         const Values&... values) {
  throw Thrown(fmt::format("{}: {}", where, fmt::format(why, values...)));
}

std::string triangle_at(const TriangleMesh& mesh, int t) {
  const auto& v = mesh.triangles;
  return fmt::format("triangle {} {} {}", mesh.location_text(v(t, 0)), mesh.location_text(v(t, 1)),
                     mesh.location_text(v(t, 2)));
}

void check_indices(const TriangleMesh& mesh, const std::vector<TaggedEdge>& tagged_edges,
                   const std::string& where) {
  const int n = mesh.vertex_count();
  if (mesh.triangle_count() == 0) refuse(where, "no triangles; accepted: a mesh of the body");
  if (static_cast<int>(mesh.region.size()) != mesh.triangle_count())
    refuse<MeshError>(where, "one region a triangle is needed");
  if (!mesh.vertices.allFinite()) refuse<MeshError>(where, "a vertex coordinate is not finite");
  const auto valid = [n](int v) { return v >= 0 && v < n; };
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i)
      if (!valid(mesh.triangles(t, i)))
        refuse(where, "triangle {} has vertex {}; accepted 0 to {}", t, mesh.triangles(t, i),
               n - 1);
  for (const TaggedEdge& e : tagged_edges)
    if (!valid(e.from) || !valid(e.to))
      refuse(where, "a tagged edge has vertices {} and {}; accepted 0 to {}", e.from, e.to, n - 1);
}

/// The named groups of the edges at each vertex that has such edges.
std::map<int, std::set<int>> named_groups_at(const std::vector<TaggedEdge>& tagged_edges) {
  std::map<int, std::set<int>> groups;
  for (const auto& [from, to, tag] : tagged_edges) {
    if (tag.group < 0) continue;
    groups[from].insert(tag.group);
    groups[to].insert(tag.group);
  }
  return groups;
}

/// Throws Error for two vertices at one place, a crack, unless they are on edges of two named
/// groups: then each face has its own condition, as two bodies in contact have.
void check_places(const TriangleMesh& mesh, const std::vector<TaggedEdge>& tagged_edges,
                  const std::string& where) {
  // duplicates are neighbours once sorted by x then y
  std::vector<int> order(mesh.vertex_count());
  std::iota(order.begin(), order.end(), 0);
  const auto& p = mesh.vertices;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return p(a, 0) != p(b, 0) ? p(a, 0) < p(b, 0) : p(a, 1) < p(b, 1);
  });
  const std::map<int, std::set<int>> groups = named_groups_at(tagged_edges);
  const auto are_two_faces = [&](int a, int b) {
    const auto of_a = groups.find(a), of_b = groups.find(b);
    if (of_a == groups.end() || of_b == groups.end()) return false;
    return of_a->second.size() > 1 || of_a->second != of_b->second;
  };
  for (std::size_t i = 1; i < order.size(); ++i)
    if (p.row(order[i]) == p.row(order[i - 1]) && !are_two_faces(order[i], order[i - 1]))
      refuse(where,
             "two vertices share the place {}: a crack; accepted: one vertex a place, or two on "
             "edges of two named groups",
             mesh.location_text(order[i]));
}

void check_vertices(const TriangleMesh& mesh, const std::string& where) {
  std::vector<char> used(mesh.vertex_count(), 0);
  for (const int v : mesh.triangles.reshaped()) used[v] = 1;
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end())
    refuse<MeshError>(where, "the vertex at {} is dangling: it belongs to no triangle",
                      mesh.location_text(static_cast<int>(unused - used.begin())));
}

/// A surface that gmsh oriented downwards is turned round as a whole; a single inverted triangle is
/// an error.
void orient(TriangleMesh& mesh, const std::vector<int>& surface, const std::string& where) {
  struct Turns {
    int members = 0;
    int clockwise = 0;
    int example = -1;  ///< a clockwise triangle
  };
  std::vector<Turns> turns(surface.empty() ? 0
                                           : *std::max_element(surface.begin(), surface.end()) + 1);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    Turns& here = turns[surface[t]];
    ++here.members;
    if (mesh.twice_area(t) >= 0) continue;
    ++here.clockwise;
    here.example = t;
  }
  for (const Turns& here : turns)
    if (here.clockwise > 0 && here.clockwise != here.members)
      refuse(where, "inverted {}; accepted: all triangles of a surface in one orientation",
             triangle_at(mesh, here.example));
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (turns[surface[t]].clockwise > 0) std::swap(mesh.triangles(t, 1), mesh.triangles(t, 2));
}

/// The regions as the surfaces of a mesh that names none.
std::vector<int> surfaces_of(const std::vector<Region>& region) {
  std::vector<int> surface;
  for (const Region each : region) surface.push_back(static_cast<int>(each));
  return surface;
}

void check_triangles(const TriangleMesh& mesh, const std::string& where) {
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
      const int a = mesh.triangles(t, i), b = mesh.triangles(t, (i + 1) % 3);
      longest = std::max(longest, (mesh.vertices.row(a) - mesh.vertices.row(b)).squaredNorm());
    }
    // below 1e-14 the sign of the area is round-off
    if (!(std::abs(mesh.twice_area(t)) > 1e-14 * longest))
      refuse<MeshError>(where, "degenerate {}: its area is zero", triangle_at(mesh, t));
  }
}

/// Tags sit on the boundary and on Sigma: only those edges need to be found.
void tag_edges(TriangleMesh& mesh, const std::vector<TaggedEdge>& tagged_edges,
               const std::string& where) {
  std::map<std::pair<int, int>, int> known;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0 || mesh.edge_tag[e] == EdgeTag::sigma)
      known[{mesh.edges(e, 0), mesh.edges(e, 1)}] = e;
  for (const TaggedEdge& tagged : tagged_edges) {
    const auto found = known.find(std::minmax(tagged.from, tagged.to));
    const bool on_sigma = found != known.end() && mesh.edge_triangles(found->second, 1) >= 0;
    if (found == known.end() || on_sigma != (tagged.tag == EdgeTag::sigma))
      refuse(where,
             "the tagged edge from {} to {} is dangling or misplaced; accepted: clamped and "
             "contact on the "
             "boundary, sigma between body and layer",
             mesh.location_text(tagged.from), mesh.location_text(tagged.to));
    EdgeTag& tag = mesh.edge_tag[found->second];
    if (tag != EdgeTag::interior && tag != tagged.tag)
      refuse(where, "the edge from {} to {} is in two groups; accepted: one of clamped, contact",
             mesh.location_text(tagged.from), mesh.location_text(tagged.to));
    tag = tagged.tag;
  }
}

/// Two triangles on the same side of their common edge run along it in the same direction.
void check_overlap(const TriangleMesh& mesh, const std::string& where) {
  std::vector<char> direction(mesh.edge_count(), 0);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      const char forward = mesh.triangles(t, (i + 1) % 3) == mesh.edges(e, 0) ? 1 : 2;
      if (direction[e] == forward)
        refuse<MeshError>(where, "inverted or overlapping {}", triangle_at(mesh, t));
      direction[e] = forward;
    }
}

/// Whether vertex v lies strictly inside edge e.
bool hangs(const TriangleMesh& mesh, int v, int e) {
  const Eigen::Vector2d a = mesh.vertices.row(mesh.edges(e, 0)),
                        b = mesh.vertices.row(mesh.edges(e, 1));
  const Eigen::Vector2d along = b - a, to = mesh.vertices.row(v).transpose() - a;
  const double t = to.dot(along) / along.squaredNorm();
  return t > 1e-9 && t < 1 - 1e-9 && (to - t * along).norm() < 1e-9 * along.norm();
}

void check_boundary(const TriangleMesh& mesh, const std::string& where) {
  std::vector<int> untagged;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0 && mesh.edge_tag[e] == EdgeTag::interior)
      untagged.push_back(e);
  if (untagged.empty()) return;
  const int first = untagged.front();
  const auto refuse_hanging = [&](int v, int e) {
    if (hangs(mesh, v, e))
      refuse<MeshError>(where, "the vertex at {} hangs on the edge from {} to {}",
                        mesh.location_text(v), mesh.location_text(mesh.edges(e, 0)),
                        mesh.location_text(mesh.edges(e, 1)));
  };
  // the likely reason: the first of them is the long side of a hanging vertex, or one of the short
  // ones
  for (int v = 0; v < mesh.vertex_count(); ++v) refuse_hanging(v, first);
  for (const int e : untagged)
    for (int end = 0; end < 2; ++end) refuse_hanging(mesh.edges(first, end), e);
  refuse(where,
         "the boundary edge from {} to {} is in no group; accepted: clamped, contact, or one that "
         "an [[edge]] names",
         mesh.location_text(mesh.edges(first, 0)), mesh.location_text(mesh.edges(first, 1)));
}

/// A piece that no clamped edge holds could move freely: the problem would be singular.
void check_held(const TriangleMesh& mesh, const std::string& where) {
  const auto held = [&](int e) {
    return is_dirichlet(mesh.edge_tag[e]) || mesh.edge_tag[e].group >= 0;
  };
  bool any = false;
  for (int e = 0; e < mesh.edge_count() && !any; ++e) any = held(e);
  if (!any) refuse<MeshError>(where, "no edge is in the group clamped, which is needed");
  if (const int t = find_floating_component(mesh, held); t >= 0)
    refuse<MeshError>(where, "dangling {}: no clamped edge holds its piece of the mesh",
                      triangle_at(mesh, t));
}

}  // namespace

int find_floating_component(const TriangleMesh& mesh, const std::function<bool(int edge)>& held) {
  std::vector<char> reached(mesh.triangle_count(), 0);
  std::vector<int> stack;
  const auto reach = [&](int t) {
    if (t < 0 || reached[t]) return;
    reached[t] = 1;
    stack.push_back(t);
  };
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (held(e)) reach(mesh.edge_triangles(e, 0));
  while (!stack.empty()) {
    const int t = stack.back();
    stack.pop_back();
    for (int i = 0; i < 3; ++i)
      for (int side = 0; side < 2; ++side)
        reach(mesh.edge_triangles(mesh.triangle_edges(t, i), side));
  }
  const auto loose = std::find(reached.begin(), reached.end(), 0);
  return loose != reached.end() ? static_cast<int>(loose - reached.begin()) : -1;
}

void number_edges(TriangleMesh& mesh, const std::string& where) {
  const int triangle_count = mesh.triangle_count();
  mesh.triangle_edges.resize(triangle_count, 3);
  mesh.edges.resize(3 * static_cast<Eigen::Index>(triangle_count), 2);
  mesh.edge_triangles.resize(3 * static_cast<Eigen::Index>(triangle_count), 2);
  // a chain of edges per vertex, those whose smaller vertex it is: each holds a handful, so that
  // the search is linear
  std::vector<int> last(mesh.vertex_count(), -1), before;
  for (int t = 0; t < triangle_count; ++t)
    for (int i = 0; i < 3; ++i) {
      const auto [from, to] =
          std::minmax(mesh.triangles(t, (i + 1) % 3), mesh.triangles(t, (i + 2) % 3));
      int e = last[from];
      while (e >= 0 && mesh.edges(e, 1) != to) e = before[e];
      if (e < 0) {
        e = static_cast<int>(before.size());
        before.push_back(std::exchange(last[from], e));
        mesh.edges.row(e) << from, to;
        mesh.edge_triangles.row(e) << t, -1;
      } else {
        if (mesh.edge_triangles(e, 1) != -1)
          refuse(where, "three triangles share the edge from {} to {}; accepted: two at most",
                 mesh.location_text(from), mesh.location_text(to));
        mesh.edge_triangles(e, 1) = t;
      }
      mesh.triangle_edges(t, i) = e;
    }
  const auto count = static_cast<Eigen::Index>(before.size());
  mesh.edges.conservativeResize(count, 2);
  mesh.edge_triangles.conservativeResize(count, 2);
  mesh.edge_tag.assign(before.size(), EdgeTag::interior);
  for (int e = 0; e < count; ++e) {
    const int other = mesh.edge_triangles(e, 1);
    if (other >= 0 && mesh.region[mesh.edge_triangles(e, 0)] != mesh.region[other])
      mesh.edge_tag[e] = EdgeTag::sigma;
  }
}

double TriangleMesh::twice_area(int t) const {
  const auto a = vertices.row(triangles(t, 0)), b = vertices.row(triangles(t, 1)),
             c = vertices.row(triangles(t, 2));
  return (b(0) - a(0)) * (c(1) - a(1)) - (c(0) - a(0)) * (b(1) - a(1));
}

double TriangleMesh::edge_length(int e) const {
  return (vertices.row(edges(e, 0)) - vertices.row(edges(e, 1))).norm();
}

std::string TriangleMesh::location_text(int vertex) const {
  return fmt::format("({:.6g}, {:.6g})", vertices(vertex, 0), vertices(vertex, 1));
}

int local_edge(const TriangleMesh& mesh, int triangle, int edge) {
  for (int i = 0; i < 3; ++i)
    if (mesh.triangle_edges(triangle, i) == edge) return i;
  throw Error(fmt::format("triangle {} has the edges {}, {} and {}; {} is none of them", triangle,
                          mesh.triangle_edges(triangle, 0), mesh.triangle_edges(triangle, 1),
                          mesh.triangle_edges(triangle, 2), edge));
}

double body_size(const TriangleMesh& mesh) {
  const auto in_body = [&](int t) { return mesh.region[t] == Region::body; };
  bool any = false;
  for (int t = 0; t < mesh.triangle_count() && !any; ++t) any = in_body(t);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::RowVector2d low = Eigen::RowVector2d::Constant(infinity);
  Eigen::RowVector2d high = -low;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (any && !in_body(t)) continue;
    for (const int v : mesh.triangles.row(t)) {
      low = low.cwiseMin(mesh.vertices.row(v));
      high = high.cwiseMax(mesh.vertices.row(v));
    }
  }
  return (high - low).maxCoeff();
}

double TriangleMesh::diameter() const {
  double longest = 0;
  for (int e = 0; e < edge_count(); ++e) longest = std::max(longest, edge_length(e));
  return longest;
}

TriangleMesh make_triangle_mesh(Points vertices, Triples triangles, std::vector<Region> region,
                                const std::vector<TaggedEdge>& tagged_edges,
                                const std::string& where, const std::vector<int>& surface) {
  TriangleMesh mesh;
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(triangles);
  mesh.region = std::move(region);
  check_indices(mesh, tagged_edges, where);
  if (!surface.empty() && (surface.size() != mesh.region.size() ||
                           *std::min_element(surface.begin(), surface.end()) < 0))
    refuse(where, "{} numbers of surfaces; accepted: none, or one per triangle, from 0 on",
           surface.size());
  check_vertices(mesh, where);
  check_places(mesh, tagged_edges, where);
  check_triangles(mesh, where);
  orient(mesh, surface.empty() ? surfaces_of(mesh.region) : surface, where);
  if (std::find(mesh.region.begin(), mesh.region.end(), Region::body) == mesh.region.end())
    refuse<MeshError>(where, "no triangle is in the group body, which is needed");
  number_edges(mesh, where);
  tag_edges(mesh, tagged_edges, where);
  check_overlap(mesh, where);
  check_boundary(mesh, where);
  check_held(mesh, where);
  return mesh;
}

TriangleMesh tag_by_position(Points vertices, Triples triangles) {
  TriangleMesh mesh;
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(triangles);
  const auto y = mesh.vertices.col(1);
  for (const auto corners : mesh.triangles.rowwise())
    mesh.region.push_back(y(corners).sum() > 0 ? Region::body : Region::layer);
  number_edges(mesh, "mesh");
  const double lowest = y.minCoeff();
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0)
      mesh.edge_tag[e] =
          (y(mesh.edges.row(e)).array() == lowest).all() ? EdgeTag::contact : EdgeTag::clamped;
  return mesh;
}

}  // namespace antilock
