// # The computation by hand
//
// Run: 03_by_hand                     1/h = 8, epsilon = 1e-6; a moment
// Run: 03_by_hand --epsilon 0         the rigid limit: the same lines, no division by epsilon
// Run: 03_by_hand --exercise 1
// Run: 03_by_hand --exercise 2
//
// **Afterwards you can** assemble a contact problem with a stiff layer, and solve it at
// every $ε$, also at 0, without dividing by $ε$.
//
// Needs: [00](../00_string_on_an_obstacle/00_string_on_an_obstacle.cpp) (contact),
// [01](../01_domain/01_domain.cpp) ((23)), [02](../02_meshes/02_meshes.cpp) (P1, kernel).
//
// **The picture.** The displacement $u$ of body and layer on a coarse mesh, drawn as a
// height. It is computed in this file, without the library's elements, forms and solvers.
// At the end the library finds the same.
//
// **Predict.** (a) On one triangle of the layer $∂_y u$ is a number: a sum of the three
// values of $u$ at the corners, each times a factor. How many of the three factors are not
// 0 on the structured mesh of chapter 02? (b) The factor $ε^{-2}$ goes to infinity as
// $ε → 0$. Does the *layer stress* $p = ε^{-2} ∂_y u$ go there too?
//
// ## From (23) to matrices
//
// Let $φ_i$ be the hat function of vertex $i$ and $u = ∑ u_i φ_i$. Let $K_h$ be the set of
// the P1 functions in $K$: 0 at the clamped vertices, not negative at those of $Γ_C$. The
// discrete problem, (26) in the paper, is (23) with $K_h$ in place of $K$. Its solution is
// $u_h$. The moderate form becomes a matrix,
// $(A_1)_{ij} = a^+(φ_i, φ_j) + a_x^-(φ_i, φ_j)$. The stiff form keeps its factors. On a
// triangle $T$ of the layer $∂_y u$ is a number; let row $T$ of $B$ compute it from $u$,
// and let $M$ be the diagonal matrix of the areas. Then
//
// $$ a_y^-(u, v) = ∑_T |T| ∂_y u ∂_y v = v^T B^T M B u. $$
//
// This is the *split form*: $A_1$ and the factors $B$, $M$, never summed.
// $A_1 + ε^{-2} B^T M B$ would add numbers near 1 to numbers near $10^{12}$, and round
// their digits away (chapter 18).

#include <Eigen/Dense>

#include "antilock/core/dense.hpp"
#include "antilock/io/write_vtu.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using Eigen::MatrixXd, Eigen::VectorXd, tutorial::Corners;

struct ByHand {
  MatrixXd a1, b;         // N x N for N vertices, R x N for R triangles of the layer
  VectorXd m, load;       // R, N
  std::vector<int> free;  // vertices that are not clamped
  std::vector<char> contact;
};

// ### Forms
// **Element matrix.** On a triangle $φ_i$ is affine: 1 at the corner $i$, 0 at the others.
// Its gradient stands on the opposite edge and has the length 1/height: turn that edge by
// 90°, divide by twice the area.
Corners hat_gradients(const Corners& x, double area) {
  Corners gradient;
  for (int i = 0; i < 3; ++i) {
    const Eigen::RowVector2d edge = x.row((i + 2) % 3) - x.row((i + 1) % 3);
    gradient.row(i) << -edge(1), edge(0);
  }
  return gradient / (2 * area);
}

// **Assembly.** One triangle after the other; what falls on the same place adds up.
ByHand assemble_by_hand(const TriangleMesh& mesh) {
  const int n = mesh.vertex_count(),
            rows = mesh.triangle_count() / 2;  // half of the triangles are in the layer
  ByHand p{MatrixXd::Zero(n, n),
           MatrixXd::Zero(rows, n),
           VectorXd::Zero(rows),
           VectorXd::Zero(n),
           {},
           {}};
  for (int t = 0, row = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::RowVector3i v = mesh.triangles.row(t);
    const Corners x = mesh.vertices(v, Eigen::indexing::all);
    const Eigen::RowVector2d one = x.row(1) - x.row(0), two = x.row(2) - x.row(0);
    const double area = 0.5 * (one(0) * two(1) - one(1) * two(0));
    const Eigen::Vector3d dx = hat_gradients(x, area).col(0),
                          dy = hat_gradients(x, area).col(1);
    Eigen::Matrix3d entries =
        dx * dx.transpose();  // d/dx phi_i d/dx phi_j, in body and layer
    if (mesh.region[t] == Region::body) {
      entries += dy * dy.transpose();           // d/dy d/dy, in the body alone
      tutorial::add_loads(p.load, v, x, area);  // int f phi_i by a rule of seven points
    } else {  // the stiff form, one row per layer triangle: never added to A1
      p.b(row, v) = dy.transpose();
      p.m(row++) = area;
    }
    p.a1(v, v) += area * entries;
  }
  for (int v = 0; v < n; ++v) {
    const double px = mesh.vertices(v, 0), py = mesh.vertices(v, 1);
    if (px > 0 && px < 1 && py < 1) p.free.push_back(v);  // u = 0 on both sides and on top
    p.contact.push_back(py == -1);
  }
  return p;
}

