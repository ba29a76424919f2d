#include "antilock/mesh/detail/edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "antilock/core/error.hpp"

namespace antilock {
void number_edges(TriangleMesh& mesh, const std::string& where) {
  const int triangle_count = mesh.triangle_count();
  // Half-edges in buckets by their smaller vertex: each bucket holds a handful, so that matching the halves is linear.
  std::vector<int> start(mesh.vertex_count() + 1, 0);
  const auto ends = [&](int t, int i) {
    return std::minmax(mesh.triangles(t, (i + 1) % 3), mesh.triangles(t, (i + 2) % 3));
  };
  for (int t = 0; t < triangle_count; ++t)
    for (int i = 0; i < 3; ++i) ++start[std::min(mesh.triangles(t, (i + 1) % 3), mesh.triangles(t, (i + 2) % 3)) + 1];
  for (int v = 0; v < mesh.vertex_count(); ++v) start[v + 1] += start[v];
  struct Edge {
    int to, id;
  };
  std::vector<Edge> bucket(3 * static_cast<std::size_t>(triangle_count));
  std::vector<int> filled(mesh.vertex_count(), 0);

  mesh.triangle_edges.resize(triangle_count, 3);
  mesh.edges.resize(3 * static_cast<Eigen::Index>(triangle_count), 2);
  mesh.edge_triangles.resize(3 * static_cast<Eigen::Index>(triangle_count), 2);
  int count = 0;
  for (int t = 0; t < triangle_count; ++t)
    for (int i = 0; i < 3; ++i) {
      const auto [from, to] = ends(t, i);
      Edge* const first = bucket.data() + start[from];
      Edge* const last = first + filled[from];
      Edge* const found = std::find_if(first, last, [to = to](const Edge& e) { return e.to == to; });
      if (found == last) {
        *last = {to, count};
        ++filled[from];
        mesh.edges.row(count) << from, to;
        mesh.edge_triangles.row(count) << t, -1;
        mesh.triangle_edges(t, i) = count++;
      } else {
        if (mesh.edge_triangles(found->id, 1) != -1)
          throw Error(fmt::format("{}: three triangles share the edge from {} to {}; accepted: two at most", where,
                                  mesh.place(from), mesh.place(to)));
        mesh.edge_triangles(found->id, 1) = t;
        mesh.triangle_edges(t, i) = found->id;
      }
    }
  mesh.edges.conservativeResize(count, 2);
  mesh.edge_triangles.conservativeResize(count, 2);
  mesh.edge_tag.assign(count, EdgeTag::interior);
  for (int e = 0; e < count; ++e) {
    const int other = mesh.edge_triangles(e, 1);
    if (other >= 0 && mesh.region[mesh.edge_triangles(e, 0)] != mesh.region[other]) mesh.edge_tag[e] = EdgeTag::sigma;
  }
}

void tag_edges(TriangleMesh& mesh, const std::vector<TaggedEdge>& tagged_edges, const std::string& where) {
  // Tags sit on the boundary and on Sigma: only those edges need to be found.
  const auto key = [](int from, int to) {
    const auto [low, high] = std::minmax(from, to);
    return (static_cast<std::uint64_t>(low) << 32U) | static_cast<std::uint64_t>(high);
  };
  std::unordered_map<std::uint64_t, int> known;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0 || mesh.edge_tag[e] == EdgeTag::sigma)
      known[key(mesh.edges(e, 0), mesh.edges(e, 1))] = e;
  for (const TaggedEdge& tagged : tagged_edges) {
    const auto found = known.find(key(tagged.from, tagged.to));
    const bool on_sigma = found != known.end() && mesh.edge_triangles(found->second, 1) >= 0;
    if (found == known.end() || on_sigma != (tagged.tag == EdgeTag::sigma))
      throw Error(fmt::format(
          "{}: the tagged edge from {} to {} is dangling or misplaced; accepted: clamped and contact on the "
          "boundary, sigma between body and layer",
          where, mesh.place(tagged.from), mesh.place(tagged.to)));
    EdgeTag& tag = mesh.edge_tag[found->second];
    if (tag != EdgeTag::interior && tag != tagged.tag)
      throw Error(fmt::format("{}: the edge from {} to {} is in two groups; accepted: one of clamped, contact", where,
                              mesh.place(tagged.from), mesh.place(tagged.to)));
    tag = tagged.tag;
  }
}

}  // namespace antilock
