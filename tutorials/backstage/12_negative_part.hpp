#pragma once
#include <cmath>

#include "antilock/analysis/inf_sup.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/form/quadrature.hpp"
#include "antilock/measure/detail/contact_edges.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/space/space.hpp"

namespace antilock::tutorial {

/// The constant c_h of condition (9) of Definition 1: |min(v_h, 0)| <= c_h |v_h|_h in L2(Gamma_C) for v_h in K_h
/// (bounds 0), since where v_h >= 0 at its points on an edge the part below 0 is no larger than what separates v_h from
/// the function through those points: the mean (CR: |E| (v_b - v_a)^2 / 12 for the square), the two chords (P2: |E|
/// (v_a - 2 v_m + v_b)^2 / 120), nothing (P1: c_h = 0). The largest eigenvalue over V_h, so an upper bound.
struct NegativePart {
  double constant = 0;    ///< c_h
  Eigen::VectorXd worst;  ///< the v_h of norm 1 that is furthest from that function; empty for P1
};

/// `norm`: h1_norm. Where the bounded unknowns of `problem` are fixed to 0, CR's worst v_h is in K_h, and what it has
/// below 0 is c_h / 2^(1/2). Dense in the edges of Gamma_C. Throws Error for other elements.
inline NegativePart negative_part(const Space& space, VariationalInequality problem, const SparseMatrix& norm) {
  const Element& element = space.element();
  const bool quadratic = element.degree() == 2;
  if (element.conforming() && element.degree() == 1) return {};
  if (element.degree() > 2)
    throw Error("negative part on Gamma_C: element " + element.name() + " is not accepted; P1, P2 or CR");
  const std::vector<ContactEdge> edges = contact_edges(space.mesh());
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < static_cast<int>(edges.size()); ++row) {
    const ContactEdge& edge = edges[row];
    const auto at = [&](double s) { return element.basis(on_edge(edge.opposite, s)); };
    Eigen::VectorXd hidden = std::sqrt(edge.length / 12) * (at(1) - at(0));
    if (quadratic) hidden = std::sqrt(edge.length / 120) * (at(0) - 2 * at(0.5) + at(1));
    for (Eigen::Index i = 0; i < hidden.size(); ++i)
      entries.emplace_back(row, space.unknowns()(edge.triangle, i), hidden(i));
  }
  problem.b.resize(static_cast<Eigen::Index>(edges.size()), space.size());
  problem.b.setFromTriplets(entries.begin(), entries.end());
  problem.m = Eigen::VectorXd::Ones(problem.b.rows());
  // sup |B v|^2 / |v|_h^2 is the largest eigenvalue mu of B norm^-1 B'; it is reached where norm v = B' x
  const SymmetricEigen seen = symmetric_eigen(multiplier_gram(problem, norm));
  const double largest = seen.values.tail(1)(0);
  problem.load = problem.b.transpose() * seen.vectors.rightCols(1);
  problem.a1 = norm;
  problem.b.resize(0, problem.size());
  problem.m.resize(0);
  const std::vector<bool> none(problem.contact.size());
  return {std::sqrt(largest), active_set(held_in_contact(problem, none)).u / std::sqrt(largest)};
}

}  // namespace antilock::tutorial
