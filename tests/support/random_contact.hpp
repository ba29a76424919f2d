#pragma once
#include <Eigen/Core>
#include <random>

#include "support/dense.hpp"

namespace antilock::test {

/// Contact problems of 3 to 30 unknowns over 0 with a random symmetric positive definite matrix,
/// condition number 1e7 at most: plain exchanges of whole sets cycle on some of them.
class RandomContact {
 public:
  void next() {
    const int n = 3 + trial_++ % 28;
    Eigen::MatrixXd g(n, n);
    q.resize(n);
    for (double& value : g.reshaped()) value = normal_(random_);
    for (double& value : q) value = normal_(random_);
    s = product(g, g.transpose()) + 1e-4 * Eigen::MatrixXd::Identity(n, n);
    lower.setZero(n);
  }
  int size() const { return static_cast<int>(q.size()); }

  Eigen::MatrixXd s;
  Eigen::VectorXd q, lower;

 private:
  std::mt19937 random_{4};
  std::normal_distribution<double> normal_;
  int trial_ = 0;
};

}  // namespace antilock::test
