#pragma once
namespace antilock {

/// The exact solution of the clamped plate of radius 1 over a flat obstacle at the height -gap. A
/// uniform force `load` per area presses the plate downwards. The plate touches the obstacle on the
/// disc r <= c. The solution is a closed form for every thickness t, except for c, the root of a
/// scalar equation (derived in exact_plate.cpp). t = 0 is Kirchhoff's plate. Everything is
/// dimensionless, as in models/plate.hpp.
class ExactPlate {
 public:
  /// Throws Error where the plate does not touch the obstacle on a disc.
  ExactPlate(double thickness, double load = 256, double gap = 1);
  double contact_radius() const { return c_; }
  double deflection(double r) const;  ///< w(r) >= -gap, 0 at r = 1
  double contact_force() const;       ///< pi load minus the force at the clamped edge

 private:
  struct Free {  ///< constants of the part without contact
    double a, b, c;
  };
  Free free_part(double radius) const;
  double fallen(double r, const Free& free) const;  ///< w(r) up to a constant
  double epsilon_, load_, gap_, c_ = 0;
  Free free_{};
};

}  // namespace antilock