// ### Solve
// The layer stress $p = ε^{-2} B u$ is kept as an unknown of its own, beside $u$ and the
// contact force $λ$:
//
// $$ A_1 u + B^T M p = L + λ,   B u = ε² p. $$
//
// No large number is left, and no division by $ε$. One matrix is factored, with a moderate
// number $δ$ where $ε²$ stood: $A_δ = A_1 + δ^{-1} B^T M B$. It would solve another
// problem, that of a softer layer. So its answer is corrected until the two equations hold.
// What they leave over for a given $u$ and $p$ are their *residuals*:
//
// $$ r_1 = L - A_1 u - B^T M p + λ,   r_2 = ε² p - B u. $$
//
// One *correction* solves $A_δ du = r_1 + δ^{-1} B^T M r_2$ and puts $dp = (B du - r_2)/δ$.
// Insert both: after it $r_1 = 0$ and $r_2 = (ε² - δ) dp$. With $δ = ε²$ nothing would be
// left over. When both residuals are 0 and the signs are right, $u$ and $p$ solve (26),
// whatever $δ$ was. This is the *iterated penalty* method. It is an *augmented Lagrangian*
// method: $p$ is the multiplier of the equation $B u = ε² p$, and a correction adds a
// multiple of the residual of this equation to it.
//
// How fast? Let $r_1 = 0$, as after the first correction, and let $r_2$ be an eigenvector
// of $B A_1^{-1} B^T M$ with the eigenvalue $σ$. A correction multiplies it by
// $(δ - ε²)/(δ + σ)$. This $σ$ is how much $B u$ answers to a stress of size 1: a number
// that depends on the mesh, and neither on $ε$ nor on $δ$. A small $δ$ is fast, but too
// small a $δ$ rounds the digits of $A_1$ away again.
//
// **The contact loop** runs in each correction, since the $λ$ in $r_1$ is not known
// beforehand. It is that of chapter 00: guess what touches, solve, look at the signs. So
// there are two loops, one in the other:
//
// ```text
// repeat                            until du no longer counts
//   r1 without lambda, r2           from u and p
//   repeat                          until the guess repeats itself
//     du = -u where it touches, A_delta du = r elsewhere
//     lambda = A_delta du - r where it touches, new guess by the signs of lambda and u + du
//   u += du,  p += (B du - r2) / delta
// ```
struct SolvedByHand {
  VectorXd u, stress;
};
SolvedByHand solve_by_hand(const ByHand& p, double epsilon, double delta, Table& history) {
  delta =
      std::max(epsilon * epsilon, delta);  // never below epsilon^2, which is stiff enough
  const MatrixXd a_delta = p.a1 + p.b.transpose() * p.m.asDiagonal() * p.b / delta;
  VectorXd u = VectorXd::Zero(p.load.size()), stress = VectorXd::Zero(p.m.size()), du = u;
  std::vector<char> touches(p.load.size(), 0);
  for (int correction = 0; correction == 0 || du.lpNorm<Eigen::Infinity>() > 1e-14;
       ++correction) {
    if (correction == 500)
      throw NotConverged("by hand: 500 corrections", du.lpNorm<Eigen::Infinity>(),
                         correction);
    const VectorXd r2 = epsilon * epsilon * stress - p.b * u;
    const VectorXd r =
        p.load - p.a1 * u - p.b.transpose() * p.m.cwiseProduct(stress - r2 / delta);
    int contact_steps = 0;
    for (std::vector<char> guess; guess != touches; ++contact_steps) {
      guess = touches;
      std::vector<int> moves;
      for (const int v : p.free)
        if (!guess[v]) moves.push_back(v);
      du = -u;  // to 0 where it touches; at the clamped vertices u is 0 already
      du(moves).setZero();
      const VectorXd inside =
          Cholesky(a_delta(moves, moves)).solve(VectorXd((r - a_delta * du)(moves)));
      du(moves) = inside;
      const VectorXd lambda = a_delta * du - r;
      for (const int v : p.free)
        if (p.contact[v]) touches[v] = guess[v] ? lambda(v) > 0 : u(v) + du(v) < -1e-15;
    }
    u += du;
    stress += (p.b * du - r2) / delta;
    history.add({correction, contact_steps, du.lpNorm<Eigen::Infinity>()});
  }
  return {u, stress};
}

// The layer stress for smaller and smaller ε, down to the rigid layer: largest value, and
// how far it is from that.
Table layer_stress(const ByHand& problem) {
  Table stresses({"epsilon", "largest B u", "largest p", "p - p at 0"}),
      unread({"correction", "contact steps", "du"});
  const VectorXd rigid = solve_by_hand(problem, 0, 1e-4, unread).stress;
  for (const double epsilon : {1e-1, 1e-2, 3e-3, 1e-3, 3e-4, 0.0}) {
    const SolvedByHand result = solve_by_hand(problem, epsilon, 1e-4, unread);
    stresses.add({epsilon, (problem.b * result.u).cwiseAbs().maxCoeff(),
                  result.stress.cwiseAbs().maxCoeff(),
                  (result.stress - rigid).cwiseAbs().maxCoeff()});
  }
  return stresses;
}

