// # The reference solution
//
// Run: 04_reference_solution                          epsilon = 1e-6, h = 1/256; about two seconds
// Run: 04_reference_solution --epsilon 1 --cells 64
// Run: 04_reference_solution --exercise 1
// Run: 04_reference_solution --exercise 2
//
// Needs: [00](../00_string_on_an_obstacle/00_string_on_an_obstacle.cpp) (complementarity),
// [01](../01_domain/01_domain.cpp) ((21), (23)), [03](../03_by_hand/03_by_hand.cpp)
// (split form, layer stress).
//
// **The picture.** Figure 4, a very fine mesh: a hill over the left half of the body, where
// the load lifts it, and a valley over the right half, where it presses the body on the
// obstacle. On the layer "its value along the normal to Σ is constant and nonnegative over
// Ω⁻" (Section 4.1). So the layer shows a ridge, a function of $x$ alone.
//
// **Predict.** Push the layer from below with the pressure $\sin kπx$, which has $k$ half
// waves, and look how far it gives way. Its stiffness is the pressure per displacement. (a)
// At $ε = 1$ layer and body are of one material. By which factor does the stiffness grow
// with twice as many half waves? (b) And at $ε = 10^{-6}$, where the layer cannot vary
// across?
//
// ## A truth without a mesh
//
// "Unilateral contact problems generally do not admit analytical solution" (Section 4.1).
// So the paper solves on a very fine mesh, by Uzawa's algorithm, and takes this for the
// truth. (The algorithm guesses the contact forces and corrects them step by step. Chapter
// 34 derives it, and chapter 21 measures what it costs.) Ours needs no mesh. All of it
// follows from two ordinary differential equations, and the errors of (23) in this course
// are measured against them.
//
// All displacements are 0 on the left and on the right side, in the body and in the layer.
// So write them as sums of sines,
//
// $$ u(x, y) = ∑_k u_k(y) \sin kπx,   f = ∑_k f_k(y) \sin kπx,   a = kπ. $$
//
// Two derivatives in $x$ multiply a sine by $-a^2$. So (21) on the unit layer (exercise 3
// of chapter 01) becomes one equation per $k$ in the body, $-Δu = f$, and one in the layer,
// $-∂_{xx} u - ε^{-2} ∂_{yy} u = 0$:
//
// $$ u_k'' = a^2 u_k - f_k   (0 < y < 1),   ε^{-2} u_k'' = a^2 u_k   (-1 < y < 0). $$
//
// **What to keep of the derivation.** It ends in one formula, $s_k → T + a^2$, and most
// chapters need no more. (11 and 17 also use the stiffness of the layer alone,
// $z \tanh κ$, and 15 uses the pull $g$.) These are its letters, for one wave number
// $a = kπ$:
//
// | letter | meaning |
// |---|---|
// | $w$, $c$ | the displacement on $Σ$, and on $Γ_C$ |
// | $p$, $λ$ | the layer stress, and the pressure on $Γ_C$ |
// | $T$, $g$ | the stiffness of the body on $Σ$, and the pull of the load there |
// | $κ$, $z$ | $ε a$ and $a/ε$, the two numbers of the layer |
// | $s_k$, $q$ | stiffness and pull again, as $Γ_C$ feels them through the layer |
//
// Both equations are solved by the hyperbolic sine and cosine. On $Σ$ two things pass from
// the layer to the body: the displacement $w = u_k(0)$, and the layer stress
// $p = ε^{-2} ∂_y u$, which must be the slope $∂_y u^+$ of the body. On top the body is
// clamped.
//
// **The body.** Hold its lower side at 1. Without a load it is
// $ψ(y) = \sinh(a(1 - y))/\sinh a$, because $ψ'' = a^2 ψ$, $ψ(0) = 1$ and $ψ(1) = 0$. Its
// slope at the lower side is $-T$ with $T = a \coth a$. Now let the lower side be at $w$,
// and let the load act. Multiply the equation of $u_k$ by $ψ$, and integrate by parts
// twice. Because $ψ'' = a^2 ψ$, only the ends are left:
//
// $$ -∫_0^1 f_k ψ dy = ∫_0^1 (u_k'' - a^2 u_k) ψ dy = -u_k'(0) + ψ'(0) u_k(0) =
// -u_k'(0) - T w. $$
//
// So the slope of the body at $Σ$ is
//
// $$ ∂_y u^+ = g - T w,   T = a \coth a,   g = ∫_0^1 f_k ψ dy. $$
//
// **The layer.** Let $c$ be the displacement of the side that may touch, and $λ$ the
// pressure there. The outward normal points down, so $p = -λ$ on this side. The solution
// that starts so is, at the height $η = 1 + y$ above it,
//
// $$ u_k = c \cosh κη - (λ/z) \sinh κη,   p = z c \sinh κη - λ \cosh κη,   κ = ε a,   z = a/ε. $$
//
// **Together.** At the top of the layer, $η = 1$, put its $u_k$ for $w$ and its $p$ for
// $∂_y u^+$ into the body's line $p = g - T w$:
//
// $$ z c \sinh κ - λ \cosh κ = g - T (c \cosh κ - (λ/z) \sinh κ). $$
//
// Solve for the pressure, and divide above and below by $\cosh κ$:
//
// $$ λ = s c - q,   s_k(ε) = z \frac{T + z \tanh κ}{z + T \tanh κ},   q = \frac{g}{\cosh κ + (T/z) \sinh κ}. $$
//
// This is all that the obstacle feels of body and layer. The *symbol* $s_k(ε)$ is the
// stiffness against $k$ half waves. How large is it? For thin layers $z \tanh κ → a^2$, so
//
// $$ s_k(ε) → T + a^2   (ε → 0),   s_k(ε) ≈ a/ε   (κ > 1). $$
//
// A rigid layer resists like a string: $a^2$ comes from its own energy along $x$. And
// $T ≈ a$ is the body's. The other case, $κ > 1$, is that of half waves shorter than $πε$,
// about three times the thickness of the layer. There $\tanh κ ≈ 1$, and such a wave dies
// out in the layer before it reaches the body.
// :figure: modes
//
// **The contact.** Left open are the displacement $c(x)$ and the pressure $λ(x)$ on the
// side that may touch. Their sine coefficients are $c_k$ and $s_k c_k - q_k$, by the last
// line, and the signs decide between them:
//
// $$ c ≥ 0,   λ ≥ 0,   λ c = 0. $$
//
// This is chapter 00's complementarity in $x$ alone, with another matrix.
// `lib/antilock/exact` solves it at $2^{17}$ points by chapter 00's active set, to 8 digits
// of $u$. From $c$ and $λ$ all $u_k$ follow in closed form.

