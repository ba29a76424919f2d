// Theorems 4, 5 and 7 and Remark 4: uniform convergence, as a program sees it, and the locking map.
//
// Run: 12_uniform              h from 1/8 to 1/32, 22 epsilons; some six seconds
// Run: 12_uniform --cells 64   to h = 1/64
//
// --epsilon is not asked for here: the supremum over it is the point.
//
// The theorem. If K_h approaches K and K_0h approaches K_0 (Definition 1), then (Theorem 4)
//
//     lim_{h->0} sup_{0 < epsilon <= 1} || u_h^epsilon - u^epsilon ||_h = 0 ,
//
// which Theorem 5 says of P1 on structured meshes and Theorem 7 of Crouzeix-Raviart on any, and
// Remark 4 of the energy seminorm |.|_{a^epsilon} too. Mind the order of limit and supremum. For
// every *fixed* epsilon > 0, P1 on an unstructured mesh converges as well (Proposition 2). The map
// shows how: the error is large below a boundary, epsilon about h^(3/2) on these meshes. Refining
// moves this boundary to smaller epsilon; it never disappears, so the supremum stays.
//
// The supremum is taken over half decades from 1 to 1e-10, and 0: by Theorem 1 nothing happens
// below.
//
// How much is lost is a number, too. Babuska and Suri (1992, the paper's [3]) compare, at equal
// unknowns N, the worst error over epsilon with the error where nothing is stiff, here epsilon = 1:
//
//     locking ratio  L(N) = sup_epsilon E(epsilon, N) / E(1, N).
//
// Their definition takes the supremum over a ball of loads as well; here there is one load. L
// bounded: free of locking. L growing like N^k: locking of order N^k; in the plane k = 1/2 is all
// that P1 can lose in H1. And sup_epsilon E falling like N^-r: robust of order N^-r; r = 1/2 is the
// best, r = 0 is none.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <cmath>

#include "antilock/study/method.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

using namespace antilock;
using tutorial::Exact;

// 1. The map: the errors of one method on one mesh at every epsilon, in the broken H1 norm and the
// energy seminorm.
Table solve_all(const Method& method, int cells, const std::vector<Exact>& truth) {
  const Discretisation on = method.on(cells);
  SceneSweep sweep(tutorial::paper_scene(1), on.space());
  Table rows({"element", "mesh", "epsilon", "cells", "h", "unknowns", "h1", "energy"});
  for (const Exact& exact : truth) {
    sweep.set_epsilon(exact.epsilon);
    const Errors errors = exact.errors(on.space(), sweep.solve());
    rows.add({method.element->name(), method.family.name, exact.epsilon, cells, 1.0 / cells, on.space().free_count(),
              errors.h1, errors.energy});
  }
  return rows;
}

// 2. The supremum over epsilon and the locking ratio: one row per mesh.
Table suprema(const Table& map) {
  Table rows({"element", "mesh", "cells", "h", "unknowns", "h1", "energy", "h1_at_1", "ratio"});
  for (const Entry& element : map.different("element"))
    for (const Entry& mesh : map.different("mesh"))
      for (const Entry& cells : map.different("cells")) {
        const Table own = map.where("element", element).where("mesh", mesh).where("cells", cells);
        const double at_1 = own.where("epsilon", 1).number("h1");
        rows.add({element, mesh, cells, own.first("h"), own.first("unknowns"), own.most("h1"), own.most("energy"), at_1,
                  own.most("h1") / at_1});
      }
  return rows;
}

std::vector<Exact> truths();
Table worst_by_norm(const Table& suprema);
void judge(const Method& method, const Table& own, tutorial::Report& report);

