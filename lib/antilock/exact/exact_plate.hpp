#pragma once
namespace antilock {

/// The exact clamped plate of radius 1 under the load -load, pressed on a flat obstacle at -gap: it touches on the disc
/// r <= c. Closed form for every thickness but for one scalar root, derived in exact_plate.cpp; t = 0 is Kirchhoff's.
class ExactPlate {
 public:
  /// Throws Error where the plate does not touch the obstacle on a disc.
  ExactPlate(double thickness, double load = 256, double gap = 1);
  double contact_radius() const { return c_; }
  double deflection(double r) const;  ///< w(r) >= -gap, 0 at r = 1
  double contact_force() const;       ///< load pi less what the rim carries

 private:
  struct Free {  ///< constants of the free part
    double a, b, c;
  };
  Free free_part(double radius) const;
  double fallen(double r, const Free& free) const;  ///< w(r) up to a constant
  double epsilon_, load_, gap_, c_ = 0;
  Free free_{};
};

}  // namespace antilock
