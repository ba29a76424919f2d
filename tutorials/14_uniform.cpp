// Theorems 4, 5 and 7 and Remark 4: uniform convergence, as a program sees it, and the locking map.
//
// Run: 14_uniform                     h from 1/8 to 1/32, 22 epsilons; some six seconds
// Run: 14_uniform --cells 64          to h = 1/64
//
// --epsilon is not asked for here: the supremum over it is the point.
//
// The theorem. If K_h approaches K and K_0h approaches K_0 (Definition 1), then (Theorem 4)
//
//     lim_{h->0} sup_{0 < epsilon <= 1} || u_h^epsilon - u^epsilon ||_h = 0 ,
//
// which Theorem 5 says of P1 on structured meshes and Theorem 7 of Crouzeix-Raviart on any, and Remark 4 of the energy
// seminorm |.|_{a^epsilon} too. Mind the order: for every *fixed* epsilon > 0, P1 on an unstructured mesh converges as
// well (Proposition 2). Its map shows how: the error is large below a line, epsilon about h^(3/2) on these meshes,
// and refining moves along it. A supremum over epsilon does not get off it.
//
// The supremum is taken over half decades from 1 to 1e-10, and 0: by Theorem 1 nothing happens below.
//
// How much is lost is a number, too. Babuska and Suri (1992) compare, at equal unknowns N, the worst error over epsilon
// with the error where nothing is stiff, here epsilon = 1:
//
//     locking ratio  L(N) = sup_epsilon E(epsilon, N) / E(1, N).
//
// L bounded: free of locking. L growing like N^k: locking of order N^k; in the plane k = 1/2 is all that P1 can lose in
// H1. And sup_epsilon E falling like N^-r: robust of order N^-r; r = 1/2 is the best, r = 0 is none.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <fmt/format.h>

#include <array>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/truth_table.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/study/sweep.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

struct Method {
  std::string element, mesh;
  std::string name() const { return element + " " + mesh; }
};
const std::array<Method, 4> methods{
    {{"P1", "structured"}, {"P1", "unstructured"}, {"CR", "structured"}, {"CR", "unstructured"}}};

// 1, 10^-1/2, ..., 1e-10, 0, each with its truth. 2^14 points of the series: gradients to 1e-6, errors are 1e-2.
struct Case {
  double epsilon;
  TruthTable truth;
};
std::vector<Case> make_cases() {
  std::vector<Case> cases;
  for (int k = 0; k <= 21; ++k) {
    const double epsilon = k <= 20 ? std::pow(10.0, -0.5 * k) : 0;
    cases.push_back({epsilon, TruthTable(Truth(paper_sine_load(), epsilon, true, 14))});
  }
  return cases;
}

// One method on one mesh: the errors, a case of epsilon each, in the broken H1 norm and in the energy seminorm.
struct Line {
  Method method;
  int cells, unknowns;
  std::vector<double> h1, energy;

  double worst(const std::vector<double>& error) const { return *std::max_element(error.begin(), error.end()); }
  double ratio() const { return worst(h1) / h1.front(); }  // cases begin with epsilon = 1
};

Line solve_all(const Method& method, const TriangleMesh& mesh, int cells, const std::vector<Case>& cases) {
  const Space space(mesh, element(method.element));
  Sweep sweep(Scene(Body{paper_load}, StiffLayer{1}, UnilateralContact{}), space);
  Line line{method, cells, space.free_count(), {}, {}};
  for (const Case& one : cases) {
    sweep.set_epsilon(one.epsilon);
    const Errors errors = measure_errors(space, sweep.solve(), one.epsilon, reference(one.truth));
    line.h1.push_back(errors.h1);
    line.energy.push_back(errors.energy);
  }
  return line;
}

std::vector<Line> lines_of(const std::vector<Line>& lines, const Method& method) {
  std::vector<Line> own;
  for (const Line& line : lines)
    if (line.method.name() == method.name()) own.push_back(line);
  return own;
}

// Least-squares slope of a quantity of the lines against another, both logarithmic.
template <class X, class Y>
double slope_of(const std::vector<Line>& lines, X&& x, Y&& y) {
  std::vector<double> xs, ys;
  for (const Line& line : lines) xs.push_back(x(line)), ys.push_back(y(line));
  return slope(xs, ys);
}
double spacing(const Line& line) { return 1.0 / line.cells; }
double unknowns(const Line& line) { return line.unknowns; }
double worst_h1(const Line& line) { return line.worst(line.h1); }
// Where worst^2 = limit^2 + (c h)^2 tends, by the first and the last mesh.
double limit_of_worst(const std::vector<Line>& lines) {
  const double a = spacing(lines.front()), b = spacing(lines.back());
  const double high = std::pow(worst_h1(lines.front()), 2), low = std::pow(worst_h1(lines.back()), 2);
  return std::sqrt(std::max(0.0, (a * a * low - b * b * high) / (a * a - b * b)));
}
double worst_energy(const Line& line) { return line.worst(line.energy); }

