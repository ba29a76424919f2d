// What else cures locking: the degree. P1, P2, P3, P4 at a small epsilon, on a mesh made for the
// layer and on one that is not.
//
// Run: 14_degree               epsilon = 1e-4, h from 1/4 to 1/32; a few seconds
// Run: 14_degree --epsilon 1e-2
// Run: 14_degree --epsilon 1   nothing is stiff: neither mesh is better than the other
//
// The introduction names "p and hp methods [2]" among the cures (Babuska and Suri). Two numbers say
// what a degree does.
//
// How many functions cost nothing: dim G_h on the layer. Those with d/dy v = 0 in the layer are
// functions of x, and polynomials of degree p on a triangle. On an unstructured mesh neighbours
// share values of x, so all triangles carry the same polynomial, x (1 - x) times one of degree p -
// 2: **p - 1 functions**, however fine the mesh (P1: none, P2: one). A number that does not grow
// under refinement does not approach K_0: every degree locks in the limit epsilon =
// 0. On the structured mesh of n columns there are n p - 1.
//
// What the others cost. A smooth ridge w(x), interpolated on an unstructured mesh, gets a slope
// d/dy of size h^p at most. In (26) it is charged epsilon^-2 times its square, which is small once
// **h^p << epsilon**. On the meshes of gmsh, nearly all triangles nearly equilateral, leading
// errors cancel and about h^(p + 1/2) is measured. So at epsilon = 1e-4 P1 keeps half of the ridge
// near h = epsilon^(2/3) = 1/460, P2 near h = epsilon^(2/5) = 1/40. Less locking with every degree,
// and none where the mesh holds w in its kernel.
//
// Contact. K_h = { v in V_h : v >= 0 at the unknowns on Gamma_C }: vertices and the p - 1 points
// between two of them. For p = 1 it is a part of K. For p >= 2 a polynomial that is nonnegative at
// p + 1 points may dip below 0 in between: V_h is part of V but K_h is not part of K, and
// Definition 1 is needed in full, as for Crouzeix-Raviart. Where contact ends u has a jump in its
// second derivative as epsilon -> 0 (worse before): in the H1 norm no degree beats h^(3/2) for
// good.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none. The elements: space/p1.cpp, p2.cpp,
// lagrange.cpp.

#include <cmath>
#include <numbers>

#include "antilock/analysis/kernel.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

using namespace antilock;
using tutorial::Exact;

// cost: |d/dy I_h w| in L2 of the layer, w = sin(2 pi x); ridge: largest u_h on Gamma_C, at the
// unknowns; kernel: dim G_h on the layer, without a word where it is not counted.
const std::vector<std::string> columns{"element", "mesh", "cells",  "h",     "unknowns", "cost",
                                       "max",     "h1",   "energy", "ridge", "degree",   "kernel"};

// 1. What the stiff form charges for a ridge that is constant across the layer: a0(I_h w, I_h
// w)^(1/2).
double ridge_cost(const Space& space, const VariationalInequality& problem) {
  const Eigen::VectorXd w = (2 * std::numbers::pi * space.points().col(0).array()).sin();
  const Eigen::VectorXd slope = problem.b * w;
  return std::sqrt(slope.dot(problem.m.cwiseProduct(slope)));
}

// 2. One element on one mesh: the same lines for every degree.
Table solve(const Method& method, const TriangleMesh& mesh, int cells, const Exact& exact) {
  const Space space = method.space(mesh);
  const VariationalInequality problem = assemble(tutorial::paper_scene(exact.epsilon), space);
  // Factor at the true epsilon: of the functions that B nearly misses (a0 falls like h^(2p)) a
  // larger delta would need hundreds of corrections. Below epsilon = 1e-4 that costs too many
  // digits; the solver says so, and refuses.
  PenaltyFactor factor(problem, problem.compliance);
  const Solution solution = active_set(problem, factor);
  const Errors errors = exact.errors(space, solution);
  // on fine meshes B nearly misses so many functions that a rank has no meaning in double precision
  const Entry kernel = cells <= 4 ? Entry(layer_kernel_dimension(problem)) : Entry("");
  Table row(columns);
  row.add({method.element->name(), method.family.name, cells, 1.0 / cells, solution.counters.unknowns,
           ridge_cost(space, problem), errors.max, errors.h1, errors.energy, solution.u(space.contact()).maxCoeff(),
           method.element->degree(), kernel});
  return row;
}

