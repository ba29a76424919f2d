#pragma once
#include "antilock/distributed/contact_loop.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock::distributed {

/// Returns the forces of the solution on Gamma_C, the contact boundary, one per owned row: 0 off
/// the contact set. Every rank must call it.
Eigen::VectorXd contact_forces(const DistributedProblem& problem, const State& state);

/// Returns the report of solve/kkt.hpp over all ranks, with the same scales. The numbers are the
/// same on every rank. Every rank must call it.
Kkt kkt_report(const DistributedProblem& problem, const State& state);

/// Returns the result of kkt_report. Throws NotConverged, on every rank, where the worst violation
/// is above max(KktTolerances::fail, 10 tolerance). `warning` is empty, or says how far the
/// violation is above KktTolerances::warn.
Kkt certified(const DistributedProblem& problem, const State& state, double tolerance,
              std::string& warning);

}  // namespace antilock::distributed
