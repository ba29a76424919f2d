#pragma once
#include <filesystem>
#include <functional>
#include <numbers>
#include <numeric>
#include <vector>

#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock::tutorial {

/// Solves min 1/2 s(u, u) - (sin 2 pi x, u) over u >= 0 on (0, 1), where the form s
/// multiplies the wave sin ax, a = k pi, by `stiffness(a)`. Returns the largest u over that
/// without an obstacle.
inline double rise_over_obstacle(const std::function<double(double)>& stiffness) {
  const int n = 63;
  const double pi = std::numbers::pi, h = 1.0 / (n + 1);
  Eigen::MatrixXd sines(n, n);
  Eigen::VectorXd symbol(n);
  for (int k = 0; k < n; ++k) {
    symbol(k) = stiffness((k + 1) * pi);
    for (int i = 0; i < n; ++i) sines(k, i) = std::sin((k + 1) * pi * (i + 1) * h);
  }
  const Eigen::MatrixXd form = h * sines.transpose() * symbol.asDiagonal() * sines;
  VariationalInequality problem;
  problem.a1 = Eigen::MatrixXd(form + form.transpose()).sparseView();  // exactly symmetric
  problem.b.resize(0, n);
  problem.load = sines.row(1).transpose();
  std::vector<int> everywhere(n);
  std::iota(everywhere.begin(), everywhere.end(), 0);
  problem.bounds = Bounds::lower_on(everywhere, Eigen::VectorXd::Zero(n));
  return active_set(problem).u.maxCoeff() * symbol(1);
}

/// The slope d/dy of the interpolant of sin(2 pi x), triangle by triangle, on the meshes of
/// two generators: slope_unstructured.vtu and slope_delaunay.vtu.
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
