#include "antilock/form/interior_penalty.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/mesh/quadrature.hpp"

namespace antilock {
namespace {

/// A linear function of the unknowns: pairs of an unknown and its coefficient.
using LinearFunction = std::vector<std::pair<int, double>>;

void add(LinearFunction& sum, double factor, const LinearFunction& terms) {
  for (const auto& [unknown, coefficient] : terms) sum.emplace_back(unknown, factor * coefficient);
}

LinearFunction on_triangle(const Space& space, int t, const Eigen::VectorXd& coefficients) {
  LinearFunction terms;
  for (Eigen::Index k = 0; k < coefficients.size(); ++k)
    terms.emplace_back(space.cell_dofs()(t, k), coefficients(k));
  return terms;
}

int local_vertex(const TriangleMesh& mesh, int t, int vertex) {
  int corner = 0;
  while (mesh.triangles(t, corner) != vertex) ++corner;
  return corner;
}

/// w_T of the header.
double side_weight(const TriangleMesh& mesh, int t, int edge) {
  const EdgeTag tag = mesh.edge_tag[edge];
  if (is_dirichlet(tag)) return 1;
  if (tag == EdgeTag::sigma) return mesh.region[t] == Region::body ? 1 : 0;
  return tag == EdgeTag::interior ? 0.5 : 0;
}

/// The mean of u over an edge, and the difference of u between its two ends, on triangle t.
std::array<LinearFunction, 2> trace(const Space& space, int t, int edge) {
  const TriangleMesh& mesh = space.mesh();
  const auto at_vertex = [&](int vertex) {
    return space.element().basis(Eigen::Vector3d::Unit(local_vertex(mesh, t, vertex)));
  };
  const Eigen::VectorXd difference =
      at_vertex(mesh.edges(edge, 1)) - at_vertex(mesh.edges(edge, 0));
  return {on_triangle(space, t, means_on_facet(space.element(), local_edge(mesh, t, edge))),
          on_triangle(space, t, difference)};
}

/// c_k m_k / |T| and c_k D_k / |T| of one edge of a triangle.
struct WeightedJump {
  LinearFunction mean, difference;
};

WeightedJump weighted_jump(const Space& space, int t, int k, int axis) {
  const TriangleMesh& mesh = space.mesh();
  const int edge = mesh.triangle_edges(t, k);
  // the outward normal times |E_k| is -2 |T| grad lambda_k
  const double factor = -2 * side_weight(mesh, t, edge) * barycentric_gradients(mesh, t)(k, axis);
  WeightedJump jump;
  if (factor == 0) return jump;
  const auto add_side = [&](int side, double sign) {
    const auto [mean, difference] = trace(space, side, edge);
    add(jump.mean, sign * factor, mean);
    add(jump.difference, sign * factor, difference);
  };
  add_side(t, 1);
  const int other = mesh.edge_triangles(edge, 0) == t ? mesh.edge_triangles(edge, 1)
                                                      : mesh.edge_triangles(edge, 0);
  if (other >= 0) add_side(other, -1);
  return jump;
}

void check_method(const Space& space, const InteriorPenalty& method) {
  const Element& element = space.element();
  require_triangles(space.mesh(), "interior penalty");
  if (element.degree() != 1 || element.dofs_per_cell() != element.dofs())
    throw Error("interior penalty: element " + element.name() +
                " is not accepted; P1dc (discontinuous_p1)");
  if (!(method.gamma > 1 && std::isfinite(method.gamma)))
    throw NotConverged(fmt::format("interior penalty: with gamma = {:.6g} the form need not be "
                                   "coercive; accepted: more than 1",
                                   method.gamma),
                       1, 0);
}

void put_row(FactoredFormBuilder& rows, const TriangleMesh& mesh, int t,
             const LinearFunction& row) {
  rows.add(t, mesh.area(t));
  for (const auto& [unknown, coefficient] : row) rows.put(unknown, coefficient);
}

}  // namespace

FactoredForm interior_penalty_form(const Space& space, Region region, int axis,
                                   const InteriorPenalty& method) {
  check_method(space, method);
  const TriangleMesh& mesh = space.mesh();
  const double root = std::sqrt(3 * method.gamma),
               alpha = (1 - std::sqrt(1 - 1 / method.gamma)) / 3;
  FactoredFormBuilder rows;
  std::vector<std::pair<int, LinearFunction>> penalties;  // triangle, row
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != region) continue;
    std::array<WeightedJump, 3> jumps;
    LinearFunction sum;
    for (int k = 0; k < 3; ++k) {
      jumps[k] = weighted_jump(space, t, k, axis);
      add(sum, 1, jumps[k].mean);
    }
    const Eigen::Vector3d centroid = Eigen::Vector3d::Constant(1.0 / 3);
    const Eigen::MatrixX3d basis_derivative = space.element().derivative(centroid);
    LinearFunction derivative =
        on_triangle(space, t, basis_derivative * barycentric_gradients(mesh, t).col(axis));
    add(derivative, -1, sum);
    put_row(rows, mesh, t, derivative);
    if (sum.empty()) continue;
    for (const WeightedJump& jump : jumps) {
      LinearFunction penalty;
      add(penalty, root, jump.mean);
      add(penalty, -root * alpha, sum);
      penalties.emplace_back(t, std::move(penalty));
    }
    for (const WeightedJump& jump : jumps) {
      if (method.penalised != PenalisedJump::whole || jump.difference.empty()) continue;
      LinearFunction penalty;
      add(penalty, std::sqrt(method.gamma / 4), jump.difference);
      penalties.emplace_back(t, std::move(penalty));
    }
  }
  for (const auto& [t, row] : penalties) put_row(rows, mesh, t, row);
  return rows.form(space.size());
}

}  // namespace antilock
