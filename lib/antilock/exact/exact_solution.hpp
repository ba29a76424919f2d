#pragma once
#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// One term of the load f(x, y) = sum f_k(y) sin(k pi x) on the body: f_k is a polynomial in y.
struct SineMode {
  int k;                        ///< wave number, 1 <= k <= N / 16 (N: the points of ExactSolution)
  std::vector<double> profile;  ///< f_k(y) = profile[0] + profile[1] y + ..., degree at most 12
};
struct SineLoad {
  std::vector<SineMode> modes;  ///< terms of equal k add up; none: no load
  double operator()(double x, double y) const;
};
/// f = 10 sin(2 pi x), the load of every figure here (the paper gives none).
SineLoad paper_sine_load();

/// The exact solution of (23), of (24) at epsilon = 0, and with it of (25), by sine series (derivation in
/// exact_solution.cpp). Construction solves the one-dimensional complementarity problem on Gamma_C; throws Error for a
/// bad argument, NotConverged if the active set does not settle. Values are dimensionless.
class ExactSolution {
 public:
  /// contact = false: Gamma_C free (a linear problem, closed form). N = 2^log2_points collocation points, 6 to 20.
  ExactSolution(const SineLoad& load, double epsilon, bool contact = true, int log2_points = 17);

  double epsilon() const;
  // At any point of the closed domain [0,1] x [-1,1], else Error; 8 digits for value from 2^12 points on. Each call
  // sums the series: about a millisecond where all N modes are alive, so use ExactTable for many points.
  double value(double x, double y) const;
  Eigen::Vector2d gradient(double x, double y) const;  ///< on Sigma: the body's side
  double layer_stress(double x,
                      double y) const;    ///< epsilon^-2 d/dy u for y <= 0 (else Error); its limit at epsilon = 0
  double d_xx(double x, double y) const;  ///< d2u/dx2; away from the ends of contact, where it jumps or blows up
  double pressure(double x) const;        ///< lambda >= 0 on Gamma_C, a density
  std::vector<std::pair<double, double>> contact_zones()
      const;                      ///< intervals of x where u = 0 on Gamma_C; without contact none
  double max_on_contact() const;  ///< max of u on Gamma_C
  double energy() const;          ///< J(u) = a(u,u)/2 - L(u)

  struct Data;  ///< the coefficients (exact_solution_data.hpp), for ExactTable
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace antilock
