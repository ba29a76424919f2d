// The lower bound, by duality. Let sigma be a flux with sigma.n continuous across edges, sigma.n >= 0 on Gamma_C and
// div sigma = -f_T on each triangle T, f_T the mean of f (0 in the layer). With A the stiffness (1 in the body; 1 and
// epsilon^-2 in the layer), for every v in K
//
//   J(v) = 1/2 |A grad v - sigma|^2 - 1/2 |sigma|^2 + int sigma.grad v - L(v),     norms weighted by A^-1,
//        >= 1/2 |A grad v - sigma|^2 - 1/2 |sigma|^2 - (f - f_T, v),
//
// since int sigma.grad v = (f_T, v) + int_Gamma_C sigma.n v. Where f is constant on triangles, -1/2 |sigma|^2 is the
// bound.
//
// Crouzeix-Raviart hands over such a flux (Marini 1985): its equation for edge E says that A grad u_h, corrected in
// each triangle by the lowest Raviart-Thomas field tau with the flux -int_T f phi_E through each edge, leaves one
// triangle as it enters the next; on Gamma_C the flux is the contact force lambda_E >= 0. In the layer tau = 0 and the
// second component is the layer stress p, so that nothing is divided by epsilon and epsilon = 0 is no exception.
//
// What is left of the load: f - f_T has mean zero on T, so by Poincare's inequality with constant h_T / pi (Payne and
// Weinberger 1960) (f - f_T, v - u_h) <= osc |grad v - grad u_h|, osc^2 = sum (h_T / pi)^2 |f - f_T|_T^2, and
// grad v - grad u_h = (grad v - sigma) + tau in the body. The smallest value of x^2 / 2 - osc x is -osc^2 / 2.
#include "antilock/analysis/energy_bracket.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antilock/core/error.hpp"
#include "antilock/form/quadrature.hpp"

namespace antilock {
namespace {

void check_bracket_request(const Space& space, const VariationalInequality& problem) {
  if (space.element().conforming())
    throw Error("energy bracket: a lower bound from element " + space.element().name() + " is not known; accepted: CR");
  if (problem.lower.size() > 0 && problem.lower.cwiseAbs().maxCoeff() > 0)
    throw Error("energy bracket: the obstacle has a gap; accepted: u >= 0 on Gamma_C");
  // grad u_h is known on triangles alone: Ventcel's term couples a boundary unknown beyond its triangle
  for (const int i : space.contact())
    if (problem.a1.col(i).nonZeros() > 3)
      throw Error(
          "energy bracket: a1 couples unknowns on Gamma_C beyond their triangle (Ventcel); accepted: a layer or "
          "none");
}

double longest_edge(const TriangleMesh& mesh, int t) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, mesh.edge_length(mesh.triangle_edges(t, i)));
  return longest;
}

}  // namespace

double EnergyBracket::error_bound() const { return std::sqrt(2 * std::max(0.0, width())); }

double energy_lower_bound(const Space& space, const VariationalInequality& problem, const Solution& solution,
                          const Field& f) {
  check_bracket_request(space, problem);
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const Quadrature &rule = radon_rule(), &midpoints = midpoint_rule();

  double cross = 0, tau2 = 0, oscillation2 = 0, remainder = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::body) continue;
    const double area = mesh.area(t);
    const Eigen::Vector3d u = solution.u(space.unknowns().row(t));

    // the load on this triangle: its mean, the mean of f x, and what f varies
    Eigen::VectorXd value(rule.weights.size());
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    for (Eigen::Index q = 0; q < value.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      value(q) = f(x(0), x(1));
      moment += rule.weights(q) * value(q) * x;
    }
    const double mean = rule.weights.dot(value), poincare = longest_edge(mesh, t) / std::numbers::pi;
    for (Eigen::Index q = 0; q < value.size(); ++q) {
      const double weighted = area * rule.weights(q) * (value(q) - mean);
      remainder += weighted * u.dot(element.basis(rule.points.row(q)));
      oscillation2 += poincare * poincare * weighted * (value(q) - mean);
    }

    // the field of flux -int f phi_i through edge i, phi_i = 1 - 2 lambda_i; c the centroid. Constant f: -f (x - c) / 2
    const Eigen::Vector2d centroid = point_in(mesh, t, Eigen::Vector3d::Constant(1.0 / 3));
    const Eigen::Vector2d gradient =
        (element.derivative(Eigen::Vector3d::Zero()) * barycentric_gradients(mesh, t)).transpose() * u;
    for (Eigen::Index q = 0; q < midpoints.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, midpoints.points.row(q));
      const Eigen::Vector2d tau = -0.5 * mean * (x - 3 * centroid) - moment;
      cross += area * midpoints.weights(q) * tau.dot(gradient);
      tau2 += area * midpoints.weights(q) * tau.squaredNorm();
    }
  }
  // |sigma|^2 = a(u_h, u_h) + 2 (grad u_h, tau) + |tau|^2, the stiff part as compliance p' M p
  double flux2 = solution.u.dot(problem.a1 * solution.u) + 2 * cross + tau2;
  if (problem.b.rows() > 0) flux2 += problem.compliance * solution.p.dot(problem.m.cwiseProduct(solution.p));
  return -0.5 * flux2 - remainder - 0.5 * oscillation2 - std::sqrt(oscillation2 * tau2);
}

}  // namespace antilock
