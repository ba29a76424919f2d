// Your own problem in the paper's class: fill A1, B, M, the load and the bounds, then ask whether
// it will lock.
//
// Run: 25_your_own_problem                          two strings glued together, epsilon = 1e-10
// Run: 25_your_own_problem --epsilon 0 --cells 64   a rigid glue
//
// What the table shows. Nothing here is known to the library: two strings, one above the other,
// bonded by a thin glue of compliance epsilon, the upper one loaded by q downwards, the lower one
// over an obstacle at -gap. Each string is meshed for itself, one with n cells and one with n + 1.
// The same problem is written with two choices of B. One of them locks: as the glue hardens, its
// strings stop moving. The library says so before anything is solved, by one number. Here epsilon
// is the parameter of the class, (1), not its square as in (23).
//
// Why. The energy is  int u'^2/2 + int w'^2/2 + (1/(2 epsilon)) int (u - w)^2 + q int u,  so
//     a1 = int u' v' + int w' z',   a0 = int (u - w)(v - z),     L = -q int v,     K = { w >= -gap }.
// (u - w) = 0 at every point leaves no pair of broken lines: their corners are at different places.
// Asked at every point the condition is too much. Asked only against the hat functions of the lower
// string (a mortar: one condition per hat function, int (u - w) hat = 0), it makes w a projection
// of u, and u stays free. The mortar changes a0 itself, so Theorem 4, which compares spaces for one
// a0, does not cover it; the kernel decides all the same. At epsilon = 0 the truth is one string of
// tension 2: with c = 2 sqrt(gap/q), contact on [c, 1 - c], contact force q (1 - 2c), energy q^2
// c^3/3 - q gap.

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

// Where the unknowns are: u_0 .. u_{n+1} of the upper string (n + 1 cells), then w_0 .. w_n of the
// lower one.
struct Strings {
  int cells;
  int upper(int i) const { return i; }
  int lower(int i) const { return cells + 2 + i; }
  int size() const { return 2 * cells + 3; }
};

SparseMatrix sum_over_cells(const Strings& s, double of_derivatives, double of_values);  // 1. below
void fill_glue(const Strings& s, Glue glue, VariationalInequality& problem);             // 2. below

// 3. The rest: load, what is held, what is bounded from below. That is all that the solver ever
// sees.
VariationalInequality make_problem(const Strings& s, Glue glue, double epsilon) {
  VariationalInequality problem;
  problem.a1 = sum_over_cells(s, 1, 0);
  fill_glue(s, glue, problem);
  problem.compliance = epsilon;
  problem.load = Eigen::VectorXd::Zero(s.size());
  for (int i = 1; i <= s.cells; ++i) problem.load(s.upper(i)) = -load / (s.cells + 1);
  problem.fixed = {s.upper(0), s.upper(s.cells + 1), s.lower(0), s.lower(s.cells)};
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

    // 4. The hypotheses, on two meshes: coercive with one constant, a kernel that grows, K and G
    // meet.
    const Hypotheses h = check_hypotheses(problem, sum_over_cells(strings, 1, 1));
    const int finer_kernel = kernel_dimension(make_problem(finer, glue, options.epsilon));

    // 5. The diagnosis: the energy as the glue hardens.
    const Table rows = diagnosis(problem);
    rows.print(
        fmt::format("{}: (H1) coercivity {:.3f}; (H2) kernel {} of {} unknowns ({} on the mesh twice as fine); K "
                    "and G meet to {:.0e}",
                    name, h.coercivity, h.kernel, h.free, finer_kernel, h.distance));
    for (const Table& row : rows.rows())
      energies.add({name, row.number("epsilon"), -row.number("energy"), row.number("corrections")});

    // 6. The solution at the epsilon asked for, with its report.
    const Solution solution = active_set(problem);
    const Kkt& k = solution.kkt;
    fmt::print(
        "  contact force {:.4f} (rigid glue: {:.4f}), KKT: gap {:.0e}, pressure {:.0e}, complementarity {:.0e}, "
        "residual {:.0e}\n\n",
        solution.lambda.sum(), load * (1 - 2 * free_part), k.min_gap, k.min_pressure, k.complementarity, k.residual);
    judge(glue, h, finer_kernel, options.cells, rows, report);
  }
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

// 7. A problem that has no solution at epsilon = 0: one end raised, K and G do not meet. It is
// refused.
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

// Three things to try:
// - the same number of cells in both strings: the corners coincide, and pointwise glue leaves n - 1
//   functions free.
// - fewer rows: the mean of u - w over each cell of the lower string. Kernel n - 1; look at the
//   corrections.
// - a problem of your own: replace steps 1 to 3; the checks of steps 4 and 5 need no truth.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.least_cells = 4;
  options.most_cells = 128;
  options.epsilon = 1e-10;
  options.epsilon_is = "the class parameter of (1), the compliance of the glue; 0 is a rigid glue";
  return tutorial::run(argc, argv, "25_your_own_problem", "Your own problem in the class: two strings and a stiff glue",
                       options, own);
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

// 1. A1, a matrix of sums of int u' v', and the Gram matrix of the H1 norm, which only the check of
// (H1) needs.
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
  add(s.cells + 1, [&](int i) { return s.upper(i); });
  add(s.cells, [&](int i) { return s.lower(i); });
  SparseMatrix sum(s.size(), s.size());
  sum.setFromTriplets(entries.begin(), entries.end());
  return sum;
}

// 2. B and M: a0(u, v) = (B u)' M (B v). Both choices walk over the pieces between all corners, two
// Gauss points each.
void fill_glue(const Strings& s, Glue glue, VariationalInequality& problem) {
  std::vector<double> corners;
  for (int i = 0; i <= s.cells; ++i) corners.push_back(static_cast<double>(i) / s.cells);
  for (int i = 1; i <= s.cells; ++i) corners.push_back(static_cast<double>(i) / (s.cells + 1));
  std::sort(corners.begin(), corners.end());
  std::vector<Eigen::Triplet<double>> b;
  std::vector<double> m;
  for (std::size_t piece = 0; piece + 1 < corners.size(); ++piece)
    for (const double sign : {-1.0, 1.0}) {
      const double length = corners[piece + 1] - corners[piece], weight = 0.5 * length;
      const double x = corners[piece] + 0.5 * length * (1 + sign / std::sqrt(3.0));
      const Hats up = hats(s.cells + 1, x), low = hats(s.cells, x);
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
