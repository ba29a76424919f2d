#include "common/two_strings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock::tutorial {

double hat(int cells, int i, double x) {
  const double t = x * cells;
  return std::max(0.0, t < i ? t - (i - 1) : i + 1 - t);
}

Eigen::RowVectorXd difference(const Strings& s, double x) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(s.size());
  for (int i = 0; i <= s.upper_cells(); ++i) row(s.upper(i)) = hat(s.upper_cells(), i, x);
  for (int i = 0; i <= s.cells; ++i) row(s.lower(i)) = -hat(s.cells, i, x);
  return row;
}

std::vector<Place> gauss_points(const Strings& s) {
  std::vector<double> corners;
  for (int i = 0; i <= s.cells; ++i) corners.push_back(static_cast<double>(i) / s.cells);
  for (int i = 1; i < s.upper_cells(); ++i) corners.push_back(static_cast<double>(i) / s.upper_cells());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<Place> places;
  for (std::size_t piece = 0; piece + 1 < corners.size(); ++piece)
    for (const double sign : {-1.0, 1.0}) {
      const double length = corners[piece + 1] - corners[piece];
      places.push_back({corners[piece] + 0.5 * length * (1 + sign / std::sqrt(3.0)), 0.5 * length});
    }
  return places;
}

SparseMatrix sum_over_cells(const Strings& s, double of_derivatives, double of_values) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int cells, auto&& unknown) {
    const double h = 1.0 / cells;
    for (int i = 0; i < cells; ++i)
      for (const int j : {i, i + 1})
        for (const int k : {i, i + 1})
          entries.emplace_back(unknown(j), unknown(k),
                               of_derivatives * (j == k ? 1 : -1) / h + of_values * h * (j == k ? 2 : 1) / 6);
  };
  add(s.upper_cells(), [&](int i) { return s.upper(i); });
  add(s.cells, [&](int i) { return s.lower(i); });
  SparseMatrix sum(s.size(), s.size());
  sum.setFromTriplets(entries.begin(), entries.end());
  return sum;
}

Table energies(const VariationalInequality& problem) {
  std::vector<double> epsilons;
  for (int k = 0; k <= 12; ++k) epsilons.push_back(std::pow(10.0, -k));
  epsilons.push_back(0);
  Table table({"epsilon", "energy", "max |u|", "corrections", "KKT"});
  for (const EnergyRow& row : energy_against_epsilon(problem, epsilons))
    table.add({row.epsilon, row.energy, row.moved, row.corrections, row.violation});
  return table;
}

void print_glue(const std::string& name, const Hypotheses& h, int finer_kernel, const Table& energies,
                const Solution& solution, double rigid_force) {
  energies.print(
      fmt::format("{}: (H1) coercivity {:.3f}; (H2) kernel {} of {} unknowns ({} on the mesh twice as fine); K "
                  "and G meet to {:.0e}",
                  name, h.coercivity, h.kernel, h.free, finer_kernel, h.distance));
  const Kkt& k = solution.kkt;
  fmt::print(
      "  contact force {:.4f} (rigid glue: {:.4f}), KKT: gap {:.0e}, pressure {:.0e}, complementarity {:.0e}, "
      "residual {:.0e}\n\n",
      solution.lambda.sum(), rigid_force, k.min_gap, k.min_pressure, k.complementarity, k.residual);
}

std::string refusal(const VariationalInequality& problem) {
  try {
    active_set(problem);
  } catch (const NotConverged& no) {
    return no.what();
  }
  return "";
}

}  // namespace antilock::tutorial
