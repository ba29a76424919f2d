// Everything depends on r alone; epsilon = t^2, the shear force is Q = (w' - theta) / epsilon, L
// the operator L theta = ((r theta)' / r)'. Off the obstacle, on (c, 1):
//     (r Q)' / r = q,  L theta = -Q   so   Q = q r/2 + A/r,
//     theta = -q r^3/16 - A (r/2 ln r - r/4) + B r/2 + C/r,   w' = theta + epsilon Q
// In contact w' = 0, so Q = -theta / epsilon and L theta = theta / epsilon: theta = D I_1(r / t),
// I_k Bessel's. At c: w' = 0 (w is C1, as for the beam), theta and theta' continuous. I_1' = I_0 -
// I_1/z and theta(c) = -epsilon Q give theta'(c) = -s Q(c), s = t I_0(c/t) / I_1(c/t) - epsilon /
// c. With theta(1) = 0 that is A, B and C for every c; w(1) - w(c) = gap then fixes c. As t -> 0,
// s -> 0: Kirchhoff's plate.
#include "antilock/exact/exact_plate.hpp"

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"

namespace antilock {
namespace {

/// I_0(z) / I_1(z), by I_(k-1) / I_k = 2 k / z + I_(k+1) / I_k from far above z down; for large z
/// its asymptotic series.
double bessel_ratio(double z) {
  if (z > 1e4) return 1 + 1 / (2 * z) + 3 / (8 * z * z) + 3 / (8 * z * z * z);
  const int above = 40 + 2 * static_cast<int>(z);
  double ratio = 2 * above / z;
  for (int k = above - 1; k >= 1; --k) ratio = 2 * k / z + 1 / ratio;
  return ratio;
}

}  // namespace

ExactPlate::Free ExactPlate::free_part(double c) const {
  const double t = std::sqrt(epsilon_);
  const double q = load_;
  const double l = std::log(c);
  const double s = t > 0 ? t * bessel_ratio(c / t) - epsilon_ / c : 0;
  Eigen::Matrix3d m;  // theta(1), w'(c), theta'(c) + s Q(c), in A, B, C
  m << 0.25, 0.5, 1,  //
      -(c / 2 * l - c / 4) + epsilon_ / c, c / 2, 1 / c,  //
      -(0.5 * l + 0.25) + s / c, 0.5, -1 / (c * c);
  const Eigen::Vector3d right(q / 16, q * c * c * c / 16 - epsilon_ * q * c / 2,
                              3 * q * c * c / 16 - s * q * c / 2);
  const Eigen::VectorXd x = least_squares(m, right, 1e-14);
  return {x(0), x(1), x(2)};
}

double ExactPlate::fallen(double r, const Free& f) const {
  const double l = std::log(r), r2 = r * r;
  return -load_ * r2 * r2 / 64 - f.a * r2 / 4 * (l - 1) + f.b * r2 / 4 + f.c * l +
         epsilon_ * (load_ * r2 / 4 + f.a * l);
}

ExactPlate::ExactPlate(double thickness, double load, double gap)
    : epsilon_(thickness * thickness), load_(load), gap_(gap) {
  const auto depth = [&](double c) {  // how far the rim is above r = c
    const Free f = free_part(c);
    return fallen(1, f) - fallen(c, f);
  };
  if (!(thickness >= 0 && thickness <= 10))
    throw Error(fmt::format("plate: thickness = {}; accepted: 0 to 10", thickness));
  if (!(gap > 1e-9 * load &&
        std::isfinite(load)))  // contact up to the rim, where fallen(1) - fallen(c) cancels
    throw Error(fmt::format(
        "plate: gap {} under the load {}; accepted: more than 1e-9 of a finite load", gap, load));
  double low = 1e-3, high = 1 - 1e-9;
  if (!(load > 0 && gap > 0 && depth(low) >= gap))
    throw Error(fmt::format(
        "plate: load {} does not press the plate on the obstacle at {} over a disc", load, -gap));
  while (high - low > 1e-15) {
    const double middle = 0.5 * (low + high);
    (depth(middle) > gap ? low : high) = middle;
  }
  c_ = 0.5 * (low + high);
  free_ = free_part(c_);
}

double ExactPlate::deflection(double r) const {
  return r > c_ ? fallen(r, free_) - fallen(1, free_) : -gap_;
}

double ExactPlate::contact_force() const { return -2 * std::numbers::pi * free_.a; }

}  // namespace antilock
