#include "antilock/analysis/layer_components.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace antilock {
namespace {

/// A generator places the points of a vertical line to about 1e-12 of the size of the body.
/// Vertices that are moved on purpose are moved farther.
constexpr double slack = 1e-9;

/// Sets of cells. Each has a leader, one of its cells.
class DisjointSets {
 public:
  explicit DisjointSets(int cells) : leader_(cells) {
    std::iota(leader_.begin(), leader_.end(), 0);
  }
  int find(int t) {
    while (leader_[t] != t) t = leader_[t] = leader_[leader_[t]];
    return t;
  }
  void join(int a, int b) { leader_[find(a)] = find(b); }

 private:
  std::vector<int> leader_;
};

bool in_layer(const Mesh& mesh, int t) { return t >= 0 && mesh.region[t] == Region::layer; }

/// Whether a facet lies between two cells of the layer.
bool is_inner(const Mesh& mesh, int e) {
  return in_layer(mesh, mesh.edge_triangles(e, 0)) && in_layer(mesh, mesh.edge_triangles(e, 1));
}

int count_sets(const Mesh& mesh, DisjointSets& sets) {
  int count = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (in_layer(mesh, t) && sets.find(t) == t) ++count;
  return count;
}

/// The place (x, y) of a vertex in space.
Eigen::Vector2d seen_from_above(const Mesh& mesh, int v) {
  return {mesh.vertices(v, 0), mesh.vertices(v, 1)};
}

/// The edges from the first vertex of a face to the other two, seen from above (a column each).
Eigen::Matrix2d projected_edges(const Mesh& mesh, int face) {
  const Eigen::Vector2d corner = seen_from_above(mesh, mesh.edges(face, 0));
  Eigen::Matrix2d along;
  for (int k = 0; k < 2; ++k)
    along.col(k) = seen_from_above(mesh, mesh.edges(face, k + 1)) - corner;
  return along;
}

bool is_vertical(const Mesh& mesh, int face, double size) {
  const Eigen::Matrix2d along = projected_edges(mesh, face);
  const double longest =
      std::max({along.col(0).norm(), along.col(1).norm(), (along.col(1) - along.col(0)).norm()});
  return std::abs(along.determinant()) <= slack * size * longest;
}

/// Whether all vertices of a cell lie below a face.
bool is_below(const Mesh& mesh, int t, int face) {
  const Eigen::Matrix2d to_barycentric = projected_edges(mesh, face).inverse();
  const Eigen::Vector2d corner = seen_from_above(mesh, mesh.edges(face, 0));
  for (const int v : mesh.triangles.row(t)) {
    const Eigen::Vector2d lambda = to_barycentric * (seen_from_above(mesh, v) - corner);
    // a vertical face has no barycentric coordinates, which the negation refuses
    if (!(std::min({lambda(0), lambda(1), 1 - lambda.sum()}) >= -slack)) return false;
  }
  return true;
}

/// Whether each component lies below the face of Sigma that it has.
bool is_aligned_in_space(const Mesh& mesh, DisjointSets& sets) {
  std::vector<int> face_above(mesh.triangle_count(), -1);  // by the leader
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::sigma) continue;
    const int first = mesh.edge_triangles(e, 0);
    const int below = in_layer(mesh, first) ? first : mesh.edge_triangles(e, 1);
    int& above = face_above[sets.find(below)];
    if (above >= 0) return false;
    above = e;
  }
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (!in_layer(mesh, t)) continue;
    const int above = face_above[sets.find(t)];
    if (above < 0 || !is_below(mesh, t, above)) return false;
  }
  return true;
}

LayerComponents components_in_space(const Mesh& mesh) {
  const double size = body_size(mesh);
  DisjointSets sets(mesh.triangle_count());
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (is_inner(mesh, e) && !is_vertical(mesh, e, size))
      sets.join(mesh.edge_triangles(e, 0), mesh.edge_triangles(e, 1));
  return {count_sets(mesh, sets), is_aligned_in_space(mesh, sets)};
}

}  // namespace

LayerComponents layer_components(const Mesh& mesh) {
  if (mesh.kind == CellKind::tetrahedron) return components_in_space(mesh);
  require_triangles(mesh, "components of the layer");
  const auto x = [&](int v) { return mesh.vertices(v, 0); };
  DisjointSets sets(mesh.triangle_count());
  const double vertical = slack * body_size(mesh);
  int edges = 0;
  double length = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] == EdgeTag::sigma) {
      ++edges;
      length += mesh.edge_length(e);
    }
    if (is_inner(mesh, e) && std::abs(x(mesh.edges(e, 0)) - x(mesh.edges(e, 1))) > vertical)
      sets.join(mesh.edge_triangles(e, 0), mesh.edge_triangles(e, 1));
  }
  LayerComponents components;
  components.count = count_sets(mesh, sets);
  if (components.count != edges) return components;
  Eigen::ArrayXd from = Eigen::ArrayXd::Constant(mesh.triangle_count(),
                                                 std::numeric_limits<double>::infinity()),
                 to = -from;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3 && mesh.region[t] == Region::layer; ++i) {
      const int set = sets.find(t);
      from(set) = std::min(from(set), x(mesh.triangles(t, i)));
      to(set) = std::max(to(set), x(mesh.triangles(t, i)));
    }
  components.is_aligned = (to - from).max(0).sum() <= length * (1 + slack);
  return components;
}

}  // namespace antilock
