#include "antilock/mesh/detail/edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "antilock/core/error.hpp"

namespace antilock {

void number_edges(TriangleMesh& mesh, const std::string& where) {
  const int triangle_count = mesh.triangle_count();
  const auto ends = [&](int t, int i) {
    return std::minmax(mesh.triangles(t, (i + 1) % 3), mesh.triangles(t, (i + 2) % 3));
  };
  // Half-edges in buckets by their smaller vertex: each bucket holds a handful, so that matching the halves is linear.
  std::vector<int> start(mesh.vertex_count() + 1, 0);
  for (int t = 0; t < triangle_count; ++t)
    for (int i = 0; i < 3; ++i) ++start[ends(t, i).first + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
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

TriangleMesh placed_mesh(Points vertices, Triples triangles) {
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
      mesh.edge_tag[e] = (y(mesh.edges.row(e)).array() == lowest).all() ? EdgeTag::contact : EdgeTag::clamped;
  return mesh;
}

}  // namespace antilock
