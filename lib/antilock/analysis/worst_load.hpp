#pragma once
#include <optional>

#include "antilock/exact/load_modes.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/penalised_cholesky.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// The load in the unit ball of L2(body) for which a method has the largest error: the supremum in
/// the definition of locking of I. Babuska and M. Suri (SIAM J. Numer. Anal. 29, 1992), without
/// contact.
struct WorstLoad {
  double error = 0;      ///< |u - u_h| in the (broken) energy seminorm, the largest for |f| <= 1 in L2(body)
  Eigen::VectorXd load;  ///< of norm 1, in LoadModes
};

/// Returns l_k, the error at epsilon = 0 under the load psi_k sin(k pi x) / |psi_k|, psi_k = sinh(k
/// pi (1 - y)) / sinh(k pi), of a method whose functions are all 0 on the layer. It falls with k >=
/// 1. A conforming method with d independent functions on the layer has a worst error of at least
/// l_{d+1} over the ball.
double loss_of_wave(int k);

/// Returns the limit as h -> 0 of the worst error of P_p over the ball at epsilon = 0 on an
/// unstructured mesh; no mesh has a smaller one. It is the error of a body that is resolved
/// exactly, whose traces on Sigma, the interface of body and layer, are x (1 - x) times polynomials
/// of degree p - 2, or 0 for p = 1. p >= 1; computed with 64 waves.
///
/// The functions that are lost are z = sum c_k e_k with a(z, v) = 0 for the kept traces v. In the
/// basis e_k / |e_k|_a, orthonormal in a, with |z|^2 = sum l_k^2 c_k^2, they are orthogonal to the
/// vectors (energy_of_wave^(1/2) int v sin(k pi x))_k.
double loss_of_degree(int p);

/// Returns the Kolmogorov n-width of the ball's solutions (A. Pinkus, n-Widths in Approximation
/// Theory, 1985): no conforming space with n >= 0 functions on the body has a smaller worst error,
/// for any epsilon. It is 1 / (pi (k^2 + m^2)^(1/2)), where sin(k pi x) sin(m pi y) is the last of
/// the first n + 1 sines in the order of k^2 + m^2.
double kolmogorov_width(int n);

/// The error of (23) without contact as a quadratic form in the load f = LoadModes:
///
///     |u - u_h|^2 = f' E f,  E = S - F' A^-1 F                                   V_h in V: by Galerkin's orthogonality
///                            E = S + F' A^-1 F - F' J - J' F                     CR, J f = I_h u
///
/// in the seminorm of a^epsilon. S: exact response. F: the loads integrated against the basis. A:
/// the method's matrix. CR's interpolant I_h u has a_h(u, v_h) = a_h(I_h u, v_h). F is dense, N x
/// n; E is never formed.
class ErrorForm {
 public:
  /// modes.waves() from 1 to 2 per cell side: above, the load is integrated inexactly. Throws Error for
  /// more than 4.25 waves per longest edge, a mesh of anything but the two unit squares, a space
  /// without layer, or of an element that is neither conforming nor CR.
  ErrorForm(const Space& space, LoadModes modes);

  /// 0 <= epsilon <= 1, else Error; 1 before the first call.
  void set_epsilon(double epsilon);
  const LoadModes& modes() const { return modes_; }
  /// E f.
  Eigen::VectorXd apply(const Eigen::VectorXd& f);
  /// The error |u - u_h| under the load f.
  double error(const Eigen::VectorXd& f);
  /// The largest over |f| <= 1, by Lanczos iteration, to a relative `tolerance`, from below.
  WorstLoad worst(double tolerance = 1e-4);

 private:
  void integrate_loads();
  void interpolate_solutions();
  Eigen::VectorXd interpolant(const Eigen::VectorXd& f) const;             // J f
  Eigen::VectorXd interpolant_transposed(const Eigen::VectorXd& b) const;  // J' b
  Eigen::VectorXd answer(const Eigen::VectorXd& load);

  Space space_;
  LoadModes modes_;
  double epsilon_ = 1;
  VariationalInequality problem_;
  std::optional<PenalisedCholesky> factor_;
  std::vector<int> active_;         // unknowns of the body that are not clamped
  Eigen::MatrixXd loads_;           // F': n x active
  Eigen::MatrixXd means_, decays_;  // CR: edge means of the basis (n x active), of 2 sin decay (waves + 1 x active)
};

}  // namespace antilock
