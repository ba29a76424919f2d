// Integrals over the facets of a group: what pulls there, springs, and the Ventcel term.
#include "antilock/form/edge_forms.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/mesh/quadrature.hpp"

namespace antilock {
namespace {

/// act(cell, weight, value of f, values of the basis) at the points of a rule on each facet with
/// the tag.
template <class Act>
void at_points(const Space& space, EdgeTag tag, const Field& f, Act&& act) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature rule = facet_rule(mesh.kind, 2 * space.element().degree() + 3);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < mesh.reference().facets; ++i) {
      const int e = mesh.triangle_edges(t, i);
      if (mesh.edge_tag[e] != tag) continue;
      const double share =
          mesh.edge_triangles(e, 1) < 0 ? 1 : 0.5;  // between two cells: the mean of both sides
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        const ReferencePoint xi = on_facet(mesh.kind, i, rule.points.row(q));
        const Eigen::Vector3d x = position(mesh, t, xi);
        const double value = f(x(0), x(1), x(2));
        if (!std::isfinite(value))
          throw Error(fmt::format("edge: its value at ({:.6g}) is not finite",
                                  fmt::join(x.data(), x.data() + mesh.dimension(), ", ")));
        act(t, share * rule.weights(q) * mesh.facet_measure(e), value, space.element().basis(xi));
      }
    }
}

}  // namespace

Eigen::VectorXd edge_load(const Space& space, EdgeTag tag, const Field& g) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.size());
  at_points(space, tag, g, [&](int t, double weight, double value, const Eigen::VectorXd& basis) {
    for (Eigen::Index i = 0; i < basis.size(); ++i)
      load(space.cell_dofs()(t, i)) += weight * value * basis(i);
  });
  return load;
}

Eigen::SparseMatrix<double> edge_mass(const Space& space, EdgeTag tag, const Field& k) {
  return gram_matrix(edge_rows(space, tag, k));
}

WeightedFactoredForm edge_rows(const Space& space, EdgeTag tag, const Field& k) {
  FactoredFormBuilder rows;
  std::vector<double> moduli;
  at_points(space, tag, k, [&](int t, double weight, double value, const Eigen::VectorXd& basis) {
    if (value < 0) throw Error("spring: its stiffness is negative; accepted: 0 or more");
    if (value == 0) return;
    rows.add(t, weight);
    moduli.push_back(value);
    for (Eigen::Index i = 0; i < basis.size(); ++i) rows.put(space.cell_dofs()(t, i), basis(i));
  });
  return {rows.form(space.size()),
          Eigen::Map<const Eigen::VectorXd>(moduli.data(), Eigen::Index(moduli.size()))};
}

Eigen::SparseMatrix<double> gram_matrix(const WeightedFactoredForm& rows) {
  const auto& [b, m, cell] = rows.form;
  Triplets entries;
  for (Eigen::Index row = 0; row < b.rows(); ++row) {
    const double weight = m(row) * rows.stiffness(row);
    for (RowMatrix::InnerIterator i(b, row); i; ++i)
      for (RowMatrix::InnerIterator j(b, row); j; ++j)
        entries.emplace_back(i.col(), j.col(), weight * i.value() * j.value());
  }
  return from_triplets<SparseMatrix>(b.cols(), b.cols(), entries);
}

Eigen::SparseMatrix<double> ventcel_form(const Space& space, const Eigen::VectorXd& given) {
  if (space.element().degree() != 1)
    throw Error("Ventcel term: element " + space.element().name() + " is not accepted; P1 or CR");
  const TriangleMesh& mesh = space.mesh();
  require_triangles(mesh, "Ventcel term");
  std::vector<int> on_sigma(mesh.vertex_count(), 0), held = on_sigma;  // edges at each vertex
  for (int e = 0; e < mesh.edge_count(); ++e)
    for (const int v : mesh.edges.row(e)) {
      on_sigma[v] += mesh.edge_tag[e] == EdgeTag::contact ? 1 : 0;
      held[v] += is_dirichlet(mesh.edge_tag[e]) ? 1 : 0;
    }
  std::vector<double> ends;  // a single piece has two
  double height = NAN;
  const double off = 1e-6 * body_size(mesh);  // formats with few digits place a vertex to 1e-8
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (on_sigma[v] == 0) continue;
    if (std::isnan(height)) height = mesh.vertices(v, 1);
    if (std::abs(mesh.vertices(v, 1) - height) > off)
      throw Error("Ventcel term: Sigma leaves its line at " + mesh.location_text(v) +
                  "; accepted: a piece of a line y = const");
    if (on_sigma[v] != 1) continue;
    ends.push_back(mesh.vertices(v, 0));
    if (held[v] == 0 || given(v) != 0 || ends.size() > 2)
      throw Error("Ventcel term: Sigma has an end at " + mesh.location_text(v) +
                  (given(v) != 0 ? " with u not 0" : "") +
                  "; accepted: u = 0 at both of its ends, or a scaled layer with epsilon = 0, "
                  "which is the same problem");
  }
  if (ends.size() != 2)
    throw Error("Ventcel term: Sigma has no ends; accepted: a piece of a line y = const");
  const auto [left, right] = std::minmax(ends[0], ends[1]);
  // x and unknown along Sigma; at the clamped ends u = 0, they have none
  std::vector<std::pair<double, int>> line{{left, -1}};
  for (const int i : space.contact_dofs()) line.emplace_back(space.dof_coordinates()(i, 0), i);
  line.emplace_back(right, -1);
  Triplets entries;
  for (std::size_t k = 1; k < line.size(); ++k)
    for (const int i : {line[k - 1].second, line[k].second})
      for (const int j : {line[k - 1].second, line[k].second})
        if (i >= 0 && j >= 0)
          entries.emplace_back(i, j, (i == j ? 1 : -1) / (line[k].first - line[k - 1].first));
  return from_triplets<SparseMatrix>(space.size(), space.size(), entries);
}

}  // namespace antilock
