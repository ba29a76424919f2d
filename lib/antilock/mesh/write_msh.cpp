#include "antilock/mesh/write_msh.hpp"

#include <algorithm>
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

/// A physical group of curves (dimension 1) or surfaces (2).
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
  const auto add_curves = [&](EdgeTag tag, const std::string& name) {
    if (has(mesh.edge_tag, tag)) groups.push_back({1, physical_number(tag), name});
  };
  const auto add_surfaces = [&](Region region, const std::string& name) {
    if (has(mesh.region, region)) groups.push_back({2, static_cast<int>(region), name});
  };
  add_curves(EdgeTag::sigma, "sigma");
  add_curves(EdgeTag::clamped, "clamped");
  add_curves(EdgeTag::contact, "contact");
  add_curves(EdgeTag::free, "free");
  add_surfaces(Region::body, "body");
  add_surfaces(Region::layer, "layer");
  for (int k = 0; k < static_cast<int>(named.size()); ++k)
    for (const EdgeTag tag : {natural_group(k), dirichlet_group(k)})
      add_curves(tag, named[k].group);
  return groups;
}

}  // namespace

void write_msh(const std::filesystem::path& path, const TriangleMesh& mesh,
               const std::vector<BoundaryCondition>& named) {
  const auto edges = labelled_edges(mesh);
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    text.print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    const std::vector<Group> groups = groups_of(mesh, named);
    text.print("$PhysicalNames\n{}\n", groups.size());
    for (const Group& group : groups)
      text.print("{} {} \"{}\"\n", group.dimension, group.number, group.name);
    text.print("$EndPhysicalNames\n$Nodes\n{}\n", mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v)
      text.print(FMT_COMPILE("{} {} {} 0\n"), v + 1, mesh.vertices(v, 0), mesh.vertices(v, 1));
    // number type tags(2) group entity vertices; the entity repeats the group
    text.print("$EndNodes\n$Elements\n{}\n", edges.size() + mesh.region.size());
    std::size_t number = 0;
    for (const auto& [from, to, label] : edges)
      text.print(FMT_COMPILE("{} 1 2 {} {} {} {}\n"), ++number, label, label, from + 1, to + 1);
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      const int group = static_cast<int>(mesh.region[t]);
      text.print(FMT_COMPILE("{} 2 2 {} {} {} {} {}\n"), ++number, group, group,
                 mesh.triangles(t, 0) + 1, mesh.triangles(t, 1) + 1, mesh.triangles(t, 2) + 1);
    }
    text.print("$EndElements\n");
  });
}

}  // namespace antilock
