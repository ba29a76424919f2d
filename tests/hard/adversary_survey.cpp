// The adversary at length: problems made by chance against rational arithmetic, counted by what
// became of them.
//
// Run: adversary_survey 0 20000              by the active set
// Run: adversary_survey 0 2000 uzawa         by Uzawa
// Run: adversary_survey 0 5000 bounds        with upper bounds and constraints of several unknowns
// Run: adversary_survey 0 5000 friction      and with bounds that give way
// Run: adversary_survey 0 5000 corners       rows on prescribed values, nearly dependent, nearly singular, tiny compliance
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "antilock/core/standard_output.hpp"
#include "hard/adversary.hpp"

using namespace antilock::hard;
using antilock::test::Exactly;

namespace {

/// Messages that differ by their numbers alone are one reason.
std::string without_numbers(const std::string& message) {
  return std::regex_replace(message, std::regex("[0-9][0-9.]*(e[-+]?[0-9]+)?"), "#");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(
        stderr,
        "adversary_survey: accepted: FROM TO [uzawa] [bounds | friction | corners], the numbers\n");
    return 2;
  }
  const auto from = static_cast<unsigned>(std::atoi(argv[1])),
             to = static_cast<unsigned>(std::atoi(argv[2]));
  const std::vector<std::string> words(argv + 3, argv + argc);
  const auto asked = [&](const char* word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  const By solver = asked("uzawa") ? By::uzawa : By::active_set;
  const auto problem_of = asked("friction")  ? random_friction
                          : asked("bounds")  ? random_bounds
                          : asked("corners") ? random_corner
                                             : random_problem;
  const char* const outcomes[] = {"right", "warned", "refused", "rightly refused", "QUIETLY WRONG"};
  std::map<std::string, int> counts, reasons;
  for (unsigned seed = from; seed < to; ++seed) {
    const antilock::VariationalInequality problem = problem_of(seed);
    const antilock::test::ExactAnswer exact = antilock::test::exact_answer(problem);
    const Judgement judgement = judge(problem, exact, solver);
    const std::string exact_solution = exact.what == Exactly::solved       ? "has an answer"
                                       : exact.what == Exactly::infeasible ? "infeasible"
                                                                           : "held by nothing";
    const std::string outcome = outcomes[static_cast<int>(judgement.outcome)];
    ++counts[fmt::format("{}: {}", exact_solution, outcome)];
    if (judgement.outcome == Outcome::refused || judgement.outcome == Outcome::warned)
      ++reasons[fmt::format("{}: {:.70}", outcome, without_numbers(judgement.reason))];
    if (judgement.over_claim > 10)
      ++counts[fmt::format("{}: over 10 times what it claims", exact_solution)];
    if (judgement.outcome == Outcome::quietly_wrong)
      fmt::print("problem {}: {}, error {:.1e}\n", seed, exact_solution, judgement.error);
  }
  for (const auto& [what, count] : counts) fmt::print("{:>7} {}\n", count, what);
  fmt::print("reasons:\n");
  for (const auto& [what, count] : reasons) fmt::print("{:>7} {}\n", count, what);
  return antilock::delivered(0, "adversary_survey");
}
