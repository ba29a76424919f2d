#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/core/stopwatch.hpp"
#include "antilock/exact/exact_plate.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/table.hpp"
#include "course/chapter.hpp"

namespace antilock::tutorial {

/// A discretisation of the plate: an element for w, one for each component of theta, and
/// what of the shear counts.
struct PlateElement {
  std::string name, file;
  const Element &deflection, &rotation;
  ShearRule shear;
  bool locks;
};

/// The method on a mesh.
inline PlateSpace plate_space(const PlateElement& method, TriangleMesh mesh) {
  const Space deflection(std::move(mesh), method.deflection),
      rotation(deflection, method.rotation);
  return {deflection, {rotation, rotation}, method.shear};
}

/// The patch test: largest error of theta at the vertices of a plate that is bent by its
/// rim with the constant curvature of w = x^2 + x y - y^2 / 2.
inline double patch_error(const PlateElement& method, const TriangleMesh& mesh,
                          double thickness) {
  const PlateSpace space = plate_space(method, mesh);
  Plate bent{.thickness = thickness, .load = [](double, double) { return 0.0; }};
  bent.gap = [](double, double) { return std::numeric_limits<double>::infinity(); };
  bent.boundary_deflection = [](double x, double y) { return x * x + x * y - y * y / 2; };
  bent.boundary_rotation_x = [](double x, double y) { return 2 * x + y; };
  bent.boundary_rotation_y = [](double x, double y) { return x - y; };
  const Eigen::VectorXd u = active_set(assemble(bent, space)).u;
  double worst = 0;
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    const double x = mesh.vertices(i, 0), y = mesh.vertices(i, 1);
    worst = std::max({worst, std::abs(u(space.theta_x() + i) - 2 * x - y),
                      std::abs(u(space.theta_y() + i) - x + y)});
  }
  return worst;
}

/// The error of w in L2: the same for an element with unknowns at vertices and for one with
/// unknowns at midpoints.
inline double error_of_w(const Space& w, const Solution& solution,
                         const ExactPlate& exact) {
  const Quadrature& rule = triangle_rule(4);
  double square = 0;
  for (int t = 0; t < w.mesh().triangle_count(); ++t) {
    const Eigen::VectorXi unknowns = w.cell_dofs().row(t);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const double here = w.element().basis(rule.points.row(q)).dot(solution.u(unknowns));
      const double r = point_in(w.mesh(), t, rule.points.row(q)).norm();
      square +=
          w.mesh().area(t) * rule.weights(q) * std::pow(here - exact.deflection(r), 2);
    }
  }
  return std::sqrt(square);
}

/// Sixteen t per decade where the disc of contact still grows with t, then 0 and what leads
/// to it. Thicker plates than t = 0.1 fall on the obstacle within a ring or two of the rim.
inline std::vector<double> thicknesses() {
  std::vector<double> all{3e-3, 1e-3, 1e-4, 1e-6, 1e-8, 1e-20, 0};
  for (int k = 16; k >= 0; --k) all.insert(all.begin(), std::pow(10, -1 - k / 16.0));
  return all;
}

/// FILE.vtu, mesh.freefem.msh, and rows x, element, w along the diameter y = 0; with "p1"
/// the exact plate's too.
inline void draw(const Options& options, const PlateElement& method, const Space& w,
                 const Solution& solution, Table& profile) {
  const TriangleMesh& mesh = w.mesh();
  const ExactPlate exact(std::sqrt(options.epsilon));
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
    if (method.file == "p1") profile.add({x, "exact", exact.deflection(std::abs(x))});
  }
  write_freefem_mesh(options.out / "mesh.freefem.msh", mesh);
  write_vtu(options.out / (method.file + ".vtu"), w, solution.u.head(w.size()));
}

/// Prints the checks, one row per element; writes errors.csv (three meshes) and
/// profile.csv.
inline void print_plate(const Options& options, const Table& checks, const Table& errors,
                        const Table& profile) {
  checks.print("", 3);
  errors.filter_number("t", [](double t) { return t >= 1e-6; })
      .filter_number("rings", [&](double n) { return n <= options.cells; })
      .write(options.out / "errors.csv");
  profile.pivot("x", "element", "w").write(options.out / "profile.csv");
}

}  // namespace antilock::tutorial
