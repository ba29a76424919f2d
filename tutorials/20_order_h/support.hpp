#pragma once
#include "antilock/certificate/equilibrated_flux.hpp"
#include "antilock/exact/exact_norms.hpp"
#include "antilock/measure/contact_edges.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

// Chapter 20: the terms of the proof, measured. Sums over the triangles and over the edges
// of Gamma_C.

/// The flux of u: its gradient in the body, (d/dx u, p) in the layer.
inline Eigen::Vector2d flux_at(const Exact& exact, const Eigen::Vector2d& x,
                               bool in_layer) {
  const ExactPoint u = exact.table.at(x(0), x(1));
  return in_layer ? Eigen::Vector2d(u.gradient(0), u.layer_stress) : u.gradient;
}

/// The mean over triangle t of the Raviart-Thomas interpolant of that flux, which is its
/// value at the centroid c: the sum of flux(E) (c - P_E) / (2 |T|) over the edges E, P_E
/// the vertex opposite. Gauss's rule of 4 points per edge.
inline Eigen::Vector2d interpolated_flux(const Exact& exact, const TriangleMesh& mesh,
                                         int t) {
  static const auto rule = gauss_rule(4);
  Eigen::Vector2d mean(0, 0);
  const auto vertex = [&](int i) {
    return Eigen::Vector2d(mesh.vertices.row(mesh.triangles(t, i % 3)));
  };
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d from = vertex(i + 1), along = vertex(i + 2) - from,
                          outward(along(1), -along(0));
    double flux = 0;
    for (Eigen::Index q = 0; q < rule.first.size(); ++q)
      flux += rule.second(q) *
              flux_at(exact, from + rule.first(q) * along, mesh.region[t] == Region::layer)
                  .dot(outward);
    mean += flux / mesh.twice_area(t) * ((from + vertex(i + 2) - 2 * vertex(i)) / 3);
  }
  return mean;
}

/// |u - I_h u|_a, |e|_a with e = I_h u - u_h, its part S^- in the layer, eta; T_C; the sum of Lemma B, int lambda int |c'|.
struct Parts {
  double interpolation = 0, discrete = 0, layer = 0, flux = 0, contact = 0, product = 0;
};

/// `result`: of Crouzeix-Raviart. Rules of degree 8 on triangles, 32 points per edge of
/// Gamma_C (the pressure may jump).
inline Parts take_apart(const Exact& exact, const Result& result) {
  const Space& space = result.space;
  constexpr int points = 32;
  const TriangleMesh& mesh = space.mesh();
  const EquilibratedFlux discrete =
      equilibrated_flux(exact.scene, result);  // cell[t].s: that of u_h
  const Quadrature& rule = triangle_rule(8);
  Parts sum;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const bool in_layer = mesh.region[t] == Region::layer;
    const FluxLaw& law = discrete.cell[t].law;
    Eigen::Vector2d mean(0, 0);
    double square = 0;
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d s =
          flux_at(exact, point_in(mesh, t, rule.points.row(q)), in_layer);
      mean += rule.weights(q) * s;
      square += rule.weights(q) * law.squared(s);
    }
    const double area = mesh.area(t), e = area * law.squared(mean - discrete.cell[t].s);
    sum.interpolation += area * (square - law.squared(mean));
    sum.discrete += e;
    sum.layer += in_layer ? e : 0;
    sum.flux += area * law.squared(mean - interpolated_flux(exact, mesh, t));
  }
  for (double* part : {&sum.interpolation, &sum.discrete, &sum.layer, &sum.flux})
    *part = std::sqrt(*part);
  for (const ContactEdge& edge : contact_edges(mesh)) {
    double pressure = 0, height = 0, slope = 0;
    for (int i = 0; i < points; ++i) {
      const double x =
          point_in(mesh, edge.triangle, on_edge(edge.opposite, (i + 0.5) / points))(0);
      const ExactPoint u = exact.table.at(x, -1);
      pressure += exact.solution.pressure(x) / points;
      height += u.value / points;
      slope += std::abs(u.gradient(0)) / points;
    }
    sum.contact +=
        pressure * edge.length *
        (height - result.solution.u(mesh.triangle_edges(edge.triangle, edge.opposite)));
    sum.product += pressure * slope * edge.length * edge.length;
  }
  return sum;
}

// Chapter 20: its tables and its drawing.

/// Theorem A at each epsilon, |.| in units of |f|; the last column in units of 1.
inline Table theorem_a(const std::vector<Exact>& exact_solution, double load_norm) {
  Table norms({"epsilon", "(|u|^2 + 2 F^2) / |f|^2", "F / |f|", "|p| / |f|",
               "epsilon^1/2 |d/dx p|"});
  for (const Exact& exact : exact_solution) {
    const Regularity u = regularity(exact.solution);
    norms.add({exact.epsilon, (u.body + 2 * u.layer) / (load_norm * load_norm),
               std::sqrt(u.layer) / load_norm, stress_norm(exact.solution) / load_norm,
               std::sqrt(exact.epsilon * u.stress_x)});
  }
  return norms;
}

