#pragma once
#include <Eigen/Core>
#include <utility>

#include "antilock/solve/contact_bounds.hpp"

namespace antilock {

/// After more halvings of a projected Newton step than this, where a piece may have two ends, the unknowns walk straight to
/// the lowest point of their pieces, from one end to the next: where A couples them stiffly, projecting one spoils the step
/// of the others.
constexpr int jams = 3;

/// The gradient of x' A x / 2 - q' x + j(x), j smooth on the pieces.
template <class Road>
Eigen::VectorXd gradient_in(const Road& road, const HeldBounds& pieces, const Eigen::VectorXd& x) {
  Eigen::VectorXd gradient = road.times(x) - road.load();
  gradient(road.places()) -= road.bounds().given(pieces);
  return gradient;
}

/// Straight on, and what ends its piece is held there: the energy falls on every stretch, to its least on what is left.
template <class Road>
void walk(Road& road, HeldBounds pieces, Eigen::VectorXd direction, Eigen::VectorXd& x) {
  const auto& places = road.places();
  while (true) {
    const auto [t, ended] = road.bounds().hold_first_end(pieces, x(places), direction(places));
    x += t * direction;
    if (ended < 0) return;
    x(places[ended]) = road.bounds().at(pieces, ended);
    direction = road.newton(pieces, gradient_in(road, pieces, x));
  }
}

/// One step of Bertsekas' projected Newton method (SIAM J. Control Optim. 20, 1982) from a feasible x: it lowers the
/// energy x' A x / 2 - q' x + j(x), j that of the bounds that give way. In the pieces that lead downhill from x the energy
/// is smooth, and their ends are bounds like any others. Returns the bounds reached. A Road has
///     times(x), load()            A x and q
///     places(), bounds()          the bounded ones among the unknowns, and their bounds
///     newton(pieces, gradient)    the way to where the gradient on the pieces vanishes
template <class Road>
HeldBounds projected_newton_step(Road& road, Eigen::VectorXd& x) {
  const auto& places = road.places();
  const ContactBounds& bounds = road.bounds();
  const Eigen::VectorXd lambda = road.times(x) - road.load();
  HeldBounds pieces = bounds.downhill(x(places), lambda(places));
  const Eigen::VectorXd gradient = gradient_in(road, pieces, x), direction = road.newton(pieces, gradient);
  // Armijo along the projected path; the change of energy from the change of x, so that no digits cancel
  double t = 1;
  Eigen::VectorXd next;
  int halvings = 0;
  for (; halvings < 60; ++halvings, t /= 2) {
    next = x + t * direction;
    next(places) = bounds.nearest(pieces, next(places));
    const Eigen::VectorXd change = next - x;
    if (change.dot(gradient + 0.5 * road.times(change)) <= 1e-4 * change.dot(gradient)) break;
  }
  if (halvings > jams && bounds.are_narrow())
    walk(road, std::move(pieces), direction, x);
  else
    x = std::move(next);
  return bounds.reached(x(places));
}

}  // namespace antilock
