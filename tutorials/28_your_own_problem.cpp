// # A problem of your own
//
// Run: 28_your_own_problem                          two strings glued together, ε = 1e-10
// Run: 28_your_own_problem --epsilon 0 --cells 64   a rigid glue
// Run: 28_your_own_problem --exercise 1
//
// Needs: [00](00_string_on_an_obstacle.cpp) for strings, [07](07_kernel.cpp) for kernels, [10](10_limits.cpp) for the
// class (1), [13](13_estimates.cpp) for coercivity. **Here ε is the parameter of the class itself**, not its square
// as in (23).
//
// **The picture.** The energy that two glued strings release, against the compliance ε of the glue. *One choice of
// $B$ locks: as the glue hardens its strings stop moving. The other does not. One number, the dimension of the
// kernel, says so before anything is solved.*
//
// **Predict.** Two strings, one above the other, have corners at different places: one has $n$ cells, the other
// $n + 1$. (a) How many independent pairs of broken lines are equal everywhere and 0 at the ends? (b) The lower string
// has $n$ cells. If $u - w$ need only be orthogonal to its $n - 1$ hat functions, how many independent pairs are left?
//
// ## Two strings and a glue
//
// Nothing here is known to the library. The upper string $u$ is loaded by $q = 32$ downwards. The lower one $w$ lies
// over an obstacle at $-g = -1/2$. Both have the tension 1, and a thin glue bonds them. With test functions $v$ for $u$
// and $z$ for $w$:
//
// $$ a_1 = ∫ u' v' + ∫ w' z',   a_0 = ∫ (u - w)(v - z),   L = -q ∫ v,   K = \{ w ≥ -g \}. $$
//
// $u = w$ at every point leaves no pair: a broken line may bend at its own corners only, and they share none. Asked
// only against the hat functions of the lower string (a *mortar*, a condition on mean values: $∫ (u - w) φ_i = 0$),
// it makes $w$ a projection of $u$: $n$ values of $u$ stay free. The mortar changes $a_0$ itself, so Theorem 4, which
// compares spaces for one $a_0$, does not cover it; the kernel decides all the same.
//
// **The truth** at ε = 0 is one string of tension 2: it lies on the obstacle over $[c, 1 - c]$ with
// $c = 2 (g/q)^{1/2}$, presses with $q (1 - 2c)$, and has the energy $q^2 c^3 / 3 - q g$.

#include <algorithm>
#include <cmath>

#include "antilock/analysis/hypotheses.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/core/error.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/table.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

constexpr double load = 32, gap = 0.5;
const double free_part = 2 * std::sqrt(gap / load);  // c: contact on [c, 1 - c] where the glue is rigid
enum class Glue { pointwise, mortar };

// ### Mesh
// The unknowns: those of the upper string ($n + 1$ cells; $n$ in the exercise), then $w_0 ... w_n$ of the lower one.
struct Strings {
  int cells, more = 1;
  int upper_cells() const { return cells + more; }
  int upper(int i) const { return i; }
  int lower(int i) const { return upper_cells() + 1 + i; }
  int size() const { return upper_cells() + cells + 2; }
};

SparseMatrix sum_over_cells(const Strings& s, double of_derivatives, double of_values);
void fill_glue(const Strings& s, Glue glue, VariationalInequality& problem);

// ### Forms
// $A_1$, $B$ and $M$ by the two helpers at the end; load, what is held, what is bounded from below. That is all that
// the solver ever sees. (Bounds from above, on sums of unknowns, and bounds that bear a given force only, as friction in
// [chapter 26](26_friction.cpp), are three more fields.)
VariationalInequality make_problem(const Strings& s, Glue glue, double epsilon) {
  VariationalInequality problem;
  problem.a1 = sum_over_cells(s, 1, 0);
  fill_glue(s, glue, problem);
  problem.compliance = epsilon;
  problem.load = Eigen::VectorXd::Zero(s.size());
  for (int i = 1; i < s.upper_cells(); ++i) problem.load(s.upper(i)) = -load / s.upper_cells();
  problem.fixed = {s.upper(0), s.upper(s.upper_cells()), s.lower(0), s.lower(s.cells)};
  problem.fixed_values = Eigen::VectorXd::Zero(4);
  for (int i = 1; i < s.cells; ++i) problem.contact.push_back(s.lower(i));
  problem.lower = Eigen::VectorXd::Constant(s.cells - 1, -gap);
  return problem;
}

Table diagnosis(const VariationalInequality& problem);
void judge(Glue glue, const Hypotheses& h, int finer_kernel, int cells, const Table& rows, tutorial::Report& report);
void refuse_the_impossible(const Strings& strings, tutorial::Report& report);

