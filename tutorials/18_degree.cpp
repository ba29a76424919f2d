// What else cures locking: the degree. P1, P2, P3, P4 at a small epsilon, on a mesh made for the layer and on one that
// is not.
//
// Run: 18_degree                               epsilon = 1e-4, h from 1/4 to 1/32; a few seconds
// Run: 18_degree --epsilon 1e-2
// Run: 18_degree --epsilon 1                   nothing is stiff: no mesh is better than the other
//
// The introduction names "p and hp methods" among the cures (Babuska and Suri [2]). Two numbers say what a degree does.
//
// How many functions cost nothing: dim G_h. Those with d/dy v = 0 in the layer are functions of x, and polynomials of
// degree p on a triangle. On an unstructured mesh neighbours share values of x, so all triangles carry the same
// polynomial, x (1 - x) times one of degree p - 2: **p - 1 functions**, however fine the mesh (P1: none, P2: one). On
// the structured mesh of n columns they are n p - 1. So every degree locks in the limit epsilon = 0.
//
// What the others cost. A smooth ridge w(x), interpolated on an unstructured mesh, gets a slope d/dy of size h^p. In
// (26) it is charged epsilon^-2 times its square: nothing to speak of once **h^p << epsilon**. For p = 1 that is the "h
// << epsilon" read off (28); P2 needs h = 1/100 at epsilon = 1e-4 where P1 needs 1/10000. Less locking with every
// degree, and none where the mesh serves w at no charge.
//
// Contact. K_h = { v in V_h : v >= 0 at the unknowns on Gamma_C }: vertices and the p - 1 points between two of them.
// For p = 1 it is a part of K. For p >= 2 a polynomial that is nonnegative at p + 1 points may dip below 0 in between:
// V_h is part of V but K_h is not part of K, and Definition 1 is needed in full, as for Crouzeix-Raviart. Where contact
// ends u has a jump in its second derivative as epsilon -> 0 (worse before): in the H1 norm no degree beats h^(3/2) for
// good.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none. The elements: space/p1.cpp, p2.cpp, lagrange.cpp.

#include <fmt/format.h>

#include <array>
#include <numbers>

#include "antilock/analysis/kernel.hpp"
#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/truth_table.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

constexpr std::array degrees{1, 2, 3, 4};

struct Row {
  int degree;
  bool structured;
  int cells, unknowns;
  int kernel;   // dim G_h without the functions of the body alone; -1: not counted on this mesh
  double cost;  // |d/dy I_h w| in L2 of the layer, w = sin(2 pi x)
  Errors errors;
  double ridge;  // largest u_h on Gamma_C, at the unknowns

  std::string mesh() const { return structured ? "structured" : "unstructured"; }
};

// 1. What the stiff form charges for a ridge that is constant across the layer: a0(I_h w, I_h w)^(1/2).
double ridge_cost(const Space& space, const VariationalInequality& problem) {
  const Eigen::VectorXd w = (2 * std::numbers::pi * space.points().col(0).array()).sin();
  const Eigen::VectorXd slope = problem.b * w;
  return std::sqrt(slope.dot(problem.m.cwiseProduct(slope)));
}

// 2. One element on one mesh: the same lines for every degree.
Row solve(int degree, bool structured, int cells, const TriangleMesh& mesh, double epsilon, const TruthTable& truth) {
  const Space space(mesh, element(fmt::format("P{}", degree)));
  const Scene scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{});
  const VariationalInequality problem = assemble(scene, space);
  // Factor at the true epsilon: of the functions that B nearly misses (a0 falls like h^(2p)) a larger penalty would
  // need hundreds of corrections. Below epsilon = 1e-4 that costs too many digits; the solver says so, and refuses.
  ActiveSetOptions options;
  options.penalty = problem.compliance;
  const Solution solution = active_set(problem, options);
  // on fine meshes B nearly misses so many functions that a rank has no meaning in double precision
  const int kernel = cells <= 4 ? layer_kernel_dimension(problem) : -1;
  return {degree,
          structured,
          cells,
          solution.counters.unknowns,
          kernel,
          ridge_cost(space, problem),
          measure_errors(space, solution, epsilon, reference(truth)),
          solution.u(space.contact()).maxCoeff()};
}

