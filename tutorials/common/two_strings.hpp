#pragma once
#include <string>
#include <vector>

#include "antilock/analysis/hypotheses.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

// What chapter 28 leaves out of its page: the unknowns of two strings, hat functions, sums over cells.

/// The unknowns of two strings on [0, 1], held or not: upper(0) ... upper(upper_cells()), then lower(0) ...
/// lower(cells).
struct Strings {
  int cells, more = 1;  ///< cells of the lower string, and how many more the upper one has
  int upper_cells() const { return cells + more; }
  int upper(int i) const { return i; }
  int lower(int i) const { return upper_cells() + 1 + i; }
  int size() const { return upper_cells() + cells + 2; }
};

/// The hat function of corner i of a string of so many cells, at x.
double hat(int cells, int i, double x);

/// (u - w)(x) as a row over all unknowns: the hat functions of the upper string, less those of the lower one.
Eigen::RowVectorXd difference(const Strings& strings, double x);

/// A place of [0, 1] and its weight.
struct Place {
  double x, weight;
};
/// Two Gauss points on each piece between neighbouring corners of either string: exact for products of broken lines.
std::vector<Place> gauss_points(const Strings& strings);

/// of_derivatives (int u' v' + int w' z') + of_values (int u v + int w z), as a matrix over all unknowns.
SparseMatrix sum_over_cells(const Strings& strings, double of_derivatives, double of_values);

/// A problem at every class parameter from 1 to 1e-12, and at 0: epsilon, energy, "max |u|", corrections, KKT.
Table energies(const VariationalInequality& problem);

/// Prints what one glue came to: its hypotheses, its energies, and the answer with the KKT report; `rigid_force` is the
/// contact force under a rigid glue.
void print_glue(const std::string& name, const Hypotheses& hypotheses, int finer_kernel, const Table& energies,
                const Solution& solution, double rigid_force);

/// What the solver says of a problem that it does not solve; empty where it solves it.
std::string refusal(const VariationalInequality& problem);

}  // namespace antilock::tutorial
