#include "antilock/mesh/detail/edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "antilock/core/error.hpp"

namespace antilock {

void number_edges(TriangleMesh& mesh, const std::string& where) {
  const int triangle_count = mesh.triangle_count();
  mesh.triangle_edges.resize(triangle_count, 3);
  mesh.edges.resize(3 * static_cast<Eigen::Index>(triangle_count), 2);
  mesh.edge_triangles.resize(3 * static_cast<Eigen::Index>(triangle_count), 2);
  // a chain of edges per vertex, those whose smaller vertex it is: each holds a handful, so that the search is linear
  std::vector<int> last(mesh.vertex_count(), -1), before;
  for (int t = 0; t < triangle_count; ++t)
    for (int i = 0; i < 3; ++i) {
      const auto [from, to] = std::minmax(mesh.triangles(t, (i + 1) % 3), mesh.triangles(t, (i + 2) % 3));
      int e = last[from];
      while (e >= 0 && mesh.edges(e, 1) != to) e = before[e];
      if (e < 0) {
        e = static_cast<int>(before.size());
        before.push_back(std::exchange(last[from], e));
        mesh.edges.row(e) << from, to;
        mesh.edge_triangles.row(e) << t, -1;
      } else {
        if (mesh.edge_triangles(e, 1) != -1)
          throw Error(fmt::format("{}: three triangles share the edge from {} to {}; accepted: two at most", where,
                                  mesh.place(from), mesh.place(to)));
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
