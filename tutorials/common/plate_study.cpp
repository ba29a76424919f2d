#include "common/plate_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/solve/active_set.hpp"

namespace antilock::tutorial {

double largest_error(const Space& w, const Solution& solution, const PlateTruth& truth) {
  double largest = 0;
  for (int i = 0; i < w.size(); ++i)
    largest = std::max(largest, std::abs(solution.u(i) - truth.deflection(w.points().row(i).norm())));
  return largest;
}

// A constant curvature, $w = x^2 + x y - y^2 / 2$ and $θ = ∇w$ on the rim, no load. Each triangle's bending is exact then.
double patch_error(const PlateMethod& method, const TriangleMesh& mesh, double thickness) {
  const Discrete on(method, mesh);
  Plate bent{.thickness = thickness, .load = [](double, double) { return 0.0; }};
  bent.gap = [](double, double) { return std::numeric_limits<double>::infinity(); };
  bent.rim = [](double x, double y) { return x * x + x * y - y * y / 2; };
  bent.rim_slope_x = [](double x, double y) { return 2 * x + y; };
  bent.rim_slope_y = [](double x, double y) { return x - y; };
  const Eigen::VectorXd u = active_set(assemble(bent, on.space)).u;
  double worst = 0;
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    const double x = mesh.vertices(i, 0), y = mesh.vertices(i, 1);
    worst =
        std::max({worst, std::abs(u(on.space.theta_x() + i) - 2 * x - y), std::abs(u(on.space.theta_y() + i) - x + y)});
  }
  return worst;
}

// The deflection along the diameter $y = 0$, at the midpoints of the edges there.
void add_diameter(Table& profile, const PlateMethod& method, const Space& w, const Solution& solution,
                  double thickness) {
  const TriangleMesh& mesh = w.mesh();
  const PlateTruth truth(thickness);
  std::vector<std::pair<double, int>> edges;  // x of the midpoint, edge
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.edges(e, 0), b = mesh.edges(e, 1);
    if (std::abs(mesh.vertices(a, 1)) + std::abs(mesh.vertices(b, 1)) < 1e-9)
      edges.emplace_back((mesh.vertices(a, 0) + mesh.vertices(b, 0)) / 2, e);
  }
  std::sort(edges.begin(), edges.end());
  for (const auto& [x, e] : edges) {
    const double mean = (solution.u(mesh.edges(e, 0)) + solution.u(mesh.edges(e, 1))) / 2;
    profile.add({x, method.file, method.deflection.conforming() ? mean : solution.u(e)});
    if (method.file == "p1") profile.add({x, "exact", truth.deflection(std::abs(x))});
  }
}

}  // namespace antilock::tutorial
