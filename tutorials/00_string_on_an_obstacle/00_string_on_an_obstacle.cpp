// # A string on an obstacle
//
// Run: 00_string_on_an_obstacle                 32 cells; a moment
// Run: 00_string_on_an_obstacle --exercise 1
// Run: 00_string_on_an_obstacle --exercise 2
// Run: 00_string_on_an_obstacle --exercise 3
//
// **Afterwards you can** derive a variational inequality from an energy, read the force of
// the floor from its solution, and solve it with an active set.
//
// Needs: one course on finite elements (hat functions, the matrix of a form). It is the
// first chapter.
// :live: string
//
// A string is held at both ends. The load $f(x) = 10 \sin 2πx$ lifts its left half and
// presses its right half on a floor at height 0. Without the floor it would be a sine.
//
// **Predict, before you read on.** On 32 cells the string has 31 nodes between its ends.
// (a) A node touches the floor or it does not: there are $2^{31}$ sets of nodes that might
// touch. How many of them must a program try? (b) The load turns down at $x = ½$. Does the
// string begin to touch the floor there, left of it or right of it?
//
// ## An energy, and a cone
//
// Among the shapes $v$ with $v(0) = v(1) = 0$ the string takes the one of least energy
//
// $$ J(v) = ½ a(v, v) - L(v),   a(u, v) = ∫_0^1 u' v' dx,   L(v) = ∫_0^1 f v dx. $$
//
// The first term is what it costs to stretch the string, the second what the load gains
// when the string gives way. The floor allows only the shapes in $K = \{ v : v ≥ 0 \}$.
// This set is *convex*: the straight way between two of its shapes stays in it. It is even
// a *cone*: with a shape it contains each positive multiple of it.
//
// **Why $v - u$ and not $v$.** Without a floor one finds the shape of least energy as one
// finds the lowest point of a parabola: the derivative of $J$ is 0 in every direction $v$,
// and $a(u, v) = L(v)$ for all $v$. Here this is too much. If the string lies on the floor
// at its best shape $u$, a lower one may well have less energy, but it is not allowed, and
// the derivative in that direction says nothing. So ask only about directions that stay in
// $K$. All of them are of one kind: choose any allowed shape $v$ and go from $u$ straight
// towards it. The direction is $v - u$. The points on the way are $u + t (v - u)$ with
// $0 ≤ t ≤ 1$, and they are allowed, because $K$ is convex. As $u$ has the least energy of
// all allowed shapes, the energy on the way is not below its own:
//
// $$ 0 ≤ J(u + t(v - u)) - J(u) = t (a(u, v - u) - L(v - u)) + ½ t^2 a(v - u, v - u). $$
//
// Divide by $t$ and let $t → 0$: the last term vanishes, and the slope in the direction
// $v - u$ is not negative.
//
// $$ u ∈ K,   a(u, v - u) ≥ L(v - u)   for all v ∈ K. $$
//
// This is a *variational inequality*. It loses nothing. Put $t = 1$ into the first formula:
// $J(v) - J(u)$ is the sum of two terms. The inequality says that the first is not
// negative, and the second is half a square. So $J(v) ≥ J(u)$ for each allowed $v$. Where
// the string is free, $v$ may be a little above or a little below $u$. Both signs of the
// difference are allowed, and $≥$ becomes the familiar $=$. Where the string touches, only
// the way up is allowed, and $≥$ is all that can be said. So one inequality holds an
// equation where nothing touches and a sign where something does. Where one ends and the
// other begins is part of the answer.
//
// **There is one solution, and only one.** Let $u$ and $u'$ both solve the inequality. By
// the formula above $J(u') - J(u)$ and $J(u) - J(u')$ are each at least
// $½ a(u' - u, u' - u)$. Their sum is 0, so $a(u' - u, u' - u)$ is 0, too. The string is
// held at its ends, hence $u' = u$. A solution exists because $J$ is continuous and grows
// beyond all bounds in every direction, and because $K$ is closed. In infinitely many
// dimensions this is the theorem of *Stampacchia*.
//
// **The same in a picture.** Let $w$ be the string without a floor: $L(v) = a(w, v)$ for
// all $v$. The inequality becomes $a(u, v - u) ≥ a(w, v - u)$, or $a(w - u, v - u) ≤ 0$.
// Seen from $u$, the way to $w$ makes no acute angle with a way to a $v$ in $K$. So $u$ is
// the *projection* of $w$ onto $K$: nearest there, with lengths $a(v, v)^{1/2}$.
// :figure: projection
//
// **The multiplier is the contact force.** Now let the string be linear between the nodes
// $x_i = i h$, so that $u = ∑ u_i φ_i$ with hat functions $φ_i$. It is in $K$ if none of
// its values at the nodes is negative. Write $u$ for the vector of these values too. With
// the matrix $A_{ij} = a(φ_i, φ_j)$ and the loads $b_i = L(φ_i)$ the inequality reads
// $(A u - b)^T (v - u) ≥ 0$. Call $λ = A u - b$ the *multiplier*: $A u = b + λ$, so it is
// the force that is missing for equilibrium, and only the floor can exert it. What is known
// of it follows from three shapes. Put $v = u + φ_i$: $λ_i ≥ 0$. Put $v = 0$: $λ^T u ≤ 0$.
// Put $v = 2u$: $λ^T u ≥ 0$. So $λ^T u = 0$, and as no term of this sum is negative, each
// is 0. For every inner node
//
// $$ u_i ≥ 0,   λ_i ≥ 0,   λ_i u_i = 0,   A u = b + λ. $$
//
// The string is not below the floor; the floor only pushes, and only where it is touched.
// Two numbers that are not negative and have the product 0 are *complementary*; the four
// are the *KKT conditions* of Karush, Kuhn and Tucker.

