// # Convergence uniform in ε
//
// Run: 12_uniform              h from 1/8 to 1/32, 22 values of ε; some five seconds
// Run: 12_uniform --cells 64
// Run: 12_uniform --exercise 1
//
// Needs: [09](09_convergence.cpp) (orders), [10](10_limits.cpp) (Propositions), [11](11_contact_sets.cpp) (approaches).
//
// **The picture.** The error of four methods over the plane of ε and $h$. *Horizontal bands mean that the error
// depends on $h$ alone. P1 on the unstructured mesh has a boundary, $ε ∼ h^{3/2}$; below it refining does nothing.*
//
// **Predict.** Take the worst error of P1 on the unstructured mesh over all ε in an interval. (a) Does it tend to 0
// with $h$ on $[0.1, 1]$? (b) And on $]0, 1]$?
//
// ## Limit and supremum do not commute
//
// For each *fixed* ε > 0 every method converges (Proposition 2). A method is free of locking if it does so
// *uniformly*: the supremum over ε comes first, the limit second.
//
// **Proposition 4.** On $[ε_0, 1]$ with $ε_0 > 0$ every method with $K_h → K$ converges uniformly. Nothing is stiff
// there. Put $u_h^{\bar ε}$ into the inequality for ε, and $u_h^ε$ into that for $\bar ε$, and add. With $α > 0$ the
// constant in $a^ε(v_h, v_h) ≥ α ‖v_h‖_h^2$ (chapter 13 computes it),
//
// $$ α ‖u_h^{\bar ε} - u_h^ε‖_h^2 ≤ (ε^{-2} - \bar ε^{-2}) a_0(u_h^{\bar ε}, u_h^{\bar ε} - u_h^ε), $$
//
// so $u_h^ε$ changes little between neighbouring ε, at a rate that $ε_0$ sets and not $h$. The same lines hold for
// $u^ε$. Finitely many ε therefore stand for all, and at each of them the method converges.
//
// **Theorem 4.** *If $K_h$ approaches $K$ and $K_{0h}$ approaches $K_0$, then*
//
// $$ \lim_{h → 0} \sup_{0 < ε ≤ 1} ‖u_h^ε - u^ε‖_h = 0. $$
//
// Suppose not: then there are $h_n → 0$ and $ε_n$ with errors above some $c > 0$. A part of the $ε_n$ tends to some
// $\bar ε ∈ [0, 1]$. If $\bar ε > 0$, Proposition 4 is violated; if $\bar ε = 0$, Proposition 3.
//
// **Theorem 5** is Theorem 4 for P1 on the structured mesh. In the layer the interpolant of a smooth $v ∈ K_0$ takes
// one value per vertical line, so it is in $K_{0h}$. Smooth $v$ are enough, by Lemma 1. **Theorem 7** is Theorem 4
// for Crouzeix–Raviart on any mesh, by Lemma 2 ([chapter 08](08_crouzeix_raviart.cpp)). **Remark 4** says the same in
// the energy seminorm $|v|_{a^ε} = a^ε(v, v)^{1/2}$, in which the layer's slope counts $ε^{-1}$ times.
//
// **How much is lost** is a number too. Babuška and Suri, [3] of the paper, compare at equal unknowns $N$ the worst
// error with the error where nothing is stiff: the *locking ratio* $\sup_ε E(ε, N) / E(1, N)$. Bounded: free of
// locking. (They take the supremum over a ball of loads too: [chapter 15](15_families_of_loads.cpp).)
//
// The computation takes half decades of ε from 1 to 1e-10, and 0. Where a method does not lock, its error changes
// little between two of them. Where it locks, the loss grows as ε falls (chapter 06), and is largest at 0, which is
// in the list. Below 1e-10 $u^ε$ and $u_h^ε$ are at their limits, up to what [chapter 10](10_limits.cpp) says.

#include "common/limit_problem.hpp"
#include "common/study.hpp"
#include "common/uniform.hpp"

using namespace antilock;
using tutorial::Exact;

const std::vector<std::string> columns{"element", "mesh", "epsilon", "cells", "h", "unknowns", "h1", "energy"};

// The map: one method on one mesh at every ε. Forms and contact sets are handed on from ε to ε.
Table solve_all(const Method& method, int cells, const std::vector<Exact>& truth, const Field& load) {
  // ### Mesh
  const Discretisation on = method.on(cells);
  // ### Forms
  SceneSweep sweep(Scene(Body{load}, StiffLayer{1}, UnilateralContact{}), on.space());
  // ### Solve
  Table rows(columns);
  for (const Exact& exact : truth) {
    sweep.set_epsilon(exact.epsilon);
    const Errors errors = exact.errors(on.space(), sweep.solve());
    rows.add({method.element->name(), method.family.name, exact.epsilon, cells, 1.0 / cells, on.space().free_count(),
              errors.h1, errors.energy});
  }
  return rows;
}

