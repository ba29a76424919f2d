// Definition 1 in practice: how K_h approaches K, and K_0h approaches K_0.
//
// Run: 11_contact_sets   epsilon = 1e-6, h from 1/8 to 1/32; a few seconds
// Run: 11_contact_sets --epsilon 1
//
// Theorem 4 asks two things of a method, that K_h approach K and K_0h approach K_0, and each is two
// conditions:
//
//   (8)  every v of K is the limit of some v_h in K_h:  inf |v - v_h|_h -> 0
//   (9)  weak limits of v_h in K_h lie in K.
//
// (8) is a number: the distance of the exact solution to the set, a contact problem for the solver,
// with the form of the norm. For the distance to K_0h, ask for d/dy v_h = 0 as well: the same
// problem at epsilon = 0. Here stands the whole of the paper. Every method comes near K at the
// order h, and only P1 on an unstructured mesh, where every function of K_0h vanishes on the layer,
// stays away from K_0. That is the hypothesis of Theorem 4 that it breaks.
//
// (9) is about what v_h in K_h may do between the points where v_h >= 0 is asked:
//   P1  at the vertices: affine in between, never below 0. K_h is a part of K.
//   CR  at the midpoints: v_h >= 0 on the mean of each edge, below 0 on half of it where it slopes.
//   P2  at vertices and midpoints: a parabola may dip below 0 between two of them.
// The part below 0 is no larger than the difference of v_h and the piecewise constant (CR) or
// affine (P2) function through those points. In L2(Gamma_C) that is at most c_h |v_h|_h with c_h ~
// h^(1/2): bounded sequences lose their negative part in the limit, so (9) holds. c_h is an
// eigenvalue. The solutions themselves do far better, since they are smooth.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <algorithm>
#include <cmath>

#include "antilock/analysis/negative_part.hpp"
#include "antilock/form/h1_norm.hpp"
#include "antilock/measure/contact_trace.hpp"
#include "antilock/measure/residual.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

using namespace antilock;
using tutorial::Exact;

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

// 2. One row per mesh: to_k and to_k0, the distances of u to K_h and of u^0 to K_0h; c_h of (9);
// dip and dip_l2, the part of u_h below 0 on Gamma_C between its unknowns, the largest value and in
// L2; h1, |u_h|_h.
const std::vector<std::string> columns{"element", "mesh", "cells", "h", "to_k", "to_k0", "c_h", "dip", "dip_l2", "h1"};

Table measure(const Method& method, int cells, const Exact& u, const Exact& u0) {
  const Discretisation on = method.on(cells);
  const VariationalInequality problem = assemble(tutorial::paper_scene(u.epsilon), on.space());
  const SparseMatrix norm = h1_norm(on.space());
  const Solution solution = active_set(problem);
  const Eigen::MatrixX3d trace = contact_trace(on.space(), solution.u);
  const Eigen::ArrayXd below = (-trace.col(1)).cwiseMax(0);
  Table row(columns);
  row.add({method.element->name(), method.family.name, cells, 1.0 / cells,
           distance(on.space(), problem, norm, u.reference(), false),
           distance(on.space(), problem, norm, u0.reference(), true), negative_part_constant(on.space(), problem, norm),
           below.maxCoeff(), std::sqrt((below.square() * trace.col(2).array()).sum()),
           std::sqrt(solution.u.dot(norm * solution.u))});
  return row;
}

Table by_quantity(const Table& results);
Table traces(const Exact& u, int cells);
void verdict(const Method& method, const Table& own, tutorial::Report& report);

void study(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("truth");
  const Exact u(options.epsilon), u0(0);
  std::vector<Method> all = methods();
  all.push_back({&p2(), structured()});
  Table results(columns);
  for (const Method& method : all) {
    report.stage(method.name());
    for (int n = 8; n <= options.cells; n *= 2) results.add(measure(method, n, u, u0));
  }
  report.finish();
  results.print("dist(u, K_h), dist(u^0, K_0h), c_h, and the part of u_h below 0");
  by_quantity(results).write(options.out / "results.csv");
  traces(u, 16).write(options.out / "trace.csv");
  for (const Method& method : all)
    verdict(method, results.where("element", method.element->name()).where("mesh", method.family.name), report);
}

