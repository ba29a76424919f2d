#include "antilock/solve/detail/anderson.hpp"

#include <algorithm>

#include "antilock/core/dense.hpp"
#include "antilock/solve/detail/tuned.hpp"

namespace antilock {

void Anderson::note(const Twice& reached, const Eigen::VectorXd& g, const Twice& companion) {
  past_.push_front({reached, companion, g});
  if (past_.size() > depth) past_.pop_back();
  double most = past_.size() < 2 ? tuned::slowest : 1 - tuned::slowest, gain = 0;
  for (std::size_t i = 1; i < past_.size(); ++i) {
    const Eigen::VectorXd after = reached - past_[i].reached;
    const double apart = (after - g + past_[i].g).norm();
    if (!(apart > 0)) continue;
    most = std::max(most, after.norm() / apart);
    gain = std::max(gain, (companion - past_[i].companion).lpNorm<Eigen::Infinity>() / apart);
  }
  contraction_ = std::min(most, tuned::slowest);
  // else the last one: another contact set hardly changes it, a smaller penalty makes it smaller
  if (gain > 0) gain_ = gain;
}

void Anderson::mix(Twice& reached, Twice& companion) const {
  const auto others = static_cast<Eigen::Index>(past_.size()) - 1;
  if (others < 1) return;
  const Eigen::VectorXd& g = past_[0].g;
  // min | g_0 - sum gamma_i (g_0 - g_i) |: a handful of columns, by a QR that drops dependent ones. The entries of the
  // normal matrix are sums of products: a pivot below their round-off tells nothing
  Eigen::MatrixXd difference(g.size(), others);
  for (Eigen::Index i = 0; i < others; ++i) difference.col(i) = g - past_[i + 1].g;
  const Eigen::VectorXd scale = difference.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
  for (Eigen::Index i = 0; i < others; ++i) difference.col(i) /= scale(i);
  const Eigen::MatrixXd normal = difference.transpose() * difference;
  const Eigen::VectorXd gamma =
      least_squares(normal, difference.transpose() * g, tuned::round_off).cwiseQuotient(scale);
  for (Eigen::Index i = 0; i < others; ++i) {
    reached += -gamma(i) * (past_[0].reached - past_[i + 1].reached);
    companion += -gamma(i) * (past_[0].companion - past_[i + 1].companion);
  }
}

}  // namespace antilock