// The supremum over ε ≥ ε_0 on each mesh, and the locking ratio.
Table worst_from(double epsilon_0, const Table& map) {
  Table rows({"cells", "h", "unknowns", "h1", "energy", "ratio"});
  for (const Entry& cells : map.different("cells")) {
    const Table own =
        map.where("cells", cells).where_number("epsilon", [=](double e) { return e >= 0.99 * epsilon_0; });
    rows.add({cells, own.first("h"), own.first("unknowns"), own.most("h1"), own.most("energy"),
              own.most("h1") / own.where("epsilon", 1).number("h1")});
  }
  return rows;
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  const std::vector<Exact> truth =
      tutorial::exact_solutions(tutorial::half_decades(), 14);  // gradients to 1e-6, errors are 1e-2
  Table map(columns), uniform({"norm", "element", "mesh", "h", "worst"}), restricted({"from", "h", "worst"});
  Table side_by_side(
      {"method", "dist(u^0, K_0h)", "its order", "sup error", "its order in h", "in N", "locking ratio"});
  const double lost = tutorial::limit_on_layer(truth.back().truth);
  for (const Method& method : methods({&crouzeix_raviart(), &p1()})) {
    Table own(columns);
    for (int n = 8; n <= options.cells; n += n % 3 == 0 ? n / 3 : n / 2)  // 8, 12, 16, 24, 32, ...
      own.add(solve_all(method, n, truth, paper_load));
    map.add(own);
    const Table worst = worst_from(0, own), near = tutorial::distances_to_limit(method, options.cells);
    side_by_side.add({method.name(), near.last("distance"), near.order("distance", "h"), worst.last("h1"),
                      worst.order("h1", "h"), worst.order("h1", "unknowns"), worst.last("ratio")});
    for (const Table& row : worst.rows())
      for (const auto& [norm, column] : {std::pair{"broken $H^1$ norm", "h1"}, {"energy seminorm", "energy"}})
        uniform.add({norm, method.element->name(), method.family.name, row.number("h"), row.number(column)});
    if (method.name() != "P1 unstructured") {
      tutorial::judge_uniform(method, worst, report);
      continue;
    }
    report.claim(worst.least("h1") > lost && worst.last("ratio") > 1.3 * worst.first("ratio"),
                 "P1 unstructured locks: worst error {:.3f}, never below |u^0| on the layer, {:.3f}; locking ratio "
                 "{:.2f} to {:.2f}",
                 worst.last("h1"), lost, worst.first("ratio"), worst.last("ratio"));
    for (const double from : {1.0, 0.1, 0.01, 1e-3, 0.0})
      for (const Table& row : worst_from(from, own).rows())
        restricted.add({fmt::format("from {:g}", from), row.number("h"), row.number("h1")});
    // On [ε_0, 1] the boundary $ε ∼ h^{3/2}$ is passed at last: from $h^{3/2} < ε_0$ on, order 1.
    report.claim_within(worst_from(0.1, own).order("h1", "h"), 0.9, 1.1, "Proposition 4 on [0.1, 1]: order");
    const Table fine = worst_from(0.01, own).where_number("cells", [&](double n) { return n >= options.cells / 2.; });
    if (options.cells >= 32)
      report.claim(fine.order("h1", "h") > 0.8, "Proposition 4 on [0.01, 1]: order {:.2f} at last",
                   fine.order("h1", "h"));
  }
  // ### Output
  side_by_side.print("Theorem 4: hypothesis (left) and conclusion (right)", 3);
  map.write(options.out / "map.csv");
  uniform.write(options.out / "uniform.csv");
  restricted.write(options.out / "restricted.csv");
}

// ## What came out
//
// Hypothesis and conclusion of Theorem 4 go together: where the distance from $u^0$ to $K_{0h}$ falls like
// $h^{0.98}$, so does the worst error, and the locking ratio is at most 1.02. For P1 on the unstructured mesh both
// stay, 0.148 at 1/h = 32 and never below 0.126; the locking ratio grows from 1.17 to 2.69. (a) Yes, with order 0.98;
// on $[0.01, 1]$ the fall begins once $h^{3/2} < 0.01$. (b) No: refining moves the boundary of the map to smaller ε,
// it never disappears.
//
// ## Exercises
//
// 1. The load $-10 \sin πx$ presses everywhere. Is P1 on the unstructured mesh uniform now? Is the hypothesis of
//    Theorem 4 necessary?
// 2. On paper: why does the worst error over $[h, 1]$ tend to 0 for locked P1, and over $[h^2, 1]$ not?

#include "answers/12_uniform.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "12_uniform",
                       "Theorems 4, 5, 7: convergence uniform in epsilon, and the locking map",
                       {.takes_epsilon = false, .least_cells = 16, .most_cells = 128, .exercises = exercises}, study);
}
