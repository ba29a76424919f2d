#pragma once
#include <optional>

#include "antilock/exact/load_modes.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/penalised_cholesky.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// The load of a ball of which a method makes the largest error: the supremum in the definition of locking of Babuska
/// and Suri (SIAM J. Numer. Anal. 29, 1992; [3] of the paper), without contact.
struct WorstLoad {
  double error = 0;      ///< |u - u_h| in the (broken) energy seminorm, the largest for |f| <= 1 in L2(body)
  Eigen::VectorXd load;  ///< of norm 1, in LoadModes
};

/// l_k: the error at epsilon = 0 under psi_k sin(k pi x) / |psi_k|, psi_k = sinh(k pi (1 - y)) / sinh(k pi), of a
/// method whose functions are all 0 on the layer. A conforming method with d functions there loses at least l_{d+1} on
/// the ball. k >= 1, falling.
double loss_of_wave(int k);

/// What P_p on an unstructured mesh loses on the ball at epsilon = 0 as h -> 0, and never less: a body resolved exactly
/// whose traces on Sigma are x (1 - x) times polynomials of degree p - 2; for p = 1 they are 0. By 64 waves; p from 1.
///
/// The functions lost are z = sum c_k e_k with a(z, v) = 0 for the kept traces v: in the basis e_k / |e_k|_a,
/// orthonormal in a, with |z|^2 = sum l_k^2 c_k^2, they are orthogonal to the vectors (energy_of_wave^(1/2) int v sin(k
/// pi x))_k.
double loss_of_degree(int p);

/// The width of the ball: no conforming space with n functions on the body has a smaller worst error, for any epsilon.
/// 1 / (pi (k^2 + m^2)^(1/2)), the last of the first n + 1 sines sin(k pi x) sin(m pi y). n >= 0.
double kolmogorov_width(int n);

/// The error of (23) without contact as a quadratic form in the load f = LoadModes:
///
///     |u - u_h|^2 = f' E f,  E = S - F' A^-1 F                                   V_h in V: by Galerkin's orthogonality
///                            E = S + F' A^-1 F - F' J - J' F                     CR, J f = I_h u
///
/// in the seminorm of a^epsilon. S: exact response. F: the loads integrated against the basis. A: the method's matrix.
/// CR's interpolant I_h u has a_h(u, v_h) = a_h(I_h u, v_h). F is dense, N x n; E is never formed.
class ErrorForm {
 public:
  /// modes.waves() from 1 to 2 per cell side: above, the load is integrated inexactly.
  /// Throws Error for more than 4.25 waves per longest edge, a mesh of anything but the two unit squares, a space
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
