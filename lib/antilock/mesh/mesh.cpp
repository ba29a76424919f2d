#include "antilock/mesh/mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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

const char* facet_name(const Mesh& mesh) { return mesh.dimension() == 2 ? "edge" : "face"; }

/// A facet with its vertices, for messages.
std::string facet_text(const Mesh& mesh, const int* vertex) {
  const auto at = [&](int i) { return mesh.location_text(vertex[i]); };
  if (mesh.dimension() == 2) return fmt::format("edge from {} to {}", at(0), at(1));
  return fmt::format("face {} {} {}", at(0), at(1), at(2));
}
std::string facet_text(const Mesh& mesh, int e) {
  return facet_text(mesh, mesh.edges.data() + static_cast<std::ptrdiff_t>(mesh.dimension()) * e);
}

/// A cell with its vertices, for messages.
std::string cell_text(const Mesh& mesh, int t) {
  std::string text = mesh.reference().name;
  for (const int v : mesh.triangles.row(t)) text += ' ' + mesh.location_text(v);
  return text;
}

void check_indices(const Mesh& mesh, const std::vector<TaggedEdge>& tagged_edges,
                   const std::string& where) {
  const int n = mesh.vertex_count();
  const ReferenceCell& cell = mesh.reference();
  if (mesh.triangle_count() == 0) refuse(where, "no {}; accepted: a mesh of the body", cell.plural);
  if (static_cast<int>(mesh.region.size()) != mesh.triangle_count())
    refuse<MeshError>(where, "one region a {} is needed", cell.name);
  if (!mesh.vertices.allFinite()) refuse<MeshError>(where, "a vertex coordinate is not finite");
  const auto valid = [n](int v) { return v >= 0 && v < n; };
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (const int v : mesh.triangles.row(t))
      if (!valid(v)) refuse(where, "{} {} has vertex {}; accepted 0 to {}", cell.name, t, v, n - 1);
  for (const TaggedEdge& tagged : tagged_edges) {
    const auto first = tagged.vertices.begin();
    const auto last = first + mesh.dimension();
    if (!std::all_of(first, last, valid))
      refuse(where, "a tagged {} has vertices {}; accepted 0 to {}", facet_name(mesh),
             fmt::format("{}", fmt::join(first, last, " and ")), n - 1);
  }
}

/// The named groups of the facets at each vertex that has such facets.
std::map<int, std::set<int>> named_groups_at(const std::vector<TaggedEdge>& tagged_edges) {
  std::map<int, std::set<int>> groups;
  for (const auto& [vertices, tag] : tagged_edges)
    for (const int v : vertices)
      if (tag.group >= 0 && v >= 0) groups[v].insert(tag.group);
  return groups;
}

/// Throws Error for two vertices at one place, a crack, unless they are on facets of two named
/// groups: then each face has its own condition, as two bodies in contact have.
void check_places(const Mesh& mesh, const std::vector<TaggedEdge>& tagged_edges,
                  const std::string& where) {
  // duplicates are neighbours once sorted by x, then y, then z
  std::vector<int> order(mesh.vertex_count());
  std::iota(order.begin(), order.end(), 0);
  const auto& p = mesh.vertices;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    for (int k = 0; k < mesh.dimension(); ++k)
      if (p(a, k) != p(b, k)) return p(a, k) < p(b, k);
    return false;
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
             "{}s of two named groups",
             mesh.location_text(order[i]), facet_name(mesh));
}

void check_vertices(const Mesh& mesh, const std::string& where) {
  std::vector<char> used(mesh.vertex_count(), 0);
  for (const int v : mesh.triangles.reshaped()) used[v] = 1;
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end())
    refuse<MeshError>(where, "the vertex at {} is dangling: it belongs to no {}",
                      mesh.location_text(static_cast<int>(unused - used.begin())),
                      mesh.reference().name);
}

