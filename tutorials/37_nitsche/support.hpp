#pragma once
#include <fmt/format.h>

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// An edge on Gamma_C: its two vertices, its length, and the row of B of its triangle.
struct NitscheEdge {
  int from, to;
  double length;
  Eigen::Index row;
};

/// (23) with P1 on a mesh whose layer has vertical lines. The two triangles at a vertical
/// edge have the same slope, so their rows of B are equal: `problem.b` has one row per
/// vertical edge, `problem.m` the area of both triangles, and the rows are linearly
/// independent.
struct NitscheProblem {
  VariationalInequality problem;
  std::vector<NitscheEdge> contact_edges;
  /// The largest |E| / |T| of an edge E on Gamma_C and its triangle T.
  double largest_ratio = 0;
};

inline int vertical_edge(const TriangleMesh& mesh, int t) {
  for (const int e : mesh.triangle_edges.row(t))
    if (mesh.vertices(mesh.edges(e, 0), 0) == mesh.vertices(mesh.edges(e, 1), 0)) return e;
  throw Error("Nitsche: the triangle at " + mesh.location_text(mesh.triangles(t, 0)) +
              " has no vertical edge; accepted: a layer in columns");
}

inline NitscheProblem nitsche_problem(const Scene& scene, const Space& space) {
  const TriangleMesh& mesh = space.mesh();
  NitscheProblem columns{assemble(scene, space), {}};
  VariationalInequality& problem = columns.problem;
  std::map<int, Eigen::Index> row_of_edge;
  Triplets entries;
  std::vector<double> weights;
  Eigen::Index old_row = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    const auto [place, is_new] =
        row_of_edge.try_emplace(vertical_edge(mesh, t), Eigen::Index(weights.size()));
    if (is_new) {
      weights.push_back(0);
      for (RowMatrix::InnerIterator entry(problem.b, old_row); entry; ++entry)
        entries.emplace_back(int(place->second), int(entry.col()), entry.value());
    }
    weights[place->second] += problem.m(old_row);
    ++old_row;
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      if (mesh.edge_tag[e] != EdgeTag::contact) continue;
      columns.contact_edges.push_back(
          {mesh.edges(e, 0), mesh.edges(e, 1), mesh.edge_length(e), place->second});
      columns.largest_ratio =
          std::max(columns.largest_ratio, mesh.edge_length(e) / mesh.area(t));
    }
  }
  problem.b = from_triplets<RowMatrix>(Eigen::Index(weights.size()), space.size(), entries);
  problem.m =
      Eigen::Map<const Eigen::VectorXd>(weights.data(), Eigen::Index(weights.size()));
  return columns;
}

/// The parameters of Nitsche's method for contact. gamma is slope / epsilon^2, so that
/// slope is gamma_0 / h, or epsilon^2 gamma_0 / h where gamma does not contain the
/// stiffness of the layer. theta is 1, 0 or -1.
struct Nitsche {
  double slope;
  double theta = 1;
};

struct NitscheSolution {
  Eigen::VectorXd u, p;
  int steps = 0;
  bool converged = false;
};

/// Returns (1 + theta)^2 / 4 times the largest |E| / |T|, the bound on `slope` above which
/// the method is strongly monotone.
inline double least_slope(const NitscheProblem& columns, const Nitsche& method) {
  return std::pow(1 + method.theta, 2) / 4 * columns.largest_ratio;
}

/// Throws NotConverged where gamma is not above the bound, so that the method need not be
/// monotone.
inline void check_monotone(const NitscheProblem& columns, const Nitsche& method) {
  const double least = least_slope(columns, method);
  if (!(method.slope > least))
    throw NotConverged(
        fmt::format("Nitsche: with gamma = {:.6g} epsilon^-2 and theta = {:g} the method "
                    "need not be monotone on this mesh; accepted: gamma above {:.6g} "
                    "epsilon^-2",
                    method.slope, method.theta, least),
        1, 0);
}

/// One Newton step of the split form: the residuals of
///
///     A1 u + B' M p - sum_q w_q ((theta / slope) (p + [P]_+) B' + [P]_+ phi) = L
///     M (B u - epsilon^2 p) = 0,   P = -p - gamma u
///
/// at the Gauss points q of the contact edges, their derivative, and the points with P > 0.
class NitscheSystem {
 public:
  NitscheSystem(const NitscheProblem& columns, const Nitsche& method)
      : columns_(columns), method_(method) {
    const VariationalInequality& problem = columns.problem;
    place_.assign(problem.size(), 0);
    for (const int i : problem.dirichlet_dofs) place_[i] = -1;
    for (int& place : place_)
      if (place == 0) place = free_++;
    const auto add = [&](int row, int column, double value) {
      if (row >= 0 && column >= 0) fixed_.emplace_back(row, column, value);
    };
    for (int column = 0; column < problem.a1.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(problem.a1, column); entry; ++entry)
        add(place_[entry.row()], place_[column], entry.value());
    for (int row = 0; row < problem.b.rows(); ++row) {
      for (RowMatrix::InnerIterator entry(problem.b, row); entry; ++entry) {
        const double value = problem.m(row) * entry.value();
        add(place_[entry.col()], free_ + row, value);
        add(free_ + row, place_[entry.col()], value);
      }
      fixed_.emplace_back(free_ + row, free_ + row, -problem.compliance * problem.m(row));
    }
  }

