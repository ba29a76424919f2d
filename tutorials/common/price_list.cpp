// The price list and the machine that it holds for.
#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <thread>
#include <tuple>

#include "antilock/core/detail/atomic_file.hpp"
#include "antilock/core/detail/blas.hpp"
#include "antilock/study/table.hpp"
#include "common/timed_runs.hpp"

namespace antilock::tutorial {
namespace {

struct Price {
  std::string outcome;  ///< reached, never, failed or beyond
  double seconds = 0;   ///< beyond: of the finest mesh
  int unknowns = 0;
};

/// `runs` are those of one method at one epsilon, from coarse to fine.
Price price(const std::vector<TimedRun>& runs, double tolerance) {
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

using Runs = std::vector<TimedRun>;  // of one method at one epsilon, from coarse to fine

std::vector<Runs> by_method(const std::vector<TimedRun>& runs) {
  std::vector<Runs> methods;
  for (const TimedRun& run : runs) {
    const auto known =
        std::find_if(methods.begin(), methods.end(), [&](const Runs& m) { return m.front().same_method(run); });
    if (known == methods.end())
      methods.push_back({run});
    else
      known->push_back(run);
  }
  std::stable_sort(methods.begin(), methods.end(), [](const Runs& a, const Runs& b) {
    const TimedRun &x = a.front(), &y = b.front();
    return std::tie(y.element, x.mesh, y.epsilon) < std::tie(x.element, y.mesh, x.epsilon);
  });
  return methods;
}

/// `unknowns: seconds of the first solver / the second / ...`; the solvers of one element, mesh and
/// epsilon.
std::string cell(const std::vector<Price>& prices) {
  const Price& first = prices.front();
  if (first.outcome == "never" || first.outcome == "failed") return first.outcome;
  if (first.outcome == "beyond") return fmt::format("> {}: > {:.2g}", first.unknowns, first.seconds);
  std::string text = fmt::format("{}:", first.unknowns);
  for (const Price& p : prices)
    text +=
        fmt::format("{} {}", &p == &first ? "" : " /", p.outcome == "reached" ? fmt::format("{:.2g}", p.seconds) : "-");
  return text;
}

}  // namespace

void write_price_list(const std::filesystem::path& folder, const std::vector<TimedRun>& runs) {
  constexpr std::array tolerances{1e-2, 1e-3, 1e-4};
  const std::vector<Runs> methods = by_method(runs);
  Table csv({"element", "mesh", "epsilon", "solver", "tolerance", "outcome", "seconds", "unknowns"});
  std::string solvers;
  std::string page = "| element and mesh | epsilon | 1e-2 | 1e-3 | 1e-4 |\n|---|---|---|---|---|\n";
  for (std::size_t first = 0; first < methods.size();) {
    const TimedRun& m = methods[first].front();
    std::array<std::vector<Price>, tolerances.size()> row;
    std::size_t next = first;
    solvers.clear();
    for (; next < methods.size(); ++next) {
      const TimedRun& other = methods[next].front();
      if (other.element != m.element || other.mesh != m.mesh || other.epsilon != m.epsilon) break;
      solvers += (solvers.empty() ? "" : " / ") + other.solver;
      for (std::size_t i = 0; i < tolerances.size(); ++i) {
        row[i].push_back(price(methods[next], tolerances[i]));
        const Price& p = row[i].back();
        csv.add({m.element, m.mesh, m.epsilon, other.solver, tolerances[i], p.outcome, p.seconds, p.unknowns});
      }
    }
    page += fmt::format("| {} {} | {:g} | {} | {} | {} |\n", m.element, m.mesh, m.epsilon, cell(row[0]), cell(row[1]),
                        cell(row[2]));
    first = next;
  }
  int finest = 0;
  for (const TimedRun& run : runs) finest = std::max(finest, run.cells);
  const std::string how =
      fmt::format("1/h from 8 to {}. Unknowns: seconds of {}", finest, solvers) +
      ", without mesh and assembly, until the relative error at the unknowns is below 1e-2, 1e-3, 1e-4. `-`: failed or "
      "over the limit; `never`: locked; `>`: not even on the finest mesh measured.\n\n";
  page.insert(0, how);
  csv.write(folder / "price_list.csv");
  write_file(folder / "price_list.md", [&](std::ostream& out) { out << page; });
}

void write_machine(const std::filesystem::path& path) {
  std::ifstream info("/proc/cpuinfo");
  std::string processor = "unknown", line;
  while (std::getline(info, line))
    if (line.starts_with("model name")) processor = line.substr(line.find(':') + 2);
  std::array<char, 32> date{};
  const std::time_t now = std::time(nullptr);
  std::strftime(date.data(), date.size(), "%F %R UTC", std::gmtime(&now));
  const Blas used = blas();
  Table table({"what", "value"});
  const auto version = [](auto a, auto b, auto c) { return fmt::format("{}.{}.{}", a, b, c); };
  table.add({"processor", processor});
  table.add({"cores", std::thread::hardware_concurrency()});
  table.add({"BLAS", fmt::format("{} with {} kernels on {} threads", used.name,
                                 used.kernel.empty() ? "unknown" : used.kernel, used.threads)});
  if (!used.wider.empty()) table.add({"wider kernels than these", fmt::format("OPENBLAS_CORETYPE={}", used.wider)});
#ifdef __clang__
  table.add({"compiler", __VERSION__});  // its own name is part of it
#else
  table.add({"compiler", std::string("GCC ") + __VERSION__});
#endif
  table.add({"Eigen", version(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)});
  table.add({"CHOLMOD", version(CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION)});
  table.add({"date", date.data()});
  table.write(path);
}

}  // namespace antilock::tutorial
