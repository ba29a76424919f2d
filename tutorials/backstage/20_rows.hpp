#pragma once
#include "backstage/20_parts.hpp"

namespace antilock::tutorial {

/// The bending length k of the rows, whose base is 1/cells.
inline double k_of_rows(int cells) { return std::lround(2 * cells / std::sqrt(3)) / (8.0 * cells * cells); }

/// Proposition E with a bend w across the end of contact: S^- >= |int chi d_x u d_y w| / |d_y w| for every h and every w that
/// is 0 on Sigma, on Gamma_C and near the sides. This w is the best one in x of those that are sin(pi y) in y.
inline double lower_bound(const Exact& exact, const TriangleMesh& mesh, int cells) {
  const double scale = std::sqrt(std::numbers::pi / k_of_rows(cells) / 2);
  const auto w = [&](int vertex) {
    const double x = mesh.vertices(vertex, 0), r = scale * std::abs(x - exact.contact_from());
    if (std::min(x, 1 - x) * cells < 1.5) return 0.0;
    return std::exp(-r) * (std::cos(r) + std::sin(r)) * std::sin(std::numbers::pi * mesh.vertices(vertex, 1));
  };
  double work = 0, energy = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    double slope = 0, mean = 0;
    Eigen::Vector3d y;
    for (int i = 0; i < 3; ++i) {
      slope += w(mesh.triangles(t, i)) * barycentric_gradients(mesh, t)(i, 1);
      mean += flux_at(exact, point_in(mesh, t, midpoint_rule().points.row(i)), true)(0) / 3;
      y(i) = mesh.vertices(mesh.triangles(t, i), 1);
    }
    const bool up = 2 * y.mean() < y.minCoeff() + y.maxCoeff();
    work += (up ? 1 : -1) * mesh.area(t) * slope * mean;
    energy += mesh.area(t) * slope * slope;
  }
  return std::abs(work) / std::sqrt(energy);
}

/// P1 without contact at epsilon = k/rho: the share of the ridge sin(a x) that rows keep, against columns under the same
/// body, over the share that the law leaves.
inline double kept_over_law(double rho, int cells) {
  const double a = 2 * std::numbers::pi, stiffness = a / std::tanh(a) + a * a;  // of the body, of the layer
  const Scene free(Body{paper_load}, StiffLayer{k_of_rows(cells) / rho});
  const auto ridge = [&](const std::string& family) {
    const Discretisation on(mesh_family(family).mesh(cells), p1());
    return active_set(assemble(free, on.space())).u(on.space().contact()).maxCoeff();
  };
  return ridge("rows") / ridge("structured") * (1 + rho * rho * std::pow(a, 4) / stiffness);
}

}  // namespace antilock::tutorial