/// A surface that gmsh oriented downwards is turned round as a whole; a single inverted triangle is
/// an error. In space the same holds for the tetrahedra of a volume.
void orient(Mesh& mesh, const std::vector<int>& surface, const std::string& where) {
  struct Turns {
    int members = 0;
    int inverted = 0;
    int example = -1;  ///< an inverted cell
  };
  std::vector<Turns> turns(surface.empty() ? 0
                                           : *std::max_element(surface.begin(), surface.end()) + 1);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    Turns& here = turns[surface[t]];
    ++here.members;
    if (mesh.measure(t) >= 0) continue;
    ++here.inverted;
    here.example = t;
  }
  for (const Turns& here : turns)
    if (here.inverted > 0 && here.inverted != here.members)
      refuse(where, "inverted {}; accepted: all {} of a {} in one orientation",
             cell_text(mesh, here.example), mesh.reference().plural,
             mesh.dimension() == 2 ? "surface" : "volume");
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (turns[surface[t]].inverted > 0) std::swap(mesh.triangles(t, 1), mesh.triangles(t, 2));
}

/// The regions as the surfaces of a mesh that names none.
std::vector<int> surfaces_of(const std::vector<Region>& region) {
  std::vector<int> surface;
  for (const Region each : region) surface.push_back(static_cast<int>(each));
  return surface;
}

/// The vertices of a row of indices as columns (d x k).
template <int d, int k>
Eigen::Matrix<double, d, k> places(const Mesh& mesh, const int* vertices) {
  Eigen::Matrix<double, d, k> columns;
  for (int i = 0; i < k; ++i)
    columns.col(i) =
        Eigen::Map<const Eigen::Matrix<double, d, 1>>(mesh.vertices.data() + d * vertices[i]);
  return columns;
}

/// Whether a simplex is flat up to round-off: at each vertex the determinant of the edges there is
/// at most 1e-14 of the product of their lengths. In the plane this quotient is the sine of the
/// angle. A thin simplex is not flat where at one of its vertices the edges are nearly
/// perpendicular.
template <CellKind kind>
bool is_flat(const Mesh& mesh, int t) {
  constexpr int d = reference_cell(kind).dimension;
  const auto x = places<d, d + 1>(mesh, mesh.triangles.data() + (d + 1) * t);
  for (int i = 0; i <= d; ++i) {
    Eigen::Matrix<double, d, d> along;
    for (int k = 0; k < d; ++k) along.col(k) = x.col(k < i ? k : k + 1) - x.col(i);
    if (std::abs(along.determinant()) > 1e-14 * along.colwise().norm().prod()) return false;
  }
  return true;
}

/// Whether Mesh::measure, which is a sum of products of coordinates of the edges at vertex 0, is
/// round-off: at most 1e-14 of the sum of the sizes of these products. A thin simplex along an axis
/// has few of them. An oblique tetrahedron of the length 1 and the width 1e-9 may have a measure of
/// the wrong sign.
template <CellKind kind>
bool has_lost_measure(const Mesh& mesh, int t) {
  constexpr int d = reference_cell(kind).dimension;
  const auto x = places<d, d + 1>(mesh, mesh.triangles.data() + (d + 1) * t);
  const Eigen::Array<double, d, d> along =
      (x.template rightCols<d>().colwise() - x.col(0)).cwiseAbs();
  double products = 0;
  if constexpr (d == 2) {
    products = along(0, 0) * along(1, 1) + along(1, 0) * along(0, 1);
  } else {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      products += along(i, 0) * (along(j, 1) * along(k, 2) + along(k, 1) * along(j, 2));
    }
  }
  constexpr int simplices_per_box = d == 2 ? 2 : 6;
  return !(simplices_per_box * std::abs(mesh.measure(t)) > 1e-14 * products);
}

template <CellKind kind>
bool is_degenerate(const Mesh& mesh, int t) {
  return is_flat<kind>(mesh, t) || has_lost_measure<kind>(mesh, t);
}

void check_cells(const Mesh& mesh, const std::string& where) {
  const bool in_space = mesh.dimension() == 3;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (in_space ? is_degenerate<CellKind::tetrahedron>(mesh, t)
                 : is_degenerate<CellKind::triangle>(mesh, t))
      refuse<MeshError>(where, "degenerate {}: its {} is zero up to round-off", cell_text(mesh, t),
                        in_space ? "volume" : "area");
}

