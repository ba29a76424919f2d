// The unstructured meshes of the live figures, for a page that has no gmsh: per mesh the numbers cells, layer (0 or 1),
// vertices, triangles, then x and y per vertex (doubles), three vertices per triangle (16 bits each).
// Run: live_meshes FILE
#include <fmt/format.h>

#include <cstdint>
#include <fstream>

#include "antilock/mesh/generate.hpp"

using namespace antilock;

namespace {

template <class Number>
void write(std::ostream& out, Number number) {
  out.write(reinterpret_cast<const char*>(&number), sizeof number);
}

void write_mesh(std::ostream& out, int cells, int layer) {
  const TriangleMesh mesh = unstructured_mesh(cells, Domain{.layer_depth = static_cast<double>(layer)});
  for (const int number : {cells, layer, mesh.vertex_count(), mesh.triangle_count()}) write<std::int32_t>(out, number);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    for (const double x : {mesh.vertices(v, 0), mesh.vertices(v, 1)}) write(out, x);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) write(out, static_cast<std::uint16_t>(mesh.triangles(t, i)));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "live_meshes: accepted: one file to write\n");
    return 2;
  }
  std::ofstream out(argv[1], std::ios::binary);
  for (const int cells : {8, 16, 24, 32})
    for (const int layer : {0, 1}) write_mesh(out, cells, layer);
  out.close();
  if (!out) fmt::print(stderr, "live_meshes: cannot write {}\n", argv[1]);
  return out ? 0 : 1;
}
