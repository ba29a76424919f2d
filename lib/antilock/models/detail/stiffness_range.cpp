#include "antilock/models/detail/stiffness_range.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "antilock/core/error.hpp"

namespace antilock {

void StiffnessRange::note(double stiffness) {
  if (!(stiffness > 0)) return;
  softest_ = std::min(softest_, stiffness);
  stiffest_ = std::max(stiffest_, stiffness);
}

void StiffnessRange::check(const char* what) const {
  if (stiffest_ > 1e16 * softest_)
    throw Error(
        fmt::format("{}: stiffnesses from {:.3g} to {:.3g}, which double precision does not hold "
                    "together; accepted: a "
                    "stiffest one of at most 1e16 times the softest",
                    what, softest_, stiffest_));
}

void StiffnessRange::append(VariationalInequality& problem,
                            const WeightedFactoredForm& rows) const {
  append_rows(problem, rows.form.b, unit_ * rows.form.m, unit_ * rows.stiffness.cwiseInverse());
}

}  // namespace antilock
