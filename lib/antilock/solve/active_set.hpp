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

/// Primal-dual active set on the contact unknowns, everything else eliminated by one sparse Cholesky factor; the stiff
/// part by iterated penalty. Without contact unknowns this is a linear solve. counters.contact are the steps on the
/// finest level, the largest number over the corrections. Throws Error for a malformed problem, NotConverged instead of
/// ever returning an unconverged answer. A bounded combination becomes an unknown of its own (tied.hpp).
Solution active_set(const VariationalInequality& problem, const ActiveSetOptions& options = {});

/// The same with a factor made before, for a sweep over loads, bounds or compliances of one pair (A1, B).
Solution active_set(const VariationalInequality& problem, PenaltyFactor& factor, const ActiveSetOptions& options = {});

}  // namespace antilock
