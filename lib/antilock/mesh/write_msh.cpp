#include "antilock/mesh/write_msh.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/text.hpp"
#include "antilock/mesh/labelled_edges.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {
namespace {

/// A physical group of curves (dimension 1), surfaces (2) or volumes (3).
struct Group {
  int dimension, number;
  std::string name;
};

/// The groups that the mesh has elements of, those of `named` last.
std::vector<Group> groups_of(const TriangleMesh& mesh,
                             const std::vector<BoundaryCondition>& named) {
  std::vector<Group> groups;
  const auto has = [](const auto& all, auto tag) {
    return std::find(all.begin(), all.end(), tag) != all.end();
  };
  const int d = mesh.dimension();
  const auto add_facets = [&](EdgeTag tag, const std::string& name) {
    if (has(mesh.edge_tag, tag)) groups.push_back({d - 1, physical_number(tag), name});
  };
  const auto add_cells = [&](Region region, const std::string& name) {
    if (has(mesh.region, region)) groups.push_back({d, static_cast<int>(region), name});
  };
  add_facets(EdgeTag::sigma, "sigma");
  add_facets(EdgeTag::clamped, "clamped");
  add_facets(EdgeTag::contact, "contact");
  add_facets(EdgeTag::free, "free");
  add_cells(Region::body, "body");
  add_cells(Region::layer, "layer");
  for (int k = 0; k < static_cast<int>(named.size()); ++k)
    for (const EdgeTag tag : {natural_group(k), dirichlet_group(k)})
      add_facets(tag, named[k].group);
  return groups;
}

}  // namespace

void write_msh(const std::filesystem::path& path, const TriangleMesh& mesh,
               const std::vector<BoundaryCondition>& named) {
  if (mesh.kind == CellKind::quadrilateral)
    throw Error(path.string() + ": a mesh of quadrilaterals; accepted: triangles and tetrahedra");
  const int d = mesh.dimension();
  const auto edges = labelled_edges(mesh);
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    text.print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    const std::vector<Group> groups = groups_of(mesh, named);
    text.print("$PhysicalNames\n{}\n", groups.size());
    for (const Group& group : groups)
      text.print("{} {} \"{}\"\n", group.dimension, group.number, group.name);
    text.print("$EndPhysicalNames\n$Nodes\n{}\n", mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      text.print(FMT_COMPILE("{} {} {} "), v + 1, mesh.vertices(v, 0), mesh.vertices(v, 1));
      if (d == 3)
        text.print(FMT_COMPILE("{}\n"), mesh.vertices(v, 2));
      else
        text.print("0\n");
    }
    // number type tags(2) group entity vertices; the entity repeats the group
    text.print("$EndNodes\n$Elements\n{}\n", edges.size() + mesh.region.size());
    std::size_t number = 0;
    const auto print_element = [&](int type, int group, const int* vertices, int count) {
      text.print(FMT_COMPILE("{} {} 2 {} {}"), ++number, type, group, group);
      for (int i = 0; i < count; ++i) text.print(FMT_COMPILE(" {}"), vertices[i] + 1);
      text.print("\n");
    };
    constexpr int line = 1, triangle = 2, tetrahedron = 4;  // gmsh's types
    for (const auto& [vertices, label] : edges)
      print_element(d == 2 ? line : triangle, label, vertices.data(), d);
    for (int t = 0; t < mesh.triangle_count(); ++t)
      print_element(d == 2 ? triangle : tetrahedron, static_cast<int>(mesh.region[t]),
                    mesh.triangles.data() + static_cast<std::ptrdiff_t>(d + 1) * t, d + 1);
    text.print("$EndElements\n");
  });
}

}  // namespace antilock
