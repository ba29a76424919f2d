#pragma once
// The networks of 36_neural_network: their points of quadrature, their features, their
// random weights, and the training. They are no part of the library, because no solver of
// the class (1) needs them.
#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/exact_solution.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// A network with one hidden layer has one row per feature (N x 5). The columns are the
/// weights of x, of y+ = max(y, 0) and of y- = min(y, 0), the shift, and the outer weight:
///
///     u = 4 x (1 - x) (1 - y+) sum_j outer_j tanh(w_j x + w_j^+ y+ + w_j^- y- + shift_j)
///
/// The factor before the sum is 0 on the clamped sides. A feature may have a kink on Sigma,
/// y = 0.
using Network = Eigen::Matrix<double, Eigen::Dynamic, 5>;
enum NetworkColumn { column_x, column_body, column_layer, column_shift, column_outer };

/// The points of Gauss's rule with n points in each direction, on the body (0,1) x (0,1) or
/// on the layer (0,1) x (-1,0). Every array has n^2 entries. With another depth of the
/// layer y runs from -depth to 0, and the weights remain those of depth 1.
struct GaussPoints {
  GaussPoints(int n, bool on_layer, double depth = 1)
      : layer(on_layer), x(n * n), y(n * n), weight(n * n) {  // filled below
    const auto [points, weights] = gauss_rule(n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        x(n * i + j) = points(i);
        y(n * i + j) = layer ? depth * (points(j) - 1) : points(j);
        weight(n * i + j) = weights(i) * weights(j);
      }
  }

  /// The column of the weights that multiply y here.
  NetworkColumn across() const { return layer ? column_layer : column_body; }
  Eigen::ArrayXd clamp() const { return 4 * x * (1 - x) * (1 - on_body() * y); }
  Eigen::ArrayXd clamp_x() const { return 4 * (1 - 2 * x) * (1 - on_body() * y); }
  Eigen::ArrayXd clamp_y() const { return -4 * on_body() * x * (1 - x); }
  /// Returns s with -ds/dx = f, the load 10 sin(2 pi x) of the body. So the work of the
  /// load is int f v = int s dv/dx for each v that is 0 at x = 0 and x = 1.
  Eigen::ArrayXd load_flux() const {
    const double pi = std::numbers::pi;
    return 5 / pi * on_body() * (2 * pi * x).cos();
  }
  double on_body() const { return layer ? 0 : 1; }

  bool layer;
  Eigen::ArrayXd x, y, weight;
};

/// Returns tanh of each feature's argument (one row per point, one column per feature).
inline Eigen::ArrayXXd activations(const Network& network, const GaussPoints& at) {
  const Eigen::MatrixXd along = at.x.matrix() * network.col(column_x).transpose();
  const Eigen::MatrixXd across = at.y.matrix() * network.col(at.across()).transpose();
  const Eigen::RowVectorXd shift = network.col(column_shift).transpose();
  const Eigen::MatrixXd argument = (along + across).rowwise() + shift;
  return argument.array().unaryExpr([](double z) { return std::tanh(z); });
}

/// The derivatives of the features with their factor (one row per point, one column per
/// feature). The outer weights are not used.
struct FeatureSlopes {
  Eigen::ArrayXXd along, across;
};
inline FeatureSlopes feature_slopes(const Network& network, const GaussPoints& at) {
  const Eigen::ArrayXXd value = activations(network, at);
  const Eigen::ArrayXXd slope = (1 - value.square()).colwise() * at.clamp();
  const Eigen::ArrayXXd along = slope.rowwise() * network.col(column_x).transpose().array();
  const Eigen::ArrayXXd across =
      slope.rowwise() * network.col(at.across()).transpose().array();
  return {along + value.colwise() * at.clamp_x(), across + value.colwise() * at.clamp_y()};
}

/// Returns for each feature 2 int_0^1 v(x, -depth) sin(2 pi x) dx (N), the height of its
/// wave sin(2 pi x) on Gamma_C.
inline Eigen::VectorXd ridge_heights(const Network& network, double depth = 1) {
  const auto [x, weight] = gauss_rule(40);
  GaussPoints bottom(1, true);
  bottom.x = x;
  bottom.y = Eigen::ArrayXd::Constant(x.size(), -depth);
  const Eigen::ArrayXXd values = activations(network, bottom).colwise() * bottom.clamp();
  const Eigen::ArrayXd wave = 2 * weight.array() * (2 * std::numbers::pi * bottom.x).sin();
  return values.matrix().transpose() * wave.matrix();
}

