#pragma once
#include "antilock/distributed/contact_loop.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock::distributed {

/// The answer's forces on Gamma_C: per owned row, 0 off the contact set.
Eigen::VectorXd contact_forces(const DistributedProblem& problem, const State& state);

/// The report of solve/kkt.hpp, with the same scales, over all ranks: the same numbers on each. Every rank must call it.
Kkt kkt_report(const DistributedProblem& problem, const State& state);

/// The report; throws NotConverged, on every rank, where it is above solve/kkt.hpp's level `refused` and ten times the
/// tolerance that was asked for. `warning` is empty, or says how far it is above the trusted level.
Kkt certified(const DistributedProblem& problem, const State& state, double tolerance, std::string& warning);

}  // namespace antilock::distributed
