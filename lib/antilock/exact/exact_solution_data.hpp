#pragma once
#include <Eigen/Core>
#include <vector>

#include "antilock/exact/exact_solution.hpp"
#include "antilock/exact/wave.hpp"

namespace antilock {

/// The data of ExactSolution: sine coefficients by wave number k = 0..modes (0 unused), and values
/// at the points j / n. Sigma is the interface of body and layer, Gamma_C the contact boundary.
struct ExactSolution::Data {
  double epsilon = 0;
  bool contact = false;
  std::vector<LoadResponse> load;  ///< one per wave number
  Eigen::VectorXd on_sigma;        ///< w_k: u(x, 0)
  Eigen::VectorXd on_gamma_c;      ///< c_k: u(x, -1)
  Eigen::VectorXd stress_sigma;    ///< layer stress on Sigma
  Eigen::VectorXd stress_gamma_c;  ///< layer stress on Gamma_C: -lambda_k
  /// Factors for the coefficients of series that jump: 1 for low k, and falling to 0 at k = n
  /// (exact_solution.cpp).
  Eigen::VectorXd filter;
  Eigen::VectorXd displacement;  ///< c at the points
  Eigen::VectorXd pressure;      ///< lambda at the points

  int modes() const { return int(on_sigma.size()) - 1; }
  int points() const { return int(displacement.size()) - 1; }
};

/// The sine coefficients by k (0 unused) of the exact solution on one row y = const. The series is
/// cut where they are negligible.
struct SineRow {
  Eigen::VectorXd u;
  Eigen::VectorXd p;    ///< body: d_y u; layer: epsilon^-2 d_y u
  Eigen::VectorXd p_y;  ///< d_y p; in the body -u_xx - f, in the layer -u_xx
  double a(Eigen::Index k) const;
};
SineRow body_row(const ExactSolution::Data& exact, double y);   ///< 0 <= y <= 1
SineRow layer_row(const ExactSolution::Data& exact, double y);  ///< -1 <= y <= 0

/// Returns (x, y), moved into the closed domain if it is outside by round-off. Throws Error if it
/// is further outside.
Eigen::Vector2d inside_domain(double x, double y);

}  // namespace antilock
