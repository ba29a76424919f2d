#pragma once
#include "antilock/models/timoshenko_beam.hpp"

namespace antilock {

/// The exact solution of the Timoshenko beam over a flat obstacle, in contact on [c, 1 - c]. It is
/// a closed form except for c, the root of a scalar equation (derived in exact_beam.cpp). At
/// epsilon = 0 it is the Bernoulli beam, with c = (72 gap / load)^(1/4). Everything is
/// dimensionless.
class ExactBeam {
 public:
  /// Throws Error where the beam does not reach the obstacle over an interval (load too small for
  /// this gap).
  explicit ExactBeam(const Beam& beam);
  double contact_start() const { return c_; }
  double deflection(double x) const;  ///< w(x) >= -gap
  double rotation(double x) const;    ///< theta(x)
  /// Returns the total contact force R = load - 2 |shear force at a clamp|.
  double contact_force() const;
  /// J = a1/2 + a0/(2 epsilon) - L = -(1/2) L(w) - (1/2) gap R at the solution.
  double energy() const;

 private:
  double epsilon_, load_, gap_;
  double c_ = 0, v0_ = 0, a_ = 0,
         d_ = 0;  ///< contact start, shear force and curvature at the clamp, rotation in contact
};

}  // namespace antilock
