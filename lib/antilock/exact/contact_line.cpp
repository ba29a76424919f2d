#include "antilock/exact/contact_line.hpp"

#include <fmt/format.h>

#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/exact/sine_transform.hpp"

namespace antilock {
namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;

constexpr int coarsest = 64;
constexpr int most_sets = 200, most_cg_steps = 1000;
constexpr double cg_tolerance =
    1e-10;  // in the energy norm; round-off of the transforms sits near 1e-11 at n = 2^17

// D or its inverse, by what it multiplies each wave with.
VectorXd multiplied(VectorXd v, const VectorXd& factor) {
  modes_from_points(v);
  v.array() *= factor.array();
  points_from_modes(v);
  return v;
}

// One grid of n points.
struct Grid {
  Grid(int n, const VectorXd& of_waves, const VectorXd& load_of_waves)
      : stiffness(of_waves.head(n + 1)), load(load_of_waves.head(n + 1)) {
    stiffness(0) = stiffness(n) = 1;
    load(0) = load(n) = 0;
    energy = std::sqrt(n / 2.0 * load.cwiseAbs2().cwiseQuotient(stiffness).sum());
    points_from_modes(load);
  }
  VectorXd apply(const VectorXd& v) const { return multiplied(v, stiffness); }
  VectorXd apply_inverse(const VectorXd& v) const {
    return multiplied(v, stiffness.cwiseInverse());
  }

  VectorXd stiffness;  // D_k
  VectorXd load;       // q_j
  double energy;       // the energy norm of D^-1 q
};

// D c = q on the points with free = 1, c = 0 on the others: conjugate gradients preconditioned by
// D^-1.
VectorXd solve_free(const Grid& level, const ArrayXd& free, const VectorXd& start) {
  const auto masked = [&](const VectorXd& v) -> VectorXd { return (v.array() * free).matrix(); };
  VectorXd c = masked(start);
  VectorXd r = masked(level.load - level.apply(c));
  VectorXd z = masked(level.apply_inverse(r));
  VectorXd p = z;
  double rz = r.dot(z);
  const double enough = cg_tolerance * level.energy;
  for (int step = 0; !(rz <= enough * enough); ++step) {
    if (step == most_cg_steps || !std::isfinite(rz))
      throw NotConverged(fmt::format("exact solution: conjugate gradients on Gamma_C stopped at "
                                     "{:.1e} after {} steps on {} points",
                                     std::sqrt(rz) / level.energy, step, level.load.size() - 1),
                         std::sqrt(rz) / level.energy, step);
    const VectorXd dp = masked(level.apply(p));
    const double alpha = rz / p.dot(dp);
    c += alpha * p;
    r -= alpha * dp;
    z = masked(level.apply_inverse(r));
    const double rz_next = r.dot(z);
    p = z + rz_next / rz * p;
    rz = rz_next;
  }
  return c;
}

// A free point that goes below the obstacle joins the contact, a contact point that is pulled
// leaves it. What counts as below and pulled leaves room for round-off: D amplifies that of c by
// its largest entry.
ContactLine settle(const Grid& level, ArrayXd free, VectorXd c) {
  for (int sets = 0; sets < most_sets; ++sets) {
    c = solve_free(level, free, c);
    const VectorXd lambda = (level.apply(c) - level.load).cwiseProduct((1 - free).matrix());
    const double largest = c.lpNorm<Eigen::Infinity>();
    const double below = -1e-11 * largest;
    const double pulled = -1e-15 * level.stiffness.maxCoeff() * largest -
                          1e-13 * level.load.lpNorm<Eigen::Infinity>();
    const ArrayXd next =
        (free > 0.5)
            .select((c.array() >= below).cast<double>(), (lambda.array() < pulled).cast<double>());
    if ((next == free).all()) return {c.cwiseMax(0), lambda.cwiseMax(0)};
    free = next;
  }
  throw NotConverged(
      fmt::format("exact solution: the contact set on {} points did not settle in {} steps",
                  level.load.size() - 1, most_sets),
      1, most_sets);
}

// A fine point starts in contact where its coarse neighbours are; the displacement is carried over
// as a sine series.
void refine(ArrayXd& free, VectorXd& c) {
  const Eigen::Index n = c.size() - 1;
  modes_from_points(c);
  c.conservativeResizeLike(VectorXd::Zero(2 * n + 1));
  ArrayXd finer(2 * n + 1);
  for (Eigen::Index j = 0; j <= n; ++j) finer(2 * j) = free(j);
  for (Eigen::Index j = 0; j < n; ++j) finer(2 * j + 1) = std::max(free(j), free(j + 1));
  free = finer;
}

}  // namespace

ContactLine solve_contact_line(const VectorXd& stiffness, const VectorXd& load) {
  const int finest = int(stiffness.size()) - 1;
  ArrayXd free = ArrayXd::Ones(coarsest + 1);
  VectorXd modes = VectorXd::Zero(coarsest + 1);
  for (int n = coarsest;; n *= 2) {
    points_from_modes(modes);
    ContactLine line = settle(Grid(n, stiffness, load), free, modes);
    if (n == finest) return line;
    free = (line.pressure.array() > 0).select(ArrayXd::Zero(n + 1), ArrayXd::Ones(n + 1));
    modes = line.displacement;
    refine(free, modes);
  }
}

}  // namespace antilock
