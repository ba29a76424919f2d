#pragma once
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

#include "antilock/analysis/layer_components.hpp"
#include "antilock/form/edge_forms.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/io/write_vtu.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// Returns N_T of the chapter, the number of triangles in the layer.
inline int layer_triangles(const TriangleMesh& mesh) {
  return static_cast<int>(
      std::count(mesh.region.begin(), mesh.region.end(), Region::layer));
}

/// Returns N_E of the chapter, the number of edges between two triangles of the layer that
/// are not vertical up to round-off.
inline int stiff_edges(const TriangleMesh& mesh) {
  int count = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const bool in_layer = mesh.region[mesh.edge_triangles(e, 0)] == Region::layer;
    if (mesh.edge_tag[e] != EdgeTag::interior || !in_layer) continue;
    const double dx =
        mesh.vertices(mesh.edges(e, 1), 0) - mesh.vertices(mesh.edges(e, 0), 0);
    count += std::abs(dx) > 1e-9 * mesh.edge_length(e) ? 1 : 0;
  }
  return count;
}

/// Returns T values: the integral of the load over each triangle, by the rule of
/// load_vector.
inline Eigen::VectorXd load_on_triangles(const Scene& scene, const Space& edges) {
  const Space triangles(edges, discontinuous_p1());
  const Eigen::VectorXd load = load_of(scene, triangles);
  Eigen::VectorXd total(edges.mesh().triangle_count());
  for (Eigen::Index t = 0; t < total.size(); ++t)
    total(t) = load(triangles.cell_dofs().row(t)).sum();
  return total;
}

/// Returns E values: the average of u over both sides at the midpoint of an edge. On Sigma
/// it is the value on the side of the layer, and on a clamped edge 0.
inline Eigen::VectorXd averages_on_edges(const Space& triangles, const Eigen::VectorXd& u) {
  const TriangleMesh& mesh = triangles.mesh();
  Eigen::VectorXd average = Eigen::VectorXd::Zero(mesh.edge_count());
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      double weight = mesh.edge_tag[e] == EdgeTag::interior ? 0.5 : 1;
      if (is_dirichlet(mesh.edge_tag[e])) weight = 0;
      if (mesh.edge_tag[e] == EdgeTag::sigma && mesh.region[t] == Region::body) weight = 0;
      average(e) += weight * u(triangles.cell_dofs()(t, i));
    }
  return average;
}

/// Values on the E edges of a Crouzeix-Raviart space, and the mean stress of each triangle
/// (T x 2).
struct EdgeSolution {
  Eigen::VectorXd u;
  Eigen::MatrixX2d stress;
};

/// Assembles (23) with Crouzeix-Raviart and the load sum_T mean(v) int_T f.
inline VariationalInequality crouzeix_raviart_problem(const Scene& scene,
                                                      const Space& edges) {
  VariationalInequality problem = assemble(scene, edges);
  const Eigen::VectorXd total = load_on_triangles(scene, edges);
  problem.load.setZero();
  for (Eigen::Index t = 0; t < total.size(); ++t)
    for (const int e : edges.cell_dofs().row(t)) problem.load(e) += total(t) / 3;
  return problem;
}

/// Returns the stress of values on the edges, p in the layer (one number per triangle of
/// the layer).
inline EdgeSolution edge_solution(const Space& edges, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& p) {
  const TriangleMesh& mesh = edges.mesh();
  EdgeSolution solution{u.head(edges.size()), Eigen::MatrixX2d(mesh.triangle_count(), 2)};
  Eigen::Index row = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3d values = u(edges.cell_dofs().row(t));
    solution.stress.row(t) = -2 * values.transpose() * barycentric_gradients(mesh, t);
    if (mesh.region[t] == Region::layer) solution.stress(t, 1) = p(row++);
  }
  return solution;
}

