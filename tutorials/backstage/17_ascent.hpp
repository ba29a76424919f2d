#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "antilock/exact/sine_load.hpp"

namespace antilock::tutorial {

/// The load sum_k c_k 2 sin(k pi x) cos(pi y / 2), of L2 norm |c|: the modes m = 1 of LoadModes, as a SineLoad (the
/// cosine by its Taylor polynomial of degree 12, to 1e-8).
inline SineLoad load_of_modes(const Eigen::VectorXd& c) {
  const double square = std::pow(std::numbers::pi / 2, 2);
  SineLoad load;
  for (int k = 1; k <= c.size(); ++k) {
    std::vector<double> cosine(13, 0.0);
    double term = 2 * c(k - 1);
    for (int i = 0; i <= 12; i += 2) {
      cosine[i] = term;
      term *= -square / ((i + 1) * (i + 2));
    }
    load.modes.push_back({k, cosine});
  }
  return load;
}

/// A maximum of `error` on the unit sphere by ascent: gradient by differences, the step doubled after a success and
/// halved after a failure, from each start. The largest found: a lower bound of the supremum, no more.
inline double ascend(const std::function<double(const Eigen::VectorXd&)>& error,
                     const std::vector<Eigen::VectorXd>& starts, int steps = 6) {
  double best = 0;
  for (const Eigen::VectorXd& start : starts) {
    Eigen::VectorXd at = start.normalized();
    double value = error(at), step = 0.3;
    for (int i = 0; i < steps && step > 0.02; ++i) {
      Eigen::VectorXd gradient(at.size());
      for (Eigen::Index k = 0; k < at.size(); ++k)
        gradient(k) = error((at + 1e-3 * Eigen::VectorXd::Unit(at.size(), k)).normalized()) - value;
      const Eigen::VectorXd tried = (at + step * gradient.normalized()).normalized();
      const double there = error(tried);
      if (there > value) {
        at = tried;
        value = there;
        step *= 2;
      } else {
        step *= 0.5;
      }
    }
    best = std::max(best, value);
  }
  return best;
}

}  // namespace antilock::tutorial
