#pragma once
#include <algorithm>
#include <deque>
#include <limits>

#include "antilock/core/dense.hpp"
#include "antilock/core/double_double.hpp"
#include "antilock/solve/defaults.hpp"

namespace antilock {

/// Anderson's acceleration of a fixed-point iteration x -> x + g(x): the combination of the last few iterates whose
/// steps g cancel best (for a linear iteration: GMRES). D. G. Anderson, J. ACM 12 (1965).
///
/// What a mix does to the rate: nothing. Near the answer a plain step multiplies the error of x by T, and a mix changes
/// the error and not T. So what a plain step after a mix leaves is bounded by the contraction of plain steps. A slow
/// mode with a small share in all starts of the history stays unseen. Where what is left of g is round-off, the
/// weights of a mix are chance; it does no harm as long as the dependent vectors that it mixes are all near the
/// solution.
class Anderson {
 public:
  /// Iterates that are kept: as many slow modes less one are gone. Two to five were seen, in locked P1; each costs two
  /// vectors of u and p.
  static constexpr std::size_t depth = 6;

  /// Adds a plain step to the history: `iterate` = x + g from some x, and `affine_image`, a vector that depends affinely
  /// on x.
  void push(const DoubleDoubleVector& iterate, const Eigen::VectorXd& g, const DoubleDoubleVector& affine_image) {
    past_.push_front({iterate, affine_image, g});
    if (past_.size() > depth) past_.pop_back();
    double most = past_.size() < 2 ? defaults::max_contraction : 1 - defaults::max_contraction, gain = 0;
    for (std::size_t i = 1; i < past_.size(); ++i) {
      const Eigen::VectorXd after = iterate - past_[i].iterate;
      const double apart = (after - g + past_[i].g).norm();
      if (!(apart > 0)) continue;
      most = std::max(most, after.norm() / apart);
      gain = std::max(gain, (affine_image - past_[i].affine_image).lpNorm<Eigen::Infinity>() / apart);
    }
    contraction_ = std::min(most, defaults::max_contraction);
    // else the last one: another contact set hardly changes it, a smaller penalty makes it smaller
    if (gain > 0) gain_ = gain;
  }

  /// What the next step adds to the dependent vector: |g| of the last step times `gain`, the most that the dependent
  /// vector moved, in the maximum norm, where a start moved by 1; 0 where the history holds no two starts yet. (A step
  /// of the dependent vector itself does not tell: round-off that a mix leaves in a start is in g, and in the
  /// dependent vector, but in no step between two of them.)
  double next_affine_image_step() const { return past_.empty() ? 0 : gain_ * past_[0].g.norm(); }

  /// By how much a plain step brings two starts closer, at worst over the last start and those before it; within
  /// defaults::max_contraction, and that where there is only one. It holds wherever the starts came from. (The ratio
  /// of two steps |g|
  /// does not: a mix makes g smaller, not the error by the same factor.)
  double contraction() const { return contraction_; }

  /// Mixes the iterates of the history: `iterate` and, with the same weights, `affine_image` become the next start.
  void mix(DoubleDoubleVector& iterate, DoubleDoubleVector& affine_image) const {
    const auto others = static_cast<Eigen::Index>(past_.size()) - 1;
    if (others < 1) return;
    const Eigen::VectorXd& g = past_[0].g;
    // min | g_0 - sum gamma_i (g_0 - g_i) |: a handful of columns, by a QR that drops dependent ones. The entries of
    // the normal matrix are sums of products: a pivot below their round-off tells nothing
    Eigen::MatrixXd difference(g.size(), others);
    for (Eigen::Index i = 0; i < others; ++i) difference.col(i) = g - past_[i + 1].g;
    const Eigen::VectorXd scale = difference.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
    for (Eigen::Index i = 0; i < others; ++i) difference.col(i) /= scale(i);
    const Eigen::MatrixXd normal = difference.transpose() * difference;
    const Eigen::VectorXd gamma =
        least_squares(normal, difference.transpose() * g, defaults::round_off).cwiseQuotient(scale);
    for (Eigen::Index i = 0; i < others; ++i) {
      iterate += -gamma(i) * (past_[0].iterate - past_[i + 1].iterate);
      affine_image += -gamma(i) * (past_[0].affine_image - past_[i + 1].affine_image);
    }
  }

  /// Forgets the past: after a change of the iteration itself (another contact set), it would only mislead.
  void restart() { past_.clear(); }
  /// Forgets the oldest start of those that are left; after a restart that is the only one.
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
