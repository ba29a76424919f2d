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
  std::vector<SineMode> modes;  ///< terms of equal k add up; empty: no load
  double operator()(double x, double y) const;
};
/// Returns f = 10 sin(2 pi x), the load of the figures of this project. (The paper, [SR04], names
/// no load. It is cited in problem/variational_inequality.hpp.)
SineLoad paper_sine_load();

/// The exact solution of (23), and at epsilon = 0 of (24) and (25), of [SR04] by sine series
/// (derivation in exact_solution.cpp). The constructor solves the one-dimensional complementarity
/// problem on Gamma_C, the contact boundary. It throws Error for an argument out of range, and
/// NotConverged if the active set does not converge. Values are dimensionless. Sigma is the
/// interface of body and layer.
class ExactSolution {
 public:
  /// With `contact` false Gamma_C is free (a linear problem, in closed form). N = 2^log2_points is
  /// the number of collocation points; log2_points is 6 to 20.
  ExactSolution(const SineLoad& load, double epsilon, bool contact = true, int log2_points = 17);

  double epsilon() const;
  // The point must be in [0,1] x [-1,1]; otherwise Error is thrown. `value` has 8 digits from 2^12
  // points on. Each call sums the series, which takes about a millisecond if all N modes
  // contribute. For many points use ExactTable.
  double value(double x, double y) const;
  Eigen::Vector2d gradient(double x, double y) const;  ///< on Sigma: the body's side
  /// Returns epsilon^-2 d/dy u, at epsilon = 0 its limit. Throws Error for y > 0.
  double layer_stress(double x, double y) const;
  /// Returns d2u/dx2, away from the ends of contact, where it jumps or is unbounded.
  double d_xx(double x, double y) const;
  double pressure(double x) const;  ///< lambda >= 0 on Gamma_C, a density
  /// Returns the intervals of x where u = 0 on Gamma_C; none without contact.
  std::vector<std::pair<double, double>> contact_zones() const;
  double max_on_contact() const;  ///< max of u on Gamma_C
  double energy() const;          ///< J(u) = a(u,u)/2 - L(u)

  struct Data;  ///< the coefficients (exact_solution_data.hpp), for ExactTable
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace antilock
