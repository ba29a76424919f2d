#include "common/estimates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antilock/analysis/kernel.hpp"
#include "antilock/form/h1_norm.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock::tutorial {

const std::vector<std::string> estimate_columns{"element", "mesh",  "epsilon", "cells", "h",        "h1",         "l2",
                                                "bound",   "right", "second",  "jumps", "constant", "consistency"};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (int k = 0; k <= 12; ++k) all.emplace_back(paper_scene(std::pow(10.0, -0.25 * k)), 14);
  for (const double epsilon : {1e-4, 1e-6}) all.emplace_back(paper_scene(epsilon), 14);
  return all;
}

namespace {

Table of_method(const Table& results, const Method& method) {
  return results.where("element", method.element->name()).where("mesh", method.family.name);
}

/// Against epsilon, on the coarsest and the finest mesh.
Table error_and_estimate(const Table& rows) {
  Table curves({"element", "mesh", "curve", "epsilon", "h1"});
  double c = 0;  // the smallest that makes (28) or (31) true
  for (const Table& row : rows.rows()) c = std::max(c, row.number("h1") / row.number("bound"));
  const double coarsest = rows.least("cells"), finest = rows.most("cells");
  for (const Table& row : rows.where_number("cells", [=](double n) { return n == coarsest || n == finest; }).rows())
    for (const auto& [what, value] : {std::pair{"error", row.number("h1")}, {"estimate", c * row.number("bound")}})
      curves.add({row.entry("element"), row.entry("mesh"), fmt::format("{} $h = 1/{}$", what, row.number("cells")),
                  row.number("epsilon"), value});
  return curves;
}

}  // namespace

void show_estimates(const std::filesystem::path& out, const Table& results, const Table& walls, const Table& lost) {
  Table curves({"element", "mesh", "curve", "epsilon", "h1"});
  for (const Method& method : methods()) curves.add(error_and_estimate(of_method(results, method)));
  const Table decades =
      results.where_number("epsilon", [](double e) { return e == 1 || e == 0.1 || e == 0.01 || e < 5e-4; });
  decades.where("cells", results.most("cells"))
      .select({"element", "mesh", "epsilon", "h1", "right", "second", "jumps", "constant", "consistency"})
      .print("both sides of (13) on the finest mesh", 3);
  walls.print("P1 unstructured: lost / kept = d epsilon^-a");
  decades.write(out / "results.csv");
  curves.write(out / "estimates.csv");
  lost.write(out / "lost.csv");
}

double exact_coercivity() {
  const double mu = std::numbers::pi * std::numbers::pi * (1 + 1.0 / 16);
  return mu / (1 + mu);
}

double discrete_coercivity(const Method& method) {
  const Discretisation coarse = method.on(8);
  return coercivity(assemble(paper_scene(1), coarse.space()), h1_norm(coarse.space()));
}

namespace {

void judge_jumps(const std::string& name, const Table& rows, Report& report) {
  double share = 1, slowest = 9;
  for (const Table& row : rows.rows()) share = std::min(share, row.number("jumps") / row.number("second"));
  for (const Entry& epsilon : rows.different("epsilon"))
    slowest = std::min(slowest, rows.where("epsilon", epsilon).order("consistency", "h"));
  // 0.7: the jump of p at the end of contact enters like h^(1/2), with a small factor
  report.claim(
      share > 0.9 && slowest > 0.7,
      "{}, (H0nc): jumps against the flux of u: h^{:.2f} at the slowest; they are {:.0f} % of the second infimum", name,
      slowest, 100 * share);
}

}  // namespace

void judge_theorems(const Table& results, Report& report) {
  for (const Method& method : methods()) {
    const std::string name = method.name();
    const bool conforming = method.element->conforming();
    const Table own = of_method(results, method), at_1 = own.where("epsilon", 1), small = own.where("epsilon", 1e-6);
    // P1 is a part of V and cannot be below alpha; eigenvalues of CR are below by O(h^2): at 1/h = 8 by less than 0.02.
    const double alpha = discrete_coercivity(method);
    report.claim(alpha > exact_coercivity() - (conforming ? 1e-9 : 0.02),
                 "{}, (H1nc): coercive with {:.4f}, on V {:.4f}", name, alpha, exact_coercivity());
    report.claim(at_1.order("h1", "h") > 0.75, "{}, Theorem 3, {}: h^{:.2f} at epsilon = 1", name,
                 conforming ? "(28)" : "Theorem 6, (31)", at_1.order("h1", "h"));
    report.claim_within(small.order("right", "h"), 1.8, 2.2,
                        name + ", (13) at epsilon = 1e-6: order of the right side");
    if (name != "P1 unstructured") {
      // The proof has C = 2 + 2 max((M/alpha)^2, 2/alpha) = 6.4 at epsilon = 1, where M = 1; observed is one C for all.
      report.claim(own.most("constant") < 2 + 4 / alpha,
                   "{}: (13) holds with C = {:.2f} at every epsilon; the proof has {:.1f} at 1, 1e24 at 1e-6", name,
                   own.most("constant"), 2 + 4 / alpha);
      const double power = std::log(small.last("h1") / at_1.last("h1")) / std::log(1e-6);
      report.claim(std::abs(power) < 0.02, "{}: the error goes like epsilon^{:.3f}, not epsilon^-2", name, power);
    }
    if (conforming)  // 1e-9: the digits of the solver
      report.claim(own.most("second") < 1e-9 * own.least("right"), "{}, Falk: the second infimum is never positive",
                   name);
    else
      judge_jumps(name, own, report);
  }
}

}  // namespace antilock::tutorial
