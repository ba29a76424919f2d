#pragma once
#include <deque>

#include "antilock/core/detail/twice.hpp"

namespace antilock {

/// Anderson's acceleration of a fixed-point iteration x -> x + g(x): the combination of the last few iterates whose
/// steps g cancel best (for a linear iteration: GMRES). D. G. Anderson, J. ACM 12 (1965).
///
/// What a mix does to the rate: nothing. Near the answer a plain step multiplies the error of x by T, and a mix changes the
/// error and not T. So what a plain step after a mix leaves is bounded by the contraction of plain steps. A slow mode with a
/// small share in all noted starts stays unseen. Where what is left of g is round-off, the weights of a mix are chance; it
/// does no harm as long as the companions that it mixes are all near the answer.
class Anderson {
 public:
  /// Iterates that are kept: as many slow modes less one are gone. Two to five were seen, in locked P1; each costs two
  /// vectors of u and p.
  static constexpr std::size_t depth = 6;

  /// Notes a plain step: `reached` = x + g from some x, and `companion`, a vector that depends affinely on x.
  void note(const Twice& reached, const Eigen::VectorXd& g, const Twice& companion);

  /// |g| of the last step times `gain`, the most that the companion moved, in the maximum norm, where a start moved by 1: what
  /// the next step adds to the companion; 0 where no two starts are noted yet. (A step of the companion itself does not tell:
  /// round-off that a mix leaves in a start is in g, and in the companion, but in no step between two companions.)
  double next_companion_step() const { return past_.empty() ? 0 : gain_ * past_[0].g.norm(); }

  /// By how much a plain step brings two starts closer, at worst over the last start and those before it; within
  /// tuned::slowest, and that where there is only one. It holds wherever the starts came from. (The ratio of two steps |g| does not: a
  /// mix makes g smaller, not the error by the same factor.)
  double contraction() const { return contraction_; }

  /// Mixes the noted iterates: `reached` and, with the same weights, `companion` become the next start.
  void mix(Twice& reached, Twice& companion) const;

  /// Forgets the past: after a change of the iteration itself (another contact set), it would only mislead.
  void restart() { past_.clear(); }
  /// Forgets the start noted first of those that are left; after a restart that is the only one.
  void forget_the_oldest() {
    if (!past_.empty()) past_.pop_back();
  }

 private:
  struct Iterate {
    Twice reached, companion;
    Eigen::VectorXd g;
  };
  std::deque<Iterate> past_;           ///< the last one first
  double contraction_ = 0, gain_ = 0;  ///< both measured by `note`
};

}  // namespace antilock
