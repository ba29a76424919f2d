#include "lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "antilock/core/atomic_file.hpp"
#include "model_check.hpp"

namespace antilock::freefem {
namespace {

// One paragraph of markdown; its lines end where they end here.
constexpr const char* note = R"(
epsilon = {0:g} where not said.
Road: how FreeFEM solved the stiff part.
mixed: the saddle point of u and the layer stress as it stands, one UMFPACK.
penalty: iterated penalty; for P1 at epsilon = 0 the mixed matrix is singular.
sum: a1 + epsilon^-2 a0 in one matrix.
The library corrects a penalised problem. In the two lines of the paper's Uzawa both sides solve the sum by CG.
Difference: maximum norm over the unknowns, relative to the largest |u|; in 25 and 27 over those of the deflection.
Where a script writes numbers and no solution: the worst of the numbers that the line names, each relative to itself
(u to the largest |u|; distances, which fall like epsilon^2, to the one at epsilon = 1; energies see an error of u only
squared).
The paper's Uzawa: the step in the gap, relative to the largest |u|.
Bound {1:.0e}, but for two kinds of line.
model_check compares P1, extrapolated from h = 1/32 and 1/64, with P2 on FreeFEM's own mesh of the true layer, (22):
bound {2:.0e}.
`plain sum` has lost its digits and is shown only.
Seconds: the solve alone, one thread, meshes and forms apart; in 17 FreeFEM's forms are counted, too.
)";

}  // namespace

std::string markdown(const std::vector<Line>& lines, double epsilon) {
  std::string text = fmt::format(
      "| tutorial | problem | road | unknowns | difference | contact set | C++ | FreeFEM "
      "|\n|---|---|---|---:|---:|---|---:|---:|\n");
  const auto time = [](double s) { return s > 0 ? fmt::format("{:.3g} s", s) : std::string("-"); };
  for (const Line& l : lines)
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} |\n", l.tutorial, l.what, l.road, l.unknowns,
        std::isinf(l.difference) ? std::string("no answer") : fmt::format("{:.1e}", l.difference),
        l.contact, time(l.seconds), time(l.freefem_seconds));
  text += fmt::format(note, epsilon, bound, model_bound);
  if (std::any_of(lines.begin(), lines.end(),
                  [](const Line& l) { return l.contact == "none moves"; }))
    text +=
        "`none moves`: P1 locks, all gaps are 0 to solver tolerance, so there is no contact set to "
        "compare.\n";
  return text;
}

void write_files(const std::vector<Line>& lines, double epsilon, const std::filesystem::path& out,
                 const std::filesystem::path& table) {
  write_file(out / "results.csv", [&](std::ostream& file) {
    file << "tutorial,problem,road,unknowns,difference,contact_set,cpp_seconds,freefem_seconds\n";
    for (const Line& l : lines)
      file << fmt::format("{},\"{}\",\"{}\",{},{},{},{:.6g},{:.6g}\n", l.tutorial, l.what, l.road,
                          l.unknowns, l.difference, l.contact, l.seconds, l.freefem_seconds);
  });
  write_file(table, [&](std::ostream& file) { file << markdown(lines, epsilon); });
}

}  // namespace antilock::freefem
