#include "antilock/models/timoshenko_beam.hpp"

#include <fmt/format.h>

#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/form/sparse_assembly.hpp"

namespace antilock {
namespace {

void require(bool holds, const char* name, double value, const char* accepted) {
  if (!holds) throw Error(fmt::format("beam: {} = {}; accepted {}", name, value, accepted));
}

}  // namespace

VariationalInequality assemble(const Beam& beam) {
  require(beam.cells >= 2, "cells", beam.cells, "2 or more");
  require(beam.epsilon >= 0 && beam.epsilon <= 1, "epsilon", beam.epsilon, "0 to 1");
  require(beam.gap > 0 && std::isfinite(beam.gap), "gap", beam.gap, "a positive number");
  require(std::isfinite(beam.load), "load", beam.load, "a finite number");
  const int n = beam.cells;
  const double h = 1.0 / n;
  const auto w = [](int node) { return 2 * node; };
  const auto theta = [](int node) { return 2 * node + 1; };

  VariationalInequality problem;
  Triplets a1;
  FactoredFormBuilder rows;
  problem.load = Eigen::VectorXd::Zero(2 * n + 2);
  const double s = 0.5 / std::sqrt(3.0);
  const std::vector<double> points =
      beam.shear == ShearIntegration::full ? std::vector{0.5 - s, 0.5 + s} : std::vector{0.5};
  for (int i = 0; i < n; ++i) {
    // int theta' phi'
    for (const int j : {i, i + 1})
      for (const int k : {i, i + 1}) a1.emplace_back(theta(j), theta(k), (j == k ? 1 : -1) / h);
    // a row of B is w' - theta at a point of the cell
    for (const double x : points) {
      rows.add(i, h / static_cast<double>(points.size()));
      rows.put(w(i), -1 / h);
      rows.put(w(i + 1), 1 / h);
      rows.put(theta(i), -(1 - x));
      rows.put(theta(i + 1), -x);
    }
    problem.load(w(i)) -= 0.5 * h * beam.load;
    problem.load(w(i + 1)) -= 0.5 * h * beam.load;
  }
  problem.a1 = from_triplets<SparseMatrix>(2 * n + 2, 2 * n + 2, a1);
  FactoredForm strain = rows.form(2 * n + 2);
  problem.b.swap(strain.b);
  problem.m.swap(strain.m);
  problem.compliance = beam.epsilon;  // here the class parameter is epsilon itself
  problem.dirichlet_dofs = {w(0), theta(0), w(n), theta(n)};
  problem.dirichlet_values = Eigen::VectorXd::Zero(4);
  std::vector<int> inside;
  for (int i = 1; i < n; ++i) inside.push_back(w(i));
  problem.bounds = Bounds::lower_on(inside, Eigen::VectorXd::Constant(n - 1, -beam.gap));
  return problem;
}

}  // namespace antilock