void print_table(const std::vector<Line>& lines, const std::vector<Case>& cases) {
  fmt::print("\n  {:<16} {:>5} {:>7} {:>11} {:>11} {:>11} {:>11} {:>9}\n", "", "1/h", "N", "sup H1", "at epsilon",
             "sup energy", "H1, eps=1", "L(N)");
  for (const Line& line : lines) {
    const auto at = std::max_element(line.h1.begin(), line.h1.end()) - line.h1.begin();
    fmt::print("  {:<16} {:5} {:7} {:11.3e} {:11.1e} {:11.3e} {:11.3e} {:9.3f}\n", line.method.name(), line.cells,
               line.unknowns, worst_h1(line), cases[at].epsilon, worst_energy(line), line.h1.front(), line.ratio());
  }
}

void write_tables(const std::filesystem::path& out, const std::vector<Line>& lines, const std::vector<Case>& cases) {
  write_file(out / "map.csv", [&](std::ostream& file) {
    file << "element,mesh,epsilon,cells,h,unknowns,h1,energy\n";
    for (const Line& line : lines)
      for (std::size_t i = 0; i < cases.size(); ++i)
        file << fmt::format("{},{},{:.6g},{},{:.17g},{},{:.17g},{:.17g}\n", line.method.element, line.method.mesh,
                            cases[i].epsilon, line.cells, spacing(line), line.unknowns, line.h1[i], line.energy[i]);
  });
  write_file(out / "uniform.csv", [&](std::ostream& file) {
    file << "norm,element,mesh,h,unknowns,worst\n";
    for (const Line& line : lines)
      file << fmt::format(
          "broken $H^1$ norm,{0},{1},{2:.17g},{3},{4:.17g}\nenergy seminorm,{0},{1},{2:.17g},{3},"
          "{5:.17g}\n",
          line.method.element, line.method.mesh, spacing(line), line.unknowns, worst_h1(line), worst_energy(line));
  });
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("truth for 22 epsilons");
  const std::vector<Case> cases = make_cases();
  std::vector<Line> lines;
  for (int n = 8; n <= options.cells; n += n % 3 == 0 ? n / 3 : n / 2) {  // 8, 12, 16, 24, 32, ...
    report.stage(fmt::format("1/h = {}: four methods, 22 epsilons", n));
    const TriangleMesh structured = structured_mesh(n), unstructured = unstructured_mesh(n);
    for (const Method& method : methods)
      lines.push_back(solve_all(method, method.mesh == "structured" ? structured : unstructured, n, cases));
  }
  report.finish();
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Line& a, const Line& b) { return a.method.name() < b.method.name(); });
  print_table(lines, cases);
  write_tables(options.out, lines, cases);

  fmt::print("\n  {:<16} {:>22} {:>22}\n", "", "order of locking", "order of robustness");
  for (const Method& method : methods) {
    const std::vector<Line> own = lines_of(lines, method);
    fmt::print("  {:<16} {:>22} {:>22}\n", method.name(),
               fmt::format("N^{:.2f}", slope_of(own, unknowns, [](const Line& line) { return line.ratio(); })),
               fmt::format("N^{:.2f}", slope_of(own, unknowns, worst_h1)));
  }
  fmt::print("\n");

  // First order is the best of P1 and CR in these norms; 0.2: the meshes are coarse. A locked method has a limit: what
  // the layer's displacement is worth in H1.
  for (const Method& method : methods) {
    const std::vector<Line> own = lines_of(lines, method);
    const double h1 = slope_of(own, spacing, worst_h1), energy = slope_of(own, spacing, worst_energy);
    const bool locks = method.name() == "P1 unstructured";
    if (locks)
      report.claim(limit_of_worst(own) > 0.1, fmt::format("{}: Section 4.1, locks: sup over epsilon tends to {:.3f} in "
                                                          "H1, not to 0",
                                                          method.name(), limit_of_worst(own)));
    else
      report.claim(h1 > 0.8 && energy > 0.8,
                   fmt::format("{}: {} and Remark 4: sup over epsilon falls like h^{:.2f} in H1, h^{:.2f} in energy",
                               method.name(), method.element == "P1" ? "Theorem 5" : "Theorem 7", h1, energy));
    const double growth = own.back().ratio() / own.front().ratio();
    report.claim(
        locks ? growth > 1.3 : own.back().ratio() < 2 && growth < 1.2,
        fmt::format("{}: locking ratio {:.2f} at N = {}, {:.2f} at N = {}: {}", method.name(), own.front().ratio(),
                    own.front().unknowns, own.back().ratio(), own.back().unknowns, locks ? "it grows" : "bounded"));
  }
  // The line of the map: for a fixed epsilon the locked method converges at last (Proposition 2).
  const std::vector<Line> locked = lines_of(lines, methods[1]);
  const double at_tenth = slope_of(locked, spacing, [](const Line& line) { return line.h1[2]; });
  report.claim(at_tenth > 0.7, fmt::format("P1 unstructured at epsilon = 0.1, fixed: converges like h^{:.2f} "
                                           "(Proposition 2)",
                                           at_tenth));
}

// Three things to try:
// - --cells 64: the locking ratio of P1 unstructured goes on like N^1/2, the three others stay.
// - `energy` in place of `h1` in the locking ratio: epsilon = 1 is then the worst case of the good methods.
// - {"P2", "unstructured"} as a fifth method: less locking, not none.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.least_cells = 16;
  options.most_cells = 128;  // a slope needs meshes from 1/8 to 1/16, 22 epsilons each
  return tutorial::run(argc, argv, "14_uniform",
                       "Theorems 4, 5, 7: convergence uniform in epsilon, and the locking map", options, study);
}