/// Tags sit on the boundary and on Sigma: only those facets need to be found.
void tag_edges(Mesh& mesh, const std::vector<TaggedEdge>& tagged_edges, const std::string& where) {
  const int d = mesh.dimension();
  std::map<std::array<int, 3>, int> known;  // by -1 (in the plane) and the vertices, ascending
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0 || mesh.edge_tag[e] == EdgeTag::sigma)
      known[{d == 3 ? mesh.edges(e, 0) : -1, mesh.edges(e, d - 2), mesh.edges(e, d - 1)}] = e;
  for (const TaggedEdge& tagged : tagged_edges) {
    std::array<int, 3> vertices = tagged.vertices;
    std::sort(vertices.begin(), vertices.end());
    const auto found = known.find(vertices);
    const bool on_sigma = found != known.end() && mesh.edge_triangles(found->second, 1) >= 0;
    if (found == known.end() || on_sigma != (tagged.tag == EdgeTag::sigma))
      refuse(where,
             "the tagged {} is dangling or misplaced; accepted: clamped and contact on the "
             "boundary, sigma between body and layer",
             facet_text(mesh, tagged.vertices.data()));
    EdgeTag& tag = mesh.edge_tag[found->second];
    if (tag != EdgeTag::interior && tag != tagged.tag)
      refuse(where, "the {} is in two groups; accepted: one of clamped, contact",
             facet_text(mesh, tagged.vertices.data()));
    tag = tagged.tag;
  }
}

/// Whether the vertices of facet i of cell t, in the order of the reference cell, are an even
/// permutation of their ascending order.
bool has_even_order(const Mesh& mesh, int t, int i) {
  const auto& local = mesh.reference().facet[i];
  int inversions = 0;
  for (int a = 0; a < mesh.dimension(); ++a)
    for (int b = a + 1; b < mesh.dimension(); ++b)
      if (mesh.triangles(t, local[a]) > mesh.triangles(t, local[b])) ++inversions;
  return inversions % 2 == 0;
}

/// Two cells on the same side of their common facet have its vertices in orders of one parity.
void check_overlap(const Mesh& mesh, const std::string& where) {
  std::vector<char> direction(mesh.edge_count(), 0);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < mesh.reference().facets; ++i) {
      const int e = mesh.triangle_edges(t, i);
      const char here = has_even_order(mesh, t, i) ? 1 : 2;
      if (direction[e] == here)
        refuse<MeshError>(where, "inverted or overlapping {}", cell_text(mesh, t));
      direction[e] = here;
    }
}

/// Whether vertex v lies in facet e and is none of its vertices.
bool hangs(const Mesh& mesh, int v, int e) {
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 2>;
  const int d = mesh.dimension();
  const Position corner = mesh.vertices.row(mesh.edges(e, 0));
  Columns along(d, d - 1);
  for (int k = 0; k + 1 < d; ++k)
    along.col(k) = (mesh.vertices.row(mesh.edges(e, k + 1)) - corner).transpose();
  const Eigen::VectorXd to = (mesh.vertices.row(v) - corner).transpose();
  const Eigen::MatrixXd gram = along.transpose() * along;
  const Eigen::VectorXd t = gram.ldlt().solve(along.transpose() * to);  // barycentric, from 1 on
  const double first = 1 - t.sum();
  constexpr double slack = 1e-9;
  const bool inside = std::min(first, t.minCoeff()) > -slack;
  const bool at_vertex = std::max(first, t.maxCoeff()) >= 1 - slack;
  return inside && !at_vertex &&
         (to - along * t).norm() < slack * along.colwise().norm().maxCoeff();
}

