#include "antilock/mesh/labelled_edges.hpp"

#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

int physical_number(EdgeTag tag) {
  switch (tag.kind) {
    case EdgeTag::Kind::interior:
      return 0;
    case EdgeTag::Kind::sigma:
      return 3;
    case EdgeTag::Kind::clamped:
      return 4;
    case EdgeTag::Kind::contact:
      return 5;
    case EdgeTag::Kind::free:
      return 6;
    case EdgeTag::Kind::natural:
      return (tag.group < 990 ? 10 : 1000) + tag.group;
    case EdgeTag::Kind::dirichlet:
      return 1000 + tag.group;
  }
  return 0;
}

std::vector<Labelled> labelled_edges(const TriangleMesh& mesh) {
  const ReferenceCell& cell = mesh.reference();
  std::vector<Labelled> labelled;
  for (int edge = 0; edge < mesh.edge_count(); ++edge) {
    if (mesh.edge_tag[edge] == EdgeTag::interior) continue;
    const int t = mesh.edge_triangles(edge, 0);
    const int i = local_edge(mesh, t, edge);
    Labelled facet{{-1, -1, -1}, physical_number(mesh.edge_tag[edge])};
    for (int k = 0; k < cell.dimension; ++k)
      facet.vertices[k] = mesh.triangles(t, cell.facet[i][k]);
    labelled.push_back(facet);
  }
  return labelled;
}

}  // namespace antilock
