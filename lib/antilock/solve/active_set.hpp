#pragma once
#include <optional>
#include <vector>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/detail/iterated_penalty.hpp"
#include "antilock/solve/penalty_factor.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

struct ActiveSetOptions {
  CorrectionOptions corrections;
  std::optional<double> penalty;              ///< delta where compliance is smaller; empty: choose_penalty
  ContactRoad road = ContactRoad::automatic;  ///< of the factor, where the solver makes it
  int max_steps = 1000;                       ///< of the contact iteration, a correction; reached: NotConverged
  std::optional<Pieces> start;                ///< C: pieces to start from; empty: the nested start
};

/// Two loops. The outer one corrects u and p by one sparse Cholesky factor, the inner one finds the contact set of each
/// correction (contact.hpp):
///
///     repeat:  r1, r2 from u, p, lambda               residual.hpp, exact
///              u += du, p += dp, lambda from the contact problem of r1, r2
///              stop where accuracy(next du, r2) is within the tolerance judge.hpp
///     then:    doubt and the KKT report               judge.hpp, kkt.hpp: a warning, or NotConverged
///
/// To read in this order: problem/variational_inequality.hpp, stairs.hpp, contact.hpp, residual.hpp, this, judge.hpp;
/// the constants with their reasons are in detail/tuned.hpp. The outer loop stands in active_set.cpp,
/// IteratedPenalty::solve, and its mathematics in detail/iterated_penalty.hpp. A loop that stops otherwise, after five
/// corrections say, changes the one condition there; `finished` judges its last correction all the same, and refuses
/// what is not within the tolerance.
///
/// Without contact unknowns this is a linear solve. counters.contact are the steps on the finest level, the largest
/// number over the corrections. Throws Error for a malformed problem, NotConverged instead of ever returning an
/// unconverged answer. A bounded combination becomes an unknown of its own (tied.hpp).
Solution active_set(const VariationalInequality& problem, const ActiveSetOptions& options = {});

/// The same with a factor made before, for a sweep over loads, bounds or compliances of one pair (A1, B).
Solution active_set(const VariationalInequality& problem, PenaltyFactor& factor, const ActiveSetOptions& options = {});

}  // namespace antilock