void check_boundary(const Mesh& mesh, const std::string& where) {
  std::vector<int> untagged;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0 && mesh.edge_tag[e] == EdgeTag::interior)
      untagged.push_back(e);
  if (untagged.empty()) return;
  const int first = untagged.front();
  const auto refuse_hanging = [&](int v, int e) {
    if (hangs(mesh, v, e))
      refuse<MeshError>(where, "the vertex at {} hangs on the {}", mesh.location_text(v),
                        facet_text(mesh, e));
  };
  // the likely reason: the first of them is the large facet of a hanging vertex, or one of the
  // small ones
  for (int v = 0; v < mesh.vertex_count(); ++v) refuse_hanging(v, first);
  for (const int e : untagged)
    for (int end = 0; end < mesh.dimension(); ++end) refuse_hanging(mesh.edges(first, end), e);
  refuse(
      where,
      "the boundary {} is in no group; accepted: clamped, contact, or one that an [[edge]] names",
      facet_text(mesh, first));
}

/// A piece that no clamped facet holds could move freely: the problem would be singular.
void check_held(const Mesh& mesh, const std::string& where) {
  const auto held = [&](int e) {
    return is_dirichlet(mesh.edge_tag[e]) || mesh.edge_tag[e].group >= 0;
  };
  bool any = false;
  for (int e = 0; e < mesh.edge_count() && !any; ++e) any = held(e);
  if (!any)
    refuse<MeshError>(where, "no {} is in the group clamped, which is needed", facet_name(mesh));
  if (const int t = find_floating_component(mesh, held); t >= 0)
    refuse<MeshError>(where, "dangling {}: no clamped {} holds its piece of the mesh",
                      cell_text(mesh, t), facet_name(mesh));
}

/// The kind of cells with these numbers of coordinates and of vertices.
CellKind kind_of_cells(Eigen::Index coordinates, Eigen::Index vertices, const std::string& where) {
  for (const CellKind kind : {CellKind::triangle, CellKind::tetrahedron})
    if (reference_cell(kind).dimension == coordinates && reference_cell(kind).vertices == vertices)
      return kind;
  refuse(
      where,
      "cells of {} vertices with {} coordinates; accepted: triangles in the plane, or tetrahedra "
      "in space",
      vertices, coordinates);
}

}  // namespace

void require_triangles(const Mesh& mesh, const char* who) {
  if (mesh.kind != CellKind::triangle)
    throw Error(fmt::format("{}: a mesh of {}; accepted: triangles", who, mesh.reference().plural));
}

int find_floating_component(const Mesh& mesh, const std::function<bool(int edge)>& held) {
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
    for (int i = 0; i < mesh.reference().facets; ++i)
      for (int side = 0; side < 2; ++side)
        reach(mesh.edge_triangles(mesh.triangle_edges(t, i), side));
  }
  const auto loose = std::find(reached.begin(), reached.end(), 0);
  return loose != reached.end() ? static_cast<int>(loose - reached.begin()) : -1;
}