#include <numbers>

#include "antilock/solve/uzawa.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using std::numbers::pi;

double symbol(int k, double epsilon) {
  const double a = k * pi, t = a / std::tanh(a);
  if (epsilon == 0) return t + a * a;
  const double z = a / epsilon, tanh = std::tanh(epsilon * a);
  return z * (t + z * tanh) / (z + t * tanh);
}

// ### Mesh
// **The library in ten lines.** From here on chapters compute with the library. These are
// its words, as the data go. A
// *scene* (chapter 23) is what is to be solved. A *method*, an element and a family of
// meshes, knows nothing of it. A
// *space* is the method at one $h$: the element's unknowns on a mesh. `assemble` brings
// both together, as chapter 03's `assemble_by_hand` does. The solver knows only the
// matrices. A *result* keeps all that belongs together, and everything is measured, drawn
// and written from it.
const Method p1_structured{&p1(), structured()};  // an element, and one mesh per 1/h
Result solve(const Scene& scene, int cells) {
  const Space space = p1_structured.space(cells);  // the unknowns, on a mesh
  // ### Forms
  // A1; B, M and epsilon^2 in front of them; the load; which unknowns may touch
  const VariationalInequality problem = assemble(scene, space);
  // ### Solve
  // u, the layer stress p, the pressure lambda, how well the conditions hold: chapter 03's
  // two loops
  const Solution solution = active_set(problem);
  return {space, problem, solution};
}

