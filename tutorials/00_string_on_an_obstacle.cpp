// # A string on an obstacle
//
// Run: 00_string_on_an_obstacle                 32 cells; a moment
// Run: 00_string_on_an_obstacle --cells 8       few enough to follow each node
//
// What the picture shows. A string is held at both ends, x = 0 and x = 1. A floor lies at height 0. The load
// f(x) = 10 sin(2 pi x) lifts the left half and presses the right half. Without the floor the string would hang through
// it. With the floor it lies on it from x = c on, and the floor pushes back with a force that is nowhere negative.
//
// Predict, before you read on. (a) Does the string touch the floor wherever the load points down? (b) Where it touches,
// how large is the force of the floor?
//
// An energy over a cone. Among all shapes v with v(0) = v(1) = 0 the string takes the one of least energy
//
//     J(v) = 1/2 a(v, v) - L(v),    a(u, v) = int u' v',    L(v) = int f v.
//
// The floor allows only the shapes in K = { v >= 0 }. K is a convex cone: with v and w it holds t v (t >= 0) and v + w.
//
// Why v - u and not v. At the minimiser u one may move in the direction v - u for every v in K, since u + t (v - u) lies
// in K for 0 <= t <= 1. The energy cannot fall there: J(u + t (v - u)) >= J(u). Divide by t, and let t tend to 0:
//
//     u in K,   a(u, v - u) >= L(v - u)   for all v in K.                       a variational inequality
//
// Without the floor both directions v - u and u - v are allowed, and >= becomes =. Where u > 0 that is still so. Where
// the string touches, only the direction upwards is allowed, and one of the two signs is lost.
//
// The multiplier. Take finite elements: the nodes x_i = i h, hat functions phi_i, A_ij = a(phi_i, phi_j), b_i = L(phi_i).
// Then lambda = A u - b is the force that the floor adds at each node. The inequality says, by v = u + phi_i, v = 0 and
// v = 2 u, that for every inner node i
//
//     u_i >= 0,    lambda_i >= 0,    lambda_i u_i = 0,    A u = b + lambda.      complementarity
//
// The string is above the floor, the floor only pushes, and it pushes only where it is touched.
//
// The truth. Where the string is free, -u'' = f, so u = 10 sin(2 pi x) / (4 pi^2) + s x on (0, c). It leaves the floor
// smoothly: u(c) = 0 and u'(c) = 0. Both together say tan(z) = z for z = 2 pi c, so z = 4.493409..., c = 0.715148...

#include <cmath>
#include <numbers>
#include <vector>

#include "antilock/study/table.hpp"
#include "common/tutorial.hpp"

using namespace antilock;
using Vector = std::vector<double>;
using std::numbers::pi;

struct String {
  int cells;
  double h;
  Vector b;  // b_i = int f phi_i at the inner nodes 1 ... cells - 1, entries 0 and cells unused
};
struct Answer {
  Vector u, lambda;
  int steps = 0;
};

String hang(int cells);
Vector solve_with_held(const String& s, const Vector& force, const std::vector<bool>& held);
Vector contact_force(const String& s, const Vector& u);
double exact(double x);
constexpr double z = 4.493409457909064;  // tan(z) = z

// ### Active set
// Guess which nodes touch. There u_i = 0; elsewhere lambda_i = 0, and the equation gives u. Then look at the signs: a
// node that sank below the floor should have touched; a node that the floor would have to pull should not. Repeat with
// the new guess. When the guess repeats itself, all signs are right, and u solves the inequality exactly.
Answer active_set_by_hand(const String& s, Table& steps) {
  std::vector<bool> touches(s.cells + 1, false);
  for (Answer answer;; ++answer.steps) {
    answer.u = solve_with_held(s, s.b, touches);
    answer.lambda = contact_force(s, answer.u);
    for (int i = 0; i <= s.cells; ++i) steps.add({answer.steps, i * s.h, answer.u[i], answer.lambda[i] / s.h});
    std::vector<bool> next(s.cells + 1, false);
    for (int i = 1; i < s.cells; ++i) next[i] = touches[i] ? answer.lambda[i] > 0 : answer.u[i] < 0;
    if (next == touches) return answer;
    touches = next;
  }
}

// ### Uzawa
// Guess the forces of the floor instead. They give a shape, A u = b + lambda; where the shape is below the floor, push
// more; where it is above, push less, but never pull: lambda_i <- max(0, lambda_i - rho u_i). The maximum is the
// projection onto the cone lambda >= 0. The step rho must stay below 2 / (largest eigenvalue of A^-1), and the smallest
// eigenvalue of A is about pi^2 h. The error falls by the factor 1 - 2 / kappa per step, kappa the condition number of A,
// which is about 4 / (pi h)^2: halve h, and there are four times as many steps.
Answer uzawa_by_hand(const String& s, double tolerance, Table& history) {
  const double rho = 1.9 * pi * pi * s.h;
  Answer answer{Vector(s.cells + 1, 0), Vector(s.cells + 1, 0)};
  for (double change = 1; change > tolerance;) {
    Vector force = s.b;
    for (int i = 1; i < s.cells; ++i) force[i] += answer.lambda[i];
    answer.u = solve_with_held(s, force, std::vector<bool>(s.cells + 1, false));
    change = 0;
    for (int i = 1; i < s.cells; ++i) {
      const double next = std::max(0.0, answer.lambda[i] - rho * answer.u[i]);
      change = std::max(change, std::abs(next - answer.lambda[i]) / rho);
      answer.lambda[i] = next;
    }
    history.add({++answer.steps, change});
  }
  return answer;
}

