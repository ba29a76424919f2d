#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {

/// One pair (A1, B) asked again and again with another compliance, load or bound. What does not change is done once:
/// - the forms a1 and a0 hold no compliance: whoever filled the problem assembled them once for all questions;
/// - all loads, all bounds and every compliance below the penalty delta of the factor share one factorisation;
/// - the contact set of one answer starts the search for the next.
/// Any problem of the class can be swept: the layer, the beam, rubber, one's own. SceneSweep does it for a scene.
class Sweep {
 public:
  /// Throws Error as `check` does.
  explicit Sweep(VariationalInequality problem);

  /// Another value of the class parameter, 0 to 1. Throws Error where nothing is stiff (B has no rows).
  void set_compliance(double compliance);
  /// N entries, one per unknown.
  void set_load(Eigen::VectorXd load);
  /// C entries, one per contact unknown; `upper` as in the problem, empty: as it was. Throws Error where there is no
  /// contact, and as `check` does.
  void set_bounds(Eigen::VectorXd lower, std::optional<Eigen::VectorXd> upper = {});
  /// C entries, or none, as in the problem. Throws Error as `check` does.
  void set_force_limit(Eigen::VectorXd force_limit);

  /// The answer, its counters saying what this question cost beyond the ones before. The road is that of the first one.
  Solution solve(ActiveSetOptions options = {});

  const VariationalInequality& problem() const { return problem_; }
  const Counters& total() const { return total_; }  ///< of all answers so far
  /// The factor of the answers so far, with its delta; throws Error before the first.
  const PenalisedCholesky& factor() const;

 protected:
  VariationalInequality problem_;

 private:
  std::optional<PenalisedCholesky> factor_;
  double asked_ = 0;  ///< the delta that the factor was asked for last
  std::optional<BoundStatuses> status_;
  Counters total_;
};

}  // namespace antilock
