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
  /// |u - u_h| in the (broken) energy seminorm, the largest for |f| <= 1 in L2(body).
  double error = 0;
  Eigen::VectorXd load;  ///< its coefficients in LoadModes, of norm 1
};

/// Returns l_k, the error at epsilon = 0 under the load psi_k sin(k pi x) / |psi_k|, psi_k = sinh(k
/// pi (1 - y)) / sinh(k pi), of a method whose functions are all 0 on the layer. k is at least 1,
/// and l_k decreases as k grows. A conforming method with d independent functions on the layer has
/// a worst error of at least l_{d+1} over the ball.
double loss_of_wave(int k);

/// Returns the limit as h -> 0 of the worst error of P_p over the ball at epsilon = 0 on an
/// unstructured mesh; no mesh has a smaller one. In this limit the body is resolved exactly, but
/// the trace of u_h on Sigma, the interface of body and layer, is x (1 - x) times a polynomial of
/// degree p - 2 (0 for p = 1). p is at least 1. The series are cut after 64 waves.
///
/// Let e_k be psi_k sin(k pi x) in the body and sin(k pi x) in the layer. The functions that the
/// method cannot represent are z = sum c_k e_k / |e_k|_a with a(z, v) = 0 for all v with an
/// admissible trace. The e_k / |e_k|_a are orthonormal in a, so the vector c is orthogonal to
/// (|e_k|_a int v sin(k pi x))_k for each admissible trace v. The norm of z in L2(body) is (sum
/// l_k^2 c_k^2)^(1/2). The largest one with |c| = 1 is the worst error, by duality.
double loss_of_degree(int p);

/// Returns the Kolmogorov n-width of the ball's solutions (A. Pinkus, n-Widths in Approximation
/// Theory, 1985): no conforming space with n >= 0 functions on the body has a smaller worst error,
/// for any epsilon. It is 1 / (pi (k^2 + m^2)^(1/2)), where sin(k pi x) sin(m pi y) is the last of
/// the first n + 1 sines in the order of k^2 + m^2.
double kolmogorov_width(int n);

/// The error of (23) of [SR04] (cited in problem/variational_inequality.hpp) without contact, as a
/// quadratic form in the load f, the vector of its coefficients in LoadModes:
///
///     |u - u_h|^2 = f' E f
///     E = S - F' A^-1 F                  if V_h is in V, by Galerkin's orthogonality
///     E = S + F' A^-1 F - F' J - J' F    for CR, with J f = I_h u
///
/// in the seminorm of a^epsilon. S is the exact response (LoadModes::response), F the matrix of the
/// loads integrated against the basis of V_h, and A the matrix of the method. CR's interpolant I_h
/// u has a_h(u, v_h) = a_h(I_h u, v_h). F is dense, N x n, and E is never formed.
class ErrorForm {
 public:
  /// modes.waves() should be 1 to 2 per cell side, because loads with more waves are not integrated
  /// accurately. Throws Error for more than 4.25 waves per longest edge, for a mesh other than that
  /// of the two unit squares, body and layer, and for an element that is neither conforming nor CR.
  ErrorForm(const Space& space, LoadModes modes);

  /// Sets epsilon, which is 1 at first. Throws Error outside of [0, 1].
  void set_epsilon(double epsilon);
  const LoadModes& modes() const { return modes_; }
  /// Returns E f.
  Eigen::VectorXd apply(const Eigen::VectorXd& f);
  /// Returns the error |u - u_h| under the load f.
  double error(const Eigen::VectorXd& f);
  /// Returns the load with the largest error over |f| <= 1. Lanczos iteration approximates this
  /// error from below to a relative `tolerance`.
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
  std::vector<int> active_;  // unknowns of the body that are not clamped
  Eigen::MatrixXd loads_;    // F': n x active
  // CR: edge means of the basis (n x active), and of 2 sin decay ((waves + 1) x active)
  Eigen::MatrixXd means_, decays_;
};

}  // namespace antilock
