#pragma once
#include <Eigen/Dense>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock::test {

/// What rational arithmetic says of a small problem.
enum class Exactly {
  solved,      ///< one u
  infeasible,  ///< compliance = 0, and no u meets the bounds, the prescribed values and B u = 0
  singular     ///< A1 + B' M B is not positive definite on the free unknowns
};

struct ExactAnswer {
  Exactly what = Exactly::singular;
  Eigen::VectorXd u;  ///< N, rounded once; empty unless solved
};

/// The inequality without any rounding: every double is a rational number. In coordinates of the
/// kernel of B (compliance = 0), or of all free unknowns, every contact set with independent bounds
/// (on either side, and on combinations) is tried until one meets every
/// condition; where none does, no u is admissible. Exponential in the contact unknowns and cubic in
/// bits: up to six unknowns or so.
ExactAnswer exact_answer(const VariationalInequality& problem);

}  // namespace antilock::test
