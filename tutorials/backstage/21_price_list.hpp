#pragma once
#include <array>
#include <tuple>

#include "backstage/21_markdown.hpp"
#include "backstage/21_timing.hpp"

namespace antilock::tutorial {

struct Price {
  std::string outcome;  ///< reached, never (locked: the error hardly falls), failed (before it came so far) or beyond
  double seconds = 0;   ///< beyond: of the finest mesh
  int unknowns = 0;
};

/// The cheapest of the runs, those of one method at one epsilon from coarse to fine, within a relative error.
inline Price price(const std::vector<TimedRun>& runs, double tolerance) {
  std::vector<TimedRun> good;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(good), [](const TimedRun& r) { return r.ok; });
  Price best;
  for (const TimedRun& r : good)
    if (r.relative() <= tolerance && (best.outcome.empty() || r.seconds < best.seconds))
      best = {"reached", r.seconds, r.unknowns};
  if (!best.outcome.empty()) return best;
  // between two meshes of a method that converges the error falls by a factor of 2 at least
  if (good.size() > 1 && good.back().relative() > 0.9 * good[good.size() - 2].relative()) return {"never"};
  if (good.size() < runs.size()) return {"failed"};
  return {"beyond", good.back().seconds, good.back().unknowns};
}

/// `unknowns: seconds of the first solver / the second / ...`, on one kind of mesh.
inline std::string cell(const std::vector<Price>& prices) {
  const Price& first = prices.front();
  if (first.outcome == "never" || first.outcome == "failed") return first.outcome;
  if (first.outcome == "beyond") return fmt::format("> {}: > {:.2g}", first.unknowns, first.seconds);
  std::string text = fmt::format("{}:", first.unknowns);
  for (const Price& p : prices)
    text +=
        fmt::format("{} {}", &p == &first ? "" : " /", p.outcome == "reached" ? fmt::format("{:.2g}", p.seconds) : "-");
  return text;
}

/// price_list.csv, one row per method, epsilon, solver and relative error, and price_list.md, one per method and epsilon.
inline void write_price_list(const std::filesystem::path& folder, const std::vector<TimedRun>& runs) {
  std::vector<std::vector<TimedRun>> methods;  // of each the runs from coarse to fine; solvers in their order
  for (const TimedRun& run : runs) {
    const auto known =
        std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m[0].same_method(run); });
    (known == methods.end() ? methods.emplace_back() : *known).push_back(run);
  }
  std::stable_sort(methods.begin(), methods.end(), [](const auto& a, const auto& b) {
    return std::tie(b[0].element, a[0].mesh, b[0].epsilon) < std::tie(a[0].element, b[0].mesh, a[0].epsilon);
  });
  constexpr std::array tolerances{1e-2, 1e-3, 1e-4};
  Table csv({"element", "mesh", "epsilon", "solver", "tolerance", "outcome", "seconds", "unknowns"});
  Table page({"element and mesh", "epsilon", "1e-2", "1e-3", "1e-4"});
  std::string solvers;
  for (auto first = methods.begin(), next = first; first != methods.end(); first = next) {
    const TimedRun& m = first->front();
    std::array<std::vector<Price>, tolerances.size()> row;
    const auto together = [&](const TimedRun& r) { return std::tie(r.element, r.mesh, r.epsilon); };
    for (solvers.clear(); next != methods.end() && together(next->front()) == together(m); ++next) {
      solvers += (solvers.empty() ? "" : " / ") + next->front().solver;
      for (std::size_t i = 0; i < tolerances.size(); ++i) {
        const Price& p = row[i].emplace_back(price(*next, tolerances[i]));
        csv.add({m.element, m.mesh, m.epsilon, next->front().solver, tolerances[i], p.outcome, p.seconds, p.unknowns});
      }
    }
    page.add({m.element + " " + m.mesh, m.epsilon, cell(row[0]), cell(row[1]), cell(row[2])});
  }
  csv.write(folder / "price_list.csv");
  write_markdown(folder / "price_list.md",
                 fmt::format("1/h from 8 to {}. Unknowns: seconds of {}, without mesh and assembly, until the relative "
                             "error at the unknowns is below 1e-2, 1e-3, 1e-4. `-`: failed or over the limit; `never`: "
                             "locked; `>`: not even on the finest mesh measured.",
                             runs.back().cells, solvers),
                 page);
}

}  // namespace antilock::tutorial
