#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "antilock/core/dense.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/core/error.hpp"
#include "antilock/form/quadrature.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/penalty_factor.hpp"
#include "antilock/space/space.hpp"
#include "backstage/17_load_modes.hpp"

namespace antilock::tutorial {

/// The basis loads of `modes` at a point.
inline Eigen::VectorXd basis_loads(const LoadModes& modes, const Eigen::Vector2d& x) {
  return 2 * modes.sines(x(0))(modes.k()).cwiseProduct(modes.cosines(x(1))(modes.m()));
}

/// 2 |e_k|_a^2 of e_k = psi_k sin(k pi x) in the body, sin(k pi x) in the layer: a coth a of the body, a^2 of the
/// layer.
inline double energy_of_wave(int k) {
  const double a = k * std::numbers::pi;
  return a / std::tanh(a) + a * a;
}

/// The load of a ball of which a method makes the largest error: the supremum in the definition of locking of Babuska
/// and Suri (SIAM J. Numer. Anal. 29, 1992; [3] of the paper), without contact.
struct WorstLoad {
  double error = 0;      ///< |u - u_h| in the (broken) energy seminorm, the largest for |f| <= 1 in L2(body)
  Eigen::VectorXd load;  ///< of norm 1, in LoadModes
};

/// l_k: the error at epsilon = 0 under psi_k sin(k pi x) / |psi_k|, psi_k = sinh(k pi (1 - y)) / sinh(k pi), of a
/// method whose functions are all 0 on the layer. A conforming method with d functions there loses at least l_{d+1} on
/// the ball. k >= 1, falling.
inline double loss_of_wave(int k) {
  const double a = k * std::numbers::pi, square = (1 / std::tanh(a) - a / std::pow(std::sinh(a), 2)) / (2 * a);
  return std::sqrt(square / energy_of_wave(k));
}

/// What P_p on an unstructured mesh loses on the ball at epsilon = 0 as h -> 0, and never less: a body resolved exactly
/// whose traces on Sigma are x (1 - x) times polynomials of degree p - 2; for p = 1 they are 0. By 64 waves; p from 1.
///
/// The functions lost are z = sum c_k e_k with a(z, v) = 0 for the kept traces v: in the basis e_k / |e_k|_a,
/// orthonormal in a, with |z|^2 = sum l_k^2 c_k^2, they are orthogonal to the vectors (energy_of_wave^(1/2) int v sin(k
/// pi x))_k.
inline double loss_of_degree(int p) {
  const int waves = 64, points = 1024;
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(points + 1, 0, 1);
  Eigen::MatrixXd kept = Eigen::MatrixXd::Zero(waves, p - 1), lost = Eigen::MatrixXd::Zero(waves, waves);
  for (int k = 1; k <= waves; ++k) {
    lost(k - 1, k - 1) = std::pow(loss_of_wave(k), 2);
    for (int j = 0; j < p - 1; ++j)
      kept(k - 1, j) =
          std::sqrt(energy_of_wave(k)) * (x * (1 - x) * (2 * x - 1).pow(j) * (k * std::numbers::pi * x).sin()).sum();
  }
  if (p > 1) {
    const Eigen::MatrixXd traces = kept.transpose(), gram = traces * kept;
    const Eigen::MatrixXd off = Eigen::MatrixXd::Identity(waves, waves) - kept * Cholesky(gram).solve(traces);
    lost = off * lost * off;
  }
  return std::sqrt(symmetric_eigenvalues(lost).maxCoeff());
}

/// The width of the ball: no conforming space with n functions on the body has a smaller worst error, for any epsilon.
/// 1 / (pi (k^2 + m^2)^(1/2)), the last of the first n + 1 sines sin(k pi x) sin(m pi y). n >= 0.
inline double width_of_ball(int n) {
  std::vector<int> squares;
  for (int k = 1; k * k < 2 * n + 8; ++k)  // more than n + 1 of them lie in this square, their first n + 1 in it
    for (int m = 1; m * m < 2 * n + 8; ++m) squares.push_back(k * k + m * m);
  std::nth_element(squares.begin(), squares.begin() + n, squares.end());
  return 1 / (std::numbers::pi * std::sqrt(squares[n]));
}

/// The error of (23) without contact as a quadratic form in the load f = LoadModes:
///
///     |u - u_h|^2 = f' E f,  E = S - F' A^-1 F                                   V_h in V: by Galerkin's orthogonality
///                            E = S + F' A^-1 F - F' J - J' F                     CR, J f = I_h u
///
/// in the seminorm of a^epsilon. S: exact response. F: the loads integrated against the basis. A: the method's matrix.
/// CR's interpolant I_h u has a_h(u, v_h) = a_h(I_h u, v_h). F is dense, N x n; E is never formed.
class ErrorForm {
 public:
  /// modes.waves() from 1 to 2 per cell side: above, the load is integrated inexactly. The space must outlive this.
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

