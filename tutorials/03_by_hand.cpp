// # The computation by hand
//
// Run: 03_by_hand                     1/h = 8, epsilon = 1e-6; a moment
// Run: 03_by_hand --epsilon 0         the rigid limit (24): the same lines, no division by epsilon
//
// What the picture shows. Figure 5 of the paper on a coarse mesh: the displacement of body and layer, computed in this
// file without the library's elements, forms and solvers. At the end the library is asked too: the same u to 1e-12.
//
// Predict. (a) How many entries different from 0 has a row of B? (b) Does the layer stress p grow as epsilon tends to 0?
//
// The problem, (23): with a1 = a+ + a_x^- and a0 = a_y^-,
//
//     u in K,   a1(u, v - u) + epsilon^-2 a0(u, v - u) >= L(v - u)   for all v in K = { v >= 0 on Gamma_C, v = 0 on Gamma_D }
//
// P1 elements on Figure 3's mesh turn functions into vectors u, one number per vertex, and forms into matrices:
// a1(u, v) = v' A1 u and a0(u, v) = v' B' M B u. A row of B is d/dy u on one triangle of the layer, M its area.

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <numbers>

#include "antilock/form/quadrature.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/table.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"

using namespace antilock;
using Eigen::MatrixXd, Eigen::VectorXd;

struct ByHand {
  MatrixXd a1, b;         // N x N, R x N
  VectorXd m, load;       // R, N
  std::vector<int> free;  // vertices that are not clamped
  std::vector<char> contact;
};
ByHand assemble_by_hand(const TriangleMesh& mesh);

// ### Element matrix
// On a triangle with corners x_0, x_1, x_2 the hat function phi_i is affine: 1 at x_i, 0 at the two others. Its gradient
// stands on the opposite edge and has the length 1 / height: turn that edge by 90 degrees, divide by twice the area.
Eigen::Matrix<double, 3, 2> hat_gradients(const std::array<Eigen::Vector2d, 3>& x, double area) {
  Eigen::Matrix<double, 3, 2> gradient;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d edge = x[(i + 2) % 3] - x[(i + 1) % 3];
    gradient.row(i) << -edge(1) / (2 * area), edge(0) / (2 * area);
  }
  return gradient;
}

// ### Assembly
ByHand assemble_by_hand(const TriangleMesh& mesh) {
  const int n = mesh.vertex_count(), triangles = mesh.triangle_count();
  ByHand p{
      MatrixXd::Zero(n, n),   MatrixXd::Zero(triangles / 2, n), VectorXd::Zero(triangles / 2), VectorXd::Zero(n), {},
      std::vector<char>(n, 0)};
  int row = 0;
  for (int t = 0; t < triangles; ++t) {
    std::array<Eigen::Vector2d, 3> x;
    for (int i = 0; i < 3; ++i) x[i] = mesh.vertices.row(mesh.triangles(t, i));
    const double area = 0.5 * ((x[1] - x[0])(0) * (x[2] - x[0])(1) - (x[1] - x[0])(1) * (x[2] - x[0])(0));
    const auto gradient = hat_gradients(x, area);
    const bool body = mesh.region[t] == Region::body;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double entry = gradient(i, 0) * gradient(j, 0);      // d/dx d/dx, in body and layer
        if (body) entry += gradient(i, 1) * gradient(j, 1);  // d/dy d/dy, in the body alone
        p.a1(mesh.triangles(t, i), mesh.triangles(t, j)) += area * entry;
      }
    if (!body) {  // the stiff form, one row per layer triangle: never added to A1
      for (int i = 0; i < 3; ++i) p.b(row, mesh.triangles(t, i)) = gradient(i, 1);
      p.m(row++) = area;
    }
    if (body)  // int f phi_i by a rule: weights and points lambda, phi_i(lambda) = lambda_i
      for (Eigen::Index q = 0; q < radon_rule().weights.size(); ++q) {
        const Eigen::Vector3d lambda = radon_rule().points.row(q);
        const double f =
            10 * std::sin(2 * std::numbers::pi * (lambda(0) * x[0] + lambda(1) * x[1] + lambda(2) * x[2])(0));
        for (int i = 0; i < 3; ++i) p.load(mesh.triangles(t, i)) += area * radon_rule().weights(q) * f * lambda(i);
      }
  }
  for (int v = 0; v < n; ++v) {
    const double px = mesh.vertices(v, 0), py = mesh.vertices(v, 1);
    if (px > 0 && px < 1 && py < 1) p.free.push_back(v);  // u = 0 on both sides and on top
    p.contact[v] = py == -1;
  }
  return p;
}

