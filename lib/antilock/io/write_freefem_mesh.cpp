#include "antilock/io/write_freefem_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/text.hpp"
#include "antilock/mesh/labelled_edges.hpp"
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {
namespace {

/// Medit's format, which FreeFEM's readmesh3 reads. Each section begins with a keyword and the
/// number of its lines.
void write_medit(const std::filesystem::path& path, const Mesh& mesh) {
  const auto faces = labelled_edges(mesh);
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    text.print("MeshVersionFormatted 2\nDimension 3\nVertices\n{}\n", mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v)
      text.print(FMT_COMPILE("{} {} {} 0\n"), mesh.vertices(v, 0), mesh.vertices(v, 1),
                 mesh.vertices(v, 2));
    text.print("Tetrahedra\n{}\n", mesh.triangle_count());
    for (int t = 0; t < mesh.triangle_count(); ++t)
      text.print(FMT_COMPILE("{} {} {} {} {}\n"), mesh.triangles(t, 0) + 1,
                 mesh.triangles(t, 1) + 1, mesh.triangles(t, 2) + 1, mesh.triangles(t, 3) + 1,
                 static_cast<int>(mesh.region[t]));
    text.print("Triangles\n{}\n", faces.size());
    for (const auto& [corners, label] : faces)
      text.print("{} {} {} {}\n", corners[0] + 1, corners[1] + 1, corners[2] + 1, label);
    text.print("End\n");
  });
}

}  // namespace

void write_freefem_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  if (mesh.kind == CellKind::tetrahedron) return write_medit(path, mesh);
  if (mesh.kind != CellKind::triangle)
    throw Error(fmt::format("{}: a mesh of {}; accepted: triangles or tetrahedra", path.string(),
                            mesh.reference().plural));
  const auto edges = labelled_edges(mesh);
  std::vector<int> vertex_label(mesh.vertex_count(),
                                0);  // a corner takes the larger of its two labels; none reads it
  for (const auto& [ends, label] : edges)
    for (const int v : {ends[0], ends[1]}) vertex_label[v] = std::max(vertex_label[v], label);
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    text.print("{} {} {}\n", mesh.vertex_count(), mesh.triangle_count(), edges.size());
    for (int v = 0; v < mesh.vertex_count(); ++v)
      text.print(FMT_COMPILE("{} {} {}\n"), mesh.vertices(v, 0), mesh.vertices(v, 1),
                 vertex_label[v]);
    for (int t = 0; t < mesh.triangle_count(); ++t)
      text.print(FMT_COMPILE("{} {} {} {}\n"), mesh.triangles(t, 0) + 1, mesh.triangles(t, 1) + 1,
                 mesh.triangles(t, 2) + 1, static_cast<int>(mesh.region[t]));
    for (const auto& [ends, label] : edges)
      text.print("{} {} {}\n", ends[0] + 1, ends[1] + 1, label);
  });
}

}  // namespace antilock