void own(const tutorial::Options& options, tutorial::Report& report) {
  const Strings strings{options.cells}, finer{2 * options.cells};
  Table energies({"glue", "epsilon", "released", "corrections"});
  for (const Glue glue : {Glue::pointwise, Glue::mortar}) {
    const std::string name = glue == Glue::pointwise ? "glue at every point" : "glue against hat functions";
    const VariationalInequality problem = make_problem(strings, glue, options.epsilon);

    // The hypotheses, on two meshes: coercive with one constant, a kernel that grows, $K$ and $G$ meet.
    const Hypotheses h = check_hypotheses(problem, sum_over_cells(strings, 1, 1));
    const int finer_kernel = kernel_dimension(make_problem(finer, glue, options.epsilon));

    // The diagnosis: the energy as the glue hardens.
    const Table rows = diagnosis(problem);
    rows.print(
        fmt::format("{}: (H1) coercivity {:.3f}; (H2) kernel {} of {} unknowns ({} on the mesh twice as fine); K "
                    "and G meet to {:.0e}",
                    name, h.coercivity, h.kernel, h.free, finer_kernel, h.distance));
    for (const Table& row : rows.rows())
      energies.add({name, row.number("epsilon"), -row.number("energy"), row.number("corrections")});

    // ### Solve
    // At the ε asked for, with its KKT report: how well the conditions of the inequality hold ([chapter
    // 00](00_string_on_an_obstacle.cpp)), named after Karush, Kuhn and Tucker.
    const Solution solution = active_set(problem);
    const Kkt& k = solution.kkt;
    fmt::print(
        "  contact force {:.4f} (rigid glue: {:.4f}), KKT: gap {:.0e}, pressure {:.0e}, complementarity {:.0e}, "
        "residual {:.0e}\n\n",
        solution.lambda.sum(), load * (1 - 2 * free_part), k.min_gap, k.min_pressure, k.complementarity, k.residual);
    judge(glue, h, finer_kernel, options.cells, rows, report);
  }
  // ### Output
  energies.write(options.out / "energies.csv");
  refuse_the_impossible(strings, report);
}

void judge(Glue glue, const Hypotheses& h, int finer_kernel, int cells, const Table& rows, tutorial::Report& report) {
  const double truth = load * load * std::pow(free_part, 3) / 3 - load * gap, n = cells;
  const Table rigid = rows.where("epsilon", 0);
  report.claim(h.coercive() && h.meet(), "the hypotheses hold: (H1) and K meets G");
  if (glue == Glue::pointwise)
    return report.claim(h.kernel == 0 && finer_kernel == 0 && rigid.number("max |u|") < 1e-6,
                        "no function is left free on any mesh: it locks, energy {:.1e} in place of {:.3f}",
                        rigid.number("energy"), truth);
  // P1 on a string alone misses q^2 h^2 / 24 of the energy: 1/2 int (u - u_h)'^2 with u'' = q; two
  // strings share it here
  report.claim(h.kernel == cells && finer_kernel == 2 * cells &&
                   std::abs(rigid.number("energy") - truth) < load * load / (24 * n * n),
               "{} functions are left free, {} on the finer mesh: energy {:.3f} at epsilon = 0, truth {:.3f}", h.kernel,
               finer_kernel, rigid.number("energy"), truth);
  report.claim(rigid.number("corrections") <= 5, "and {} corrections are enough", rigid.number("corrections"));
}

// A problem that has no solution at ε = 0: one end raised, $K$ and $G$ do not meet. It is refused.
void refuse_the_impossible(const Strings& strings, tutorial::Report& report) {
  VariationalInequality impossible = make_problem(strings, Glue::pointwise, 0);
  impossible.fixed_values(0) = 0.1;
  const double distance = distance_to_kernel(impossible);
  std::string refusal = "an answer";
  try {
    active_set(impossible);
  } catch (const NotConverged& no) {
    refusal = no.what();
  }
  report.claim(distance > 1e-3 && refusal != "an answer",
               "strings held 0.1 apart: K and G are {:.2g} from meeting; the solver says: {}", distance, refusal);
}

// ## What came out
//
// (a) None, on any mesh: the energy is 0 in place of -10.667. (b) $n$, and $2n$ on the finer mesh. The truth is met
// up to the energy that P1 misses, $q^2 h^2/24$. Strings held 0.1 apart have no solution at ε = 0: the solver
// refuses, and says why.
//
// ## Exercises
//
// Predict first. `--exercise N` prints the prediction and its outcome; the answers are in `answers/`.
//
// 1. Give both strings $n$ cells. Does the glue at every point still lock?
// 2. A problem of your own: replace $A_1$, $B$, $M$, load and bounds; the checks need no truth.

