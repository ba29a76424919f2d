// # A string on an obstacle
//
// Run: 00_string_on_an_obstacle                 32 cells; a moment
// Run: 00_string_on_an_obstacle --cells 8       few enough to follow each node
// Run: 00_string_on_an_obstacle --exercise 1
// Run: 00_string_on_an_obstacle --exercise 2
// Run: 00_string_on_an_obstacle --exercise 3
//
// Needs: one course on finite elements (hat functions, the matrix of a form). It is the first chapter.
// :live: string
//
// **The picture.** A string is held at both ends. The load `f(x) = 10 sin(2πx)` lifts its left half and presses its
// right half on a floor at height 0. *The string touches the floor in one piece, and the floor pushes exactly there.*
// The next picture shows how the active set below finds that piece, the last one the same with two nodes only.
//
// **Predict, before you read on.** (a) The load points down from `x = 1/2` on. Does the string touch the floor from
// there on? (b) How large is the pressure of the floor where the string lies on it?
//
// ## An energy, and a cone
//
// Among the shapes $v$ with $v(0) = v(1) = 0$ the string takes the one of least energy
//
// $$ J(v) = ½ a(v, v) - L(v),   a(u, v) = ∫_0^1 u' v' dx,   L(v) = ∫_0^1 f v dx. $$
//
// The floor allows only the shapes in $K = \{ v : v ≥ 0 \}$. $K$ is *convex*: the straight way between two of its
// shapes stays in it. It is even a *cone*: with $v$ it contains $t v$ for every $t ≥ 0$.
//
// **Why $v - u$ and not $v$.** Let $u$ be the minimiser and $v$ any shape in $K$. Then $u + t(v - u)$ lies in $K$ for
// $0 ≤ t ≤ 1$, and its energy is not below that of $u$:
//
// $$ 0 ≤ J(u + t(v - u)) - J(u) = t (a(u, v - u) - L(v - u)) + ½ t^2 a(v - u, v - u). $$
//
// Divide by $t$ and let $t → 0$. What is left is a *variational inequality*:
//
// $$ u ∈ K,   a(u, v - u) ≥ L(v - u)   for all v ∈ K. $$
//
// Without the floor one may go in the direction $v - u$ and back, and $≥$ becomes $=$. Where the string touches the
// floor, only the way up is allowed. Geometrically: let $w$ be the string without a floor, $L(v) = a(w, v)$. Then
// $a(w - u, v - u) ≤ 0$: seen from $u$, the way to $w$ makes no acute angle with the way to any $v$ in $K$. So $u$ is
// the *projection* of $w$ onto $K$, its nearest element when lengths are measured by $a(v, v)^{1/2}$ (last picture).
//
// **The multiplier is the contact force.** Now let $u$ and $v$ be linear between nodes $x_i = i h$, so that
// $u = ∑ u_i φ_i$ with the hat functions $φ_i$. Such a $u$ is in $K$ if no $u_i$ is negative. Write $u$ for the
// vector of the $u_i$ too. With the matrix $A_{ij} = a(φ_i, φ_j)$ and the vector $b_i = L(φ_i)$ the inequality reads
// $(A u - b)^T (v - u) ≥ 0$. Call $λ = A u - b$ the *multiplier*. It is the force that is missing for equilibrium:
// the force of the floor. Put $v = u + φ_i$ into the inequality: $λ_i ≥ 0$. Put $v = 0$: $λ^T u ≤ 0$. Put $v = 2u$:
// $λ^T u ≥ 0$. So $λ^T u = 0$. No term $λ_i u_i$ of this sum is negative, so each is 0. For every inner node
//
// $$ u_i ≥ 0,   λ_i ≥ 0,   λ_i u_i = 0,   A u = b + λ. $$
//
// The string is not below the floor; the floor only pushes; it pushes only where it is touched. Two numbers that are
// not negative and have the product 0 are called *complementary*. The four together are the *KKT conditions* of
// Karush, Kuhn and Tucker. Both programs below look for this pair $(u, λ)$.

