// The energy bracket: two computable numbers with the exact energy between them, and locking seen without the solution.
//
// Run: 16_energy_bracket                     h from 1/8 to 1/64, five epsilons, both meshes; a few seconds
// Run: 16_energy_bracket --cells 128
//
// --epsilon is not asked for here: the study has five of its own.
//
// u solves (23) exactly if it makes J(v) = a(v, v)/2 - (f, v) smallest on K. Three facts follow.
//
// Above. P1 is conforming and asks for v >= 0 at every vertex of Gamma_C, hence everywhere on it: K_h is part of K
// (Section 4.1, before (26)), so J(u_h) >= J(u). More: |u - v|_a^2 / 2 <= J(v) - J(u) for all v of K, in the energy
// norm of Remark 4.
//
// Below. K_h^nc is not part of K, and the energy of Crouzeix-Raviart may lie on either side. The interpolation of
// Lemma 2 takes K into K_h^nc and gives J_h(u_h) <= J_h(I_h u) = J(u) - |u - I_h u|^2 / 2 + (f, u - I_h u): the last
// term, of the same size h^2, is what stands in the way. On every mesh of this study J_h(u_h) < J(u): that is observed.
// It is not proved, and it is false in general: on the unit square cut in two triangles, load 1, it fails (a test of
// the library). What is proved: every flux sigma with -div sigma = f, sigma.n >= 0 on Gamma_C, gives -|sigma|^2 / 2 <=
// J(u), and Crouzeix-Raviart's own gradient becomes such a flux by a correction known triangle by triangle. The bound
// is its energy minus about sum_T |T| f_T^2 s_T / 288, s_T the sum of the squares of the three edges: the same number
// for every epsilon, 0 included. analysis/energy_bracket.cpp and certificate.cpp derive it, with the terms for a load
// that is not constant on triangles.
//
// So the bracket [lower, J(P1)] holds J(u) whatever epsilon is, and sqrt(2 width) bounds the energy error of P1. Where
// P1 locks, its energy does not come down, the bracket stays open, and the reader of the two numbers knows.

#include <fmt/format.h>

#include <array>

#include "antilock/analysis/energy_bracket.hpp"
#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/truth_table.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/study/sweep.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

constexpr std::array epsilons{1.0, 1e-1, 1e-2, 1e-4, 0.0};
const Scene scene(Body{paper_load}, StiffLayer{1}, UnilateralContact{});

struct Row {
  bool structured;
  int cells;
  double epsilon;
  EnergyBracket bracket;
  double cr;     // J of Crouzeix-Raviart, the uncorrected number
  double truth;  // J(u), used by the verdicts alone
  double error;  // |u - u_h| of P1 in the energy norm, measured with the truth

  std::string mesh() const { return structured ? "structured" : "unstructured"; }
};

// 1. One mesh: P1 and Crouzeix-Raviart, the forms assembled once for all epsilons.
std::vector<Row> solve_all(bool structured, int cells, const std::vector<Truth>& truth,
                           const std::vector<TruthTable>& table) {
  const TriangleMesh mesh = structured ? structured_mesh(cells) : unstructured_mesh(cells);
  const Space conforming(mesh, p1()), nonconforming(mesh, crouzeix_raviart());
  Sweep above(scene, conforming), below(scene, nonconforming);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < epsilons.size(); ++i) {
    above.set_epsilon(epsilons[i]);
    below.set_epsilon(epsilons[i]);
    const Solution upper = above.solve(), lower = below.solve();
    // 2. The bracket: nothing in these two lines knows u.
    const Scene now(Body{paper_load}, StiffLayer{epsilons[i]}, UnilateralContact{});
    const EnergyBracket bracket{energy_lower_bound(now, nonconforming, below.problem(), lower),
                                energy(above.problem(), upper)};
    const Errors errors = measure_errors(conforming, upper, epsilons[i], reference(table[i]));
    rows.push_back(
        {structured, cells, epsilons[i], bracket, energy(below.problem(), lower), truth[i].energy(), errors.energy});
  }
  return rows;
}

void print_and_write(const std::filesystem::path& path, const std::vector<Row>& rows) {
  fmt::print("\n  {:>12} {:>5} {:>8}  {:>12} {:>12} {:>12} {:>12}  {:>9} {:>9} {:>9}\n", "mesh", "1/h", "epsilon",
             "lower bound", "J(CR)", "J(u), truth", "J(P1)", "width", "bound of", "error of");
  fmt::print("  {:>94} {:>9} {:>9}\n", "", "P1 error", "P1");
  for (const Row& r : rows)
    fmt::print("  {:>12} {:>5} {:>8g}  {:12.8f} {:12.8f} {:12.8f} {:12.8f}  {:9.2e} {:9.2e} {:9.2e}\n", r.mesh(),
               r.cells, r.epsilon, r.bracket.lower, r.cr, r.truth, r.bracket.upper, r.bracket.width(),
               r.bracket.error_bound(), r.error);
  write_file(path, [&](std::ostream& out) {
    out << "mesh,epsilon,cells,h,lower,cr,truth,upper,width,error_bound,energy_error\n";
    for (const Row& r : rows)
      out << fmt::format("{},{:g},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", r.mesh(),
                         r.epsilon, r.cells, 1.0 / r.cells, r.bracket.lower, r.cr, r.truth, r.bracket.upper,
                         r.bracket.width(), r.bracket.error_bound(), r.error);
  });
  fmt::print("\n");
}