  const Space& space_;
  LoadModes modes_;
  double epsilon_ = 1;
  VariationalInequality problem_;
  std::optional<PenaltyFactor> factor_;
  std::vector<int> active_;         // unknowns of the body that are not clamped
  Eigen::MatrixXd loads_;           // F': n x active
  Eigen::MatrixXd means_, decays_;  // CR: edge means of the basis (n x active), of 2 sin decay (waves + 1 x active)
};

inline ErrorForm::ErrorForm(const Space& space, LoadModes modes) : space_(space), modes_(std::move(modes)) {
  if (!space.element().conforming() && &space.element() != &crouzeix_raviart())
    throw Error("error form: element " + space.element().name() + "; accepted: conforming ones and CR");
  const TriangleMesh& mesh = space.mesh();
  // three per cell side of a structured mesh, whose longest edges are sqrt(2) h
  const double most_waves = 4.25 / mesh.diameter();
  if (modes_.waves() > most_waves)
    throw Error(
        fmt::format("error form: {} waves on edges up to {:.3g} long; accepted: up to {:.0f}, those that the "
                    "quadrature sees",
                    modes_.waves(), mesh.diameter(), most_waves));
  const Eigen::RowVector2d least = mesh.vertices.colwise().minCoeff(), most = mesh.vertices.colwise().maxCoeff();
  if (!((least - Eigen::RowVector2d(0, -1)).norm() < 1e-6 && (most - Eigen::RowVector2d(1, 1)).norm() < 1e-6))
    throw Error(fmt::format(
        "error form: a mesh of ({:.6g}, {:.6g}) x ({:.6g}, {:.6g}); accepted: (0, 1) x (-1, 1), body and layer",
        least(0), most(0), least(1), most(1)));
  problem_ = assemble(Scene(Body{[](double, double) { return 0.0; }}, StiffLayer{1}), space);
  integrate_loads();
  if (!space.element().conforming()) interpolate_solutions();
}

inline void ErrorForm::set_epsilon(double epsilon) {
  if (!(epsilon >= 0 && epsilon <= 1)) throw Error(fmt::format("error form: epsilon = {}; accepted 0 to 1", epsilon));
  epsilon_ = epsilon;
  problem_.compliance = compliance(StiffLayer{epsilon});
  const double delta = moderate_delta(problem_);
  if (factor_ && factor_->delta() != delta) factor_->refactor(delta);
}

inline void ErrorForm::integrate_loads() {
  const TriangleMesh& mesh = space_.mesh();
  const Element& element = space_.element();
  const Quadrature& rule = triangle_rule(12);
  const Eigen::Index points = rule.weights.size();
  Eigen::MatrixXd weighted(points, element.unknowns()), values(modes_.size(), points);
  for (Eigen::Index q = 0; q < points; ++q)
    weighted.row(q) = rule.weights(q) * element.basis(rule.points.row(q)).transpose();
  std::vector<int> place(space_.size(), -1);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; mesh.region[t] == Region::body && i < element.unknowns(); ++i) place[space_.unknowns()(t, i)] = 0;
  for (const int i : space_.clamped()) place[i] = -1;
  for (int i = 0; i < space_.size(); ++i)
    if (place[i] == 0) {
      place[i] = static_cast<int>(active_.size());
      active_.push_back(i);
    }
  loads_.setZero(modes_.size(), static_cast<Eigen::Index>(active_.size()));
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::body) continue;
    for (Eigen::Index q = 0; q < points; ++q)
      values.col(q) = basis_loads(modes_, point_in(mesh, t, rule.points.row(q)));
    const Eigen::MatrixXd local = mesh.area(t) * values * weighted;
    for (int i = 0; i < element.unknowns(); ++i)
      if (const int p = place[space_.unknowns()(t, i)]; p >= 0) loads_.col(p) += local.col(i);
  }
}

// The unknowns of CR are means over edges. Those of the layer are not needed: no load stands there.
inline void ErrorForm::interpolate_solutions() {
  const auto [points, weights] = gauss_rule(10);
  const TriangleMesh& mesh = space_.mesh();
  means_.setZero(modes_.size(), loads_.cols());
  decays_.setZero(modes_.waves() + 1, loads_.cols());
  for (Eigen::Index p = 0; p < loads_.cols(); ++p) {
    const Eigen::Vector2d from = mesh.vertices.row(mesh.edges(active_[p], 0)),
                          to = mesh.vertices.row(mesh.edges(active_[p], 1));
    for (Eigen::Index q = 0; q < points.size(); ++q) {
      const Eigen::Vector2d x = from + points(q) * (to - from);
      means_.col(p) += weights(q) * basis_loads(modes_, x);
      decays_.col(p) += 2 * weights(q) * modes_.sines(x(0)).cwiseProduct(modes_.decays(x(1)));
    }
  }
}

inline Eigen::VectorXd ErrorForm::interpolant(const Eigen::VectorXd& f) const {
  return means_.transpose() * modes_.held_at_top().cwiseProduct(f) -
         decays_.transpose() * modes_.taken_away(epsilon_).cwiseProduct(modes_.on_free_sigma(f));
}

inline Eigen::VectorXd ErrorForm::interpolant_transposed(const Eigen::VectorXd& b) const {
  const Eigen::VectorXd decaying = modes_.taken_away(epsilon_).cwiseProduct(decays_ * b);
  return modes_.held_at_top().cwiseProduct(means_ * b - decaying(modes_.k()));
}

inline Eigen::VectorXd ErrorForm::answer(const Eigen::VectorXd& load) {
  problem_.load.setZero();
  problem_.load(active_) = load;
  if (!factor_) factor_.emplace(problem_);
  return active_set(problem_, *factor_).u;
}

inline Eigen::VectorXd ErrorForm::apply(const Eigen::VectorXd& f) {
  const Eigen::VectorXd exact = modes_.response(f, epsilon_);  // asks for the size of f
  const Eigen::VectorXd load = loads_.transpose() * f, u = answer(load)(active_);
  if (space_.element().conforming()) return exact - loads_ * u;
  return exact + loads_ * (u - interpolant(f)) - interpolant_transposed(load);
}

inline double ErrorForm::error(const Eigen::VectorXd& f) { return std::sqrt(std::max(0.0, f.dot(apply(f)))); }

inline WorstLoad ErrorForm::worst(double tolerance) {
  const Eigenpair largest =
      largest_eigenpair([this](const Eigen::VectorXd& f) { return apply(f); }, modes_.size(), tolerance, 20);
  return {std::sqrt(std::max(0.0, largest.value)), largest.vector};
}

}  // namespace antilock::tutorial
