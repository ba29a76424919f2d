#pragma once
#include <functional>

#include "common/course.hpp"

namespace antilock::tutorial {

/// (23) without contact, its stiff lines of slope 2: (d/dx + 2 d/dy)/sqrt(5) in the place of d/dy.
inline VariationalInequality turned(const Space& space, double epsilon) {
  VariationalInequality problem = assemble(Scene(Body{paper_load}, StiffLayer{epsilon}), space);
  std::vector<Eigen::Triplet<double>> entries;
  for (int t = 0, row = 0; t < space.mesh().triangle_count(); ++t) {
    if (space.mesh().region[t] != Region::layer) continue;
    const Eigen::VectorXd slopes =
        space.element().derivative(Eigen::Vector3d::Constant(1.0 / 3)) * barycentric_gradients(space.mesh(), t).col(0);
    for (int i = 0; i < slopes.size(); ++i) entries.emplace_back(row, space.unknowns()(t, i), slopes(i));
    ++row;
  }
  RowMatrix d_x(problem.b.rows(), problem.b.cols());
  d_x.setFromTriplets(entries.begin(), entries.end());
  const RowMatrix across = (2 * d_x - problem.b) / std::sqrt(5.0), along = (d_x + 2 * problem.b) / std::sqrt(5.0);
  const auto energy = [&](const RowMatrix& d) { return SparseMatrix(d.transpose() * problem.m.asDiagonal() * d); };
  problem.a1 += energy(across) - energy(d_x);
  problem.b = along;
  return problem;
}

/// Six methods at six epsilons, solved by `solve`: method, epsilon, u (the largest -u on Sigma), from_limit (the distance
/// from its own solution at epsilon = 0, relative).
inline Table turn_the_lines(int cells, const std::function<Eigen::VectorXd(const VariationalInequality&)>& cure) {
  Table rows({"method", "epsilon", "u", "from_limit"});
  const auto solve = [&](const Discretisation& on, double epsilon) { return cure(turned(on.space(), epsilon)); };
  const auto largest = [](const Discretisation& on, const Eigen::VectorXd& u) {
    double most = 0;
    for (int i = 0; i < u.size(); ++i)
      if (std::abs(on.space().points()(i, 1)) < 1e-12) most = std::max(most, -u(i));
    return most;
  };
  const auto add = [&](const std::string& name, const Discretisation& on) {
    const Eigen::VectorXd limit = solve(on, 0);
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6}) {
      const Eigen::VectorXd u = solve(on, epsilon);
      rows.add({name, epsilon, largest(on, u), (u - limit).norm() / limit.norm()});
    }
  };
  const auto along = [](int n) {  // its layer has cells of h x 2h: each diagonal / is a line
    TriangleMesh mesh = structured_mesh(n, {0.5});
    for (auto vertex : mesh.vertices.rowwise())
      if (vertex(1) < 0) vertex(1) *= 2;
    return mesh;
  };
  add("P1 along, 4 times finer", Discretisation(along(4 * cells), p1()));
  add("P1 along", Discretisation(along(cells), p1()));
  add("P1 structured", Discretisation(structured_mesh(cells), p1()));
  add("P1 unstructured", Discretisation(unstructured_mesh(cells), p1()));
  add("CR structured", Discretisation(structured_mesh(cells), crouzeix_raviart()));
  add("CR unstructured", Discretisation(unstructured_mesh(cells), crouzeix_raviart()));
  return rows;
}

}  // namespace antilock::tutorial
