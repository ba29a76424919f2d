#include "antilock/mesh/labelled_edges.hpp"

#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

std::vector<Labelled> labelled_edges(const TriangleMesh& mesh) {
  std::vector<Labelled> labelled;
  for (int edge = 0; edge < mesh.edge_count(); ++edge) {
    if (mesh.edge_tag[edge] == EdgeTag::interior) continue;
    const int triangle = mesh.edge_triangles(edge, 0);
    for (int i = 0; i < 3; ++i)  // edge i runs from vertex i+1 to vertex i+2
      if (mesh.triangle_edges(triangle, i) == edge)
        labelled.push_back({mesh.triangles(triangle, (i + 1) % 3), mesh.triangles(triangle, (i + 2) % 3),
                            static_cast<int>(mesh.edge_tag[edge])});
  }
  return labelled;
}

}  // namespace antilock
