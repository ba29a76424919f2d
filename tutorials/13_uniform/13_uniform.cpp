// # Convergence uniform in ε
//
// Run: 13_uniform              h from 1/8 to 1/32, 42 values of ε; some twenty seconds
// Run: 13_uniform --cells 64
// Run: 13_uniform --exercise 1
//
// **Afterwards you can** tell a robust method from one that is free of locking, prove
// uniform convergence by contradiction, and read a map of locking.
//
// Needs: [05](../05_p1_structured/05_p1_structured.cpp) (approaches, Theorem 4 in words),
// [09](../09_convergence/09_convergence.cpp) (orders),
// [11](../11_propositions/11_propositions.cpp) (Propositions 2 and 3).
//
// **The picture.** What P1 loses of the layer's displacement over what it keeps, over the
// plane of ε and $h$, on four families of meshes. *Yellow: nearly all is lost. Dark: nearly
// nothing. Each family has a border of its own, or none.*
//
// :figure: locking_map
//
// **Predict.** Take the worst error of P1 on the unstructured mesh over all ε in an
// interval. (a) Does it tend to 0 with $h$ on $[0.1, 1]$? (b) And on $]0, 1]$?
//
// ## Limit and supremum do not commute
//
// For each *fixed* ε > 0 every method here converges (Proposition 2). That is one limit per
// ε, and each of them may begin on a finer mesh than the one before. What a user needs is
// one bound for all ε. So the order of the two steps is turned round: first, on each mesh,
// the worst error over ε; then the limit in $h$. A method is **robust**, or *uniformly
// convergent*, if this worst error tends to 0,
//
// $$ \lim_{h → 0} \sup_{0 < ε ≤ 1} ‖u_h^ε - u^ε‖_h = 0. $$
//
// Nothing is said about how fast. A method is **free of locking** if the worst error has
// the order that the error has where nothing is stiff, at ε = 1. Free of locking is more: a
// method whose worst error falls like $h^{1/2}$ is robust, and not free of locking. A
// method that is not robust **locks** in the strongest sense: its worst error stays.
// Babuška and Suri, [3] of the paper, measure locking by the *locking ratio*. Write
// $E(ε, N)$ for the error with $N$ unknowns. The ratio is the worst error over the error at
// ε = 1,
//
// $$ L(N) = \frac{\sup_ε E(ε, N)}{E(1, N)}. $$
//
// If the error at ε = 1 tends to 0 and the ratio is bounded, the method is free of locking.
// If the ratio grows, but more slowly than $E(1, N)$ falls, the method is robust without
// being free of locking. (They take the supremum over a set of solutions, too:
// [chapter 17](../17_families_of_loads/17_families_of_loads.cpp).) The words are those of
// [3], and the paper calls Theorem 7, which has no order, robustness. Other authors say
// "free of locking" where the error merely converges uniformly.
//
// ## Away from 0, and near it
//
// **Proposition 4.** On $[ε_0, 1]$ with $ε_0 > 0$ every method with $K_h → K$ converges
// uniformly. Nothing is stiff there, because $ε^{-2}$ is at most $ε_0^{-2}$. Take two
// values ε and $\bar ε$ of the interval. Put $u_h^{\bar ε}$ into the inequality for ε, and
// $u_h^ε$ into that for $\bar ε$, and add. With $α > 0$ the constant in
// $a^ε(v_h, v_h) ≥ α ‖v_h‖_h^2$ (chapter 14 computes it),
//
// $$ α ‖u_h^{\bar ε} - u_h^ε‖_h^2 ≤ (ε^{-2} - \bar ε^{-2}) a_0(u_h^{\bar ε}, u_h^{\bar ε} - u_h^ε). $$
//
// The right side is small if ε and $\bar ε$ are near each other. How near they must be
// depends on $ε_0$, and not on the mesh: that is the point. The same lines hold for $u^ε$.
// So finitely many values of ε stand for all others, on all meshes at once, and at each of
// these finitely many the method converges.
//
// **Theorem 4.** *If $K_h$ approaches $K$ and $K_{0h}$ approaches $K_0$, the method is
// robust.* (A method that jumps needs two more properties. (H1nc): the form is coercive in
// the broken norm, with one constant for all meshes. (H0nc): weak limits of its functions do
// not jump. A conforming method has both, because its functions are in $V$. Crouzeix–Raviart
// has them, too: [chapter 14](../14_estimates/14_estimates.cpp) checks it. The paper supposes
// them from its Section 3.1 on.) Suppose that a method with both properties is not
// robust. Then there are $h_n → 0$ and $ε_n$ with errors above some $c > 0$. Numbers of
// $[0, 1]$ have limit points (*Bolzano* and *Weierstrass*), so a part of the $ε_n$ tends to
// some $\bar ε$. If $\bar ε > 0$, the $ε_n$ keep away from 0 from some $n$ on, and this
// contradicts Proposition 4. If $\bar ε = 0$, both $h$ and ε tend to 0, and it contradicts
// Proposition 3.
//
// **Theorem 5** is Theorem 4 for P1 on the structured mesh. In the layer the interpolant of
// a smooth $v ∈ K_0$ takes one value per vertical line, so it is in $K_{0h}$. Smooth $v$
// are enough, by Lemma 1. **Theorem 7** is Theorem 4 for Crouzeix–Raviart on any mesh with
// good angles, by Lemma 2
// ([chapter 08](../08_crouzeix_raviart/08_crouzeix_raviart.cpp)). **Remark 4** says the
// same in the energy seminorm $|v|_{a^ε} = a^ε(v, v)^{1/2}$, in which the layer's slope
// counts $ε^{-1}$ times.
//
// None of the theorems has a rate. The orders below are measured. On columns order $h$ in
// the energy seminorm is proved in [a chapter of its own](../20_order_h/20_order_h.cpp).
// For CR on any mesh with good angles $h^{1/2}$ is proved there. Order $h$ does not hold on
// all of them: on rows of triangles, which are not among the meshes below, the order at ε =
// 0 is at most 3/4 (same chapter).
//
// The computation takes quarter decades of ε from 1 to 1e-10, and 0. A supremum over a list
// is not a supremum, so the list must be dense enough: every second value gives the same to
// 2 %, which the run checks. Below 1e-10 $u^ε$ and $u_h^ε$ are at their limits, up to what
// [chapter 10](../10_limits/10_limits.cpp) says of $u^ε$, and
// [chapter 11](../11_propositions/11_propositions.cpp) of $u_h^ε$.