/// Returns one component of the hybrid high-order form of degree 0 on a region, in factors:
/// the gradient of the reconstruction r with the weight |T|, and n_k delta_k with the
/// weight |E_k| / h_k = 1, delta_k = u_k - r(x_k). The unknowns are those of E edges, then
/// those of T triangles. The rows are all gradients, then all penalties.
inline FactoredForm hybrid_rows(const Space& edges, Region region, int axis) {
  const TriangleMesh& mesh = edges.mesh();
  FactoredFormBuilder rows;
  const auto each = [&](const auto& act) {
    for (int t = 0; t < mesh.triangle_count(); ++t)
      if (mesh.region[t] == region)
        act(t, barycentric_gradients(mesh, t));  // -2 |T| grad lambda_k = |E_k| n_k
  };
  each([&](int t, const Eigen::Matrix<double, 3, 2>& gradients) {
    rows.add(t, mesh.area(t));
    for (int k = 0; k < 3; ++k) rows.put(edges.cell_dofs()(t, k), -2 * gradients(k, axis));
  });
  each([&](int t, const Eigen::Matrix<double, 3, 2>& gradients) {
    const Eigen::Vector2d centroid = point_in(mesh, t, Eigen::Vector3d::Constant(1.0 / 3));
    for (int k = 0; k < 3; ++k) {
      const double normal = -gradients(k, axis) / gradients.row(k).norm();
      if (normal == 0) continue;
      const int edge = edges.cell_dofs()(t, k);
      const Eigen::Vector2d off_centre =
          edges.dof_coordinates().row(edge).transpose() - centroid;
      rows.add(t, 1);
      rows.put(edge, normal);
      rows.put(edges.size() + t, -normal);
      for (int j = 0; j < 3; ++j)
        rows.put(edges.cell_dofs()(t, j), 2 * normal * gradients.row(j).dot(off_centre));
    }
  });
  return rows.form(edges.size() + mesh.triangle_count());
}

/// Assembles (23) by the hybrid high-order method of degree 0. The unknowns are those of E
/// edges, then those of T triangles.
inline VariationalInequality hybrid_problem(const Scene& scene, const Space& edges) {
  const VariationalInequality base = assemble(scene, edges);
  const int size = edges.size() + edges.mesh().triangle_count();
  VariationalInequality problem;
  problem.a1.resize(size, size);
  for (const auto& [region, axis] :
       {std::pair{Region::body, 0}, {Region::body, 1}, {Region::layer, 0}}) {
    FactoredForm rows = hybrid_rows(edges, region, axis);
    const auto count = rows.m.size();
    problem.a1 += gram_matrix({std::move(rows), Eigen::VectorXd::Ones(count)});
  }
  const FactoredForm across = hybrid_rows(edges, Region::layer, 1);
  problem.b = across.b;
  problem.m = across.m;
  problem.compliance = base.compliance;
  problem.load.resize(size);
  problem.load << Eigen::VectorXd::Zero(edges.size()), load_on_triangles(scene, edges);
  problem.dirichlet_dofs = base.dirichlet_dofs;
  problem.dirichlet_values = base.dirichlet_values;
  problem.bounds = base.bounds;
  return problem;
}

