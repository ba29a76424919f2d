#pragma once
// Chapter 20: the terms of the proof, measured. Sums over the triangles and over the edges of Gamma_C.
#include "antilock/analysis/detail/equilibrated_flux.hpp"
#include "antilock/form/quadrature.hpp"
#include "antilock/measure/detail/contact_edges.hpp"
#include "common/course.hpp"

namespace antilock::tutorial {

/// The flux of u: its gradient in the body, (d/dx u, p) in the layer.
inline Eigen::Vector2d flux_at(const Exact& exact, const Eigen::Vector2d& x, bool in_layer) {
  const TruthPoint u = exact.table.at(x(0), x(1));
  return in_layer ? Eigen::Vector2d(u.gradient(0), u.layer_stress) : u.gradient;
}

/// The mean over triangle t of the Raviart-Thomas interpolant of that flux, which is its value at the centroid c: the
/// sum of flux(E) (c - P_E) / (2 |T|) over the edges E, P_E the vertex opposite. Gauss's rule of 4 points per edge.
inline Eigen::Vector2d interpolated_flux(const Exact& exact, const TriangleMesh& mesh, int t) {
  static const auto rule = gauss_rule(4);
  Eigen::Vector2d mean(0, 0);
  const auto vertex = [&](int i) { return Eigen::Vector2d(mesh.vertices.row(mesh.triangles(t, i % 3))); };
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d from = vertex(i + 1), along = vertex(i + 2) - from, outward(along(1), -along(0));
    double flux = 0;
    for (Eigen::Index q = 0; q < rule.first.size(); ++q)
      flux +=
          rule.second(q) * flux_at(exact, from + rule.first(q) * along, mesh.region[t] == Region::layer).dot(outward);
    mean += flux / mesh.twice_area(t) * ((from + vertex(i + 2) - 2 * vertex(i)) / 3);
  }
  return mean;
}

/// |u - I_h u|_a, |e|_a with e = I_h u - u_h, its part S^- in the layer, eta; T_C; the sum of Lemma B, int lambda int |c'|.
struct Parts {
  double interpolation = 0, discrete = 0, layer = 0, flux = 0, contact = 0, product = 0;
};

/// u_h: of Crouzeix-Raviart. Rules of degree 8 on triangles, 32 points per edge of Gamma_C (the pressure may jump).
inline Parts take_apart(const Exact& exact, const Space& space, const VariationalInequality& problem,
                        const Solution& u_h) {
  constexpr int points = 32;
  const TriangleMesh& mesh = space.mesh();
  const EquilibratedFlux discrete = equilibrated_flux(exact.scene, space, problem, u_h);  // cell[t].s: that of u_h
  const Quadrature& rule = triangle_rule(8);
  Parts sum;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const bool in_layer = mesh.region[t] == Region::layer;
    const FluxLaw& law = discrete.cell[t].law;
    Eigen::Vector2d mean(0, 0);
    double square = 0;
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d s = flux_at(exact, point_in(mesh, t, rule.points.row(q)), in_layer);
      mean += rule.weights(q) * s;
      square += rule.weights(q) * law.squared(s);
    }
    const double area = mesh.area(t), e = area * law.squared(mean - discrete.cell[t].s);
    sum.interpolation += area * (square - law.squared(mean));
    sum.discrete += e;
    sum.layer += in_layer ? e : 0;
    sum.flux += area * law.squared(mean - interpolated_flux(exact, mesh, t));
  }
  for (double* part : {&sum.interpolation, &sum.discrete, &sum.layer, &sum.flux}) *part = std::sqrt(*part);
  for (const ContactEdge& edge : contact_edges(mesh)) {
    double pressure = 0, height = 0, slope = 0;
    for (int i = 0; i < points; ++i) {
      const double x = point_in(mesh, edge.triangle, on_edge(edge.opposite, (i + 0.5) / points))(0);
      const TruthPoint u = exact.table.at(x, -1);
      pressure += exact.truth.pressure(x) / points;
      height += u.value / points;
      slope += std::abs(u.gradient(0)) / points;
    }
    sum.contact += pressure * edge.length * (height - u_h.u(mesh.triangle_edges(edge.triangle, edge.opposite)));
    sum.product += pressure * slope * edge.length * edge.length;
  }
  return sum;
}

}  // namespace antilock::tutorial
