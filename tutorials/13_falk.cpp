// Theorem 2, the estimate of Falk's type, with both of its sides evaluated: what it sees of locking, and what not.
//
// Run: 13_falk                       h from 1/8 to 1/32, five epsilons, P1 and Crouzeix-Raviart on both meshes
// Run: 13_falk --cells 64
//
// --epsilon is not asked for here: the study has five of its own. Load: f = 10 sin(2 pi x); the paper gives none.
//
//   |u - u_h|_h^2 <= C ( inf over v_h in K_h { |u - v_h|_h^2 + a(u, v_h - u) - f(v_h - u) }
//                        + inf over v in K { a(u, v - u_h) - f(v - u_h) } ),                (13)
//
// C depending "linearly on the constants M and 1/alpha_2". All of it is made of one functional of the exact u,
//
//   R(v) = a(u, v) - f(v),   R(u) = 0;   in V the work of the contact pressure: R(v) = int_Gamma_C lambda v.
//
// The first infimum is a contact problem over the same K_h, with the form 2 (., .)_h and the load 2 (u, .)_h - R: the
// solver finds it. The second is known: R >= 0 on K and R(u) = 0, so it is -R(u_h).
//
// P1: -R(u_h) <= 0, since K_h is a part of K; Falk's lemma has no second term. Crouzeix-Raviart: -R(u_h) is the
// consistency term, the fluxes of u through the jumps of u_h, and the larger half of the estimate. As a functional of
// w_h its norm is about O(h) at every epsilon: the flux through an edge of the layer is the layer stress p, bounded.
//
// And locking? Neither infimum divides by epsilon: for P1 on an unstructured mesh the right-hand side falls like h^2 at
// every epsilon, while the left one stands still. All of the locking is in C: M, the continuity of a in the norm |.|_h,
// is epsilon^-2, and (13) promises nothing uniform. Where nothing locks the C that is needed stays near 1. That is why
// uniformity takes Theorem 4, and K_0h.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/truth_table.hpp"
#include "antilock/form/h1_norm.hpp"
#include "antilock/measure/residual.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/study/sweep.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

constexpr std::array epsilons{1.0, 1e-1, 1e-2, 1e-4, 1e-6};

struct Exact {
  explicit Exact(double epsilon) : truth(paper_sine_load(), epsilon), table(truth) {
    for (const auto& [from, to] : truth.contact_zones()) ends.insert(ends.end(), {from, to});
  }
  Truth truth;
  TruthTable table;
  std::vector<double> ends;  // of contact
};

struct Row {
  std::string element;
  bool structured;
  int cells;
  double epsilon;
  double left;           // |u - u_h|_h^2
  double first, second;  // the two infima
  double jumps;          // the part of the second that comes from the jumps of u_h
  double consistency;    // the largest consistency term over |w_h|_h = 1
  std::string mesh() const { return structured ? "structured" : "unstructured"; }
  double constant() const { return left / (first + second); }  // what C must be at least
};

// 1. The smallest of |u - v|_h^2 + R(v) over K_h: the problem's own K_h, another form and load.
double first_infimum(const Space& space, VariationalInequality problem, const SparseMatrix& norm,
                     const Eigen::VectorXd& residual, const Reference& u) {
  problem.a1 = 2 * norm;
  problem.b.resize(0, problem.size());
  problem.m.resize(0);
  problem.load = 2 * h1_products(space, u) - residual;
  const Solution nearest = active_set(problem);
  const double distance = measure_errors(space, nearest, 1, u).h1;
  return distance * distance + residual.dot(nearest.u);
}

// 2. sup functional(w) / |w|_h over V_h: Riesz's representative is a linear problem.
double dual_norm(VariationalInequality problem, const SparseMatrix& norm, const Eigen::VectorXd& functional) {
  problem.a1 = norm;
  problem.b.resize(0, problem.size());
  problem.m.resize(0);
  problem.contact.clear();
  problem.lower.resize(0);
  problem.load = functional;
  return std::sqrt(functional.dot(active_set(problem).u));
}

// 3. Both sides of (13), one mesh, one element, five epsilons.
std::vector<Row> both_sides(const std::string& name, bool structured, int cells, const TriangleMesh& mesh,
                            const std::vector<Exact>& exact) {
  const Space space(mesh, element(name));
  Sweep sweep(Scene(Body{paper_load}, StiffLayer{1}, UnilateralContact{}), space);
  const SparseMatrix norm = h1_norm(space);
  const bool conforming = name == "P1";
  std::vector<Row> rows;
  for (std::size_t i = 0; i < epsilons.size(); ++i) {
    sweep.set_epsilon(epsilons[i]);
    const Solution solution = sweep.solve();
    const Reference u = reference(exact[i].table);
    const Eigen::VectorXd work = contact_work(space, [&](double x) { return exact[i].truth.pressure(x); });
    const Eigen::VectorXd residual = conforming ? work : exact_residual(space, sweep.problem().load, u, exact[i].ends);
    Row row{name, structured, cells, epsilons[i], 0, 0, 0, 0, 0};
    row.left = std::pow(measure_errors(space, solution, epsilons[i], u).h1, 2);
    row.first = first_infimum(space, sweep.problem(), norm, residual, u);
    row.second = -residual.dot(solution.u);
    row.jumps = -(residual - work).dot(solution.u);
    row.consistency = conforming ? 0 : dual_norm(sweep.problem(), norm, residual - work);
    rows.push_back(row);
  }
  return rows;
}

