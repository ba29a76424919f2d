#pragma once
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "antilock/analysis/hypotheses.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/matrix.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// A problem at every class parameter from 1 to 1e-12, and at 0: epsilon, energy, "max |u|"
/// of all unknowns, corrections (many: the penalty does not fit, or the problem locks), and
/// the KKT report's largest number. J rises as epsilon falls, to a limit; where the stiff
/// part locks, to that with the stiff part held: the rest still moves. Energy and |u| are
/// no numbers where no answer was found.
inline Table energies(VariationalInequality problem) {
  Table table({"epsilon", "energy", "max |u|", "corrections", "KKT"});
  for (int k = 0; k <= 13; ++k) {
    problem.compliance = k <= 12 ? std::pow(10.0, -k) : 0;
    try {
      const Solution s = active_set(problem);
      table.add({problem.compliance, energy(problem, s), s.u.lpNorm<Eigen::Infinity>(),
                 s.counters.corrections, worst_violation(s.kkt)});
    } catch (const NotConverged& failure) {
      table.add({problem.compliance, NAN, NAN, failure.steps, failure.reached});
    }
  }
  return table;
}

/// Prints what one glue came to: its hypotheses, its energies, and the answer with the KKT
/// report; `rigid_force` is the contact force under a rigid glue.
inline void print_glue(const std::string& name, const Hypotheses& h, int finer_kernel,
                       const Table& energies, const Solution& solution,
                       double rigid_force) {
  energies.print(
      fmt::format("{}: (H1) coercivity {:.3f}; (H2) kernel {} of {} unknowns ({} on the "
                  "mesh twice as fine); K "
                  "and G meet to {:.0e}",
                  name, h.coercivity, h.kernel, h.free, finer_kernel, h.distance));
  const Kkt& k = solution.kkt;
  fmt::print(
      "  contact force {:.4f} (rigid glue: {:.4f}), KKT: gap {:.0e}, pressure {:.0e}, "
      "complementarity {:.0e}, "
      "residual {:.0e}\n\n",
      solution.lambda.sum(), rigid_force, k.min_gap, k.min_pressure, k.complementarity,
      k.residual);
}

/// What the solver says of a problem that it does not solve; empty where it solves it.
inline std::string refusal(const VariationalInequality& problem) {
  try {
    active_set(problem);
  } catch (const NotConverged& no) {
    return no.what();
  }
  return "";
}

/// The unknowns of two strings on [0, 1], held or not: upper(0) ... upper(upper_cells()),
/// then lower(0) ... lower(cells).
struct Strings {
  int cells, more = 1;  ///< cells of the lower string, and how many more the upper one has
  int upper_cells() const { return cells + more; }
  int upper(int i) const { return i; }
  int lower(int i) const { return upper_cells() + 1 + i; }
  int size() const { return upper_cells() + cells + 2; }
  double corner(int i) const {
    return static_cast<double>(i) / cells;
  }  ///< of the lower string
  /// Returns the unknowns of the lower string between its ends.
  std::vector<int> inside_lower() const {
    std::vector<int> inside;
    for (int i = 1; i < cells; ++i) inside.push_back(lower(i));
    return inside;
  }
};

/// The hat function of corner i of a string of so many cells, at x.
inline double hat(int cells, int i, double x) {
  const double t = x * cells;
  return std::max(0.0, t < i ? t - (i - 1) : i + 1 - t);
}

/// (u - w)(x) as a row over all unknowns: the hat functions of the upper string, less those
/// of the lower one.
inline Eigen::RowVectorXd difference(const Strings& s, double x) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(s.size());
  for (int i = 0; i <= s.upper_cells(); ++i) row(s.upper(i)) = hat(s.upper_cells(), i, x);
  for (int i = 0; i <= s.cells; ++i) row(s.lower(i)) = -hat(s.cells, i, x);
  return row;
}

/// Returns the heights of both strings and the pressures below them, at the corners of the
/// lower string: what carries the upper string there is the lower one, and what carries the
/// lower one is the floor. The lower string hangs `distance` below the upper one, and
/// `distance` above the floor.
inline Table touching_table(const Strings& s, const Eigen::VectorXd& u,
                            const Eigen::VectorXd& pair, const Eigen::VectorXd& floor,
                            double distance) {
  Table table({"x", "upper", "lower", "floor", "on_upper", "on_lower"});
  for (int i = 0; i <= s.cells; ++i) {
    const bool inside = i > 0 && i < s.cells;
    const double lower = u(s.lower(i)), upper = lower + difference(s, s.corner(i)).dot(u);
    table.add({s.corner(i), upper, lower - distance, -2 * distance,
               inside ? pair(i - 1) * s.cells : 0.0,
               inside ? floor(i - 1) * s.cells : 0.0});
  }
  return table;
}

/// Returns the pressures between two blocks, at the inner vertices of the lower one: those
/// of the patch test (mortar, node to segment), and those below the layer (P1 without
/// columns, Crouzeix-Raviart, P1 with columns). Each argument has the rows x, distance,
/// pressure. In the patch test the ends are free and have rows of their own. For
/// Crouzeix-Raviart the pressure at a vertex is the mean of those of the edges beside it.
inline Table blocks_table(const Eigen::MatrixX3d& mortar, const Eigen::MatrixX3d& nodes,
                          const Eigen::MatrixX3d& locked,
                          const Eigen::MatrixX3d& nonconforming,
                          const Eigen::MatrixX3d& columns) {
  Table table({"x", "mortar", "node_to_segment", "P1", "CR", "P1_columns"});
  for (Eigen::Index i = 0; i < columns.rows(); ++i)
    table.add({columns(i, 0), mortar(i + 1, 2), nodes(i + 1, 2), locked(i, 2),
               (nonconforming(i, 2) + nonconforming(i + 1, 2)) / 2, columns(i, 2)});
  return table;
}

/// A place of [0, 1] and its weight.
struct Place {
  double x, weight;
};
/// Two Gauss points on each piece between neighbouring corners of either string: exact for
/// products of broken lines.
inline std::vector<Place> gauss_points(const Strings& s) {
  std::vector<double> corners;
  for (int i = 0; i <= s.cells; ++i) corners.push_back(static_cast<double>(i) / s.cells);
  for (int i = 1; i < s.upper_cells(); ++i)
    corners.push_back(static_cast<double>(i) / s.upper_cells());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<Place> places;
  for (std::size_t piece = 0; piece + 1 < corners.size(); ++piece)
    for (const double sign : {-1.0, 1.0}) {
      const double length = corners[piece + 1] - corners[piece];
      places.push_back(
          {corners[piece] + 0.5 * length * (1 + sign / std::sqrt(3.0)), 0.5 * length});
    }
  return places;
}

/// of_derivatives (int u' v' + int w' z') + of_values (int u v + int w z), as a matrix over
/// all unknowns.
inline SparseMatrix sum_over_cells(const Strings& s, double of_derivatives,
                                   double of_values) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int cells, auto&& unknown) {
    const double h = 1.0 / cells;
    for (int i = 0; i < cells; ++i)
      for (const int j : {i, i + 1})
        for (const int k : {i, i + 1})
          entries.emplace_back(unknown(j), unknown(k),
                               of_derivatives * (j == k ? 1 : -1) / h +
                                   of_values * h * (j == k ? 2 : 1) / 6);
  };
  add(s.upper_cells(), [&](int i) { return s.upper(i); });
  add(s.cells, [&](int i) { return s.lower(i); });
  SparseMatrix sum(s.size(), s.size());
  sum.setFromTriplets(entries.begin(), entries.end());
  return sum;
}

}  // namespace antilock::tutorial
