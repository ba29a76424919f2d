#include "antilock/exact/detail/contact_line.hpp"

#include <fmt/format.h>

#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/exact/detail/sine_transform.hpp"

namespace antilock {
namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;

constexpr int coarsest = 64;
constexpr int most_sets = 200, most_cg_steps = 1000;
constexpr double cg_tolerance = 1e-10;  // in the energy norm; round-off of the transforms sits near 1e-11 at n = 2^17

// One grid of n points: D and its inverse act by two sine transforms.
class Grid {
 public:
  Grid(int n, const VectorXd& stiffness, const VectorXd& load)
      : stiffness_(stiffness.head(n + 1)), load_(load.head(n + 1)), transform_(n) {
    stiffness_(0) = stiffness_(n) = 1;
    load_(0) = load_(n) = 0;
    energy_ = std::sqrt(n / 2.0 * load_.cwiseAbs2().cwiseQuotient(stiffness_).sum());
    transform_.points_from_modes(load_);
  }
  VectorXd apply(VectorXd v) { return multiply(v, stiffness_.array()); }
  VectorXd apply_inverse(VectorXd v) { return multiply(v, stiffness_.array().inverse()); }
  const VectorXd& load() const { return load_; }
  double energy() const { return energy_; }  // the energy norm of D^-1 q
  int size() const { return transform_.size(); }
  double largest_stiffness() const { return stiffness_.maxCoeff(); }
  SineTransform& transform() { return transform_; }

 private:
  template <class Factor>
  VectorXd multiply(VectorXd& v, const Factor& factor) {
    transform_.modes_from_points(v);
    v.array() *= factor;
    transform_.points_from_modes(v);
    return v;
  }
  VectorXd stiffness_, load_;
  SineTransform transform_;
  double energy_;
};

// D c = q on the points with free = 1, c = 0 on the others: conjugate gradients preconditioned by D^-1.
VectorXd solve_free(Grid& level, const ArrayXd& free, const VectorXd& start) {
  const auto masked = [&](const VectorXd& v) -> VectorXd { return (v.array() * free).matrix(); };
  VectorXd c = masked(start);
  VectorXd r = masked(level.load() - level.apply(c));
  VectorXd z = masked(level.apply_inverse(r));
  VectorXd p = z;
  double rz = r.dot(z);
  const double enough = cg_tolerance * level.energy();
  for (int step = 0; !(rz <= enough * enough); ++step) {
    if (step == most_cg_steps || !std::isfinite(rz))
      throw NotConverged(
          fmt::format("truth: conjugate gradients on Gamma_C stopped at {:.1e} after {} steps on {} points",
                      std::sqrt(rz) / level.energy(), step, level.size()),
          std::sqrt(rz) / level.energy(), step);
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

// A free point that goes below the obstacle joins the contact, a contact point that is pulled leaves it.
// What counts as below and pulled leaves room for round-off: D amplifies that of c by its largest entry.
ContactLine settle(Grid& level, ArrayXd free, VectorXd c) {
  for (int sets = 0; sets < most_sets; ++sets) {
    c = solve_free(level, free, c);
    const VectorXd lambda = (level.apply(c) - level.load()).cwiseProduct((1 - free).matrix());
    const double largest = c.lpNorm<Eigen::Infinity>();
    const double below = -1e-11 * largest;
    const double pulled = -1e-15 * level.largest_stiffness() * largest - 1e-13 * level.load().lpNorm<Eigen::Infinity>();
    const ArrayXd next =
        (free > 0.5).select((c.array() >= below).cast<double>(), (lambda.array() < pulled).cast<double>());
    if ((next == free).all()) return {c.cwiseMax(0), lambda.cwiseMax(0)};
    free = next;
  }
  throw NotConverged(
      fmt::format("truth: the contact set on {} points did not settle in {} steps", level.size(), most_sets), 1,
      most_sets);
}

// A fine point starts in contact where its coarse neighbours are; the displacement is carried over as a sine series.
void refine(Grid& coarse, ArrayXd& free, VectorXd& c) {
  const int n = coarse.size();
  coarse.transform().modes_from_points(c);
  c.conservativeResizeLike(VectorXd::Zero(2 * n + 1));
  ArrayXd finer(2 * n + 1);
  for (int j = 0; j <= n; ++j) finer(2 * j) = free(j);
  for (int j = 0; j < n; ++j) finer(2 * j + 1) = std::max(free(j), free(j + 1));
  free = finer;
}

}  // namespace

ContactLine solve_contact_line(const VectorXd& stiffness, const VectorXd& load) {
  const int finest = int(stiffness.size()) - 1;
  ArrayXd free = ArrayXd::Ones(coarsest + 1);
  VectorXd modes = VectorXd::Zero(coarsest + 1);
  for (int n = coarsest;; n *= 2) {
    Grid level(n, stiffness, load);
    level.transform().points_from_modes(modes);
    ContactLine line = settle(level, free, modes);
    if (n == finest) return line;
    free = (line.pressure.array() > 0).select(ArrayXd::Zero(n + 1), ArrayXd::Ones(n + 1));
    modes = line.displacement;
    refine(level, free, modes);
  }
}

}  // namespace antilock