#include "antilock/analysis/best_approximation.hpp"
#include "antilock/exact/exact_norms.hpp"
#include "course/add_row.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using tutorial::Exact;

const std::vector<std::string> columns{"element", "mesh",     "epsilon", "cells",       "h",
                                       "h1",      "unknowns", "energy",  "lost_to_kept"};

// The map: one method on one mesh at every ε. Forms and contact sets are handed on from ε
// to ε.
Table solve_all(const Method& method, int cells, const std::vector<Exact>& exact_solution,
                const Field& load) {
  // ### Mesh
  const Space space = method.space(cells);
  // ### Forms
  SceneSweep sweep(Scene(Body{load}, StiffLayer{1}, UnilateralContact{}), space);
  // ### Solve
  Table rows(columns);
  for (const Exact& exact : exact_solution) {
    sweep.set_epsilon(exact.epsilon);
    const Solution solution = sweep.solve();
    const Errors errors = exact.errors(space, solution);
    const double kept =
        solution.u(space.contact_dofs()).maxCoeff() / exact.solution.max_on_contact();
    tutorial::add_row(rows, {{"element", method.element->name()},
                             {"mesh", method.family.name},
                             {"epsilon", exact.epsilon},
                             {"cells", cells},
                             {"h", 1.0 / cells},
                             {"h1", errors.h1},
                             {"unknowns", space.free_count()},
                             {"energy", errors.energy},
                             {"lost_to_kept", 1 / kept - 1}});
  }
  return rows;
}