  /// Solves for the step (u, p) -> (u, p) + step, and returns the statuses of the points
  /// before it.
  std::vector<char> step(Eigen::VectorXd& u, Eigen::VectorXd& p, double& change) const {
    const VariationalInequality& problem = columns_.problem;
    const double gamma = method_.slope / problem.compliance;
    Eigen::VectorXd of_u =
        problem.a1 * u + problem.b.transpose() * problem.m.cwiseProduct(p) - problem.load;
    const Eigen::VectorXd of_p =
        problem.m.cwiseProduct(problem.b * u - problem.compliance * p);
    Triplets entries = fixed_;
    std::vector<char> statuses;
    const auto [points, weights] = gauss_rule(3);
    for (const NitscheEdge& edge : columns_.contact_edges)
      for (Eigen::Index q = 0; q < points.size(); ++q) {
        const double weight = weights(q) * edge.length;
        const std::pair<int, double> hats[] = {{edge.from, 1 - points(q)},
                                               {edge.to, points(q)}};
        const double here = hats[0].second * u(edge.from) + hats[1].second * u(edge.to);
        const double force = -p(edge.row) - gamma * here;
        const bool active = force > 0;
        statuses.push_back(active ? 1 : 0);
        // p + [P]_+, which is -gamma u where P > 0: no difference of large numbers is taken
        const double mean = active ? -gamma * here : p(edge.row);
        const double of_slope = -weight * method_.theta / method_.slope;
        for (RowMatrix::InnerIterator b(problem.b, edge.row); b; ++b) {
          of_u(b.col()) += of_slope * mean * b.value();
          if (!active)
            put(entries, place_[b.col()], free_ + int(edge.row), of_slope * b.value());
          for (const auto& [vertex, value] : hats)
            if (active)
              put(entries, place_[b.col()], place_[vertex],
                  -of_slope * gamma * value * b.value());
        }
        for (const auto& [row, value] : hats) {
          if (!active) continue;
          of_u(row) -= weight * force * value;
          put(entries, place_[row], free_ + int(edge.row), weight * value);
          for (const auto& [column, other] : hats)
            put(entries, place_[row], place_[column], weight * gamma * value * other);
        }
      }
    solve(entries, of_u, of_p, u, p, change);
    return statuses;
  }

 private:
  static void put(Triplets& entries, int row, int column, double value) {
    if (row >= 0 && column >= 0) entries.emplace_back(row, column, value);
  }
  void solve(const Triplets& entries, const Eigen::VectorXd& of_u,
             const Eigen::VectorXd& of_p, Eigen::VectorXd& u, Eigen::VectorXd& p,
             double& change) const {
    const auto size = free_ + p.size();
    Eigen::VectorXd right(size);
    for (std::size_t i = 0; i < place_.size(); ++i)
      if (place_[i] >= 0) right(place_[i]) = -of_u(Eigen::Index(i));
    right.tail(p.size()) = -of_p;
    const Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(
        from_triplets<Eigen::SparseMatrix<double>>(size, size, entries));
    if (factor.info() != Eigen::Success)
      throw NotConverged("Nitsche: the matrix of a Newton step is singular", 1, 0);
    const Eigen::VectorXd found = factor.solve(right);
    change = found.head(free_).cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < place_.size(); ++i)
      if (place_[i] >= 0) u(Eigen::Index(i)) += found(place_[i]);
    p += found.tail(p.size());
  }

  const NitscheProblem& columns_;
  Nitsche method_;
  std::vector<int> place_;  ///< N: the number of a free unknown; -1 for the others
  int free_ = 0;
  Triplets fixed_;  ///< of A1, B and the compliance
};

/// Runs Newton's method from u = 0 until the statuses of the Gauss points repeat and u
/// changes by less than 1e-9 of its largest value. `converged` tells whether this happened
/// within `most_steps`.
inline NitscheSolution solve_nitsche(const NitscheProblem& columns, const Nitsche& method,
                                     int most_steps = 40) {
  const NitscheSystem system(columns, method);
  NitscheSolution solution{Eigen::VectorXd::Zero(columns.problem.size()),
                           Eigen::VectorXd::Zero(columns.problem.b.rows())};
  std::vector<char> before;
  while (solution.steps < most_steps && !solution.converged) {
    double change = 0;
    const std::vector<char> statuses = system.step(solution.u, solution.p, change);
    ++solution.steps;
    if (!solution.u.allFinite()) return solution;
    solution.converged =
        statuses == before && change <= 1e-9 * solution.u.cwiseAbs().maxCoeff();
    before = statuses;
  }
  return solution;
}

}  // namespace antilock::tutorial
