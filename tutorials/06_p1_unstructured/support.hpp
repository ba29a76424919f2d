#pragma once
#include <filesystem>
#include <numbers>

#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/families.hpp"

namespace antilock::tutorial {

/// The slope d/dy of the interpolant of sin(2 pi x), triangle by triangle, on the meshes of two generators:
/// slope_unstructured.vtu and slope_delaunay.vtu.
inline void draw_slopes(const std::filesystem::path& out, int cells) {
  for (const char* name : {"unstructured", "delaunay"}) {
    const TriangleMesh mesh = mesh_family(name).mesh(cells);
    Eigen::MatrixX3d corners(mesh.triangle_count(), 3);
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      double slope = 0;
      for (int i = 0; i < 3; ++i)
        slope += std::sin(2 * std::numbers::pi * mesh.vertices(mesh.triangles(t, i), 0)) *
                 barycentric_gradients(mesh, t)(i, 1);
      corners.row(t).setConstant(mesh.region[t] == Region::layer ? slope : 0);
    }
    write_vtu(out / (std::string("slope_") + name + ".vtu"), mesh, corners);
  }
}

}  // namespace antilock::tutorial