namespace {

/// Sorts the two or three vertices of a facet.
template <std::size_t count>
void sort_few(std::array<int, count>& corner) {
  for (std::size_t i = 0; i + 1 < count; ++i)
    for (std::size_t j = count - 1; j > i; --j)
      if (corner[j] < corner[j - 1]) std::swap(corner[j], corner[j - 1]);
}

/// Numbers the edges or the facets of the cells: those with the same k vertices have one number.
/// Row i of `local` has the vertices of entity i in its cell. `vertices` receives the k vertices of
/// each entity, ascending, and `numbers` (T x rows) the entities of each cell. act(e, t, is_new) is
/// called for each entity e of each cell t.
template <CellKind kind, int k, int rows, class Local, class Act>
void number_entities(const Mesh& mesh, const Local& local, IndexRows& vertices, int* numbers,
                     Act&& act) {
  constexpr int n = reference_cell(kind).vertices;
  const int cell_count = mesh.triangle_count();
  vertices.resize(static_cast<Eigen::Index>(rows) * cell_count, k);
  const int* const corners = mesh.triangles.data();
  int* const known = vertices.data();
  // a chain of entities per vertex, those whose smallest vertex it is: each holds a handful, so
  // that the search is linear
  std::vector<int> last(mesh.vertex_count(), -1), before;
  for (int t = 0; t < cell_count; ++t)
    for (int i = 0; i < rows; ++i) {
      std::array<int, k> corner;
      for (int j = 0; j < k; ++j) corner[j] = corners[n * t + local[i][j]];
      sort_few(corner);
      int e = last[corner[0]];
      while (e >= 0 && !std::equal(corner.begin() + 1, corner.end(), known + k * e + 1))
        e = before[e];
      const bool is_new = e < 0;
      if (is_new) {
        e = static_cast<int>(before.size());
        before.push_back(std::exchange(last[corner[0]], e));
        std::copy(corner.begin(), corner.end(), known + k * e);
      }
      numbers[rows * t + i] = e;
      act(e, t, is_new);
    }
  vertices.conservativeResize(static_cast<Eigen::Index>(before.size()), k);
}

template <CellKind kind>
void number_facets(Mesh& mesh, const std::string& where) {
  constexpr const ReferenceCell& cell = reference_cell(kind);
  mesh.triangle_edges.resize(mesh.triangle_count(), cell.facets);
  mesh.edge_triangles.resize(static_cast<Eigen::Index>(cell.facets) * mesh.triangle_count(), 2);
  number_entities<kind, cell.dimension, cell.facets>(
      mesh, cell.facet, mesh.edges, mesh.triangle_edges.data(), [&](int e, int t, bool is_new) {
        if (is_new)
          mesh.edge_triangles.row(e) << t, -1;
        else if (mesh.edge_triangles(e, 1) == -1)
          mesh.edge_triangles(e, 1) = t;
        else
          refuse(where, "three {} share the {}; accepted: two at most", cell.plural,
                 facet_text(mesh, e));
      });
  mesh.edge_triangles.conservativeResize(mesh.edges.rows(), 2);
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a(0) * b(1) - b(0) * a(1);
}

}  // namespace

void number_edges(Mesh& mesh, const std::string& where) {
  with_kind(mesh.kind, [&]<CellKind kind>() { number_facets<kind>(mesh, where); });
  mesh.edge_tag.assign(mesh.edge_count(), EdgeTag::interior);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int other = mesh.edge_triangles(e, 1);
    if (other >= 0 && mesh.region[mesh.edge_triangles(e, 0)] != mesh.region[other])
      mesh.edge_tag[e] = EdgeTag::sigma;
  }
}

CellEdges cell_edges(const Mesh& mesh) {
  if (mesh.kind != CellKind::tetrahedron)
    throw Error("edges of cells: a mesh in the plane; accepted: tetrahedra");
  constexpr const ReferenceCell& cell = reference_cell(CellKind::tetrahedron);
  IndexRows ends;
  CellEdges edges;
  edges.of_cell.resize(mesh.triangle_count(), cell.edges);
  number_entities<CellKind::tetrahedron, 2, cell.edges>(mesh, cell.edge, ends, edges.of_cell.data(),
                                                        [](int, int, bool) {});
  edges.count = static_cast<int>(ends.rows());
  return edges;
}

double Mesh::twice_area(int t) const {
  require_triangles(*this, "area");
  const auto x = places<2, 3>(*this, triangles.data() + 3 * t);
  return (x(0, 1) - x(0, 0)) * (x(1, 2) - x(1, 0)) - (x(0, 2) - x(0, 0)) * (x(1, 1) - x(1, 0));
}

double Mesh::measure(int t) const {
  if (kind == CellKind::triangle) return area(t);
  if (kind == CellKind::quadrilateral) {
    const auto x = places<2, 4>(*this, triangles.data() + 4 * t);
    return 0.5 * cross(x.col(2) - x.col(0), x.col(3) - x.col(1));  // of the diagonals
  }
  const auto x = places<3, 4>(*this, triangles.data() + 4 * t);
  const Eigen::Vector3d along = x.col(1) - x.col(0);
  return along.dot((x.col(2) - x.col(0)).cross(x.col(3) - x.col(0))) / 6;
}

double Mesh::facet_measure(int e) const {
  if (dimension() == 2) return edge_length(e);
  const auto x = places<3, 3>(*this, edges.data() + 3 * e);
  return 0.5 * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm();
}

