#pragma once
#include <Eigen/Core>
#include <vector>

#include "antilock/core/eigen_memory.hpp"
#include "antilock/exact/wave.hpp"

namespace antilock {

/// One term of the load f(x, y, z) = sum f_kl(z) sin(k pi x) sin(l pi y) on the body.
struct DoubleSineMode {
  int k, l;                     ///< wave numbers, 1 or more
  std::vector<double> profile;  ///< f_kl(z) = profile[0] + profile[1] z + ..., degree at most 12
};

/// The exact solution of (23) in space, and at epsilon = 0 of (24), of [SR04] (cited in
/// problem/variational_inequality.hpp) by double sine series: the unit cube on the layer (0,1)^2 x
/// (-1,0), u = 0 on the sides and on the top. Gamma_C, the bottom of the layer, is free. So the
/// problem is linear. Values are dimensionless. The constructor throws Error for an argument out of
/// range.
class ExactSolutionInSpace {
 public:
  ExactSolutionInSpace(const std::vector<DoubleSineMode>& load, double epsilon);

  double force(double x, double y, double z) const;  ///< f
  // The point must be in [0,1]^2 x [-1,1]; otherwise Error is thrown.
  double value(double x, double y, double z) const;
  Eigen::Vector3d gradient(double x, double y, double z) const;  ///< on Sigma: the body's side
  /// Returns epsilon^-2 d/dz u, at epsilon = 0 its limit. Throws Error for z > 0.
  double layer_stress(double x, double y, double z) const;

 private:
  struct Term {
    double along_x, along_y;  ///< k pi, l pi
    double on_sigma;          ///< the amplitude of u on Sigma
    WaveResponse response;
  };
  /// The amplitude of u at the height z, its derivative, and in the layer its stress.
  struct Amplitude {
    double value, slope, stress;
  };
  Amplitude in_body(const Term& term, double z) const;
  Amplitude in_layer(const Term& term, double z) const;

  double epsilon_;
  std::vector<Term> terms_;
};

}  // namespace antilock
