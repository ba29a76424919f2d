#include "antilock/solve/iterated_penalty.hpp"

#include <algorithm>

#include "antilock/problem/bounds.hpp"
#include "antilock/solve/corrections.hpp"

namespace antilock {

CorrectionOptions corrections_to(double asked) {
  CorrectionOptions options;
  options.tolerance = asked;
  options.refused = std::max(options.refused, 10 * asked);
  return options;
}

Solution iterated_penalty(const VariationalInequality& problem, PenaltyFactor& factor, const ContactSolver& contact,
                          const CorrectionOptions& options, const std::string& name) {
  require_bounds_on_unknowns(problem, name);
  return Corrections(problem, factor, options, name).solve(contact);
}

}  // namespace antilock