#include "answers/28_your_own_problem.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "28_your_own_problem", "Your own problem in the class: two strings and a stiff glue",
                       {.epsilon = 1e-10,
                        .epsilon_is = "the class parameter of (1), the compliance of the glue; 0 is a rigid glue",
                        .least_cells = 4,
                        .most_cells = 128,
                        .exercises = exercises},
                       own);
}

// The two hat functions that are not zero at x, on a string of `cells` cells, with their values.
struct Hats {
  int left;
  double at_left, at_right;
};
Hats hats(int cells, double x) {
  const int left = std::min(static_cast<int>(x * cells), cells - 1);
  return {left, left + 1 - x * cells, x * cells - left};
}

// $A_1$, a matrix of sums of $∫ u' v'$, and the Gram matrix of the H1 norm, which only the check of (H1) needs.
SparseMatrix sum_over_cells(const Strings& s, double of_derivatives, double of_values) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int cells, auto&& unknown) {
    const double h = 1.0 / cells;
    for (int i = 0; i < cells; ++i)
      for (const int j : {i, i + 1})
        for (const int k : {i, i + 1})
          entries.emplace_back(unknown(j), unknown(k),
                               of_derivatives * (j == k ? 1 : -1) / h + of_values * h * (j == k ? 2 : 1) / 6);
  };
  add(s.upper_cells(), [&](int i) { return s.upper(i); });
  add(s.cells, [&](int i) { return s.lower(i); });
  SparseMatrix sum(s.size(), s.size());
  sum.setFromTriplets(entries.begin(), entries.end());
  return sum;
}

// $B$ and $M$: $a_0(u, v) = (B u)^T M (B v)$. Both choices walk over the pieces between all corners, two Gauss points
// each.
void fill_glue(const Strings& s, Glue glue, VariationalInequality& problem) {
  std::vector<double> corners;
  for (int i = 0; i <= s.cells; ++i) corners.push_back(static_cast<double>(i) / s.cells);
  for (int i = 1; i < s.upper_cells(); ++i) corners.push_back(static_cast<double>(i) / s.upper_cells());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<Eigen::Triplet<double>> b;
  std::vector<double> m;
  for (std::size_t piece = 0; piece + 1 < corners.size(); ++piece)
    for (const double sign : {-1.0, 1.0}) {
      const double length = corners[piece + 1] - corners[piece], weight = 0.5 * length;
      const double x = corners[piece] + 0.5 * length * (1 + sign / std::sqrt(3.0));
      const Hats up = hats(s.upper_cells(), x), low = hats(s.cells, x);
      const auto row = [&](int r, double factor) {  // adds factor (u - w)(x) to the row
        b.emplace_back(r, s.upper(up.left), factor * up.at_left);
        b.emplace_back(r, s.upper(up.left + 1), factor * up.at_right);
        b.emplace_back(r, s.lower(low.left), -factor * low.at_left);
        b.emplace_back(r, s.lower(low.left + 1), -factor * low.at_right);
      };
      if (glue == Glue::pointwise) {  // one row per point: a0 is the integral itself
        row(static_cast<int>(m.size()), 1);
        m.push_back(weight);
      } else {  // one row per hat function of the lower string: (1/h) int (u - w) hat
        if (low.left > 0) row(low.left - 1, weight * low.at_left * s.cells);
        if (low.left + 1 < s.cells) row(low.left, weight * low.at_right * s.cells);
      }
    }
  if (glue == Glue::mortar) m.assign(s.cells - 1, 1.0 / s.cells);
  problem.m = Eigen::Map<const Eigen::VectorXd>(m.data(), static_cast<Eigen::Index>(m.size()));
  problem.b.resize(problem.m.size(), s.size());
  problem.b.setFromTriplets(b.begin(), b.end());  // entries at one place add up
}

Table diagnosis(const VariationalInequality& problem) {
  std::vector<double> epsilons;
  for (int k = 0; k <= 12; ++k) epsilons.push_back(std::pow(10.0, -k));
  epsilons.push_back(0);
  Table table({"epsilon", "energy", "max |u|", "corrections", "KKT"});
  for (const EnergyRow& row : energy_against_epsilon(problem, epsilons))
    table.add({row.epsilon, row.energy, row.moved, row.corrections, row.violation});
  return table;
}