void verdict(const Method& method, const Table& own, tutorial::Report& report) {
  const bool p1_used = method.element->degree() == 1 && method.element->conforming();
  const bool locks = method.name() == "P1 unstructured";
  // order 1 of P1 and CR in the norm of H1; of P2 at least 3/2, where contact ends and u is like
  // r^(3/2), at most 2
  const double low = method.element->degree() == 1 ? 0.9 : 1.4, high = method.element->degree() + 0.1;
  const double finest = own.most("cells"), order = own.order("to_k", "h");
  const double order0 = own.where_number("cells", [=](double n) { return n >= finest / 2; }).order("to_k0", "h");
  report.claim(order > low && order < high, "{}, (8) for K: dist(u, K_h) falls like h^{:.2f}", method.name(), order);
  // 0.5: the part of u^0 in the body is still approached on coarse meshes
  report.claim(locks ? order0 < 0.5 : order0 > low && order0 < high,
               "{}, (8) for K_0: dist(u^0, K_0h) = {:.1e} at 1/h = {}, order {:.2f}{}", method.name(),
               own.last("to_k0"), finest, order0, locks ? ": K_0h does not approach K_0" : "");
  if (p1_used)
    return report.claim(own.most("dip_l2") <= 1e-9 * own.least("h1"),  // the digits of the solver
                        "{}, (9): nothing lies below 0, K_h is a part of K", method.name());
  const double c_h = own.order("c_h", "h");
  double share = 0;  // u_h is smooth: it does better than the bound by a factor h
  for (const Table& row : own.rows())
    share = std::max(share, row.number("dip_l2") / (row.number("h") * row.number("c_h") * row.number("h1")));
  report.claim(
      std::abs(c_h - 0.5) < 0.05 && share < 1,
      "{}, (9): what lies below 0 is at most c_h |v_h|_h with c_h ~ h^{:.2f}; of u_h itself {:.0e} at 1/h = {}, "
      "{:.2g} h c_h |u_h|_h at most",
      method.name(), c_h, own.last("dip_l2"), finest, share);
}

// Three things to try:
// - replace u in `distance` by a function of K with a kink, min(x, 1 - x) at y = -1 say: order 1/2,
//   and still (8).
// - {&p3(), structured()}, {&p4(), structured()} in `study` (the chords of P2 are then too few:
//   derive c_h anew).
// - epsilon = 1: the dips of Crouzeix-Raviart are there on both meshes, smaller, and fall like
//   h^(5/3) or so.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.least_cells = 32;
  options.most_cells = 64;  // distances settle from 1/32 on
  return tutorial::run(argc, argv, "11_contact_sets", "Definition 1: how K_h approaches K, and K_0h approaches K_0",
                       options, study);
}

// For the picture: one row per quantity, without the zeros of P1, which has nothing below 0.
Table by_quantity(const Table& results) {
  Table table({"quantity", "element", "mesh", "cells", "h", "value"});
  for (const Table& row : results.rows())
    for (const auto& [quantity, column] : {std::pair{"distance from $u$ to $K_h$", "to_k"},
                                           {"distance from $u^0$ to $K_{0h}$", "to_k0"},
                                           {"$c_h$: part below 0", "c_h"}})
      if (row.number(column) > 0)
        table.add({quantity, row.entry("element"), row.entry("mesh"), row.number("cells"), row.number("h"),
                   row.number(column)});
  return table;
}

// For the picture: u_h on Gamma_C around the end of contact: P1, CR (unstructured: it slopes) and
// P2, on the same edges.
Table traces(const Exact& u, int cells) {
  std::vector<Eigen::MatrixX3d> trace;
  for (const Method& method :
       {Method{&p1(), structured()}, {&crouzeix_raviart(), unstructured()}, {&p2(), structured()}}) {
    const Discretisation on = method.on(cells);
    trace.push_back(contact_trace(on.space(), active_set(assemble(tutorial::paper_scene(u.epsilon), on.space())).u));
  }
  Table table({"x", "truth", "p1", "cr", "p2"});
  for (Eigen::Index k = 0; k < trace.front().rows(); ++k)
    if (const double x = trace.front()(k, 0); x > 0.55 && x < 0.85)
      table.add({x, u.table.value(x, -1), trace[0](k, 1), trace[1](k, 1), trace[2](k, 1)});
  return table;
}