// The stiffness of the mesh against $\sin kπx$: push with this pressure, without an
// obstacle, and see how far it gives.
double discrete_symbol(int k, double epsilon, int cells) {
  const Space space = p1_structured.space(cells);
  VariationalInequality problem =
      assemble(Scene(Body{[](double, double) { return 0.0; }}, StiffLayer{epsilon}), space);
  const double h = 1.0 / cells, a = k * pi,
               integral = (2 - 2 * std::cos(a * h)) / (a * a * h);  // chapter 00
  for (const int v : space.contact_dofs())
    problem.load(v) = integral * std::sin(a * space.dof_coordinates()(v, 0));
  const int highest =
      space.contact_dofs()[static_cast<std::size_t>(cells / (2 * k)) - 1];  // x = 1/(2 k)
  return 1 / active_set(problem).u(highest);
}

void reference_solution(const tutorial::Options& options, tutorial::Report& report) {
  const double epsilon = options.epsilon, h = 1.0 / options.cells;
  const Scene scene(Body{paper_load}, StiffLayer{epsilon},
                    UnilateralContact{});  // body, layer, contact: (23)
  const Result fine = solve(scene, options.cells);
  const Space& space = fine.space;
  const tutorial::Exact exact(
      scene);  // the truth of this scene; refused where it is not known
  const Errors errors = exact.errors(space, fine.solution);

  Table symbols({"epsilon", "k", "s_k", "on 1/h = 64", "off by (a h)^2 times"});
  for (const double one : {1.0, 0.1, 1e-6})
    for (const int k : {1, 2, 4, 8}) {
      const double s = symbol(k, one), found = discrete_symbol(k, one, 64);
      symbols.add({one, k, s, found, (found / s - 1) / std::pow(k * pi / 64, 2)});
    }
  // ### Output
  tutorial::present(options.out, exact.scene, fine, "reference solution", errors);
  tutorial::modes({1.0, 0.1}, symbol).write(options.out / "modes.csv");
  symbols.print("the symbol, by formula and by P1 on a mesh");

  // P1's stiffness is derived below ("What came out"): a (1 + (a h)^2 / 6) for a block, a^2
  // exactly for a string. The rigid layer is a string under a block. So of its s_k = T +
  // a^2 only T, the share of the block, is off.
  const Table block = symbols.filter("epsilon", 1.0),
              rigid = symbols.filter("epsilon", 1e-6);
  report.claim_within(block.max("off by (a h)^2 times") * 6, 0.98, 1.02,
                      "epsilon = 1: off by (a h)^2 / 6 (proved), times");
  double law = 0;
  for (const Table& row : rigid.rows()) {
    const double a = row.number("k") * pi,
                 share = a / std::tanh(a) / row.number("s_k");  // of the body, T / s_k
    law = std::max(law, std::abs(row.number("off by (a h)^2 times") * 6 / share - 1));
  }
  report.claim(law < 0.05,
               "epsilon = 1e-6: off by T / s_k of that, up to {:.0f} per cent (proved)",
               100 * law);
  report.claim_within(errors.max_at_unknowns / (h * h), 0.16, 0.8,
                      "error of the reference solution / h^2 (observed):");
  double across = 0;  // between Sigma and Gamma_C, on one vertical line; the stress is at
                      // most 1.7 in size
  for (int i = 0; i <= options.cells; ++i)
    across = std::max(across,
                      std::abs(fine.solution.u(i) -
                               fine.solution.u(i + options.cells * (options.cells + 1))));
  report.claim(across <= 1.7 * epsilon * epsilon + 1e-13,
               "constant across the layer up to {:.0e} (proved: p is finite)", across);
  const auto& c = fine.problem.bounds.unknowns;
  report.claim(fine.solution.u(c).minCoeff() >= 0,
               "nonnegative on Gamma_C (proved: u is in K_h)");
  const double from = contact_zone(fine).from.value_or(1);
  report.claim_within((from - exact.contact_from()) / h, -1, 1,
                      "start of contact - truth, in cells (observed):");
  // It stops where a step moves less than 1e-10 of u in the gap, which is its error on
  // Gamma_C: where the obstacle pushes, u should be 0, and Uzawa's last change is that u.
  const Result coarse = solve(scene, std::min(64, options.cells));
  const Eigen::VectorXd as_the_paper = uzawa(coarse.problem).u;
  const double apart = (as_the_paper - coarse.solution.u).cwiseAbs().maxCoeff() /
                       as_the_paper.cwiseAbs().maxCoeff();
  report.claim(
      apart <= 2e-10,
      "Uzawa, the paper's way, finds the same up to {:.0e}, on 1/h = 64 (observed)", apart);
}