// 3. Widths of one mesh family and epsilon: by how much the last refinement closes the bracket, as an order in h.
double closing_order(const std::vector<Row>& rows, bool structured, double epsilon) {
  std::vector<double> h, width;
  for (const Row& r : rows)
    if (r.structured == structured && r.epsilon == epsilon) {
      h.push_back(1.0 / r.cells);
      width.push_back(r.bracket.width());
    }
  return rates(h, width).back();
}

void verdicts(const std::vector<Row>& rows, tutorial::Report& report) {
  const int finest = rows.back().cells;
  bool inside = true, cr_below = true, bounded = true;
  double least = 1, most = 0, sharpest = 0, bluntest = 1;
  for (const Row& r : rows) {
    inside = inside && r.bracket.lower <= r.truth && r.truth <= r.bracket.upper;
    cr_below = cr_below && r.cr <= r.truth;
    bounded = bounded && r.error <= r.bracket.error_bound();
    sharpest = std::max(sharpest, r.error / r.bracket.error_bound());
    bluntest = std::min(bluntest, r.error / r.bracket.error_bound());
    if (r.cells != finest || r.structured) continue;
    least = std::min(least, r.cr - r.bracket.lower);
    most = std::max(most, r.cr - r.bracket.lower);
  }
  report.claim(inside, fmt::format("the bracket holds the exact energy in all {} runs (proved)", rows.size()));
  report.claim(cr_below, "the energy of Crouzeix-Raviart alone lies below it, too (observed here, not proved)");
  // 1e-3: of the correction only the small term (f - f_T, u_h) knows u, and through it epsilon
  report.claim(
      most - least < 1e-3 * most,
      fmt::format("the proved bound lies {:.2f} h^2 below J(CR) at 1/h = {}, whatever epsilon is (spread {:.0e})",
                  most * finest * finest, finest, (most - least) / most));
  report.claim(bounded,
               fmt::format("Remark 4: the energy error of P1 is {:.2f} to {:.2f} of sqrt(2 width), never above",
                           bluntest, sharpest));
  if (finest < 64) return;  // coarser meshes do not tell a locked line from a late one
  for (const bool structured : {true, false})
    for (const double epsilon : {1.0, 1e-4, 0.0}) {
      const double order = closing_order(rows, structured, epsilon);
      const bool locks = !structured && epsilon < 1e-2;
      // 2 is the order of energies; 0.6: the width of a locked run still falls with what P1 gains in the body
      report.claim(locks ? order < 0.6 : order > 1.8,
                   fmt::format("{}, epsilon = {:g}: the bracket {}, its width falls like h^{:.2f}",
                               structured ? "P1 structured" : "P1 unstructured", epsilon,
                               locks ? "stays open: locked" : "closes", order));
    }
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("truth for five epsilons");
  std::vector<Truth> truth;
  std::vector<TruthTable> table;
  for (const double epsilon : epsilons) table.emplace_back(truth.emplace_back(paper_sine_load(), epsilon));
  std::vector<Row> rows;
  for (const bool structured : {true, false})
    for (int n = 8; n <= options.cells; n *= 2) {
      report.stage(fmt::format("{} mesh, 1/h = {}: P1 and CR", structured ? "structured" : "unstructured", n));
      for (const Row& row : solve_all(structured, n, truth, table)) rows.push_back(row);
    }
  report.finish();
  print_and_write(options.out / "results.csv", rows);
  verdicts(rows, report);
}

// Three things to try:
// - draw `error_bound` and `energy_error` of results.csv against h: the bound and what it bounds.
// - replace p1() by p2(): K_h is no longer part of K (the parabola between two unknowns may dip below 0), and J(u_h) is
// an upper bound no more.
// - a load with a jump across triangles, x < 0.4 ? 10 : 0: the oscillation term wakes up.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.least_cells = 16;
  options.most_cells = 256;  // an order needs two meshes from 1/8 on
  options.cells = 64;
  return tutorial::run(argc, argv, "16_energy_bracket",
                       "two-sided bounds of the energy: P1 from above, Crouzeix-Raviart from below", options, study);
}
