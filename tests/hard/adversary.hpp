#pragma once
#include <string>

#include "antilock/problem/variational_inequality.hpp"
#include "support/exact_rational.hpp"

namespace antilock::hard {

/// Problem number `seed` of an endless list: up to six unknowns; stiffnesses, loads, bounds,
/// prescribed values, units of B and M each over up to twelve decades; dependent rows of B;
/// compliance from 0 to above 1.
VariationalInequality random_problem(unsigned seed);

/// Problem number `seed` of a second list: a problem of the first with bounds of other shapes.
/// Upper bounds; two-sided ones, some so narrow that both sides touch, some equations; combinations
/// of two to four unknowns in units of their own, some through fixed and bounded unknowns, a few
/// dependent on other bounds.
VariationalInequality random_bounds(unsigned seed);

/// Problem number `seed` of a third list: a problem of the second with up to four bounds, most of
/// which give way. Friction (equations that bear a given force), plastic obstacles, forces that are
/// borne over twelve decades, some 0, some the very force at which the bound gives way.
VariationalInequality random_friction(unsigned seed);

/// Problem number `seed` of a fourth list: corners of the first two. Rows of B on prescribed values
/// alone, at compliance 1e-14; rows of B between 1e-12 and 1e-3 from dependent; an A1 that is
/// singular but for 1e-12 to 1e-6 of it; combinations at compliance 1e-14.
VariationalInequality random_corner(unsigned seed);

enum class Outcome {
  right,         ///< u to 1e-6 of its largest entry, no warning
  warned,        ///< answered with a warning
  refused,       ///< refused though there is an answer
  rightly,       ///< refused, and there is none
  quietly_wrong  ///< answered without a warning, and wrong; or answered where there is none
};

struct Judgement {
  Outcome outcome = Outcome::right;
  double error = 0;       ///< of u relative to the largest entry of the exact u
  double over_claim = 0;  ///< where answered without a warning: the error of u over the one that
                          ///< Solution::error claims
  std::string reason;     ///< the message of a refusal or a warning
};

enum class By { active_set, uzawa };

/// Solves, and compares with rational arithmetic.
Judgement judge(const VariationalInequality& problem, const test::ExactAnswer& exact,
                By solver = By::active_set);

}  // namespace antilock::hard