void print_and_write(const std::filesystem::path& path, const std::vector<Row>& rows) {
  fmt::print("\n  {:>7} {:>12} {:>4} {:>8} {:>10} {:>10} {:>10} {:>10} {:>7} {:>12}\n", "element", "mesh", "1/h",
             "epsilon", "left side", "first inf", "second inf", "of jumps", "C >=", "consistency");
  for (const Row& r : rows)
    fmt::print("  {:>7} {:>12} {:>4} {:>8g} {:10.2e} {:10.2e} {:10.1e} {:10.1e} {:7.2f} {:>12}\n", r.element, r.mesh(),
               r.cells, r.epsilon, r.left, r.first, r.second, r.jumps, r.constant(),
               r.element == "CR" ? fmt::format("{:.2e}", r.consistency) : "");
  write_file(path, [&](std::ostream& out) {
    out << "element,mesh,epsilon,cells,h,left,first,second,jumps,constant,consistency\n";
    for (const Row& r : rows)
      out << fmt::format("{},{},{:g},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", r.element, r.mesh(),
                         r.epsilon, r.cells, 1.0 / r.cells, r.left, r.first, r.second, r.jumps, r.constant(),
                         r.consistency);
  });
  fmt::print("\n");
}

void verdicts(const std::vector<Row>& rows, tutorial::Report& report) {
  double most = 0, p1_second = 0, share = 1;
  std::vector<const Row*> locked;  // P1 unstructured at the smallest epsilon, by h
  for (const Row& r : rows) {
    const bool p1_unstructured = r.element == "P1" && !r.structured;
    if (!p1_unstructured || r.epsilon >= 0.1) most = std::max(most, r.constant());
    if (p1_unstructured && r.epsilon == epsilons.back()) locked.push_back(&r);
    if (r.element == "P1") p1_second = std::max(p1_second, r.second / r.first);
    if (r.element == "CR") share = std::min(share, r.jumps / r.second);
  }
  const Row &last = *locked.back(), &before = *locked[locked.size() - 2];
  report.claim(most < 1.5, fmt::format("(13) holds with C = {:.2f} where nothing locks, at every h and epsilon", most));
  report.claim(
      last.first + last.second < 0.35 * (before.first + before.second) && last.constant() > 1.7 * before.constant(),
      fmt::format("P1 unstructured, epsilon = 1e-6: the right-hand side falls all the same, and C must be {:.1f} at "
                  "1/h = {}, {:.1f} at 1/h = {}: no constant will do",
                  before.constant(), before.cells, last.constant(), last.cells));
  // 1e-9: the digits of the solver
  report.claim(p1_second < 1e-9, "P1: the second infimum is never positive (K_h is a part of K, Falk's lemma)");
  report.claim(share > 0.9, fmt::format("CR: at least {:.0f} % of the second infimum is consistency, the rest contact",
                                        100 * share));
  for (const bool structured : {true, false}) {
    double order = 9, low = 9, high = 0;
    for (const double epsilon : epsilons) {
      std::vector<double> h, norms;
      for (const Row& r : rows)
        if (r.element == "CR" && r.structured == structured && r.epsilon == epsilon) {
          h.push_back(1.0 / r.cells);
          norms.push_back(r.consistency);
        }
      order = std::min(order, slope(h, norms));
      low = std::min(low, norms.back());
      high = std::max(high, norms.back());
    }
    // 0.7: the jump of p at the end of contact enters like h^(1/2), with a small factor
    report.claim(
        order > 0.7 && high < 2 * low,
        fmt::format("CR {}: the consistency term falls like h^{:.2f} at its slowest, and varies by {:.2f} over epsilon",
                    structured ? "structured" : "unstructured", order, high / low));
  }
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("truth for five epsilons");
  std::vector<Exact> exact;
  for (const double epsilon : epsilons) exact.emplace_back(epsilon);
  std::vector<Row> rows;
  for (const bool structured : {true, false})
    for (int n = 8; n <= options.cells; n *= 2) {
      report.stage(fmt::format("{} mesh, 1/h = {}: both sides", structured ? "structured" : "unstructured", n));
      const TriangleMesh mesh = structured ? structured_mesh(n) : unstructured_mesh(n);
      for (const char* name : {"P1", "CR"})
        for (const Row& row : both_sides(name, structured, n, mesh, exact)) rows.push_back(row);
    }
  report.finish();
  print_and_write(options.out / "results.csv", rows);
  verdicts(rows, report);
}

// Three things to try:
// - replace the first infimum by its value at the paper's interpolant, interpolant(space, u.value): a few percent for
// P1, half again as much for CR.
// - measure both sides in the energy norm (Remark 4): M and alpha_2 become 1, and the locking moves into the infimum.
// - draw left and first + second against h, one epsilon a panel.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.least_cells = 16;
  options.most_cells = 128;  // an order needs two meshes from 1/8 on
  return tutorial::run(argc, argv, "13_falk", "Theorem 2, both sides of (13): where the locking hides", options, study);
}