double Mesh::edge_length(int e) const {
  if (dimension() == 3) require_triangles(*this, "length of an edge");
  return (vertices.row(edges(e, 0)) - vertices.row(edges(e, 1))).norm();
}

std::string Mesh::location_text(int vertex) const {
  std::vector<std::string> coordinates;
  for (const double x : vertices.row(vertex)) coordinates.push_back(fmt::format("{:.6g}", x));
  return fmt::format("({})", fmt::join(coordinates, ", "));
}

int local_edge(const Mesh& mesh, int cell, int edge) {
  const auto facets = mesh.triangle_edges.row(cell);
  for (int i = 0; i < mesh.reference().facets; ++i)
    if (facets(i) == edge) return i;
  throw Error(fmt::format("{} {} has the {}s {}; {} is none of them", mesh.reference().name, cell,
                          facet_name(mesh), fmt::join(facets, ", "), edge));
}

double body_size(const Mesh& mesh) {
  const auto in_body = [&](int t) { return mesh.region[t] == Region::body; };
  bool any = false;
  for (int t = 0; t < mesh.triangle_count() && !any; ++t) any = in_body(t);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  using Corner = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 3>;
  Corner low = Corner::Constant(mesh.dimension(), infinity);
  Corner high = -low;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (any && !in_body(t)) continue;
    for (const int v : mesh.triangles.row(t)) {
      low = low.cwiseMin(mesh.vertices.row(v));
      high = high.cwiseMax(mesh.vertices.row(v));
    }
  }
  return (high - low).maxCoeff();
}

double Mesh::diameter() const {
  double longest = 0;
  for (int e = 0; e < edge_count(); ++e)
    for (int i = 0; i < dimension(); ++i)
      for (int j = i + 1; j < dimension(); ++j)
        longest = std::max(longest, (vertices.row(edges(e, i)) - vertices.row(edges(e, j))).norm());
  return longest;
}

Mesh make_mesh(Points vertices, IndexRows cells, std::vector<Region> region,
               const std::vector<TaggedEdge>& tagged_edges, const std::string& where,
               const std::vector<int>& surface) {
  Mesh mesh;
  mesh.kind = kind_of_cells(vertices.cols(), cells.cols(), where);
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(cells);
  mesh.region = std::move(region);
  check_indices(mesh, tagged_edges, where);
  if (!surface.empty() && (surface.size() != mesh.region.size() ||
                           *std::min_element(surface.begin(), surface.end()) < 0))
    refuse(where, "{} numbers of {}s; accepted: none, or one per {}, from 0 on", surface.size(),
           mesh.dimension() == 2 ? "surface" : "volume", mesh.reference().name);
  check_vertices(mesh, where);
  check_places(mesh, tagged_edges, where);
  check_cells(mesh, where);
  orient(mesh, surface.empty() ? surfaces_of(mesh.region) : surface, where);
  if (std::find(mesh.region.begin(), mesh.region.end(), Region::body) == mesh.region.end())
    refuse<MeshError>(where, "no {} is in the group body, which is needed", mesh.reference().name);
  number_edges(mesh, where);
  tag_edges(mesh, tagged_edges, where);
  check_overlap(mesh, where);
  check_boundary(mesh, where);
  check_held(mesh, where);
  return mesh;
}

Mesh tag_by_position(Points vertices, IndexRows cells, CellKind kind) {
  Mesh mesh;
  mesh.kind = kind;
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(cells);
  const auto height = mesh.vertices.col(mesh.vertical());
  for (const auto corners : mesh.triangles.rowwise())
    mesh.region.push_back(height(corners).sum() > 0 ? Region::body : Region::layer);
  number_edges(mesh, "mesh");
  const double lowest = height.minCoeff();
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0)
      mesh.edge_tag[e] =
          (height(mesh.edges.row(e)).array() == lowest).all() ? EdgeTag::contact : EdgeTag::clamped;
  return mesh;
}

}  // namespace antilock