void print_and_write(const std::filesystem::path& path, const std::vector<Row>& rows) {
  fmt::print("\n  {:>12} {:>7} {:>4} {:>9} {:>7} {:>11} {:>11} {:>11} {:>11} {:>9}\n", "mesh", "element", "1/h",
             "unknowns", "kernel", "d/dy I_h w", "L-infinity", "H1", "energy", "ridge");
  for (const Row& r : rows)
    fmt::print("  {:>12} {:>7} {:>4} {:>9} {:>7} {:11.1e} {:11.2e} {:11.2e} {:11.2e} {:9.5f}\n", r.mesh(),
               fmt::format("P{}", r.degree), r.cells, r.unknowns, r.kernel < 0 ? "" : fmt::format("{}", r.kernel),
               r.cost, r.errors.max, r.errors.h1, r.errors.energy, r.ridge);
  write_file(path, [&](std::ostream& out) {
    out << "element,mesh,cells,h,unknowns,cost,max,h1,energy,ridge\n";
    for (const Row& r : rows)
      out << fmt::format("P{},{},{},{:.17g},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", r.degree, r.mesh(), r.cells,
                         1.0 / r.cells, r.unknowns, r.cost, r.errors.max, r.errors.h1, r.errors.energy, r.ridge);
  });
  fmt::print("\n");
}

void verdicts(const std::vector<Row>& rows, double epsilon, double ridge, tutorial::Report& report) {
  const int finest = rows.back().cells;
  bool counted = true, free_of_charge = true;
  for (const Row& r : rows) {
    const int predicted = r.structured ? r.cells * r.degree - 1 : r.degree - 1;
    counted = counted && (r.kernel < 0 || r.kernel == predicted);
    free_of_charge = free_of_charge && (!r.structured || r.cost < 1e-9);  // round-off: gmsh is not asked
  }
  report.claim(counted,
               "1/h = 4: dim G_h is n p - 1 on the structured mesh and p - 1 on the unstructured one, p = 1 to 4");
  report.claim(free_of_charge, "structured: d/dy I_h w = 0 for every degree, any ridge is free of charge");
  for (const int degree : degrees) {
    std::vector<double> h, cost;
    const Row *aligned = nullptr, *last = nullptr;
    for (const Row& r : rows)
      if (r.degree == degree && r.structured && r.cells == finest)
        aligned = &r;
      else if (r.degree == degree && !r.structured) {
        h.push_back(1.0 / r.cells);
        cost.push_back(r.cost);
        last = &r;
      }
    const double order = slope(h, cost);
    // nearly all of gmsh's triangles are nearly equilateral, where leading errors cancel: about half an order is given
    report.claim(
        order > degree - 0.1 && order < degree + 0.8,
        fmt::format("P{} unstructured: d/dy I_h w falls like h^{:.2f} (at least h^{})", degree, order, degree));
    if (finest < 32) continue;  // the thresholds below are for 1/h = 32 at the least
    // how much of the ridge is left; h^p / epsilon decides: 312, 9.8, 0.31, 0.0095 at 1/h = 32, epsilon = 1e-4
    const double ratio = std::pow(1.0 / finest, degree) / epsilon, left = last->ridge / ridge;
    const bool locks = ratio > 30, fine = ratio < 0.5;
    report.claim(locks  ? left < 0.1
                 : fine ? left > 0.99
                        : left > 0.1 && left < 0.99,
                 fmt::format("P{} unstructured, h^p / epsilon = {:.2g}: {:.1f} % of the ridge is kept; H1 error {:.1f} "
                             "times that of the structured mesh",
                             degree, ratio, 100 * left, last->errors.h1 / aligned->errors.h1));
  }
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("truth");
  const Truth exact(paper_sine_load(), options.epsilon);
  const TruthTable truth(exact);
  std::vector<Row> rows;
  for (const bool structured : {true, false})
    for (int n = 4; n <= options.cells; n *= 2) {
      report.stage(fmt::format("{} mesh, 1/h = {}: P1 to P4", structured ? "structured" : "unstructured", n));
      const TriangleMesh mesh = structured ? structured_mesh(n) : unstructured_mesh(n);
      for (const int degree : degrees) rows.push_back(solve(degree, structured, n, mesh, options.epsilon, truth));
    }
  report.finish();
  print_and_write(options.out / "results.csv", rows);
  verdicts(rows, options.epsilon, exact.max_on_contact(), report);
}

// Three things to try:
// - P2 at epsilon = 1e-4, 1e-3, 1e-2: the knee of its line moves to the h where h^2 = epsilon, or so.
// - draw `cost` against h: straight lines of slope p.
// - add 5 sin(pi x) to the load: x (1 - x), the one kernel function of P2, gets its share. Under sin(2 pi x), odd about
// the middle, it gets nothing, and P2 locks as P1 does once h^2 >> epsilon.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.least_epsilon = 1e-4;  // below, P3 and P4 leave functions that B nearly misses: the solver has no digits
  options.least_cells = 8;
  options.most_cells = 64;  // an order needs two meshes from 1/4 on
  options.epsilon = 1e-4;
  return tutorial::run(argc, argv, "18_degree", "degrees 1 to 4 on both meshes: less locking, not none", options,
                       study);
}
