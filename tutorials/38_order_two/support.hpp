#pragma once
// Tables and pictures of 38_order_two.
#include <filesystem>

#include "antilock/analysis/kernel.hpp"
#include "antilock/measure/contact_edges.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/problem/bounds.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// Returns the energy error in the triangles of the layer.
inline double layer_part(const Space& space, const Errors& errors) {
  double squared = 0;
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    if (space.mesh().region[t] == Region::layer)
      squared += errors.by_triangle(t) * errors.by_triangle(t);
  return std::sqrt(squared);
}

/// Returns the dimension of the kernel that 1.9 of guides/order_two.md proves: triangles of
/// the layer, and edges on Sigma and Gamma_C, less those on the two sides.
inline int one_per_triangle(const TriangleMesh& mesh) {
  auto dimension =
      static_cast<int>(std::count(mesh.region.begin(), mesh.region.end(), Region::layer));
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const bool of_layer = mesh.region[mesh.edge_triangles(e, 0)] == Region::layer;
    // Gamma_C is free in a scene without contact, and has its tag all the same
    if (mesh.edge_tag[e] == EdgeTag::sigma || mesh.edge_tag[e] == EdgeTag::contact)
      ++dimension;
    if (is_dirichlet(mesh.edge_tag[e]) && of_layer) --dimension;
  }
  return dimension;
}

/// Returns how many functions have no strain in the layer, if they are polynomials of
/// degree k on each triangle, agree at the k Gauss points of each edge between two
/// triangles, and are 0 at those of the sides. These are the elements of Crouzeix and
/// Raviart (k = 1), Fortin and Soulie (2), Crouzeix and Falk (3). A polynomial without
/// strain depends on x alone, so that each triangle has k + 1 coefficients.
inline int strainless_polynomials(const TriangleMesh& mesh, int degree) {
  std::vector<int> first(mesh.triangle_count(), -1);  // coefficient of a layer triangle
  int size = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    first[t] = size;
    size += degree + 1;
  }
  const Eigen::VectorXd points = gauss_rule(degree).first;
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    std::vector<int> beside;  // its triangles in the layer
    for (int k = 0; k < 2; ++k)
      if (const int t = mesh.edge_triangles(e, k); t >= 0 && first[t] >= 0)
        beside.push_back(t);
    if (beside.size() + (is_dirichlet(mesh.edge_tag[e]) ? 1 : 0) != 2) continue;
    const double from = mesh.vertices(mesh.edges(e, 0), 0);
    const double to = mesh.vertices(mesh.edges(e, 1), 0);
    for (const double s : points) {
      for (const int t : beside) {
        const double x = from + s * (to - from) - mesh.vertices(mesh.triangles(t, 0), 0);
        const double scaled = x / std::sqrt(mesh.area(t));
        for (int j = 0; j <= degree; ++j)
          entries.emplace_back(row, first[t] + j,
                               (t == beside[0] ? 1 : -1) * std::pow(scaled, j));
      }
      ++row;
    }
  }
  VariationalInequality conditions;
  conditions.a1 = SparseMatrix(size, size);
  conditions.a1.setIdentity();
  conditions.b = RowMatrix(row, size);
  conditions.b.setFromTriplets(entries.begin(), entries.end());
  conditions.m = Eigen::VectorXd::Ones(row);
  conditions.load = Eigen::VectorXd::Zero(size);
  return kernel_dimension(conditions);
}

/// Appends the equation of fortin_soulie(), one per triangle or per triangle of the layer, to
/// a problem of hybrid BDM1, as rows of B with the compliance 0. The weights M are those of
/// models/plane_strain.cpp, which has the reasons. They change the number of corrections, and
/// not the solution.
inline VariationalInequality with_equations(VariationalInequality problem,
                                            const Space& space, bool layer_alone = false) {
  const TriangleMesh& mesh = space.mesh();
  const Eigen::VectorXd equation = fortin_soulie().equation();
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> areas;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (layer_alone && mesh.region[t] != Region::layer) continue;
    const auto row = static_cast<int>(areas.size());
    for (int i = 0; i < 6; ++i)  // the coefficient of the mean is 0
      entries.emplace_back(row, space.cell_dofs()(t, i), equation(i));
    areas.push_back(mesh.area(t));
  }
  const auto count = static_cast<Eigen::Index>(areas.size());
  RowMatrix rows(count, space.size());
  rows.setFromTriplets(entries.begin(), entries.end());
  const Eigen::Map<const Eigen::VectorXd> area(areas.data(), count);
  append_rows(problem, rows, 300 * area.sum() * area.cwiseInverse(),
              Eigen::VectorXd::Zero(count));
  return problem;
}