/// The solution of (23) by the hybridised Raviart-Thomas method of lowest order, and the
/// residual fluxes on the edges of the contact set, which are the contact forces.
struct RaviartThomas {
  EdgeSolution solution;
  Eigen::VectorXd force;  ///< E
};
/// Solves (23) by this method with a given contact set: edges that are clamped or `held`
/// have the value 0. The unknowns are 3 T fluxes through edges, T values on triangles, and
/// E on edges.
inline RaviartThomas raviart_thomas(const Scene& scene, const Space& edges,
                                    const std::vector<int>& held) {
  const TriangleMesh& mesh = edges.mesh();
  const int triangles = mesh.triangle_count(), first_value = 3 * triangles,
            first_edge = 4 * triangles;
  const int size = first_edge + edges.size();
  const double compliance = class_parameter(std::get<StiffLayer>(scene.layer()));
  std::vector<char> fixed(edges.size(), 0);
  for (const int e : edges.dirichlet_dofs()) fixed[e] = 1;
  for (const int e : held) fixed[e] = 1;
  // psi_k = (x - P_k) / (2 |T|), P_k the vertex opposite: the flux 1 through edge k and 0
  // through the others
  const auto psi = [&](int t, int k, const Eigen::Vector2d& x) {
    return Eigen::Vector2d((x - mesh.vertices.row(mesh.triangles(t, k)).transpose()) /
                           mesh.twice_area(t));
  };
  Triplets entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  right.segment(first_value, triangles) = load_on_triangles(scene, edges);
  const Quadrature& rule = midpoint_rule();  // exact for the products
  for (int t = 0; t < triangles; ++t) {
    const Eigen::Vector2d inverse(1, mesh.region[t] == Region::layer ? compliance : 1);
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) {
        double product = 0;
        for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
          const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
          product += rule.weights(q) * mesh.area(t) *
                     inverse.cwiseProduct(psi(t, k, x)).dot(psi(t, j, x));
        }
        entries.emplace_back(3 * t + k, 3 * t + j, product);
      }
      const int edge = first_edge + edges.cell_dofs()(t, k);
      entries.emplace_back(3 * t + k, first_value + t, 1);   // + u_T int div psi_k
      entries.emplace_back(first_value + t, 3 * t + k, -1);  // -int div sigma = int f
      entries.emplace_back(3 * t + k, edge, -1);             // -u_E times the flux of psi_k
      if (!fixed[edge - first_edge]) entries.emplace_back(edge, 3 * t + k, 1);
    }
  }
  for (int e = 0; e < edges.size(); ++e)
    if (fixed[e]) entries.emplace_back(first_edge + e, first_edge + e, 1);
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(
      from_triplets<Eigen::SparseMatrix<double>>(size, size, entries));
  if (factor.info() != Eigen::Success)
    throw NotConverged("Raviart-Thomas: the matrix is singular", 1, 0);
  const Eigen::VectorXd all = factor.solve(right);
  RaviartThomas found{{all.tail(edges.size()), Eigen::MatrixX2d(triangles, 2)},
                      Eigen::VectorXd::Zero(edges.size())};
  for (int t = 0; t < triangles; ++t) {
    const Eigen::Vector2d centroid = point_in(mesh, t, Eigen::Vector3d::Constant(1.0 / 3));
    Eigen::Vector2d mean(0, 0);
    for (int k = 0; k < 3; ++k) {
      mean += all(3 * t + k) * psi(t, k, centroid);
      found.force(edges.cell_dofs()(t, k)) += all(3 * t + k);
    }
    found.solution.stress.row(t) = mean;
  }
  return found;
}

/// Compares Crouzeix-Raviart with the mean load, the hybrid high-order method and the
/// hybridised Raviart-Thomas method on one mesh. Returns relative differences of the values
/// on the edges and of the mean stresses, and the smallest of the gaps and contact forces
/// of Raviart-Thomas on Gamma_C (relative), which must not be negative.
inline Table compare_hybrid_methods(const TriangleMesh& mesh) {
  const Space edges(mesh, crouzeix_raviart());
  Table table({"method", "epsilon", "displacement", "stress", "sign"});
  for (const double epsilon : {1e-1, 1e-3, 1e-6, 0.0}) {
    const Scene scene = paper_scene(epsilon);
    const VariationalInequality problem = crouzeix_raviart_problem(scene, edges);
    const Solution solution = active_set(problem),
                   high_order = active_set(hybrid_problem(scene, edges));
    const EdgeSolution cr = edge_solution(edges, solution.u, solution.p);
    std::vector<int> held;
    for (std::size_t i = 0; i < problem.bounds.unknowns.size(); ++i)
      if (solution.active[i]) held.push_back(problem.bounds.unknowns[i]);
    const RaviartThomas mixed = raviart_thomas(scene, edges, held);
    const auto add = [&](const char* name, const EdgeSolution& other, double sign) {
      table.add({name, epsilon,
                 (other.u - cr.u).cwiseAbs().maxCoeff() / cr.u.cwiseAbs().maxCoeff(),
                 (other.stress - cr.stress).cwiseAbs().maxCoeff() /
                     cr.stress.cwiseAbs().maxCoeff(),
                 sign});
    };
    const Eigen::VectorXd gaps = mixed.solution.u(problem.bounds.unknowns),
                          forces = mixed.force(problem.bounds.unknowns);
    add("hybrid high-order", edge_solution(edges, high_order.u, high_order.p),
        high_order.kkt.min_gap);
    add("Raviart-Thomas", mixed.solution,
        std::min(gaps.minCoeff() / gaps.maxCoeff(), forces.minCoeff() / forces.maxCoeff()));
  }
  return table;
}

}  // namespace antilock::tutorial
