#include "antilock/measure/contact_trace.hpp"

#include <algorithm>
#include <cmath>

#include "antilock/measure/contact_edges.hpp"
#include "antilock/measure/inf_sup.hpp"
#include "antilock/scene/error.hpp"

namespace antilock {
Eigen::MatrixX3d contact_trace(const Space& space, const Eigen::VectorXd& v, int points) {
  std::vector<Eigen::RowVector3d> samples;
  for (const ContactEdge& edge : contact_edges(space.mesh()))
    for (int k = 0; k < points; ++k) {
      const Eigen::Vector3d lambda = edge.lambda((k + 0.5) / points);
      const double value = space.element().basis(lambda).dot(v(space.unknowns().row(edge.triangle)));
      samples.emplace_back(point_in(space.mesh(), edge.triangle, lambda)(0), value, edge.length / points);
    }
  std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a(0) < b(0); });
  Eigen::MatrixX3d trace(samples.size(), 3);
  for (std::size_t k = 0; k < samples.size(); ++k) trace.row(static_cast<Eigen::Index>(k)) = samples[k];
  return trace;
}

double negative_part_constant(const Space& space, VariationalInequality problem, const SparseMatrix& norm) {
  const Element& element = space.element();
  if (element.name() == "P1") return 0;
  if (element.name() != "CR" && element.name() != "P2")
    throw Error("negative part on Gamma_C: element " + element.name() + " is not accepted; P1, P2 or CR");
  const std::vector<ContactEdge> edges = contact_edges(space.mesh());
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < static_cast<int>(edges.size()); ++row) {
    const ContactEdge& edge = edges[row];
    const auto at = [&](double s) { return element.basis(edge.lambda(s)); };
    Eigen::VectorXd hidden = std::sqrt(edge.length / 12) * (at(1) - at(0));
    if (element.name() == "P2") hidden = std::sqrt(edge.length / 120) * (at(0) - 2 * at(0.5) + at(1));
    for (Eigen::Index i = 0; i < hidden.size(); ++i)
      entries.emplace_back(row, space.unknowns()(edge.triangle, i), hidden(i));
  }
  problem.b.resize(static_cast<Eigen::Index>(edges.size()), space.size());
  problem.b.setFromTriplets(entries.begin(), entries.end());
  problem.m = Eigen::VectorXd::Ones(problem.b.rows());
  const Eigen::MatrixXd seen = multiplier_gram(problem, norm);  // sup |B v|^2 / |v|_h^2 is its largest eigenvalue
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(seen, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
}

}  // namespace antilock