#include <numbers>

#include "antilock/core/dense.hpp"
#include "course/chapter.hpp"
#include "programs/report.hpp"
#include "support.hpp"

using namespace antilock;
using Eigen::MatrixXd, Eigen::VectorXd, std::numbers::pi;

// ### Mesh
struct String {
  double h;
  MatrixXd a;
  VectorXd b, floor;  // at the inner nodes: the load, and the height of the floor
};
// ### Forms
// $A$ has $2/h$ on its diagonal and $-1/h$ beside it;
// $∫ \sin(2πx) φ_i = \sin(2πx_i) (2 - 2\cos 2πh)/(4π² h)$.
String hang(int cells, double load = 10, double floor = 0) {
  const int n = cells - 1;
  const double h = 1.0 / cells,
               factor = load * (2 - 2 * std::cos(2 * pi * h)) / (4 * pi * pi * h);
  String s{h, MatrixXd::Zero(n, n), VectorXd::Zero(n), VectorXd::Constant(n, floor)};
  for (int i = 0; i < n; ++i) {
    s.a(i, i) = 2 / h;
    if (i > 0) s.a(i, i - 1) = s.a(i - 1, i) = -1 / h;
    s.b(i) = factor * std::sin(2 * pi * (i + 1) * h);
  }
  return s;
}

struct Result {
  VectorXd u, lambda;  // at the inner nodes
  int solves = 0;      // linear systems solved
};

// ### Solve
// **Active set.** Guess which nodes touch. There the string is on the floor; elsewhere
// there is no force, and the equation gives the shape. Then look at the signs: a node that
// sank below the floor should have touched; a node that the floor would have to pull should
// not. When the guess, the *active set*, repeats itself, all signs are right.
//
// It does repeat itself. A force upwards at one node lowers no other: $A$ is an *M-matrix*
// (no entry off its diagonal is positive, none of its inverse negative). From the second
// guess on, the nodes that are let go are those with $λ_i < 0$: the floor pulled them. The
// next shape is in balance without these pulls. So $A (u_{new} - u_{old})$ is their
// opposite, which is not negative, at the nodes that are free now, and at the others $u$
// stays on the floor. As the inverse has no negative entry, $u_{new} ≥ u_{old}$: no node
// comes back, and the set shrinks. Other matrices may cycle.
Result active_set_by_hand(const String& s, std::vector<VectorXd>& guesses) {
  const int n = static_cast<int>(s.b.size());
  Result result;
  std::vector<bool> touches(n, false), guess;
  for (; guess != touches; ++result.solves) {
    guess = touches;
    MatrixXd a = s.a;
    VectorXd right = s.b;
    for (int i = 0; i < n; ++i)
      if (guess[i])
        a(i, i) = 1e30, right(i) = 1e30 * s.floor(i);  // row i now says u_i = floor
    result.u = Cholesky(a).solve(right);
    for (int i = 0; i < n; ++i)
      if (guess[i]) result.u(i) = s.floor(i);  // without the round-off of 1e30
    guesses.push_back(result.u);
    const VectorXd missing = s.a * result.u - s.b;
    result.lambda = VectorXd::Zero(n);
    for (int i = 0; i < n; ++i) {
      if (guess[i]) result.lambda(i) = missing(i);
      touches[i] = guess[i] ? missing(i) > 0 : result.u(i) < s.floor(i);
    }
  }
  return result;
}

