// Definition 1 in practice: how K_h approaches K, and K_0h approaches K_0.
//
// Run: 17_contact_sets                     epsilon = 1e-6, h from 1/8 to 1/64; a few seconds
// Run: 17_contact_sets --epsilon 1
//
// Theorem 4 asks two things of a method, that K_h approach K and K_0h approach K_0, and each is two conditions:
//
//   (8)  every v of K is the limit of some v_h in K_h:  inf |v - v_h|_h -> 0
//   (9)  weak limits of v_h in K_h lie in K.
//
// (8) is a number: the distance of the exact solution to the set, a contact problem for the solver, with the form of
// the norm. To K_0h, ask for d/dy v_h = 0 as well: the same problem at epsilon = 0. Here stands the whole of the paper:
// every method comes near K at the order h, and only P1 on an unstructured mesh, with K_0h = {0} in the layer, stays
// away from K_0. That is the hypothesis of Theorem 4 that it breaks.
//
// (9) is about what v_h in K_h may do between the points where v_h >= 0 is asked:
//   P1  at the vertices: affine in between, never below 0. K_h is a part of K.
//   CR  at the midpoints: v_h >= 0 on the mean of each edge, below 0 on half of it where it slopes.
//   P2  at vertices and midpoints: a parabola may dip below 0 between two of them.
// The part below 0 is no larger than what separates v_h from the piecewise constant (CR) or affine (P2) function
// through those points. In L2(Gamma_C) that is at most c_h |v_h|_h with c_h ~ h^(1/2): bounded sequences lose their
// negative part in the limit, so (9) holds. c_h is an eigenvalue. The solutions themselves do far better, since they
// are smooth.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "antilock/analysis/negative_part.hpp"
#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/truth_table.hpp"
#include "antilock/form/h1_norm.hpp"
#include "antilock/measure/contact_trace.hpp"
#include "antilock/measure/residual.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

struct Method {
  const char* element;
  bool structured;
  std::string mesh() const { return structured ? "structured" : "unstructured"; }
};
constexpr std::array<Method, 5> methods{{{"P1", true}, {"P1", false}, {"CR", true}, {"CR", false}, {"P2", true}}};

struct Row {
  Method method;
  int cells;
  double to_k, to_k0;      // distances of u to K_h and of u^0 to K_0h
  double below;            // c_h of (9)
  double dip, dip_l2;      // the part of u_h below 0 on Gamma_C: largest, and in L2
  double h1;               // |u_h|_h
  Eigen::MatrixX3d trace;  // u_h on Gamma_C
};

// 1. (8): the distance from u to K_h, or with B v = 0 to K_0h, in the broken H1 norm.
double distance(const Space& space, VariationalInequality problem, const SparseMatrix& norm, const Reference& u,
                bool kernel) {
  problem.a1 = norm;
  problem.load = h1_products(space, u);  // |u - v|^2 / 2 but for a constant
  problem.compliance = 0;
  if (!kernel) {
    problem.b.resize(0, problem.size());
    problem.m.resize(0);
  }
  return measure_errors(space, active_set(problem), 1, u).h1;
}

Row measure(const Method& method, int cells, double epsilon, const Reference& u, const Reference& u0) {
  const TriangleMesh mesh = method.structured ? structured_mesh(cells) : unstructured_mesh(cells);
  const Space space(mesh, element(method.element));
  const VariationalInequality problem =
      assemble(Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}), space);
  const SparseMatrix norm = h1_norm(space);
  Row row{method,
          cells,
          distance(space, problem, norm, u, false),
          distance(space, problem, norm, u0, true),
          negative_part_constant(space, problem, norm),
          0,
          0,
          0,
          {}};
  // 3. What the solution itself does below 0 between its unknowns.
  const Solution solution = active_set(problem);
  row.h1 = std::sqrt(solution.u.dot(norm * solution.u));
  row.trace = contact_trace(space, solution.u);
  const Eigen::ArrayXd below = (-row.trace.col(1)).cwiseMax(0);
  row.dip = below.maxCoeff();
  row.dip_l2 = std::sqrt((below.square() * row.trace.col(2).array()).sum());
  return row;
}