// The supremum over ε ≥ ε_0 on each mesh, and the locking ratio.
Table worst_from(double epsilon_0, const Table& map) {
  Table rows({"cells", "h", "unknowns", "h1", "energy", "ratio"});
  for (const TableEntry& cells : map.unique("cells")) {
    const Table own = map.filter("cells", cells).filter_number("epsilon", [=](double e) {
      return e >= 0.99 * epsilon_0;
    });
    rows.add({cells, own.first("h"), own.first("unknowns"), own.max("h1"),
              own.max("energy"), own.max("h1") / own.filter("epsilon", 1).number("h1")});
  }
  return rows;
}

// The hypothesis of Theorem 4: the distance from $u^0$ to $K_{0h}$.
Table distances(const Method& method, const Table& worst, const Exact& u0) {
  Table rows({"h", "distance"});
  for (const TableEntry& cells : worst.unique("cells")) {
    const Space space = method.space(static_cast<int>(cells.number()));
    const VariationalInequality problem = assemble(tutorial::paper_scene(0), space);
    rows.add(
        {1 / cells.number(),
         best_approximation(space, problem, u0.reference(), AdmissibleSet::k_0h).distance});
  }
  return rows;
}

void judge(const Method& method, const Table& own, const Table& worst, double lost,
           tutorial::Report& report);

void study(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("truth");
  const std::vector<Exact> exact_solution = tutorial::exact_solutions(
      tutorial::quarter_decades(), 14);  // gradients to 1e-6, errors are 1e-2
  Table map(columns), restricted({"from", "h", "worst"});
  Table side_by_side({"method", "dist(u^0, K_0h)", "order", "sup error", "order in h",
                      "in N", "locking ratio"});
  const double lost = layer_norm(exact_solution.back().solution);
  std::vector<Method> all = methods({&crouzeix_raviart(), &p1()});
  for (const char* family : {"delaunay", "staggered"})
    all.push_back({&p1(), mesh_family(family)});
  std::vector<std::pair<Method, Table>> found;
  for (const Method& method : all) {
    report.stage(method.name());
    Table own(columns);
    for (int n = 8; n <= options.cells;
         n += n % 3 == 0 ? n / 3 : n / 2)  // 8, 12, 16, 24, 32, ...
      own.add(solve_all(method, n, exact_solution, paper_load));
    const Table worst = worst_from(0, own),
                near = distances(method, worst, exact_solution.back());
    side_by_side.add({method.name(), near.last("distance"), near.order("distance", "h"),
                      worst.last("h1"), worst.order("h1", "h"),
                      worst.order("h1", "unknowns"), worst.last("ratio")});
    if (method.name() == "P1 unstructured")
      for (const double from : {1.0, 0.1, 0.01, 1e-3, 0.0})
        for (const Table& row : worst_from(from, own).rows())
          restricted.add(
              {fmt::format("from {:g}", from), row.number("h"), row.number("h1")});
    map.add(own);
    found.emplace_back(method, worst);
  }
  report.finish();
  // ### Output
  side_by_side.print("Theorem 4: hypothesis (left) and conclusion (right)", 3);
  tutorial::write_map(options.out, map);
  tutorial::write_uniform(options.out, found);
  restricted.write(options.out / "restricted.csv");
  for (const auto& [method, worst] : found)
    judge(method,
          map.filter("element", method.element->name()).filter("mesh", method.family.name),
          worst, lost, report);
}