// **The truth.** Where the string is free it is $U(x) = α \sin 2πx + s x$, $α = 10/(4π²)$,
// since $-u'' = f$. Contact starts at $c$, where $U$ is 0. A kink there would be a jump of
// $u'$ from a negative value up to 0, which only a pull can hold. So $U'(c) = 0$, too. Both
// together say $\tan z = z$ for $z = 2πc$: $c = 0.715148...$, $s = -2πα \cos z$.
//
// **The discrete string.** With exact loads a free string is exact at its nodes. So left of
// the first node $x_j$ that touches it is $U(x) - U(x_j) x/x_j$, which solves $-u'' = f$
// and is 0 at both ends. Near $c$, $U$ is the parabola $|f(c)| (x - c)²/2$: the error is
// about its value at $x_j$. Were $x_j$ over half a cell right of $c$, the node before it
// would be nearer to $c$, with a smaller $U$: below the floor. Were it over half a cell
// left, the kink at it would need more than its load: a pull. So it is the node nearest to
// $c$, up to a part of a cell that falls with $h$.
void string_on_an_obstacle(const tutorial::Options& options, tutorial::Report& report) {
  const String s = hang(options.cells);
  std::vector<VectorXd> guesses;
  const Result active = active_set_by_hand(s, guesses);
  fmt::print("  linear solves of the active set: {}\n", active.solves);
  // ### Output
  const double from = tutorial::contact_starts(active.lambda),
               c = tutorial::touches_from(0);
  const VectorXd expected = tutorial::discrete_string(options.cells, from);
  tutorial::write_string(options.out, guesses, active.lambda,
                         tutorial::exact_string(options.cells));
  const double left_over = (s.a * active.u - s.b - active.lambda).cwiseAbs().maxCoeff();
  report.claim(active.u.minCoeff() >= 0 && active.lambda.minCoeff() >= 0 &&
                   active.u.dot(active.lambda) == 0 &&
                   left_over <= 1e-12,  // round-off: 2e-14 on 128 cells
               "KKT: the signs exactly, A u = b + lambda to {:.0e} (proved)", left_over);
  report.claim_within((active.u - expected).cwiseAbs().maxCoeff(), 0, 1.5e-13,
                      "u is what it must be, up to (proved)");
  report.claim(std::abs(from - c) <= 0.6 * s.h,
               "contact from {:.4f} on, the node next to {:.4f} (proved)", from, c);
}

// ## What came out
// :output:
// :figure: string_steps
//
// (a) It tries 9 of $2^{31}$. Each guess corrects the one before, and from the second one
// on they only shrink. (In exact numbers the first shape is 0 at $x = ½$. The computed one
// is a little below 0 there. Were it a little above, this node would not be in the second
// guess, and 8 guesses would be enough.) (b) Right of it: contact starts at 0.7151 and not
// at the middle, since the lifted half pulls its neighbour up. Where the string lies flat
// it does not bend, so the pressure is $-f$: from the first touch on, the floor carries the
// whole load.
// :number: 9 = line "linear solves of the active set: {}"
// :number: 0.7151 = line "the node next to {}"
//
// Other solvers guess the forces of the floor, or never touch it.
// [Chapter 34](../34_solving_the_inequality/34_solving_the_inequality.cpp) compares eight
// of them.
//
// ## Exercises
//
// 1. Double the load. What happens to $u$, to the forces, to the contact set?
// 2. Lower the floor to $-0.05$. $K$ is no cone any more. Where does contact start? Does it
//    reach $x = 1$?
// 3. *Code.* Tilt the floor of exercise 2: its height is $-0.05$ at $x = 0$ still, and 0 at
//    $x = 1$. (`floor` has a height per node: this takes two lines.) Where does contact
//    start now, and does it reach $x = 1$?
// 4. On paper: show by $v = 0$ and $v = 2u$ that $a(u, u) = L(u)$. Which of the two is
//    forbidden in exercise 2, and what is left of the equality?
//
// ## Further reading
//
// - [Kinderlehrer and Stampacchia 2000](../guides/bibliography.md#kinderlehrer-2000): the
//   theorem of Stampacchia, and how smooth a string on an obstacle is.
// - [Hintermüller, Ito and Kunisch 2002](../guides/bibliography.md#hintermueller-2002): the
//   active set method as a method of Newton.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "00_string_on_an_obstacle",
                       "what a variational inequality is, by hand",
                       {.takes_epsilon = false,
                        .least_cells = 4,
                        .most_cells = 128,
                        .exercises = exercises()},
                       string_on_an_obstacle);
}