#include <numbers>

#include "antilock/core/dense.hpp"
#include "common/string_output.hpp"
#include "common/tutorial.hpp"

using namespace antilock;
using Eigen::MatrixXd, Eigen::VectorXd, std::numbers::pi;

// ### Mesh
struct String {
  double h, floor;
  MatrixXd a;
  VectorXd b;  // at the inner nodes
};
// ### Forms
// $A$ has $2/h$ on its diagonal and $-1/h$ beside it; $∫ \sin(2πx) φ_i = \sin(2πx_i) (2 - 2\cos 2πh)/(4π² h)$.
String hang(int cells, double load = 10, double floor = 0) {
  const int n = cells - 1;
  const double h = 1.0 / cells, factor = load * (2 - 2 * std::cos(2 * pi * h)) / (4 * pi * pi * h);
  String s{h, floor, MatrixXd::Zero(n, n), VectorXd::Zero(n)};
  for (int i = 0; i < n; ++i) {
    s.a(i, i) = 2 / h;
    if (i > 0) s.a(i, i - 1) = s.a(i - 1, i) = -1 / h;
    s.b(i) = factor * std::sin(2 * pi * (i + 1) * h);
  }
  return s;
}

struct Answer {
  VectorXd u, lambda;  // at the inner nodes
  int solves = 0;      // linear systems solved
};

// ### Solve
// **Active set.** Guess which nodes touch. There $u_i = $ floor; elsewhere $λ_i = 0$, and the equation gives $u$.
// Then look at the signs: a node that sank below the floor should have touched; a node that the floor would have to
// pull should not. When the guess repeats itself, all signs are right. The guess is called the *active set*.
Answer active_set_by_hand(const String& s, std::vector<VectorXd>& guesses) {
  const int n = static_cast<int>(s.b.size());
  Answer answer;
  std::vector<bool> touches(n, false), guess;
  for (; guess != touches; ++answer.solves) {
    guess = touches;
    MatrixXd a = s.a;
    VectorXd right = s.b;
    for (int i = 0; i < n; ++i)
      if (guess[i]) a(i, i) = 1e30, right(i) = 1e30 * s.floor;  // row i now says u_i = floor
    answer.u = Cholesky(a).solve(right);
    for (int i = 0; i < n; ++i)
      if (guess[i]) answer.u(i) = s.floor;  // without the round-off of 1e30
    guesses.push_back(answer.u);
    const VectorXd missing = s.a * answer.u - s.b;
    answer.lambda = VectorXd::Zero(n);
    for (int i = 0; i < n; ++i) {
      if (guess[i]) answer.lambda(i) = missing(i);
      touches[i] = guess[i] ? missing(i) > 0 : answer.u(i) < s.floor;
    }
  }
  return answer;
}

// **Uzawa.** Guess the forces of the floor instead. They give a shape, $A u = b + λ$. Where it is below the floor,
// push more; where it is above, push less, but never pull: $λ_i ← \max(0, λ_i - ρ (u_i - floor))$, $ρ$ the length of
// the step. The maximum is the projection onto the cone $λ ≥ 0$. $u - floor$ is the gradient in $λ$ of
// $½ (b + λ)^T A^{-1} (b + λ) - floor ∑ λ_i$, so this is a *projected gradient* method. Its operator is $A^{-1}$, the
// *compliance*: force in, displacement out. $A$ has the eigenvalues $4 \sin^2(kπh/2)/h$, so those of $A^{-1}$ lie
// between about $h/4$ and $1/(π² h)$. A step multiplies the part of the error with the eigenvalue $σ$ by $1 - ρσ$. So
// every $ρ < 2π² h$, which is 2 / largest $σ$, is safe. The part with the smallest $σ$ is the slowest: its factor is
// $1 - ρ h/4$, at best about $1 - π² h²/2$. So halve $h$, and there are four times as many steps. The *condition
// number* $κ$ = largest / smallest eigenvalue, here $4/(π² h²)$, says it in one number: the factor is $1 - 2/κ$.
Answer uzawa_by_hand(const String& s, double rho, double tolerance) {
  const Cholesky factor(s.a);
  Answer answer{s.b, 0 * s.b};
  for (double change = 1; change > tolerance; ++answer.solves) {
    answer.u = factor.solve(VectorXd(s.b + answer.lambda));
    const VectorXd next = (answer.lambda.array() - rho * (answer.u.array() - s.floor)).max(0).matrix();
    change = (next - answer.lambda).lpNorm<Eigen::Infinity>() / rho;
    answer.lambda = next;
  }
  return answer;
}

