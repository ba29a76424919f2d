#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/exact/truth_distance.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

// What chapter 13 leaves out of its page.

/// An exact solution with the norms on the right of (28).
struct Case : Exact {
  using Exact::Exact;
  double h2 = h2_norm(truth);
};
/// epsilon from 1 to 1e-3 by quarters of a decade, 1e-4 and 1e-6; gradients to 1e-6.
std::vector<Case> cases();

/// Both sides of (13): element, mesh, epsilon, cells, h; the errors h1, l2; bound: (28) with C = 1; right: the sum
/// of the two infima; second: the second of them; jumps: what of it comes from the jumps of u_h; constant: the C
/// that (13) needs at least; consistency: the largest work of the flux of u on the jumps of functions of norm 1, 0
/// without jumps.
extern const std::vector<std::string> estimate_columns;

/// Prints both sides on the finest mesh, and the walls. Writes results.csv, estimates.csv (errors and estimates, each
/// with the smallest constant that makes it true) and lost.csv.
void show_estimates(const std::filesystem::path& out, const Table& results, const Table& walls, const Table& lost);

/// The smallest constant alpha in (a1 + a0)(v, v) >= alpha |v|_h^2, of (H1nc): on V, and of a method at 1/h = 8.
double exact_coercivity();
double discrete_coercivity(const Method& method);

/// For each method: (H1nc) by its alpha; the orders of Theorem 3 and of the right side of (13), and one constant in it
/// and no power of epsilon in the error, but where P1 locks; (H0nc) where functions
/// jump, Falk's lemma where they do not.
void judge_theorems(const Table& results, Report& report);

}  // namespace antilock::tutorial