void judge(const Method& method, const Table& own, const Table& worst, double lost,
           tutorial::Report& report) {
  const std::string name = method.name();
  const double denser = tutorial::supremum(own, "h1", "epsilon").denser;
  report.claim(denser < 1.02,
               "{}: a list of ε twice as dense makes the worst error {:.4f} times as large "
               "(below 1.02)",
               name, denser);
  if (!method.element->conforming() || method.family.name == "structured") {
    const std::string theorem =
        method.element->conforming() ? ", Theorem 5" : ", Theorem 7";
    report.claim_order(
        worst, "h1", "h", 0.95, 1.05,
        name + theorem + ": worst H1 error (it falls: proved; order observed)");
    report.claim_order(worst, "energy", "h", 0.95, 1.05,
                       name + ", Remark 4: worst energy error");
    report.claim(worst.max("ratio") < 1.05,
                 "{} is free of locking: locking ratio {:.3f} on all meshes (observed)",
                 name, worst.max("ratio"));
    return;
  }
  report.claim(worst.min("h1") > lost,
               "{} locks: worst error {:.3f}, never below |u^0| on the layer, {:.3f} "
               "(proved: its kernel there is 0)",
               name, worst.last("h1"), lost);
  // The worst error stays and the error at ε = 1 has order 1: so has 1/L in the end.
  report.claim_order(worst, "ratio", "h", -1.05, -0.4, name + ": locking ratio");
  if (name != "P1 unstructured") return;
  report.claim_order(worst_from(0.1, own), "h1", "h", 0.9, 1.1,
                     name + ", Proposition 4 on [0.1, 1] (observed)");
  const std::vector<double> steps = worst_from(0.01, own).pairwise_orders("h1", "h");
  if (steps.size() >= 4)
    report.claim(steps.back() > 0.95 && steps.front() < 0.8,
                 "{}, Proposition 4 on [0.01, 1]: order {:.2f} in the first step, {:.2f} "
                 "in the last, below the wall "
                 "(observed)",
                 name, steps.front(), steps.back());
}

// ## What came out
//
// :output: Theorem 4
//
// :figure: uniform
//
// Hypothesis and conclusion of Theorem 4 go together. Where the distance from $u^0$ to
// $K_{0h}$ falls like $h^{0.98}$, so does the worst error, and the locking ratio is at most
// 1.02: on these meshes the methods are free of locking. For P1 off columns both stay, on
// the unstructured mesh at 0.148 on 1/32 and never below 0.126, and the locking ratio
// grows. (a) Yes, with order 0.98. The *wall* is the ε at which half is lost, about
// $5.84 k$ by chapter 06. On $[0.01, 1]$ the error falls once it is to the left of 0.01.
// (b) No: refining moves the wall, and in $]0, 1]$ there is always an ε left of it.
// :number: 0.98 = table "Theorem 4" "order in h" "method=P1 structured"
// :number: 1.02 = table "Theorem 4" "locking ratio" "method=P1 structured"
// :number: 0.148 = table "Theorem 4" "sup error" "method=P1 unstructured"
// :number: 0.126 = line "never below |u^0| on the layer, {} ("
//
// :figure: restricted
//
// ## Exercises
//
// 1. The load $-10 \sin πx$ presses everywhere. Is P1 on the unstructured mesh uniform now?
//    Is the hypothesis of Theorem 4 necessary?
// 2. On paper: on the unstructured mesh, does the worst error of P1 over $[h, 1]$ tend to
//    0, and that over $[h^2, 1]$? And on the Delaunay mesh?
//
// ## Further reading
//
// - [Babuška and Suri 1992](../guides/bibliography.md#babuska-1992): robust, and free of
//   locking.
// - [Slimane and Renard 2004](../guides/bibliography.md#slimane-2004): Theorem 4, and
//   Theorems 5 and 7 for two elements.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "13_uniform",
      "Theorems 4, 5, 7: convergence uniform in epsilon, and the locking map",
      {.takes_epsilon = false,
       .least_cells = 16,
       .most_cells = 128,
       .exercises = exercises},
      study);
}