void string_on_an_obstacle(const tutorial::Options& options, tutorial::Report& report) {
  const String s = hang(options.cells);
  Table steps({"step", "x", "u", "pressure"}), history({"step", "change"});
  const Answer active = active_set_by_hand(s, steps), uzawa = uzawa_by_hand(s, 1e-10, history);
  const Vector free = solve_with_held(s, s.b, std::vector<bool>(s.cells + 1, false));

  Table shapes({"x", "free", "u", "exact", "pressure"});
  double error = 0, apart = 0, product = 0, pull = 0, sunk = 0, first = 1;
  for (int i = 0; i <= s.cells; ++i) {
    const double x = i * s.h, pressure = active.lambda[i] / s.h;
    shapes.add({x, free[i], active.u[i], exact(x), pressure});
    error = std::max(error, std::abs(active.u[i] - exact(x)));
    apart = std::max(apart, std::abs(active.u[i] - uzawa.u[i]));
    product = std::max(product, std::abs(active.lambda[i] * active.u[i]));
    pull = std::min(pull, active.lambda[i]);
    sunk = std::min(sunk, active.u[i]);
    if (active.lambda[i] > 0) first = std::min(first, x);
  }
  Table solvers({"", "linear solves", "contact starts at"});
  solvers.add({"active set", active.steps + 1, first});
  solvers.add({"Uzawa", uzawa.steps, first});
  solvers.print("Two ways to the same string");
  shapes.write(options.out / "shapes.csv");
  steps.write(options.out / "active_sets.csv");
  history.write(options.out / "uzawa.csv");

  report.claim(sunk == 0 && pull >= 0 && product == 0, "u >= 0, lambda >= 0 and lambda u = 0 at every node, exactly");
  // the set is right to one cell: a node touches or it does not
  report.claim(std::abs(first - z / (2 * pi)) <= s.h, "contact starts at x = {:.4f}, truth {:.4f} (h = {:.4f})", first,
               z / (2 * pi), s.h);
  // P1 with exact loads is exact at the nodes up to the place where contact starts, which is off by at most h: there
  // u'' = -f jumps by |f(c)| = 9.76, so the error is at most 9.76 h^2 / 2
  report.claim(error <= 4.9 * s.h * s.h, "the largest error at the nodes is {:.1e} (at most 4.9 h^2 = {:.1e})", error,
               4.9 * s.h * s.h);
  // Uzawa stops when a step moves less than 1e-10; kappa / 2 such steps are left to the end
  const double left = 1e-10 * 2 / (pi * pi * s.h * s.h);
  report.claim(apart <= left, "Uzawa comes to the same string, within {:.0e}", left);
}

// Answers to the predictions. (a) No: the load points down from x = 1/2 on, contact starts at 0.7151. The lifted half
// pulls its neighbour up. (b) Where the string lies flat, u'' = 0, so the pressure of the floor is -f there.
//
// Three things to try:
// - double the load: u and the pressure double, and contact starts at the same place. Why? (K is a cone.)
// - raise the floor to -0.05: K is no cone any more, and v = 0, v = 2 u may not be used. Which conditions change?
// - take rho = 2.2 pi^2 h: Uzawa no longer converges.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.least_cells = 4;
  options.most_cells = 256;
  return tutorial::run(argc, argv, "00_string_on_an_obstacle", "what a variational inequality is, by hand", options,
                       string_on_an_obstacle);
}

// ### Helpers
String hang(int cells) {
  String s{cells, 1.0 / cells, Vector(cells + 1, 0)};
  // int sin(2 pi x) phi_i, exactly: sin(2 pi x_i) (2 - 2 cos(2 pi h)) / ((2 pi)^2 h)
  const double factor = 10 * (2 - 2 * std::cos(2 * pi * s.h)) / (4 * pi * pi * s.h);
  for (int i = 1; i < cells; ++i) s.b[i] = factor * std::sin(2 * pi * i * s.h);
  return s;
}

// A u = force at the nodes that are not held, u = 0 at the others: elimination from left to right, then back. A has the
// entries 2/h on its diagonal and -1/h beside it.
Vector solve_with_held(const String& s, const Vector& force, const std::vector<bool>& held) {
  Vector pivot(s.cells + 1, 1), rest(s.cells + 1, 0);
  for (int i = 1; i < s.cells; ++i) {
    if (held[i]) continue;
    const bool coupled = i > 1 && !held[i - 1];
    pivot[i] = 2 / s.h - (coupled ? 1 / (s.h * s.h * pivot[i - 1]) : 0);
    rest[i] = force[i] + (coupled ? rest[i - 1] / (s.h * pivot[i - 1]) : 0);
  }
  Vector u(s.cells + 1, 0);
  for (int i = s.cells - 1; i > 0; --i)
    if (!held[i]) u[i] = (rest[i] + u[i + 1] / s.h) / pivot[i];
  return u;
}

// lambda = A u - b at the nodes that touch; zero elsewhere, where the equation holds.
Vector contact_force(const String& s, const Vector& u) {
  Vector lambda(s.cells + 1, 0);
  for (int i = 1; i < s.cells; ++i)
    if (u[i] == 0) lambda[i] = (-u[i - 1] + 2 * u[i] - u[i + 1]) / s.h - s.b[i];
  return lambda;
}

double exact(double x) {
  if (x >= z / (2 * pi)) return 0;
  return 10 / (4 * pi * pi) * (std::sin(2 * pi * x) - x * 2 * pi * std::cos(z));
}
