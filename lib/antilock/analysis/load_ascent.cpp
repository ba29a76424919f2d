#include "antilock/analysis/load_ascent.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "antilock/exact/sine_load.hpp"

namespace antilock {

SineLoad load_of_modes(const Eigen::VectorXd& c) {
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

double ascend(const std::function<double(const Eigen::VectorXd&)>& error,
              const std::vector<Eigen::VectorXd>& starts, int steps) {
  double best = 0;
  for (const Eigen::VectorXd& start : starts) {
    Eigen::VectorXd at = start.normalized();
    double value = error(at);
    double step = 0.3;
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

}  // namespace antilock