/// Random numbers between -1 and 1, the same on every machine. The distributions of
/// <random> differ between standard libraries, and the generators do not.
class RandomWeights {
 public:
  explicit RandomWeights(int seed) : generator_(seed) {}
  double operator()() { return static_cast<double>(generator_() >> 11) * 0x1p-52 - 1; }

 private:
  std::mt19937_64 generator_;
};

/// Returns a network whose inner weights and shifts are random between -scale and scale.
/// Its outer weights are random between -start and start.
inline Network random_network(int features, double scale, double start, int seed) {
  RandomWeights random(seed);
  Network network(features, 5);
  for (int j = 0; j < features; ++j) {
    for (const NetworkColumn column : {column_x, column_body, column_layer, column_shift})
      network(j, column) = scale * random();
    network(j, column_outer) = start * random();
  }
  return network;
}

/// Returns the median of numbers. There must be one at least.
inline double median(std::vector<double> numbers) {
  const auto middle = numbers.begin() + numbers.size() / 2;
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

/// Returns "least to most" of a column.
inline std::string range_text(const Table& rows, const std::string& column) {
  return fmt::format("{:.2f} to {:.2f}", rows.min(column), rows.max(column));
}

/// Returns "least to most" of the medians of five numbers each, in their order. A remainder
/// of fewer than five is left out.
inline std::string range_of_medians(const std::vector<double>& numbers) {
  Table medians({"of five"});
  for (std::size_t i = 0; i + 5 <= numbers.size(); i += 5)
    medians.add({median({numbers.begin() + i, numbers.begin() + i + 5})});
  return range_text(medians, "of five");
}

/// Returns a row per kind of weights and epsilon for networks of 50 features: the energy
/// and the ridge of all draws, their medians, and the medians of five draws each.
inline Table spread_of_draws(const Table& draws) {
  Table spread({"weights", "epsilon", "energy", "ridge", "median", "medians of five"});
  for (const TableEntry& weights : draws.unique("weights"))
    for (const TableEntry& epsilon : draws.unique("epsilon")) {
      const Table kind = draws.filter("weights", weights).filter("features", 50);
      const Table some = kind.filter("epsilon", epsilon);
      const std::vector<double> ridges = some.numbers("ridge");
      spread.add({weights, epsilon, range_text(some, "energy"), range_text(some, "ridge"),
                  median(ridges), range_of_medians(ridges)});
    }
  return spread;
}

/// Prints the medians of the energy (N features, random weights), and writes results.csv
/// and networks.csv, the medians for the picture.
inline void show_draws(const std::filesystem::path& to, const Table& draws) {
  Table networks({"weights", "network", "features", "epsilon", "energy"});
  for (const TableEntry& weights : draws.unique("weights"))
    for (const TableEntry& features : draws.unique("features"))
      for (const TableEntry& epsilon : draws.unique("epsilon")) {
        const Table kind = draws.filter("weights", weights).filter("features", features);
        const double energy = median(kind.filter("epsilon", epsilon).numbers("energy"));
        const std::string network = features.text() + ", " + weights.text();
        networks.add({weights, network, features, epsilon, energy});
      }
  const Table energies = networks.pivot("network", "epsilon", "energy");
  energies.print("the energy, by epsilon: medians", 3);
  spread_of_draws(draws).print("50 features, from draw to draw: energy and ridge", 2);
  draws.write(to / "results.csv");
  networks.write(to / "networks.csv");
}

/// Prints the training from seed to seed, and writes training.csv and trained.csv, the
/// medians over the seeds for the picture. A median below 0 (J is above that of u = 0) is
/// left out of the picture.
inline void show_training(const std::filesystem::path& to, const Table& runs) {
  Table ranges({"epsilon", "steps", "energy", "ridge", "across"});
  Table medians({"epsilon", "steps", "energy"});
  for (const TableEntry& epsilon : runs.unique("epsilon"))
    for (const TableEntry& steps : runs.unique("steps")) {
      const Table some = runs.filter("epsilon", epsilon).filter("steps", steps);
      const double middle = median(some.numbers("energy"));
      if (middle > 0) medians.add({epsilon, steps, middle});
      if (steps.number() < 100) continue;
      const std::string energy = range_text(some, "energy");
      const std::string ridge = range_text(some, "ridge");
      ranges.add({epsilon, steps, energy, ridge, range_text(some, "across")});
    }
  ranges.print("training of 50 features: from seed to seed", 3);
  runs.write(to / "training.csv");
  medians.write(to / "trained.csv");
}

/// A function to minimise. It returns its value at a point and writes its gradient there.
using Objective =
    std::function<double(const Eigen::VectorXd& at, Eigen::VectorXd& gradient)>;

/// Minimises a smooth function by L-BFGS [LN89] with 20 pairs, Algorithm 7.4 of [NW06].
/// Each step length is bisected until it meets the weak Wolfe conditions, as Lewis and
/// Overton [LO13] do.
///
/// Debian's L-BFGS++ (0.1.0) would do the same. It would be one more package for each
/// build, and headers that the compiler of the book does not find.
///
/// [LN89] D. C. Liu, J. Nocedal, On the limited memory BFGS method for large scale
/// optimization, Math. Program. 45 (1989) 503-528.
/// [NW06] J. Nocedal, S. J. Wright, Numerical Optimization, 2nd ed., Springer 2006.
/// [LO13] A. S. Lewis, M. L. Overton, Nonsmooth optimization via quasi-Newton methods,
/// Math. Program. 141 (2013) 135-163.
class Lbfgs {
 public:
  Lbfgs(Objective objective, Eigen::VectorXd start)
      : objective_(std::move(objective)), x_(std::move(start)), gradient_(x_.size()) {
    value_ = objective_(x_, gradient_);
  }

  const Eigen::VectorXd& x() const { return x_; }
  double value() const { return value_; }
  /// Takes one step. Returns false, and stays at x, where no step length meets the
  /// conditions.
  bool step() {
    const Eigen::VectorXd direction = -times_inverse_hessian(gradient_);
    const double slope = gradient_.dot(direction);
    double length = pairs_.empty() ? std::min(1.0, 1 / gradient_.norm()) : 1;
    double shortest = 0, longest = std::numeric_limits<double>::infinity();
    Eigen::VectorXd gradient(x_.size());
    for (int trial = 0; trial < 40; ++trial) {
      const Eigen::VectorXd x = x_ + length * direction;
      const double value = objective_(x, gradient);
      const bool decreases = value <= value_ + 1e-4 * length * slope;
      if (decreases && gradient.dot(direction) >= 0.9 * slope) {
        remember(x - x_, gradient - gradient_);
        x_ = x;
        value_ = value;
        gradient_ = gradient;
        return true;
      }
      (decreases ? shortest : longest) = length;
      length = std::isinf(longest) ? 2 * shortest : (shortest + longest) / 2;
    }
    return false;
  }

 private:
  struct Pair {
    Eigen::VectorXd step, change;  // of x, and of the gradient
    double product;                // step . change, positive by the second Wolfe condition
  };

  void remember(const Eigen::VectorXd& step, const Eigen::VectorXd& change) {
    const double product = step.dot(change);
    if (!(product > 0)) return;  // round-off alone
    if (pairs_.size() == 20) pairs_.erase(pairs_.begin());
    pairs_.push_back({step, change, product});
  }

  Eigen::VectorXd times_inverse_hessian(Eigen::VectorXd q) const {
    std::vector<double> shares(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      shares[i] = pairs_[i].step.dot(q) / pairs_[i].product;
      q -= shares[i] * pairs_[i].change;
    }
    if (!pairs_.empty()) q *= pairs_.back().product / pairs_.back().change.squaredNorm();
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      q += (shares[i] - pairs_[i].change.dot(q) / pairs_[i].product) * pairs_[i].step;
    return q;
  }

  Objective objective_;
  Eigen::VectorXd x_, gradient_;
  double value_ = 0;
  std::vector<Pair> pairs_;
};

}  // namespace antilock::tutorial
