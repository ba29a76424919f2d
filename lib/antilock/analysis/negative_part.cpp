#include "antilock/analysis/negative_part.hpp"

#include <cmath>

#include "antilock/analysis/inf_sup.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/measure/contact_edges.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

NegativePart negative_part(const Space& space, VariationalInequality problem,
                           const SparseMatrix& norm) {
  const Element& element = space.element();
  const bool quadratic = element.degree() == 2;
  if (element.conforming() && element.degree() == 1) return {};
  if (element.degree() > 2 || !element.nodal())
    throw Error("negative part on Gamma_C: element " + element.name() +
                " is not accepted; P1, P2 or CR");
  const std::vector<ContactEdge> edges = contact_edges(space.mesh());
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < static_cast<int>(edges.size()); ++row) {
    const ContactEdge& edge = edges[row];
    const auto at = [&](double s) { return element.basis(on_edge(edge.opposite, s)); };
    Eigen::VectorXd hidden = std::sqrt(edge.length / 12) * (at(1) - at(0));
    if (quadratic) hidden = std::sqrt(edge.length / 120) * (at(0) - 2 * at(0.5) + at(1));
    for (Eigen::Index i = 0; i < hidden.size(); ++i)
      entries.emplace_back(row, space.cell_dofs()(edge.triangle, i), hidden(i));
  }
  problem.b.resize(static_cast<Eigen::Index>(edges.size()), space.size());
  problem.b.setFromTriplets(entries.begin(), entries.end());
  problem.m = Eigen::VectorXd::Ones(problem.b.rows());
  // sup |B v|^2 / |v|_h^2 is the largest eigenvalue mu of B norm^-1 B'; it is reached where norm
  // v = B' x
  const SymmetricEigen seen = symmetric_eigen(multiplier_gram(problem, norm));
  const double largest = seen.values.tail(1)(0);
  problem.load = problem.b.transpose() * seen.vectors.rightCols(1);
  problem.a1 = norm;
  problem.b.resize(0, problem.size());
  problem.m.resize(0);
  const std::vector<bool> none(problem.bounds.unknowns.size());
  return {std::sqrt(largest),
          active_set(equality_constrained(problem, none)).u / std::sqrt(largest)};
}

}  // namespace antilock