/// Returns a row per element, mesh and h with the largest energy error over epsilon,
/// `worst`. `panel` is the title of the mesh in the picture: with the names "structured" and
/// "jittered" the renderer would take a curve for a method with a style of its own.
inline Table worst_over_epsilon(const Table& all) {
  Table worst({"mesh", "panel", "element", "cells", "h", "unknowns", "worst"});
  for (const TableEntry& mesh : all.unique("mesh")) {
    TableEntry panel = mesh;
    if (mesh == TableEntry("structured")) panel = TableEntry("right diagonals");
    if (mesh == TableEntry("jittered")) panel = TableEntry("jittered mesh");
    for (const TableEntry& element : all.unique("element")) {
      const Table runs = all.filter("mesh", mesh).filter("element", element);
      for (const TableEntry& cells : runs.unique("cells")) {
        const Table here = runs.filter("cells", cells);
        worst.add({mesh, panel, element, cells, here.first("h"), here.first("unknowns"),
                   here.max("energy")});
      }
    }
  }
  return worst;
}

/// Returns the fewest unknowns with which the runs have a relative energy error of at most
/// 10 %, 3 %, 1 % and 0.3 %, per mesh and element. The entry is "-" where none has.
inline Table prices(const Table& runs) {
  const std::vector<std::pair<std::string, double>> accuracies{
      {"10 %", 0.1}, {"3 %", 0.03}, {"1 %", 0.01}, {"0.3 %", 0.003}};
  Table prices({"mesh", "element", "10 %", "3 %", "1 %", "0.3 %"});
  for (const TableEntry& mesh : runs.unique("mesh"))
    for (const TableEntry& element : runs.unique("element")) {
      const Table here = runs.filter("mesh", mesh).filter("element", element);
      if (here.size() == 0) continue;
      std::vector<TableEntry> row{mesh, element};
      for (const auto& [name, accuracy] : accuracies) {
        const auto reached = [most = accuracy](double error) { return error <= most; };
        const Table enough = here.filter_number("relative", reached);
        row.push_back(enough.size() > 0 ? TableEntry(enough.min("unknowns"))
                                        : TableEntry("-"));
      }
      prices.add(row);
    }
  return prices;
}

/// Imposes contact at the two Gauss points of each edge of Gamma_C, in place of the hat
/// means. The value at s of the affine function with the hat means a-, a+ is
/// (2 - 3 s) a- + (3 s - 1) a+.
inline VariationalInequality at_gauss_points(VariationalInequality problem,
                                             const Space& space) {
  const Eigen::VectorXd points = gauss_rule(2).first;
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (const ContactEdge& edge : contact_edges(space.mesh()))
    for (const double s : points) {
      entries.emplace_back(row, space.cell_dofs()(edge.triangle, 2 * edge.opposite),
                           2 - 3 * s);
      entries.emplace_back(row++, space.cell_dofs()(edge.triangle, 2 * edge.opposite + 1),
                           3 * s - 1);
    }
  RowMatrix rows(row, problem.size());
  rows.setFromTriplets(entries.begin(), entries.end());
  problem.bounds = Bounds({}, BoundLimits(Eigen::VectorXd::Zero(row)), rows);
  return problem;
}

