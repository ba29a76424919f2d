#pragma once
#include <Eigen/Core>
#include <deque>

namespace antilock {

/// Anderson's acceleration of a fixed-point iteration x -> x + g(x): the combination of the last few iterates whose
/// steps g cancel best (for a linear iteration: GMRES). D. G. Anderson, J. ACM 12 (1965).
class Anderson {
 public:
  explicit Anderson(int depth) : depth_(depth) {}

  /// Notes the iterate reached, `x + g`, and its step `g`, and mixes `reached` in place; `companion` (a vector that
  /// depends affinely on x) is mixed with the same weights.
  void mix(Eigen::VectorXd& reached, const Eigen::VectorXd& g, Eigen::VectorXd& companion);

  /// Forgets the past: after a change of the iteration itself (another contact set), it would only mislead.
  void restart() { past_.clear(); }

 private:
  struct Iterate {
    Eigen::VectorXd reached, g, companion;
  };
  int depth_;
  std::deque<Iterate> past_;
};

}  // namespace antilock