void by_hand(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  const TriangleMesh mesh = structured_mesh(options.cells);
  const ByHand problem = assemble_by_hand(mesh);
  Table history({"correction", "contact steps", "du"});
  const VectorXd u = solve_by_hand(problem, options.epsilon, 1e-4, history).u;
  const Table stresses = layer_stress(problem);

  // ### Output
  const Space space(mesh, p1());  // says which vertex carries which number
  tutorial::show_by_hand(options.out, space, u, history, stresses);

  // And now the library, from the scene to the answer.
  const VariationalInequality same =
      assemble(tutorial::paper_scene(options.epsilon), space);
  const double matrices = (MatrixXd(same.a1) - problem.a1).cwiseAbs().maxCoeff();
  const double rows = (MatrixXd(same.b) - problem.b).cwiseAbs().maxCoeff();
  const double apart =
      (active_set(same).u - u).lpNorm<Eigen::Infinity>() / u.lpNorm<Eigen::Infinity>();
  report.claim(matrices <= 1e-13 && rows <= 1e-12,
               "A1 and B are the library's, to {:.0e} and {:.0e} (proved)", matrices, rows);
  report.claim(apart <= 1e-12,
               "u is the library's to {:.0e}, relative (proved: (26) has one solution)",
               apart);
  const Table small = stresses.filter_number(
      "epsilon", [](double epsilon) { return 0 < epsilon && epsilon < 0.05; });
  report.claim_order(small, "p - p at 0", "epsilon", 1.9, 2.1,
                     "p tends to the stress of the rigid layer (observed)");
}

// ## What came out
// :output:
//
// (a) Two: on Figure 3's mesh each triangle has one vertical edge, and $∂_y u$ is the
// difference of $u$ along it, divided by its length $h$. So one row of $B$ couples two
// vertices of one vertical line, and never two lines. This is chapter 02's kernel: one
// function per line. (b) No, by the second table. $B u$ falls like $ε²$, and $p$, their
// quotient, tends to the stress of the rigid layer, a finite force that holds it straight:
// at ε = 0.01 its largest value is 1.616, and at ε = 0 it is 1.617.
// :number: 1.616 = table "the layer stress" "largest p" epsilon=0.01
// :number: 1.617 = table "the layer stress" "largest p" epsilon=0
//
// The `du` of the corrections fall by a factor of 1500, then of 500 to 270. By the formula
// above, with $δ = 10^{-4}$ and $ε^2 ≪ δ$, these are the factors $(δ + σ)/δ$ of $σ = 0.15$,
// and of 0.05 to 0.027: the parts with a large $σ$ go first, and the smallest one that the
// error holds decides in the end. The first correction takes 4 contact steps. After it the
// contact set hardly moves, and 1 step is enough.
// :number: 4 = table "the corrections" "contact steps" correction=0
// :number: 1 = table "the corrections" "contact steps" correction=1
//
// ## The same loop in the library
//
// No chapter of the course needs this section. It is for those who want to read the
// library: `active_set` runs these two loops on sparse matrices, with every kind of bound.
// Side by side:
//
// | here | in `lib/antilock/solve` | what is added there |
// |---|---|---|
// | `touches` | `bound_status.hpp` | `touches` has two states; with bounds on both sides, or friction, there are up to five |
// | the inner loop | `contact.hpp` | from guess to guess the energy falls: what leaves its piece stops there, and so it ends (proof there) |
// | `r2` and `r` | `residual.hpp` | $u$ and $p$ are pairs of doubles: no digit of a residual is lost |
// | `Cholesky`, one per guess | `penalised_cholesky.hpp` | one sparse factor, the vertices of $Γ_C$ last |
// | the outer loop | `active_set.cpp` | the next start is mixed from the last few (Anderson) |
// | `du > 1e-14` | `forward_error.hpp`, `kkt.hpp` | the last $du$ says how right $u$ is, a report afterwards whether all holds |
//
// ## Exercises
//
// 1. $δ = 10^{-2}$ in place of $10^{-4}$. The same $u$? As many corrections?
// 2. Move one inner vertex of the layer sideways by $h/10$. Six triangles meet there. How
//    many entries have their rows?
// 3. On paper: derive the factor $(δ - ε²)/(δ + σ)$. (Without contact; write $du$ by $r_2$
//    alone.)
//
// ## Further reading
//
// - [Boffi, Brezzi and Fortin 2013](../guides/bibliography.md#boffi-2013): the stress as an
//   unknown, and the iterated penalty method.
// - [Fortin and Glowinski 1983](../guides/bibliography.md#fortin-1983): the same method
//   under its other name, augmented Lagrangians.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "03_by_hand", "Figure 5 on a coarse mesh, every step written out",
      {.cells = 8, .least_cells = 4, .most_cells = 16, .exercises = exercises},
      by_hand);  // dense matrices
}