// ## What came out
// :output: the symbol
//
// (a) Twice: at $ε = 1$ a wave goes into the depth about as far as it is long, so a wave of
// half the length has slopes twice as large over half the depth, and $2^2/2 = 2$. The
// table has 3.142 and 6.283.
// :number: 3.142 = table "the symbol" s_k epsilon=1 k=1
// :number: 6.283 = table "the symbol" s_k epsilon=1 k=2
//
// (b) Between three and four times: $s_k ≈ a + a^2$. The body's $a$ doubles, the string's
// $a^2$ becomes four times as large, and it is the larger part. At $ε = 0.1$ long waves see
// a string, short ones an elastic block: $s_1$ is 12.33, near the 13.02 of the rigid layer,
// and $s_8$ is 248.6, near $a/ε = 251$.
// :number: 12.33 = table "the symbol" s_k epsilon=0.1 k=1
// :number: 13.02 = table "the symbol" s_k epsilon=1e-06 k=1
// :number: 248.6 = table "the symbol" s_k epsilon=0.1 k=8
//
// Figure 4's solution, P1 on $1/h = 256$, is some $5·10^{-6}$ off the truth at the
// unknowns. So from now on every error is measured against the sine series and not against
// Figure 4. In the truth the contact zone begins at $x = 0.702$.
// :number: 5 = 1e6 * line "reference solution {}"
// :output: error against the truth
//
// **Why P1 is off by $(ah)^2/6$.** On the structured mesh the row of an inner vertex is
// four times its value less its four neighbours. Put in $u = ρ^j \sin ax$ on the $j$-th
// line above $Γ_C$, with $ρ = e^{-θ}$. The row is 0 if $\cosh θ = 2 - \cos ah$, that is
// $\sinh(θ/2) = \sin(ah/2)$. (The block is deep: what its far side sends back is as small
// as $e^{-4a}$.) The row of a vertex of $Γ_C$ leaves $2 - \cos ah - ρ = \sinh θ$, and the
// pressure $\sin ax$ has the load $(2 - 2 \cos ah)/(a^2 h) = 4 \sin^2(ah/2)/(a^2 h)$ there.
// So the stiffness of the mesh is
//
// $$ \frac{a^2 h \sinh θ}{4 \sin^2(ah/2)} = \frac{a^2 h}{2} \coth \frac{θ}{2} =
// a (1 + \frac{(ah)^2}{6} + ...). $$
//
// For a string the row and the load are both $2 - 2 \cos ah$ over $h$ and over $a^2 h$: the
// stiffness is $a^2$, exactly.
//
// ## Exercises
//
// 1. Turn the load to $-10 \sin πx$. Where does the body touch? How far does the ridge
//    rise? How far off is P1?
// 2. How far does $ε = 0.1$ let half waves see a string: for which $k$ has $s_k$ lost half
//    of $T + a^2$?
// 3. On paper: derive $T = a \coth a$, and $s_k(1) = a \coth 2a$. Why must this be so?
//
// ## Further reading
//
// - [Kikuchi and Oden 1988](../guides/bibliography.md#kikuchi-1988): contact as an
//   inequality, with finite elements.
// - [Glowinski 1984](../guides/bibliography.md#glowinski-1984): the method of Uzawa, with
//   which the paper computes its reference solution.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "04_reference_solution",
      "Figure 4: the reference solution on a very fine mesh, and a truth without a mesh",
      {.cells = 256, .least_cells = 4, .exercises = exercises}, reference_solution);
}
