#pragma once
#include <algorithm>
#include <deque>
#include <limits>

#include "antilock/core/dense.hpp"
#include "antilock/core/double_double.hpp"
#include "antilock/solve/defaults.hpp"

namespace antilock {

/// Anderson's acceleration of a fixed-point iteration x -> x + g(x): the next start is the affine
/// combination of the last few iterates for which the norm of the combined steps g is smallest (D.
/// G. Anderson, J. ACM 12, 1965). For a linear iteration with all iterates kept it is equivalent to
/// GMRES (H. F. Walker and P. Ni, SIAM J. Numer. Anal. 49, 2011).
///
/// Mixing leaves the iteration matrix T of plain steps unchanged: near the solution a plain step
/// multiplies the error of x by T, whatever the start. So the contraction of plain steps also holds
/// for the plain step that follows a mix. The measured contraction misses a slow mode whose
/// component is small in all starts of the history. Where the steps g are round-off, the weights of
/// a mix are arbitrary. This does no harm while all vectors of the history are near the solution.
class Anderson {
 public:
  /// The number of iterates that are kept. With 6 iterates a mix can eliminate five slow modes. Two
  /// to five were observed in locked P1. Each iterate costs vectors of the sizes of u and p.
  static constexpr std::size_t depth = 6;

  /// Adds a plain step to the history. From a start x the step g leads to `iterate` = x + g.
  /// `affine_image` is a second vector that depends affinely on x. (In active_set x is p, and this
  /// vector is u.)
  void push(const DoubleDoubleVector& iterate, const Eigen::VectorXd& g,
            const DoubleDoubleVector& affine_image) {
    past_.push_front({iterate, affine_image, g});
    if (past_.size() > depth) past_.pop_back();
    double most = past_.size() < 2 ? defaults::max_contraction : 1 - defaults::max_contraction,
           gain = 0;
    for (std::size_t i = 1; i < past_.size(); ++i) {
      const Eigen::VectorXd after = iterate - past_[i].iterate;
      const double apart = (after - g + past_[i].g).norm();
      if (!(apart > 0)) continue;
      most = std::max(most, after.norm() / apart);
      gain =
          std::max(gain, (affine_image - past_[i].affine_image).lpNorm<Eigen::Infinity>() / apart);
    }
    contraction_ = std::min(most, defaults::max_contraction);
    // otherwise gain_ keeps its last value, which another contact set hardly changes and a smaller
    // penalty only reduces
    if (gain > 0) gain_ = gain;
  }

  /// Estimates the change of the affine image by the next step: |g| of the last step times the
  /// gain. The last entry of the history is compared with each one before it: the distance of their
  /// affine images in the maximum norm is divided by the distance of their starts. The gain is the
  /// largest of these quotients. It is 0 before two starts are known. (The last step of the affine
  /// image itself is no estimate: it contains the round-off that a mix leaves in a start. A
  /// difference of two images does not contain it.)
  double next_affine_image_step() const { return past_.empty() ? 0 : gain_ * past_[0].g.norm(); }

  /// Estimates the contraction of a plain step. The last entry of the history is compared with each
  /// one before it: the distance of their iterates is divided by the distance of their starts. The
  /// largest of these quotients is the estimate. It is clamped to the range from 1 -
  /// defaults::max_contraction to defaults::max_contraction, and is the latter while there is only
  /// one start. It is valid for any starts. (The ratio of two steps |g| is no estimate after a mix:
  /// a mix makes g smaller, but does not reduce the error by the same factor.)
  double contraction() const { return contraction_; }

  /// Replaces `iterate` by the mix of the history, the next start, and `affine_image` by the mix
  /// with the same weights.
  void mix(DoubleDoubleVector& iterate, DoubleDoubleVector& affine_image) const {
    const auto others = static_cast<Eigen::Index>(past_.size()) - 1;
    if (others < 1) return;
    const Eigen::VectorXd& g = past_[0].g;
    // min | g_0 - sum gamma_i (g_0 - g_i) | over gamma, by the normal equations of at most five
    // scaled columns and a factorisation that drops dependent ones. The entries of the normal
    // matrix are sums of products, so that a pivot below their round-off has no meaning
    Eigen::MatrixXd difference(g.size(), others);
    for (Eigen::Index i = 0; i < others; ++i) difference.col(i) = g - past_[i + 1].g;
    const Eigen::VectorXd scale =
        difference.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
    for (Eigen::Index i = 0; i < others; ++i) difference.col(i) /= scale(i);
    const Eigen::MatrixXd normal = difference.transpose() * difference;
    const Eigen::VectorXd gamma =
        least_squares(normal, difference.transpose() * g, defaults::round_off).cwiseQuotient(scale);
    for (Eigen::Index i = 0; i < others; ++i) {
      iterate += -gamma(i) * (past_[0].iterate - past_[i + 1].iterate);
      affine_image += -gamma(i) * (past_[0].affine_image - past_[i + 1].affine_image);
    }
  }

  /// Forgets the history. This is needed after a change of the iteration itself: another contact
  /// set, or another penalty.
  void restart() { past_.clear(); }
  /// Forgets the oldest entry of the history.
  void forget_the_oldest() {
    if (!past_.empty()) past_.pop_back();
  }

 private:
  struct Iterate {
    DoubleDoubleVector iterate, affine_image;
    Eigen::VectorXd g;
  };
  std::deque<Iterate> past_;           ///< the last one first
  double contraction_ = 0, gain_ = 0;  ///< both measured by `push`
};

}  // namespace antilock
