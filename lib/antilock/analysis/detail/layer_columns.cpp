#include "antilock/analysis/detail/layer_columns.hpp"

#include <algorithm>
#include <cmath>

#include "antilock/form/edge_forms.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/mesh/quadrature.hpp"

namespace antilock {
namespace {

/// R: the number of rows with which the cells are square in the layer of thickness epsilon, but no
/// more than the mesh has, because a coarse layer is no locked one.
int row_count(const TriangleMesh& mesh, const InterfaceLine& sigma, double epsilon) {
  // a wave over the depth loses (pi / 8)^2 / 12 = 1.3 % by the height 1/8
  constexpr int most_rows = 8;
  const int degree = sigma.degree();
  const auto edges = static_cast<int>(sigma.edges.size());
  const auto in_layer =
      static_cast<int>(std::count(mesh.region.begin(), mesh.region.end(), Region::layer));
  const int of_mesh = std::clamp(degree * in_layer / (2 * edges), 1, most_rows);
  const double square = std::ceil(epsilon * degree * edges / sigma.length - 1e-9);
  return std::clamp(static_cast<int>(square), 1, of_mesh);
}

/// The matrices in x: a_x, value and weight.
void add_forms_in_x(LayerColumns& columns, const Element& element, const InterfaceLine& sigma,
                    double s) {
  const int degree = sigma.degree();
  auto [at, weights] = gauss_rule(degree + 1);
  if (degree == 1) at << 0, 1;
  const EdgeBasis basis = edge_basis(element, at);
  const Eigen::MatrixXd form = basis.slope.transpose() * weights.asDiagonal() * basis.slope;
  const auto edges = static_cast<int>(sigma.edges.size());
  Triplets of_form;
  Triplets of_value;
  columns.weight.resize(edges * (degree + 1));
  for (int e = 0; e < edges; ++e) {
    const std::vector<int>& edge = sigma.edges[e];
    const double dx = sigma.edge_length(edge);
    for (int i = 0; i <= degree; ++i) {
      const int row = e * (degree + 1) + i;
      columns.weight(row) = s * dx * weights(i);
      for (int j = 0; j <= degree; ++j) {
        of_form.emplace_back(edge[i], edge[j], s / dx * form(i, j));
        of_value.emplace_back(row, edge[j], basis.value(i, j));
      }
    }
  }
  columns.a_x = from_triplets<SparseMatrix>(sigma.size(), sigma.size(), of_form);
  columns.value = from_triplets<RowMatrix>(columns.weight.size(), sigma.size(), of_value);
}

/// The matrices in y: difference and depth.
void add_forms_in_y(LayerColumns& columns) {
  const int rows = columns.rows;
  columns.depth = Eigen::VectorXd::Constant(rows + 1, 1.0 / rows);
  columns.depth(0) = 0.5 / rows;
  columns.depth(rows) = 0.5 / rows;
  columns.difference.resize(rows, rows + 1);
  for (int row = 0; row < rows; ++row) {
    columns.difference.insert(row, row) = rows;
    columns.difference.insert(row, row + 1) = -rows;
  }
}

/// Per place on Sigma, but not the last one of an edge: the edge on its right.
std::vector<const std::vector<int>*> edges_by_place(const InterfaceLine& sigma) {
  std::vector<const std::vector<int>*> edges(sigma.size());
  for (const std::vector<int>& edge : sigma.edges)
    for (std::size_t i = 0; i + 1 < edge.size(); ++i) edges[edge[i]] = &edge;
  return edges;
}

bool has_corner_on(const InterfaceLine& sigma, const TriangleMesh& mesh, int t) {
  const auto corners = mesh.triangles.row(t);
  return std::any_of(corners.begin(), corners.end(), [&](int v) { return sigma.place[v] >= 0; });
}

}  // namespace

LayerColumns layer_columns(const Space& space, const InterfaceLine& sigma, double epsilon,
                           double s) {
  LayerColumns columns;
  columns.rows = row_count(space.mesh(), sigma, epsilon);
  add_forms_in_x(columns, space.element(), sigma, s);
  add_forms_in_y(columns);
  return columns;
}

std::vector<ColumnLoad> column_loads(const Space& space, const InterfaceLine& sigma, int rows,
                                     const Field& f) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = load_rule(space.element());
  const std::vector<const std::vector<int>*> right_of = edges_by_place(sigma);
  std::vector<ColumnLoad> loads;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      const std::vector<int>* const edge = right_of[interval_of(sigma.x, x(0)).first];
      const double share = (x(0) - sigma.left_end(*edge)) / sigma.edge_length(*edge);
      const EdgeBasis basis = edge_basis(space.element(), Eigen::VectorXd::Constant(1, share));
      const int row = std::min(static_cast<int>(-x(1) * rows), rows - 1);
      loads.push_back({edge, row, -x(1) * rows - row,
                       mesh.area(t) * rule.weights(q) * f(x(0), x(1)) * basis.value.row(0)});
    }
  }
  return loads;
}

SparseMatrix layer_form_at(const InterfaceLine& sigma, const Space& space,
                           const Eigen::Vector2d& stiffness) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = strain_quadrature(space.element());
  Triplets entries;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] == Region::body || !has_corner_on(sigma, mesh, t)) continue;
    const auto dofs = space.cell_dofs().row(t);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::MatrixX3d derivative = space.element().derivative(rule.points.row(q));
      const Eigen::MatrixX2d gradient = derivative * barycentric_gradients(mesh, t);
      const Eigen::MatrixXd local = gradient *
                                    (rule.weights(q) * mesh.area(t) * stiffness).asDiagonal() *
                                    gradient.transpose();
      for (Eigen::Index i = 0; i < local.rows(); ++i)
        for (Eigen::Index j = 0; j < local.cols(); ++j)
          entries.emplace_back(dofs(i), dofs(j), local(i, j));
    }
  }
  return from_triplets<SparseMatrix>(space.size(), space.size(), entries);
}

}  // namespace antilock