// ### The split form
// Summing A1 + epsilon^-2 B'MB would lose A1's digits (chapter 08). So the layer stress p = epsilon^-2 B u is kept as an
// unknown of its own, and only K = A1 + delta^-1 B'MB with a moderate delta is factored. What is then wrong is
//
//     r1 = L - A1 u - B'M p + lambda,     r2 = epsilon^2 p - B u,
//
// and one correction solves  K du = r1 + delta^-1 B'M r2,  dp = (B du - r2) / delta.  When r1 and r2 are zero, u and p
// solve (23), whatever delta was. This is the iterated penalty method; each correction makes the error smaller by about
// (delta - epsilon^2) / (delta + h^2).
//
// ### The contact loop
// In each correction: guess which vertices of Gamma_C touch, solve with u = 0 there, and look at the signs (chapter 00).
VectorXd solve_by_hand(const ByHand& p, double epsilon, Table& history) {
  const double delta = std::max(epsilon * epsilon, 1e-4);  // never below epsilon^2, which is stiff enough
  const MatrixXd k = p.a1 + p.b.transpose() * p.m.asDiagonal() * p.b / delta;
  VectorXd u = VectorXd::Zero(p.load.size()), stress = VectorXd::Zero(p.m.size());
  std::vector<char> touches(p.load.size(), 0);
  double size = 1;
  for (int correction = 0; size > 1e-14; ++correction) {
    const VectorXd r2 = epsilon * epsilon * stress - p.b * u;
    const VectorXd r = p.load - p.a1 * u - p.b.transpose() * p.m.cwiseProduct(stress - r2 / delta);
    for (int step = 1;; ++step) {
      std::vector<int> moves;
      for (const int v : p.free)
        if (!touches[v]) moves.push_back(v);
      VectorXd du = -u;  // to 0 where it touches; at the clamped vertices u is 0 already
      du(moves).setZero();
      const VectorXd inside = MatrixXd(k(moves, moves)).llt().solve(VectorXd((r - k * du)(moves)));
      du(moves) = inside;
      const VectorXd lambda = k * du - r;
      std::vector<char> next = touches;
      for (const int v : p.free)
        if (p.contact[v]) next[v] = touches[v] ? lambda(v) > 0 : u(v) + du(v) < -1e-15;
      if (next != touches) {
        touches = next;
        continue;
      }
      u += du;
      stress += (p.b * du - r2) / delta;
      size = du.lpNorm<Eigen::Infinity>();
      history.add({correction, step, size});
      break;
    }
    if (correction == 50) throw NotConverged("by hand: 50 corrections", size, correction);
  }
  return u;
}

void by_hand(const tutorial::Options& options, tutorial::Report& report) {
  const TriangleMesh mesh = structured_mesh(options.cells);
  const ByHand problem = assemble_by_hand(mesh);
  Table history({"correction", "contact steps", "du"});
  const VectorXd u = solve_by_hand(problem, options.epsilon, history);
  history.print("The corrections");
  history.write(options.out / "corrections.csv");

  // The library, from the scene to the answer, in four lines.
  const Space space(mesh, p1());
  const VariationalInequality same =
      assemble(Scene(Body{paper_load}, StiffLayer{options.epsilon}, UnilateralContact{}), space);
  const Solution solution = active_set(same);
  tutorial::write_results(options.out, space, same, solution);
  const double matrices = (MatrixXd(same.a1) - problem.a1).cwiseAbs().maxCoeff();
  const double rows = (MatrixXd(same.b) - problem.b).cwiseAbs().maxCoeff();
  const double apart = (solution.u - u).lpNorm<Eigen::Infinity>() / u.lpNorm<Eigen::Infinity>();
  report.claim(matrices <= 1e-13 && rows <= 1e-12, "A1 and B are the library's, to {:.0e} and {:.0e}", matrices, rows);
  report.claim(apart <= 1e-12, "u is the library's to {:.0e}, relative", apart);
}

// Answers to the predictions. (a) On Figure 3's mesh two: the triangle has one vertical edge, and d/dy u is the
// difference along it. Vertical edges tie the layer together column by column, and nothing else does. (b) No: p tends to
// the stress of the rigid limit; only its two factors, epsilon^-2 and B u, go to infinity and to 0.
//
// Three things to try:
// - delta = 1e-2 in solve_by_hand: the same u, more corrections. delta = 1e-12: fewer digits.
// - count the contact steps: why is there one per correction from the second correction on?
// - move one vertex of the layer sideways: how many entries have the rows of B around it then?
int main(int argc, char** argv) {
  tutorial::Options options;
  options.cells = 8;
  options.least_cells = 2;
  options.most_cells = 16;  // dense matrices
  return tutorial::run(argc, argv, "03_by_hand", "Figure 5 on a coarse mesh, every step written out", options, by_hand);
}