void study(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("truth for 22 epsilons");
  const std::vector<Exact> truth = truths();
  const std::vector<Method> all = methods({&crouzeix_raviart(), &p1()});
  Table map({"element", "mesh", "epsilon", "cells", "h", "unknowns", "h1", "energy"});
  for (const Method& method : all) {
    report.stage(method.name() + ", 22 epsilons per mesh");
    for (int n = 8; n <= options.cells; n += n % 3 == 0 ? n / 3 : n / 2)  // 8, 12, 16, 24, 32, ...
      map.add(solve_all(method, n, truth));
  }
  report.finish();
  const Table worst = suprema(map);
  worst.print("the worst error over epsilon, and the locking ratio");
  map.write(options.out / "map.csv");
  worst_by_norm(worst).write(options.out / "uniform.csv");

  Table orders({"method", "order of locking", "order of robustness"});
  for (const Method& method : all) {
    const Table own = worst.where("element", method.element->name()).where("mesh", method.family.name);
    orders.add({method.name(), fmt::format("N^{:.2f}", own.order("ratio", "unknowns")),
                fmt::format("N^{:.2f}", own.order("h1", "unknowns"))});
  }
  orders.print();
  for (const Method& method : methods())
    judge(method, worst.where("element", method.element->name()).where("mesh", method.family.name), report);
  // The boundary of the map: for a fixed epsilon the locked method converges at last (Proposition
  // 2).
  const Table locked = map.where("element", "P1").where("mesh", "unstructured");
  const double order = locked.where_number("epsilon", [](double e) { return e > 0.09 && e < 0.11; }).order("h1", "h");
  report.claim(order > 0.7, "P1 unstructured at epsilon = 0.1, fixed: converges like h^{:.2f} (Proposition 2)", order);
}

void judge(const Method& method, const Table& own, tutorial::Report& report) {
  // First order is the best of P1 and CR in these norms; 0.2: the meshes are coarse. A locked
  // method has a limit: the H1 norm of the displacement that the layer loses. It is where worst^2 =
  // limit^2 + (c h)^2 tends, by the first and the last mesh.
  const double a = own.first("h"), b = own.last("h"), high = own.first("h1"), low = own.last("h1");
  const double limit = std::sqrt(std::max(0.0, (a * a * low * low - b * b * high * high) / (a * a - b * b)));
  const double h1 = own.order("h1", "h"), energy = own.order("energy", "h");
  const bool locks = method.name() == "P1 unstructured";
  if (locks)
    report.claim(limit > 0.1, "{}: Section 4.1, locks: sup over epsilon tends to {:.3f} in H1, not to 0", method.name(),
                 limit);
  else
    report.claim(h1 > 0.8 && energy > 0.8,
                 "{}: {} and Remark 4: sup over epsilon falls like h^{:.2f} in H1, h^{:.2f} in energy", method.name(),
                 method.element->conforming() ? "Theorem 5" : "Theorem 7", h1, energy);
  const double growth = own.last("ratio") / own.first("ratio");
  report.claim(locks ? growth > 1.3 : own.last("ratio") < 2 && growth < 1.2,
               "{}: locking ratio {:.2f} at N = {}, {:.2f} at N = {}: {}", method.name(), own.first("ratio"),
               own.first("unknowns"), own.last("ratio"), own.last("unknowns"), locks ? "it grows" : "bounded");
}

// Three things to try:
// - --cells 64: the locking ratio of P1 unstructured goes on like N^1/2, the three others stay.
// - `energy` in place of `h1` in the locking ratio: epsilon = 1 is then the worst case of the good
//   methods.
// - {&p2(), unstructured()} as a fifth method: less locking, not none.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.least_cells = 16;
  options.most_cells = 128;  // a slope needs meshes from 1/8 to 1/16, 22 epsilons each
  return tutorial::run(argc, argv, "12_uniform",
                       "Theorems 4, 5, 7: convergence uniform in epsilon, and the locking map", options, study);
}

// 1, 10^-1/2, ..., 1e-10, 0, each with its truth. 2^14 points of the series: gradients to 1e-6,
// errors are 1e-2.
std::vector<Exact> truths() {
  std::vector<double> epsilons;
  for (int k = 0; k <= 20; ++k) epsilons.push_back(std::pow(10.0, -0.5 * k));
  epsilons.push_back(0);
  return tutorial::exact_solutions(epsilons, 14);
}

// The worst error in each of the two norms, for the picture.
Table worst_by_norm(const Table& suprema) {
  Table rows({"norm", "element", "mesh", "h", "unknowns", "worst"});
  for (const Table& row : suprema.rows())
    for (const auto& [norm, column] : {std::pair{"broken $H^1$ norm", "h1"}, {"energy seminorm", "energy"}})
      rows.add(
          {norm, row.entry("element"), row.entry("mesh"), row.number("h"), row.number("unknowns"), row.number(column)});
  return rows;
}
