// The mesh as MSH 2.2 (gmsh and this library's reader) and in FreeFEM's own format, with one numbering.
#include <algorithm>
#include <array>

#include "antilock/core/detail/atomic_file.hpp"
#include "antilock/core/detail/text.hpp"
#include "antilock/io/writers.hpp"

namespace antilock {
namespace {

/// An edge that carries a group, its vertices in the order of its first triangle: the domain lies on the left of a
/// boundary edge.
struct Labelled {
  int from, to, label;
};

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

struct Group {
  int dimension, number;
  const char* name;
};
constexpr std::array groups = {
    Group{1, static_cast<int>(EdgeTag::sigma), "sigma"},     Group{1, static_cast<int>(EdgeTag::clamped), "clamped"},
    Group{1, static_cast<int>(EdgeTag::contact), "contact"}, Group{1, static_cast<int>(EdgeTag::free), "free"},
    Group{2, static_cast<int>(Region::body), "body"},        Group{2, static_cast<int>(Region::layer), "layer"}};

/// The groups that the mesh has elements of.
std::vector<Group> groups_present(const TriangleMesh& mesh, const std::vector<Labelled>& edges) {
  std::vector<Group> present;
  for (const Group& group : groups) {
    const bool on_edges = std::any_of(edges.begin(), edges.end(), [&](const Labelled& edge) {
      return group.dimension == 1 && edge.label == group.number;
    });
    const bool on_triangles = std::any_of(mesh.region.begin(), mesh.region.end(), [&](Region region) {
      return group.dimension == 2 && static_cast<int>(region) == group.number;
    });
    if (on_edges || on_triangles) present.push_back(group);
  }
  return present;
}

}  // namespace

void write_msh(const std::filesystem::path& path, const TriangleMesh& mesh, const std::vector<EdgeCondition>& named) {
  const auto edges = labelled_edges(mesh);
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    text.print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    auto names = groups_present(mesh, edges);
    for (int k = 0; k < static_cast<int>(named.size()); ++k)
      for (const EdgeTag tag : {natural_group(k), held_group(k)})
        if (std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), tag) > 0)
          names.push_back({1, static_cast<int>(tag), named[k].group.c_str()});
    text.print("$PhysicalNames\n{}\n", names.size());
    for (const Group& group : names) text.print("{} {} \"{}\"\n", group.dimension, group.number, group.name);
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
      text.print(FMT_COMPILE("{} 2 2 {} {} {} {} {}\n"), ++number, group, group, mesh.triangles(t, 0) + 1,
                 mesh.triangles(t, 1) + 1, mesh.triangles(t, 2) + 1);
    }
    text.print("$EndElements\n");
  });
}

void write_freefem_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const auto edges = labelled_edges(mesh);
  std::vector<int> vertex_label(mesh.vertex_count(), 0);  // a corner takes the larger of its two labels; none reads it
  for (const auto& [from, to, label] : edges)
    for (const int v : {from, to}) vertex_label[v] = std::max(vertex_label[v], label);
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    text.print("{} {} {}\n", mesh.vertex_count(), mesh.triangle_count(), edges.size());
    for (int v = 0; v < mesh.vertex_count(); ++v)
      text.print(FMT_COMPILE("{} {} {}\n"), mesh.vertices(v, 0), mesh.vertices(v, 1), vertex_label[v]);
    for (int t = 0; t < mesh.triangle_count(); ++t)
      text.print(FMT_COMPILE("{} {} {} {}\n"), mesh.triangles(t, 0) + 1, mesh.triangles(t, 1) + 1,
                 mesh.triangles(t, 2) + 1, static_cast<int>(mesh.region[t]));
    for (const auto& [from, to, label] : edges) text.print("{} {} {}\n", from + 1, to + 1, label);
  });
}

}  // namespace antilock