void verdicts(const Table& results, const Exact& exact, tutorial::Report& report);

void study(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("truth");
  const Exact exact(options.epsilon);
  Table results(columns);
  for (const MeshFamily& family : {structured(), unstructured()})
    for (int n = 4; n <= options.cells; n *= 2) {
      report.stage(fmt::format("{} mesh, 1/h = {}: P1 to P4", family.name, n));
      const TriangleMesh mesh = family.mesh(n);
      for (const Element* element : {&p1(), &p2(), &p3(), &p4()}) results.add(solve({element, family}, mesh, n, exact));
    }
  report.finish();
  results.select({"mesh", "element", "cells", "unknowns", "kernel", "cost", "max", "h1", "energy", "ridge"})
      .print("degrees 1 to 4; cost: d/dy I_h w", 3);
  results.select({"element", "mesh", "cells", "h", "unknowns", "cost", "max", "h1", "energy", "ridge"})
      .write(options.out / "results.csv");
  verdicts(results, exact, report);
}

void verdicts(const Table& results, const Exact& exact, tutorial::Report& report) {
  bool counted = true;
  for (const Table& row : results.where("cells", 4).rows()) {
    const double degree = row.number("degree");
    counted = counted && row.number("kernel") == (row.entry("mesh") == "structured" ? 4 * degree - 1 : degree - 1);
  }
  report.claim(counted,
               "1/h = 4: dim G_h is n p - 1 on the structured mesh and p - 1 on the unstructured one, p = 1 to 4");
  report.claim(results.where("mesh", "structured").most("cost") < 1e-9,  // round-off
               "structured: d/dy I_h w = 0 for every degree, any ridge is free of charge");
  const double finest = results.most("cells");
  for (const Entry& element : results.different("element")) {
    const Table own = results.where("element", element), any = own.where("mesh", "unstructured");
    const double degree = own.first("degree"), order = any.order("cost", "h");
    report.claim(order > degree - 0.1 && order < degree + 0.8,
                 "{} unstructured: d/dy I_h w falls like h^{:.2f} (at least h^{})", element.text(), order, degree);
    if (finest < 32) {
      report.not_judged("how much of the ridge is kept: the thresholds are for 1/h = 32 and finer");
      continue;
    }
    // how much of the ridge is left; h^p / epsilon decides: 312, 9.8, 0.31, 0.0095 at 1/h = 32,
    // epsilon = 1e-4
    const Table last = any.where("cells", finest), aligned = own.where("mesh", "structured").where("cells", finest);
    const double ratio = std::pow(1 / finest, degree) / exact.epsilon;
    const double left = last.number("ridge") / exact.truth.max_on_contact();
    const bool locks = ratio > 30, fine = ratio < 0.5;
    report.claim(
        locks  ? left < 0.1
        : fine ? left > 0.99
               : left > 0.1 && left < 0.99,
        "{} unstructured, h^p / epsilon = {:.2g}: {:.1f} % of the ridge is kept; H1 error {:.1f} times that of "
        "the structured mesh",
        element.text(), ratio, 100 * left, last.number("h1") / aligned.number("h1"));
  }
}

// Three things to try:
// - P2 at epsilon = 1e-4, 1e-3, 1e-2: the knee of its line moves to the h where h^2 = epsilon, or
//   so.
// - draw `cost` against h: straight lines of slope p + 1/2 or so.
// - add 5 sin(pi x) to the load: x (1 - x), the one kernel function of P2, gets its share. Under
//   sin(2 pi x), odd about the middle, it gets nothing, and P2 locks as P1 does once h^2 >>
//   epsilon.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.least_epsilon = 1e-4;  // below, P3 and P4 leave functions that B nearly misses: the solver has no digits
  options.least_cells = 8;
  options.most_cells = 64;  // an order needs two meshes from 1/4 on
  options.epsilon = 1e-4;
  return tutorial::run(argc, argv, "14_degree", "degrees 1 to 4 on both meshes: less locking, not none", options,
                       study);
}
