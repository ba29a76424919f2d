// # The degree as a cure
//
// Run: 14_degree               ε = 1e-4, h from 1/4 to 1/32, P1 to P4; a few seconds
// Run: 14_degree --epsilon 1e-2
// Run: 14_degree --epsilon 1   nothing is stiff: neither mesh is better than the other
// Run: 14_degree --exercise 1
//
// Needs: [07](07_kernel.cpp) for $G_h$ and its dimension, [11](11_contact_sets.cpp) for $K_h ⊄ K$,
// [06](06_p1_unstructured.cpp) for the wall.
//
// **The picture.** Error against unknowns for the degrees 1 to 4 at ε = 1e-4. *On the structured mesh every degree
// converges at once. On the unstructured mesh the error of degree $p$ stays until $h^p$ is below ε: a higher degree
// locks less, and every degree locks.*
//
// **Predict.** On an unstructured mesh, how many functions $v$ on the layer of degree $p$ per triangle have
// $∂_y v = 0$ everywhere and are 0 at both ends: (a) for $p = 1$? (b) for $p = 3$, and how many more on a mesh of
// half the width?
//
// ## Which functions cost nothing
//
// The introduction of the paper names "p and hp methods [2]" among the cures (hp: [chapter 27](27_hp.cpp)). Take
// continuous functions that are polynomials of degree $p$ on each triangle, with unknowns at the points that cut each
// edge into $p$ equal parts (and inside): the element $P_p$. If $∂_y v = 0$ then $v$ is a polynomial of degree $p$ in
// $x$ on each triangle. Two neighbours that share an interval of $x$ share the polynomial, unless the edge between them
// is vertical. On an unstructured mesh no edge is, so all triangles have the same one, and it is 0 at $x = 0$ and
// $x = 1$: $x (1 - x)$ times a polynomial of degree $p - 2$. So
//
// $$ \dim G_h = p - 1 \text{ on the layer, however fine the mesh;} $$
//
// P1 has none, P2 has one. A number that does not grow under refinement does not approach $K_0$: every degree locks
// in the limit ε = 0. On the structured mesh of $n$ columns $v$ is any continuous function of $x$ of degree $p$ per
// column: $n p - 1$.
//
// ## What the others cost
//
// Interpolate a smooth ridge $w(x)$, constant across the layer, on an unstructured mesh. Its slope is wrong by $h^p$,
// so $∂_y I_h w$ is of size $h^p$ where it should be 0. (26) charges $ε^{-2}$ times the square: it is nothing once
// $h^p ≪ ε$. On the meshes of gmsh nearly all triangles are nearly equilateral, leading errors of neighbours cancel,
// and about $h^{p + 1/2}$ is measured. Half of the ridge is lost where that, times a factor near 1, equals ε. With
// the factor 1 this is at ε = 1e-4 $h = ε^{2/3} = 1/460$ for P1 and $h = ε^{2/5} = 1/40$ for P2. For P2 the factor
// is less than 1: the run below puts its wall nearer to 1/28.
//
// Contact is asked at the unknowns on $Γ_C$. For $p ≥ 2$ a polynomial may dip below 0 between them: $V_h ⊂ V$, but
// $K_h ⊄ K$. And $u$ is not smooth where contact ends. Nearer than ε it is like $r^{3/2}$ (chapter 09). Seen from
// farther away its second derivative along $x$ jumps, as the pressure does (chapter 10). Both leave $h^{3/2}$ in $H^1$:
// on fine meshes no degree has a higher order.

#include "antilock/analysis/kernel.hpp"
#include "common/study.hpp"

using namespace antilock;
using std::numbers::pi, tutorial::Exact;

// `cost`: $|∂_y I_h w|$ in $L^2$ of the layer, $w = \sin 2πx$. `ridge`: the largest $u_h$ on $Γ_C$. `kernel`:
// $\dim G_h$ on the layer, counted on the coarsest mesh (a rank has no meaning where $B$
// nearly misses many functions).
const std::vector<std::string> columns{"element",  "degree", "mesh", "cells", "h",
                                       "unknowns", "kernel", "cost", "h1",    "ridge"};