// ### Output
// **The truth.** Where the string is free $-u'' = f$, so $u = α \sin 2πx + s x$ with $α = 10/(4π²)$ and a slope $s$
// still to be found. Contact starts at $c$: $u(c) = 0$. A kink at $c$ would be a jump of $u'$ from a negative value
// up to 0. Only a force that pulls the string down could hold it there, and the floor does not pull. So $u'(c) = 0$.
// Both together say $\tan z = z$ for $z = 2πc$, so $c = 0.715148...$
void string_on_an_obstacle(const tutorial::Options& options, tutorial::Report& report) {
  const String s = hang(options.cells);
  std::vector<VectorXd> guesses;
  const Answer active = active_set_by_hand(s, guesses), uzawa = uzawa_by_hand(s, 1.9 * pi * pi * s.h, 1e-10);
  fmt::print("  linear solves: active set {}, Uzawa {}\n", active.solves, uzawa.solves);
  tutorial::write_string(options.out, guesses, active.lambda);

  const double from = tutorial::contact_starts(active.lambda), c = tutorial::string_touches_from(0);
  report.claim(active.u.minCoeff() >= 0 && active.lambda.minCoeff() >= 0 && active.u.dot(active.lambda) == 0,
               "u >= 0, lambda >= 0 and lambda u = 0 at every node, exactly");
  report.claim(std::abs(from - c) <= s.h, "contact starts at x = {:.4f}, truth {:.4f} (h = {:.4f})", from, c, s.h);
  // With exact loads P1 is exact at the nodes of a free string. The end of contact is off by at most h, and u'' jumps
  // there by |f(c)| = 9.76: the error is at most 9.76 h^2 / 2.
  report.claim_within(tutorial::string_error(active.u) / (s.h * s.h), 0, 4.9, "largest error at the nodes / h^2:");
  // Uzawa stops when a step moves less than 1e-10; each later step is (1 - pi^2 h^2 / 2) times the one before.
  report.claim_within((uzawa.u - active.u).lpNorm<Eigen::Infinity>(), 0, 2e-10 / (pi * pi * s.h * s.h),
                      "Uzawa comes to the same string:");
}

// ## What came out
//
// The active set needs fewer than ten linear solves, Uzawa 2,737, for the same string. (a) No: contact starts at
// 0.7151, since the lifted half pulls its neighbour up. (b) Where the string lies flat $u'' = 0$: the pressure is $-f$.
//
// ## Exercises
//
// Predict first. `--exercise N` prints the prediction and its outcome; the answers are in `answers/`.
//
// 1. Double the load. What happens to $u$, to the forces, to the contact set?
// 2. Lower the floor to $-0.05$. $K$ is no cone any more. Where does contact start? Does it reach $x = 1$?
// 3. Uzawa with $ρ = 4π² h$, twice the safe step. Does it diverge? (Where does $λ$ live?)
// 4. On paper: show by $v = 0$ and $v = 2u$ that $a(u, u) = L(u)$. Which of the two is forbidden in exercise 2, and
//    what is left of the equality?

#include "answers/00_string_on_an_obstacle.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "00_string_on_an_obstacle", "what a variational inequality is, by hand",
                       {.takes_epsilon = false, .least_cells = 4, .most_cells = 128, .exercises = exercises()},
                       string_on_an_obstacle);
}
