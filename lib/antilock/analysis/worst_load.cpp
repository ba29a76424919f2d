#include "antilock/analysis/worst_load.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "antilock/core/dense.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/load_modes.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/space/space.hpp"

namespace antilock {
namespace {

/// The basis loads of `modes` at a point.
Eigen::VectorXd basis_loads(const LoadModes& modes, const Eigen::Vector2d& x) {
  return 2 * modes.sines(x(0))(modes.k()).cwiseProduct(modes.cosines(x(1))(modes.m()));
}

/// 2 |e_k|_a^2 of e_k = psi_k sin(k pi x) in the body, sin(k pi x) in the layer: a coth a of the
/// body, a^2 of the layer.
double energy_of_wave(int k) {
  const double a = k * std::numbers::pi;
  return a / std::tanh(a) + a * a;
}

}  // namespace

double loss_of_wave(int k) {
  const double a = k * std::numbers::pi;
  const double square = (1 / std::tanh(a) - a / std::pow(std::sinh(a), 2)) / (2 * a);
  return std::sqrt(square / energy_of_wave(k));
}

double loss_of_degree(int p) {
  const int waves = 64, points = 1024;
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(points + 1, 0, 1);
  Eigen::MatrixXd kept = Eigen::MatrixXd::Zero(waves, p - 1),
                  lost = Eigen::MatrixXd::Zero(waves, waves);
  for (int k = 1; k <= waves; ++k) {
    lost(k - 1, k - 1) = std::pow(loss_of_wave(k), 2);
    for (int j = 0; j < p - 1; ++j)
      kept(k - 1, j) = std::sqrt(energy_of_wave(k)) *
                       (x * (1 - x) * (2 * x - 1).pow(j) * (k * std::numbers::pi * x).sin()).sum();
  }
  if (p > 1) {
    const Eigen::MatrixXd traces = kept.transpose(), gram = traces * kept;
    const Eigen::MatrixXd off =
        Eigen::MatrixXd::Identity(waves, waves) - kept * Cholesky(gram).solve(traces);
    lost = off * lost * off;
  }
  return std::sqrt(symmetric_eigenvalues(lost).maxCoeff());
}

double kolmogorov_width(int n) {
  std::vector<int> squares;
  for (int k = 1; k * k < 2 * n + 8;
       ++k)  // more than n + 1 of them lie in this square, their first n + 1 in it
    for (int m = 1; m * m < 2 * n + 8; ++m) squares.push_back(k * k + m * m);
  std::nth_element(squares.begin(), squares.begin() + n, squares.end());
  return 1 / (std::numbers::pi * std::sqrt(squares[n]));
}

ErrorForm::ErrorForm(const Space& space, LoadModes modes)
    : space_(space), modes_(std::move(modes)) {
  require_triangles(space.mesh(), "error form");
  if (!space.element().conforming() && &space.element() != &crouzeix_raviart())
    throw Error("error form: element " + space.element().name() +
                "; accepted: conforming ones and CR");
  const TriangleMesh& mesh = space.mesh();
  // three per cell side of a structured mesh, whose longest edges are sqrt(2) h
  const double most_waves = 4.25 / mesh.diameter();
  if (modes_.waves() > most_waves)
    throw Error(fmt::format(
        "error form: {} waves on edges up to {:.3g} long; accepted: up to {:.0f}, those that the "
        "quadrature sees",
        modes_.waves(), mesh.diameter(), most_waves));
  const Eigen::RowVector2d least = mesh.vertices.colwise().minCoeff(),
                           most = mesh.vertices.colwise().maxCoeff();
  if (!((least - Eigen::RowVector2d(0, -1)).norm() < 1e-6 &&
        (most - Eigen::RowVector2d(1, 1)).norm() < 1e-6))
    throw Error(
        fmt::format("error form: a mesh of ({:.6g}, {:.6g}) x ({:.6g}, {:.6g}); accepted: (0, 1) x "
                    "(-1, 1), body and layer",
                    least(0), most(0), least(1), most(1)));
  problem_ = assemble(Scene(Body{[](double, double) { return 0.0; }}, StiffLayer{1}), space);
  integrate_loads();
  if (!space.element().conforming()) interpolate_solutions();
}

void ErrorForm::set_epsilon(double epsilon) {
  if (!(epsilon >= 0 && epsilon <= 1))
    throw Error(fmt::format("error form: epsilon = {}; accepted 0 to 1", epsilon));
  epsilon_ = epsilon;
  problem_.compliance = class_parameter(StiffLayer{epsilon});
  const double delta = penalty_parameter(problem_);
  if (factor_ && factor_->delta() != delta) factor_->refactor(delta);
}

void ErrorForm::integrate_loads() {
  const TriangleMesh& mesh = space_.mesh();
  const Element& element = space_.element();
  const Quadrature& rule = triangle_rule(12);
  const Eigen::Index points = rule.weights.size();
  Eigen::MatrixXd weighted(points, element.dofs()), values(modes_.size(), points);
  for (Eigen::Index q = 0; q < points; ++q)
    weighted.row(q) = rule.weights(q) * element.basis(rule.points.row(q)).transpose();
  std::vector<int> place(space_.size(), -1);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; mesh.region[t] == Region::body && i < element.dofs(); ++i)
      place[space_.cell_dofs()(t, i)] = 0;
  for (const int i : space_.dirichlet_dofs()) place[i] = -1;
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
    for (int i = 0; i < element.dofs(); ++i)
      if (const int p = place[space_.cell_dofs()(t, i)]; p >= 0) loads_.col(p) += local.col(i);
  }
}

// The unknowns of CR are means over edges. Those of the layer are not needed: no load stands there.
void ErrorForm::interpolate_solutions() {
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

Eigen::VectorXd ErrorForm::interpolant(const Eigen::VectorXd& f) const {
  return means_.transpose() * modes_.held_at_top().cwiseProduct(f) -
         decays_.transpose() * modes_.taken_away(epsilon_).cwiseProduct(modes_.on_free_sigma(f));
}

Eigen::VectorXd ErrorForm::interpolant_transposed(const Eigen::VectorXd& b) const {
  const Eigen::VectorXd decaying = modes_.taken_away(epsilon_).cwiseProduct(decays_ * b);
  return modes_.held_at_top().cwiseProduct(means_ * b - decaying(modes_.k()));
}

Eigen::VectorXd ErrorForm::answer(const Eigen::VectorXd& load) {
  problem_.load.setZero();
  problem_.load(active_) = load;
  if (!factor_) factor_.emplace(problem_);
  return active_set(problem_, *factor_).u;
}

Eigen::VectorXd ErrorForm::apply(const Eigen::VectorXd& f) {
  const Eigen::VectorXd exact = modes_.response(f, epsilon_);  // asks for the size of f
  const Eigen::VectorXd load = loads_.transpose() * f;
  const Eigen::VectorXd u = answer(load)(active_);
  if (space_.element().conforming()) return exact - loads_ * u;
  return exact + loads_ * (u - interpolant(f)) - interpolant_transposed(load);
}

double ErrorForm::error(const Eigen::VectorXd& f) {
  return std::sqrt(std::max(0.0, f.dot(apply(f))));
}

WorstLoad ErrorForm::worst(double tolerance) {
  const Eigenpair largest = largest_eigenpair([this](const Eigen::VectorXd& f) { return apply(f); },
                                              modes_.size(), tolerance, 20);
  return {std::sqrt(std::max(0.0, largest.value)), largest.vector};
}

}  // namespace antilock