/// Returns the discrete pressure of hybrid BDM1 at nine points of each edge of Gamma_C,
/// ordered by x, for contact by hat means and at Gauss points, and the exact pressure: x,
/// exact, hats, gauss. The pressure is the affine density on each edge whose work is that
/// of the bound forces: its value at an end is 2 / |E| times the force on the hat mean of
/// this end.
inline Table pressures(const TriangleMesh& mesh, const Exact& exact) {
  const Space space(mesh, hybrid_bdm1());
  const VariationalInequality hats = assemble(exact.scene, space);
  const VariationalInequality gauss = at_gauss_points(hats, space);
  const Eigen::VectorXd of_hats =
      bound_forces(hats.bounds, active_set(hats).lambda, space.size());
  const Eigen::VectorXd of_gauss =
      bound_forces(gauss.bounds, active_set(gauss).lambda, space.size());
  std::vector<std::array<double, 4>> rows;
  for (const ContactEdge& edge : contact_edges(mesh)) {
    Eigen::Array2d x, hat, at_points;  // at both ends
    for (int end = 0; end < 2; ++end) {
      const int unknown = space.cell_dofs()(edge.triangle, 2 * edge.opposite + end);
      const int corner = mesh.triangles(edge.triangle, (edge.opposite + 1 + end) % 3);
      x(end) = mesh.vertices(corner, 0);
      hat(end) = 2 / edge.length * of_hats(unknown);
      at_points(end) = 2 / edge.length * of_gauss(unknown);
    }
    constexpr int parts = 8;
    for (int k = 0; k <= parts; ++k) {
      // a vertex has two values, each inside of its edge
      const double s = std::clamp(static_cast<double>(k) / parts, 1e-9, 1 - 1e-9);
      const Eigen::Array2d ends(1 - s, s);
      const double at = (ends * x).sum();
      rows.push_back(
          {at, exact.solution.pressure(at), (ends * hat).sum(), (ends * at_points).sum()});
    }
  }
  std::sort(rows.begin(), rows.end());
  Table table({"x", "exact", "hats", "gauss"});
  for (const auto& [x, known, hat, at_points] : rows) table.add({x, known, hat, at_points});
  return table;
}

/// Draws the unknowns of P2, CR and hybrid BDM1 on a triangle each.
inline void draw_unknowns(const std::filesystem::path& path) {
  Table drawing({"kind", "name", "label", "x", "y"});
  const auto points = [&](const char* kind, const std::string& name,
                          const std::vector<Eigen::Vector2d>& corners) {
    for (const auto& corner : corners) drawing.add({kind, name, "", corner(0), corner(1)});
  };
  int dots = 0;
  const auto dot = [&](const Eigen::Vector2d& at, double radius) {
    std::vector<Eigen::Vector2d> circle;
    for (int k = 0; k < 24; ++k)
      circle.push_back(at + radius * Eigen::Vector2d(std::cos(k * std::numbers::pi / 12),
                                                     std::sin(k * std::numbers::pi / 12)));
    // a name of its own, because parts of one name that follow each other are one part
    points("fill", "contact " + std::to_string(++dots), circle);
  };
  points("page", "", {{-0.3, -0.62}, {4.5, 1.3}});
  for (int element = 0; element < 3; ++element) {
    const Eigen::Vector2d shift(1.55 * element, 0);
    const std::array<Eigen::Vector2d, 3> corner{shift, shift + Eigen::Vector2d(1.1, 0),
                                                shift + Eigen::Vector2d(0.55, 0.95)};
    points("fill", "body " + std::to_string(element), {corner[0], corner[1], corner[2]});
    points("line", "axis " + std::to_string(element),
           {corner[0], corner[1], corner[2], corner[0]});
    const Eigen::Vector2d centre = (corner[0] + corner[1] + corner[2]) / 3;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d from = corner[(i + 1) % 3], to = corner[(i + 2) % 3],
                            middle = (from + to) / 2;
      const Eigen::Vector2d out = (middle - centre).normalized();
      const std::string name = std::to_string(3 * element + i);
      if (element == 0) dot(corner[i], 0.045);
      if (element == 0) dot(middle, 0.045);
      if (element == 1)
        points("line", "layer_clamped weight " + name,
               {from + 0.12 * out, to + 0.12 * out});
      if (element < 2) continue;
      // the two hat functions, drawn on the edge: 1 at one end, 0 at the other
      points("line", "layer_clamped hat " + name, {from + 0.22 * out, to + 0.04 * out});
      points("line", "contact hat " + name, {from + 0.04 * out, to + 0.22 * out});
    }
    if (element == 2) dot(centre, 0.09);
  }
  const auto label = [&](const char* text, double x) {
    drawing.add({"label", "axis", text, x, -0.45});
  };
  label("$P_2$: six values", 0.55);
  label("Crouzeix–Raviart: three means", 2.1);
  label("seven weighted means", 3.65);
  drawing.write(path);
}

}  // namespace antilock::tutorial