void print_and_write(const std::filesystem::path& out, const std::vector<Row>& rows, const TruthTable& u) {
  fmt::print("\n  {:>7} {:>12} {:>4} {:>15} {:>17} {:>10} {:>12} {:>10}\n", "element", "mesh", "1/h", "dist(u, K_h)",
             "dist(u^0, K_0h)", "c_h", "largest dip", "dip in L2");
  for (const Row& r : rows)
    fmt::print("  {:>7} {:>12} {:>4} {:15.3e} {:17.3e} {:10.2e} {:12.1e} {:10.1e}\n", r.method.element, r.method.mesh(),
               r.cells, r.to_k, r.to_k0, r.below, r.dip, r.dip_l2);
  fmt::print("\n");
  write_file(out / "results.csv", [&](std::ostream& file) {
    file << "quantity,element,mesh,cells,h,value\n";
    for (const Row& r : rows)
      for (const auto& [quantity, value] : {std::pair{"distance from $u$ to $K_h$", r.to_k},
                                            {"distance from $u^0$ to $K_{0h}$", r.to_k0},
                                            {"$c_h$: part below 0", r.below}})
        if (value > 0)  // P1 has nothing below 0
          file << fmt::format("{},{},{},{},{:.17g},{:.17g}\n", quantity, r.method.element, r.method.mesh(), r.cells,
                              1.0 / r.cells, value);
  });
  // the traces at 1/h = 16 around the end of contact: P1, CR (unstructured: it slopes) and P2, on the same edges
  std::vector<const Row*> drawn;
  for (const Row& r : rows)
    if (const std::string name = r.method.element; r.cells == 16 && r.method.structured == (name != "CR"))
      drawn.push_back(&r);
  write_file(out / "trace.csv", [&](std::ostream& file) {
    file << "x,truth,p1,cr,p2\n";
    for (Eigen::Index k = 0; k < drawn.at(0)->trace.rows(); ++k)
      if (const double x = drawn[0]->trace(k, 0); x > 0.55 && x < 0.85)
        file << fmt::format("{:.10g},{:.10g},{:.10g},{:.10g},{:.10g}\n", x, u.value(x, -1), drawn[0]->trace(k, 1),
                            drawn.at(1)->trace(k, 1), drawn.at(2)->trace(k, 1));
  });
}

void verdicts(const std::vector<Row>& rows, tutorial::Report& report) {
  for (const Method& method : methods) {
    std::vector<double> h, to_k, to_k0, below;
    bool dips = false, small = true;
    double dip = 0;
    for (const Row& r : rows)
      if (r.method.element == method.element && r.method.structured == method.structured) {
        h.push_back(1.0 / r.cells);
        to_k.push_back(r.to_k);
        to_k0.push_back(r.to_k0);
        below.push_back(r.below);
        dips = dips || r.dip_l2 > 1e-9 * r.h1;  // the digits of the solver
        small = small && r.dip_l2 <= r.below * r.h1;
        dip = r.dip_l2;
      }
    const std::string name = fmt::format("{} {}", method.element, method.mesh());
    const bool p1 = below.back() == 0, locks = p1 && !method.structured;
    const double order = slope(h, to_k), order0 = rates(h, to_k0).back();
    report.claim(order > 0.9, fmt::format("{}, (8) for K: dist(u, K_h) falls like h^{:.2f}", name, order));
    // 0.5: what is left of u^0 in the body still falls on coarse meshes
    report.claim(locks ? order0 < 0.5 : order0 > 0.9,
                 fmt::format("{}, (8) for K_0: dist(u^0, K_0h) = {:.1e} at 1/h = {:g}, order {:.2f}{}", name,
                             to_k0.back(), 1 / h.back(), order0, locks ? ": K_0h does not approach K_0" : ""));
    if (p1)
      report.claim(!dips, name + ", (9): nothing lies below 0, K_h is a part of K");
    else
      report.claim(
          std::abs(slope(h, below) - 0.5) < 0.05 && small,
          fmt::format("{}, (9): what lies below 0 is at most c_h |v_h|_h with c_h ~ h^{:.2f}; u_h itself: {:.0e} at "
                      "1/h = {:g}",
                      name, slope(h, below), dip, 1 / h.back()));
  }
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("truth");
  const TruthTable u(Truth(paper_sine_load(), options.epsilon)), u0(Truth(paper_sine_load(), 0));
  std::vector<Row> rows;
  for (const Method& method : methods)
    for (int n = 8; n <= options.cells; n *= 2) {
      report.stage(fmt::format("{} {}, 1/h = {}", method.element, method.mesh(), n));
      rows.push_back(measure(method, n, options.epsilon, reference(u), reference(u0)));
    }
  report.finish();
  print_and_write(options.out, rows, u);
  verdicts(rows, report);
}

// Three things to try:
// - replace u in `distance` by a function of K with a kink, min(x, 1 - x) at y = -1 say: order 1/2, and still (8).
// - {"P3", true}, {"P4", true} in `methods` (the chords of P2 are then too few: derive c_h anew).
// - epsilon = 1: the dips of Crouzeix-Raviart are there on both meshes, smaller, and fall like h^(5/3) or so.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.least_cells = 32;
  options.most_cells = 64;  // distances settle from 1/32 on
  return tutorial::run(argc, argv, "17_contact_sets", "Definition 1: how K_h approaches K, and K_0h approaches K_0",
                       options, study);
}
