// Off the obstacle, on (0, c), with the shear force V = (w' - theta) / epsilon:
//     V' = q,  theta'' = -V   so   V = q x + V0,   theta = -(q x^3/6 + V0 x^2/2) + A x,
//     w = -(q x^4/24 + V0 x^3/6) + A x^2/2 + epsilon (q x^2/2 + V0 x)
// In contact, on (c, 1 - c): w = -gap, so V = -theta / epsilon and theta'' = theta / epsilon, odd
// about 1/2:
//     theta = D sinh((x - 1/2) / sqrt(epsilon))
// At c: w' = 0 (w solves a second-order obstacle problem, so it is C1), theta and theta'
// continuous. With
//     t = sqrt(epsilon) tanh((1/2 - c) / sqrt(epsilon)),  theta(c) = -t theta'(c)
// these give V0 and A for every c; w(c) = -gap then fixes c. As epsilon -> 0, t -> 0: the clamped
// Bernoulli beam.
#include "antilock/exact/exact_beam.hpp"

#include <fmt/format.h>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/models/timoshenko_beam.hpp"

namespace antilock {
namespace {

struct Branch {
  double v0, a;
};

/// V0 and A of the free part for a given c.
Branch free_part(double epsilon, double q, double c) {
  const double root = std::sqrt(epsilon);
  const double epsilon_over_t = epsilon > 0 ? root / std::tanh((0.5 - c) / root) : 0;
  const double k = c * epsilon_over_t + epsilon;
  Branch b{};
  b.v0 = -(q * c * c * c / 3 + k * q * c) / (c * c / 2 + k);
  b.a = epsilon_over_t * (q * c + b.v0) + q * c * c / 2 + b.v0 * c;
  return b;
}

double free_deflection(double epsilon, double q, const Branch& b, double x) {
  return -(q * x * x * x * x / 24 + b.v0 * x * x * x / 6) + b.a * x * x / 2 +
         epsilon * (q * x * x / 2 + b.v0 * x);
}

}  // namespace

ExactBeam::ExactBeam(const Beam& beam) : epsilon_(beam.epsilon), load_(beam.load), gap_(beam.gap) {
  const auto sinks = [&](double c) {
    return free_deflection(epsilon_, load_, free_part(epsilon_, load_, c), c) + gap_;
  };
  double low = 1e-9, high = 0.5 - 1e-9;
  if (!(load_ > 0) || sinks(high) > 0)
    throw Error(
        fmt::format("beam: load {} does not press the beam on the obstacle at {} over an interval",
                    load_, gap_));
  while (high - low > 1e-15) {  // sinks falls from gap > 0 as c grows
    const double middle = 0.5 * (low + high);
    (sinks(middle) > 0 ? low : high) = middle;
  }
  c_ = 0.5 * (low + high);
  const Branch b = free_part(epsilon_, load_, c_);
  v0_ = b.v0;
  a_ = b.a;
  d_ = rotation(c_);
}

double ExactBeam::deflection(double x) const {
  if (x > 0.5) return deflection(1 - x);
  return x < c_ ? free_deflection(epsilon_, load_, {v0_, a_}, x) : -gap_;
}

double ExactBeam::rotation(double x) const {
  if (x > 0.5) return -rotation(1 - x);
  if (x <= c_) return -(load_ * x * x * x / 6 + v0_ * x * x / 2) + a_ * x;
  if (epsilon_ == 0) return 0;
  // sinh((1/2 - x)/r) / sinh((1/2 - c)/r) with decaying exponentials
  const double r = std::sqrt(epsilon_);
  const double far = (0.5 - c_) / r;
  const double here = (0.5 - x) / r;
  return d_ * std::exp(here - far) * std::expm1(-2 * here) / std::expm1(-2 * far);
}

double ExactBeam::contact_force() const { return load_ + 2 * v0_; }

double ExactBeam::energy() const {
  // L(w) = -q int w; a(w, w) = L(w) + int lambda w = L(w) - gap R
  const double q = load_, c = c_, c2 = c * c, c3 = c2 * c;
  const double free_part_integral = -(q * c2 * c3 / 120 + v0_ * c2 * c2 / 24) + a_ * c3 / 6 +
                                    epsilon_ * (q * c3 / 6 + v0_ * c2 / 2);
  const double work = -q * (2 * free_part_integral - gap_ * (1 - 2 * c));
  return -0.5 * work - 0.5 * gap_ * contact_force();
}

}  // namespace antilock