Table solve(const Method& method, int cells, double epsilon, const Field& load, const Exact& exact) {
  // ### Mesh
  const Discretisation on = method.on(cells);
  // ### Forms
  // The same lines for every degree. $B$ has one row per point of a quadrature that is exact for $(∂_y v)^2$.
  const Scene scene(Body{load}, StiffLayer{epsilon}, UnilateralContact{});
  const VariationalInequality problem = assemble(scene, on.space());
  const Eigen::VectorXd slope = problem.b * (2 * pi * on.space().points().col(0).array()).sin().matrix();
  // ### Solve
  // Factored at the true ε: functions that $B$ nearly misses would need hundreds of corrections with a larger penalty
  // ([chapter 16](16_roundoff.cpp)). Below ε = 1e-4 that costs too many digits; the solver says so, and refuses.
  PenaltyFactor factor(problem, problem.compliance);
  const Solution solution = active_set(problem, factor);
  Table row(columns);
  row.add({method.element->name(), method.element->degree(), method.family.name, cells, 1.0 / cells,
           on.space().free_count(), cells <= 4 ? Entry(layer_kernel_dimension(problem)) : Entry(""),
           std::sqrt(slope.dot(problem.m.cwiseProduct(slope))), exact.errors(on.space(), solution).h1,
           solution.u(on.space().contact()).maxCoeff()});
  return row;
}

void verdicts(const Table& results, const Exact& exact, tutorial::Report& report);

void study(const tutorial::Options& options, tutorial::Report& report) {
  const Exact exact(tutorial::paper_scene(options.epsilon));
  Table results(columns);
  for (const Method& method : methods({&p1(), &p2(), &p3(), &p4()}))
    for (int n = 4; n <= options.cells; n *= 2) results.add(solve(method, n, options.epsilon, paper_load, exact));
  // ### Output
  results.print("degrees 1 to 4; cost: |d/dy I_h w|", 3);
  results.select({"element", "mesh", "cells", "h", "unknowns", "cost", "h1", "ridge"})
      .write(options.out / "results.csv");
  verdicts(results, exact, report);
}

void verdicts(const Table& results, const Exact& exact, tutorial::Report& report) {
  for (const Table& row : results.where("cells", 4).rows()) {
    const double p = row.number("degree"), expected = row.entry("mesh") == "structured" ? 4 * p - 1 : p - 1;
    report.claim(row.number("kernel") == expected, "{} {}, 1/h = 4: dim G_h = {} ({})", row.entry("element").text(),
                 row.entry("mesh").text(), row.number("kernel"), expected);
  }
  const Table aligned = results.where("mesh", "structured"), any = results.where("mesh", "unstructured");
  report.claim(aligned.most("cost") < 1e-9, "structured: d/dy I_h w = 0 for every degree, up to round-off");
  const double finest = results.most("cells");
  for (const Entry& element : any.different("element")) {
    const Table own = any.where("element", element);
    const double p = own.first("degree"), order = own.order("cost", "h");
    report.claim(order > p - 0.1 && order < p + 0.8, "{} unstructured: d/dy I_h w falls like h^{:.2f} (at least h^{})",
                 element.text(), order, p);
    // What is lost over what is kept is the square of h^p / ε times a number near 1: 1e3 and more,
    // or 1/4 and less, decide.
    const double ratio = std::pow(1 / finest, p) / exact.epsilon,
                 kept = own.last("ridge") / exact.truth.max_on_contact();
    const auto say = [&](bool holds) {
      report.claim(holds,
                   "{} unstructured, h^p / epsilon = {:.2g}: {:.1f} % of the ridge is kept, H1 error {:.1f} times that "
                   "of the structured mesh",
                   element.text(), ratio, 100 * kept, own.last("h1") / aligned.where("element", element).last("h1"));
    };
    if (finest >= 32 && ratio > 30)
      say(kept < 0.1);
    else if (finest >= 32 && ratio < 0.5)
      say(kept > 0.99);
    else
      report.not_judged(fmt::format(
          "{}: h^p / epsilon = {:.2g} (30 and more, or 0.5 and less, on 1/32 or finer decides); {:.1f} % is kept",
          element.text(), ratio, 100 * kept));
  }
}

// ## What came out
//
// (a) None. (b) Two on every unstructured mesh: $\dim G_h$ at 1/h = 4 is 0, 1, 2, 3 for the degrees 1 to 4, and 3, 7,
// 11, 15 on the structured mesh. At ε = 1e-4 and 1/h = 32 the degrees 1 to 4 keep 0, 66, 99.9 and 100 % of the ridge.
// Even then the $H^1$ errors of P3 and P4 are 22 and 5 times those of the structured mesh. The slope of $I_h w$ falls
// like $h^{1.39}$, $h^{2.40}$, $h^{3.41}$, $h^{4.41}$.
//
// ## Exercises
//
// 1. A coarse unstructured mesh (1/h = 4) and ε = 1e-4: P1 and P2 both lock under $\sin 2πx$. And under $10 \sin πx$?
// 2. On paper: a mesh of the layer on which P1 has exactly 3 kernel functions. (Vertical mesh lines at three inner
//    $x$, anything between them.)

#include "answers/14_degree.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "14_degree", "degrees 1 to 4 on both meshes: less locking, not none",
      {.epsilon = 1e-4, .least_epsilon = 1e-4, .least_cells = 8, .most_cells = 64, .exercises = exercises}, study);
}
