#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/form/quadrature.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/solve/active_set.hpp"
#include "backstage/27_truth.hpp"

namespace antilock::tutorial {

/// A discretisation of the plate: an element for w, one for each component of theta, and what of the shear counts.
struct PlateElement {
  std::string name, file;
  const Element &deflection, &rotation;
  ShearRule shear;
  bool locks;
};

/// The method on a mesh, which must outlive it.
struct Discrete {
  Discrete(const PlateElement& method, const TriangleMesh& mesh)
      : w(mesh, method.deflection), theta(mesh, method.rotation), space{w, {theta, theta}, method.shear} {}
  Space w, theta;
  PlateSpace space;
};

/// The patch test: largest error of theta at the vertices of a plate that is bent by its rim with the constant curvature
/// of w = x^2 + x y - y^2 / 2.
inline double patch_error(const PlateElement& method, const TriangleMesh& mesh, double thickness) {
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

/// The error of w in L2: the same for an element with unknowns at vertices and for one with unknowns at midpoints.
inline double error_of_w(const Space& w, const Solution& solution, const PlateTruth& truth) {
  const Quadrature& rule = triangle_rule(4);
  double square = 0;
  for (int t = 0; t < w.mesh().triangle_count(); ++t) {
    const Eigen::VectorXi unknowns = w.unknowns().row(t);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const double here = w.element().basis(rule.points.row(q)).dot(solution.u(unknowns));
      const double r = point_in(w.mesh(), t, rule.points.row(q)).norm();
      square += w.mesh().area(t) * rule.weights(q) * std::pow(here - truth.deflection(r), 2);
    }
  }
  return std::sqrt(square);
}

/// Sixteen t per decade where the disc of contact still grows with t, then 0 and what leads to it. Thicker plates than
/// t = 0.1 fall on the obstacle within a ring or two of the rim.
inline std::vector<double> thicknesses() {
  std::vector<double> all{3e-3, 1e-3, 1e-4, 1e-6, 1e-8, 1e-20, 0};
  for (int k = 16; k >= 0; --k) all.insert(all.begin(), std::pow(10, -1 - k / 16.0));
  return all;
}

}  // namespace antilock::tutorial
