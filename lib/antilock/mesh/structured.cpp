// Figure 3: squares cut by a diagonal. Two loops, so written out: gmsh's transfinite meshes give the same triangles (a
// test holds the two together) but take seconds where this takes milliseconds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/mesh/edges.hpp"
#include "antilock/mesh/generate.hpp"

namespace antilock {

void check_mesh_request(int cells, int most, const Domain& domain) {
  if (cells < 1 || cells > most)
    throw Error(fmt::format("mesh: cells = {} is out of range; accepted 1 to {}", cells, most));
  if (!(domain.layer_depth >= 0 && domain.layer_depth <= 1))
    throw Error(fmt::format("mesh: layer depth {} is out of range; accepted 0 to 1", domain.layer_depth));
}

TriangleMesh structured_mesh(int cells, const Domain& domain, Diagonal diagonal) {
  check_mesh_request(cells, 2048, domain);
  const double depth = domain.layer_depth;
  const int layer_rows = depth > 0 ? std::max(2, static_cast<int>(std::lround(depth * cells))) : 0;
  const int rows = layer_rows + cells;
  TriangleMesh mesh;
  mesh.vertices.resize(static_cast<Eigen::Index>(rows + 1) * (cells + 1), 2);
  for (int j = 0; j <= rows; ++j) {
    const double y =
        j < layer_rows ? -depth * (layer_rows - j) / layer_rows : static_cast<double>(j - layer_rows) / cells;
    for (int i = 0; i <= cells; ++i) mesh.vertices.row(j * (cells + 1) + i) << static_cast<double>(i) / cells, y;
  }
  const bool crossed = diagonal == Diagonal::crossed;
  const int corners = mesh.vertex_count();
  if (crossed) mesh.vertices.conservativeResize(corners + static_cast<Eigen::Index>(rows) * cells, 2);
  mesh.triangles.resize(static_cast<Eigen::Index>(crossed ? 4 : 2) * rows * cells, 3);
  mesh.region.resize(mesh.triangles.rows());
  int t = 0;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < cells; ++i) {
      const int low = j * (cells + 1) + i, up = low + cells + 1;  // lower left and upper left corner
      const Region region = j < layer_rows ? Region::layer : Region::body;
      std::fill_n(mesh.region.begin() + t, crossed ? 4 : 2, region);
      if (crossed) {
        const int centre = corners + j * cells + i;
        mesh.vertices.row(centre) = 0.5 * (mesh.vertices.row(low) + mesh.vertices.row(up + 1));
        mesh.triangles.row(t++) << low, low + 1, centre;
        mesh.triangles.row(t++) << low + 1, up + 1, centre;
        mesh.triangles.row(t++) << up + 1, up, centre;
        mesh.triangles.row(t++) << up, low, centre;
      } else if (diagonal == Diagonal::right) {
        mesh.triangles.row(t++) << low, low + 1, up + 1;
        mesh.triangles.row(t++) << low, up + 1, up;
      } else {
        mesh.triangles.row(t++) << low, low + 1, up;
        mesh.triangles.row(t++) << low + 1, up + 1, up;
      }
    }
  number_edges(mesh, "structured mesh");
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_triangles(e, 1) >= 0) continue;
    const bool bottom = mesh.edges(e, 0) <= cells && mesh.edges(e, 1) <= cells;
    mesh.edge_tag[e] = bottom ? EdgeTag::contact : EdgeTag::clamped;
  }
  return mesh;
}

}  // namespace antilock