/// All runs: what is bounded by h |f| or its square, in units of these; `half` is |u - I_h
/// u|_a in units of (h/pi) |f|.
inline Table in_units(const Table& all, double load_norm) {
  Table units({"mesh", "cells", "epsilon", "CR", "P1", "half", "eta", "T_C", "Lemma B"});
  for (const Table& row : all.rows()) {
    const double unit = row.number("h") * load_norm;
    units.add({row.entry("mesh"), row.entry("cells"), row.entry("epsilon"),
               row.number("CR") / unit, row.number("P1") / unit,
               std::numbers::pi * row.number("interpolation") / unit,
               row.number("flux") / unit, row.number("contact") / (unit * unit),
               row.number("product") / (unit * unit)});
  }
  return units;
}

/// Prints the finest mesh in units; writes results.csv, errors.csv (of the structured mesh)
/// and layer.csv.
inline void show_orders(const std::filesystem::path& out, const Table& all,
                        const Table& units, const Table& limit) {
  units.filter("cells", all.max("cells"))
      .print(
          "the finest mesh, T_C and Lemma B in (h |f|)^2, the rest in h |f|, half in "
          "(h/pi) |f| (proved on the "
          "structured "
          "mesh: 1.7, 1.3, 1, 0.601, 0.56, 0.56)",
          3);
  Table errors({"element", "mesh", "epsilon", "cells", "h", "error"});
  for (const Table& row : all.filter("mesh", "structured").rows())
    for (const char* element : {"CR", "P1"})
      errors.add({element, "structured", row.entry("epsilon"), row.entry("cells"),
                  row.entry("h"), row.entry(element)});
  all.write(out / "results.csv");
  errors.write(out / "errors.csv");
  limit.select({"mesh", "h", "layer"}).write(out / "layer.csv");
}

/// A triangle of a column and one of a row, for figures/pictures/domain.cpp.
inline void draw_triangles(const std::filesystem::path& path) {
  Table drawing({"kind", "name", "label", "x", "y"});
  const auto points = [&](const char* kind, const char* name,
                          const std::vector<Eigen::Vector2d>& corners) {
    for (const auto& corner : corners) drawing.add({kind, name, "", corner(0), corner(1)});
  };
  const auto label = [&](const char* name, const char* text, double x, double y) {
    drawing.add({"label", name, text, x, y});
  };
  points("page", "", {{-0.75, -0.32}, {3.25, 1.25}});
  points("fill", "layer column", {{0, 0}, {0.87, 0.5}, {0, 1}});
  points("line", "layer_clamped", {{0, 0}, {0.87, 0.5}, {0, 1}});
  points("line", "sigma", {{0, 0}, {0, 1}});
  points("arrow", "sigma out", {{0, 0.5}, {-0.3, 0.5}});
  label("sigma", "$u_x$", -0.48, 0.5);
  label("axis", "a triangle of a column", 0.35, -0.2);
  points("fill", "layer row", {{1.85, 0}, {2.85, 0}, {2.35, 0.87}});
  points("line", "layer_clamped base", {{1.85, 0}, {2.85, 0}});
  points("line", "contact", {{2.85, 0}, {2.35, 0.87}, {1.85, 0}});
  points("arrow", "contact left", {{2.1, 0.435}, {1.84, 0.585}});
  points("arrow", "contact right", {{2.6, 0.435}, {2.86, 0.585}});
  label("contact", "$u_x$ and $p$", 1.55, 0.72);
  label("layer_clamped", "$p$", 2.35, 0.1);
  label("axis", "a triangle of a row", 2.35, -0.2);
  drawing.write(path);
}

/// The bending length k of the rows, whose base is 1/cells.
inline double k_of_rows(int cells) {
  return std::lround(2 * cells / std::sqrt(3)) / (8.0 * cells * cells);
}

/// Proposition E with a bend w across the end of contact: S^- >= |int chi d_x u d_y w|
/// / |d_y w| for every h and every w that is 0 on Sigma, on Gamma_C and near the sides.
/// This w is the best one in x of those that are sin(pi y) in y.
inline double lower_bound(const Exact& exact, const TriangleMesh& mesh, int cells) {
  const double scale = std::sqrt(std::numbers::pi / k_of_rows(cells) / 2);
  const auto w = [&](int vertex) {
    const double x = mesh.vertices(vertex, 0),
                 r = scale * std::abs(x - exact.contact_from());
    if (std::min(x, 1 - x) * cells < 1.5) return 0.0;
    return std::exp(-r) * (std::cos(r) + std::sin(r)) *
           std::sin(std::numbers::pi * mesh.vertices(vertex, 1));
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

/// P1 without contact at epsilon = k/rho: the share of the ridge sin(a x) that rows keep,
/// against columns under the same body, over the share that the law leaves.
inline double kept_over_law(double rho, int cells) {
  const double a = 2 * std::numbers::pi,
               stiffness = a / std::tanh(a) + a * a;  // of the body, of the layer
  const Scene free(Body{paper_load}, StiffLayer{k_of_rows(cells) / rho});
  const auto ridge = [&](const std::string& family) {
    const Space space(mesh_family(family).mesh(cells), p1());
    return active_set(assemble(free, space)).u(space.contact_dofs()).maxCoeff();
  };
  return ridge("rows") / ridge("structured") * (1 + rho * rho * std::pow(a, 4) / stiffness);
}

}  // namespace antilock::tutorial
