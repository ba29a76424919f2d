// # The degree as a cure
//
// Run: 16_degree               ε = 1e-4, h from 1/4 to 1/32, P1 to P4; a few seconds
// Run: 16_degree --epsilon 1e-2
// Run: 16_degree --epsilon 1   nothing is stiff: neither mesh is better than the other
// Run: 16_degree --exercise 1
//
// Needs: [07](../07_kernel/07_kernel.cpp) for $G_h$ and its dimension,
// [06](../06_p1_unstructured/06_p1_unstructured.cpp) for the wall.
//
// **The picture.** Error against unknowns for the degrees 1 to 4 at ε = 1e-4, on three
// families of meshes, from 1/h = 4 (Delaunay: 8) to 32. *On the structured mesh every
// degree converges at once. On the two others each degree waits for its own mesh width.*
//
// :figure: degree
//
// **Predict.** On an unstructured mesh, how many functions $v$ on the layer of degree $p$
// per triangle have $∂_y v = 0$ everywhere and are 0 at both ends: (a) for $p = 1$? (b) for
// $p = 3$, and how many more on a mesh of half the width?
//
// ## Which functions cost nothing
//
// The paper names "p and hp methods [2]" ([chapter 31](../31_hp/31_hp.cpp)) among the cures
// (in its introduction). Take continuous functions that are polynomials of
// degree $p$ on each triangle, with unknowns at the points that cut each edge into $p$
// equal parts (and inside): the element $P_p$. If $∂_y v = 0$ then $v$ is a polynomial of
// degree $p$ in $x$ on each triangle. Two neighbours that share an interval of $x$ share
// the polynomial, unless the edge between them is vertical. On an unstructured mesh some
// edges are. But unless a line of them goes all the way from $Σ$ to $Γ_C$, every triangle
// is connected with every other one through edges that are not
// ([chapter 02](../02_meshes/02_meshes.cpp)). Then all have the same polynomial, and it is
// 0 at $x = 0$ and $x = 1$: $x (1 - x)$ times a polynomial of degree $p - 2$. So
//
// $$ \dim G_h = p - 1 \text{ on the layer, however fine the mesh;} $$
//
// P1 has none, P2 has one. $K_0$ holds infinitely many functions of $x$, and a kernel that
// does not grow under refinement cannot approach it (chapter 07). So every degree locks in
// the limit ε = 0. Where $c - 1$ vertical lines part the layer into $c$ columns, $v$ is any
// continuous function of $x$ of degree $p$ per column: $c p - 1$. On the structured mesh
// $c = 1/h$.
//
// ## What all other functions cost
//
// Take a smooth ridge $w(x)$, constant across the layer, that is not in the kernel. Its
// interpolant of degree $p$ has a slope across the layer, $∂_y I_h w$, where $w$ has none.
// On a triangle with a vertical edge this slope is 0 for every degree: $w$ takes equal
// values at equal $x$, so the interpolant is a function of $x$. On all others it is of the
// order $h^p$. Let $κ$ be its norm over the layer, the *cost* of the ridge. The law of
// [chapter 06](../06_p1_unstructured/06_p1_unstructured.cpp#how-much-is-lost-one-number-per-triangle)
// does not ask for the degree: with its $E$ the share
//
// $$ \frac{1}{1 + ρ},   ρ = \frac{κ^2}{ε^2 E},   κ = ‖∂_y I_h w‖, $$
//
// of the ridge is kept, and P1 is the case $κ = k ‖w''‖$. On a Delaunay mesh $κ ∼ h^p$. On
// that of Frontal-Delaunay the triangles without a vertical edge are left along the
// boundary, so their share of the layer falls like $h$, and $κ ∼ h^{p + 1/2}$. A higher
// degree moves the wall, the ε at which $ρ = 1$, to smaller ε. It does not remove it.
//
// Contact is asked at the unknowns on $Γ_C$. For $p ≥ 2$ a polynomial may dip below 0
// between them: $V_h ⊂ V$, but $K_h ⊄ K$. And $u$ is not smooth where contact ends. Nearer
// than ε it is like $r^{3/2}$ (chapter 09). Seen from farther away its second derivative
// along $x$ jumps, as the pressure does (chapter 10). Both leave $h^{3/2}$ in $H^1$: on
// fine meshes no degree has a higher order.

#include "antilock/analysis/kernel.hpp"
#include "antilock/analysis/layer_components.hpp"
#include "course/add_row.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using std::numbers::pi, tutorial::Exact;

// `columns`: $c$. `kernel`: $\dim G_h$ on the layer, counted on the coarsest mesh (a rank
// has no meaning where $B$ nearly misses many functions). `cost`: $κ$ for $w = \sin 2πx$.
// `kept`: the largest $u_h$ on $Γ_C$ over that of $u$; `law`: $1/(1 + ρ)$, where
// the verdicts write x for ρ.
const std::vector<std::string> names{"element", "degree",   "mesh",    "cells",
                                     "h",       "unknowns", "columns", "kernel",
                                     "cost",    "h1",       "kept",    "law"};

Table solve(const Method& method, int cells, double epsilon, const Field& load,
            const Exact& exact) {
  // ### Mesh
  const Space space = method.space(cells);
  // ### Forms
  // The same lines for every degree. $B$ has one row per point of a quadrature that is
  // exact for $(∂_y v)^2$.
  const Scene scene(Body{load}, StiffLayer{epsilon}, UnilateralContact{});
  const VariationalInequality problem = assemble(scene, space);
  const Eigen::VectorXd slope =
      problem.b * (2 * pi * space.dof_coordinates().col(0).array()).sin().matrix();
  // ### Solve
  // Factored at the true ε: functions that $B$ nearly misses would need hundreds of
  // corrections with a larger penalty ([chapter 18](../18_roundoff/18_roundoff.cpp)). Below
  // ε = 1e-4 that costs too many digits; the solver says so, and refuses.
  PenalisedCholesky factor(problem, problem.compliance);
  const Solution solution = active_set(problem, factor);
  const double a = 2 * pi, ridge = 0.5 * (a / std::tanh(a) + a * a);  // E, chapter 06
  const double squared = slope.dot(problem.m.cwiseProduct(slope));
  // gmsh's lines are vertical up to 1e-12, and the rank of a high degree sees the
  // difference.
  const bool counted = cells <= 4 && method.family.name != "delaunay";
  Table row(names);
  const double kept =
      solution.u(space.contact_dofs()).maxCoeff() / exact.solution.max_on_contact();
  tutorial::add_row(row,
                    {{"element", method.element->name()},
                     {"degree", method.element->degree()},
                     {"mesh", method.family.name},
                     {"cells", cells},
                     {"h", 1.0 / cells},
                     {"unknowns", space.free_count()},
                     {"columns", layer_components(space.mesh()).count},
                     {"kernel", counted ? TableEntry(layer_kernel_dimension(problem)) : ""},
                     {"cost", std::sqrt(squared)},
                     {"h1", exact.errors(space, solution).h1},
                     {"kept", kept},
                     {"law", 1 / (1 + squared / (epsilon * epsilon * ridge))}});
  return row;
}

void judge_kernels(const Table& coarsest, tutorial::Report& report);
void judge(const Table& results, tutorial::Report& report);

void study(const tutorial::Options& options, tutorial::Report& report) {
  const Exact exact(tutorial::paper_scene(options.epsilon));
  Table results(names), coarsest(names);
  for (const Method& method :
       methods({&p1(), &p2(), &p3(), &p4()},
               {structured(), unstructured(), mesh_family("delaunay")}))
    for (int n = 4; n <= options.cells; n *= 2) {
      const Table row = solve(method, n, options.epsilon, paper_load, exact);
      if (n == 4) coarsest.add(row);
      // gmsh's Delaunay mesh at 1/h = 4 has a vertical line by chance, and the others have
      // none
      if (row.number("columns") == 1 || method.family.name == "structured")
        results.add(row);
    }
  // ### Output
  results
      .select({"element", "mesh", "cells", "h", "unknowns", "kernel", "cost", "h1", "kept",
               "law"})
      .print("degrees 1 to 4; cost: |d/dy I_h w|", 3);
  coarsest.select({"element", "mesh", "columns", "kernel", "kept", "law"})
      .print("1/h = 4: the kernel on the layer", 3);
  tutorial::write_degrees(options.out, results);
  judge_kernels(coarsest, report);
  judge(results, report);
}

void judge_kernels(const Table& coarsest, tutorial::Report& report) {
  for (const Table& row : coarsest.rows()) {
    if (row.entry("mesh") == "delaunay") continue;
    const double expected = row.number("columns") * row.number("degree") - 1;
    report.claim(row.number("kernel") == expected,
                 "{} {}, 1/h = 4, columns: {}, dim G_h = {} ({}, proved)",
                 row.entry("element").text(), row.entry("mesh").text(),
                 row.number("columns"), row.number("kernel"), expected);
  }
}

void judge(const Table& results, tutorial::Report& report) {
  report.claim(results.filter("mesh", "structured").max("cost") < 1e-9,
               "structured: d/dy I_h w = 0 for every degree, up to round-off (proved)");
  for (const TableEntry& element : results.unique("element")) {
    const Table all = results.filter("element", element);
    const double p = all.first("degree");
    // h^p at least is proved. The half more is that of the one generator.
    report.claim_orders(all.filter("mesh", "delaunay"), "cost", p - 0.25, p + 0.25,
                        element.text() + " delaunay: cost");
    report.claim_order(all.filter("mesh", "unstructured"), "cost", "h", p + 0.3, p + 0.6,
                       element.text() + " unstructured: cost (observed)");
    // From 1/8 on, where the interpolant is near the ridge. A twentieth: what the body's
    // error may take.
    double least = 9, most = 0, locked = 0;
    for (const Table& row :
         all.filter_number("h", [](double h) { return h < 0.13; }).rows()) {
      if (row.entry("mesh") == "structured") continue;
      const double kept = row.number("kept"), law = row.number("law");
      least = std::min(least, kept / law), most = std::max(most, kept / law);
      if (law < 1e-3) locked = std::max(locked, kept);
    }
    report.claim(least > 0.95,
                 "{}: of the ridge at least {:.2f} times 1/(1 + rho) is kept (observed)",
                 element.text(), least);
    if (p == 1) report.claim(most < 2.5, "P1: and at most {:.2f} times (observed)", most);
    if (locked > 0)
      report.claim(locked < 0.01,
                   "{} locks: where 1/(1 + rho) < 1e-3 it keeps {:.2g} or less (observed)",
                   element.text(), locked);
  }
}

// ## What came out
//
// :output: degrees 1 to 4
//
// (a) None. (b) Two, and not one more on the finer mesh: $\dim G_h$ at 1/h = 4 is 0, 1, 2,
// 3 for the degrees 1 to 4, and 3, 7, 11, 15 on the structured mesh. At ε = 1e-4 and 1/h =
// 32 the degrees 1 to 4 keep 0, 66, 99.9 and 100 % of the ridge on the unstructured mesh,
// and 0, 35, 99.9 and 100 % on the Delaunay mesh. The cost says how much is kept at least.
// P1 keeps up to 2.23 times that: 1.46 times because of contact, the rest because $u_h$
// leans on the better triangles (chapter 06). P2 and P3 keep up to 19 times as much of the
// little that is left: among their functions there are better ones than the interpolant.
// Where the ridge is kept the $H^1$ error can still be large: the gradient sees the wrong
// slope first.
// :number: 66 = 100 * table "degrees 1 to 4" kept element=P2 mesh=unstructured cells=32
// :number: 35 = 100 * table "degrees 1 to 4" kept element=P2 mesh=delaunay cells=32
// :number: 99.9 = 100 * table "degrees 1 to 4" kept element=P3 mesh=delaunay cells=32
// :number: 2.23 = line "P1: and at most {} times"
//
// **One vertical line is enough.** gmsh's Delaunay mesh at 1/h = 4 has, by chance, a
// vertical line at $x = 1/2$. It has two columns, so $\dim G_h$ is 1, 3, 5, 7. P2 keeps
// 0.943 of the ridge there, where $1/(1 + ρ)$ is 1.14e-05. P1 gains nothing, because its
// one function, the hat at $x = 1/2$, is even about $x = 1/2$ and the load is odd. This
// mesh says nothing about the others of its family, so the picture begins at 1/8 there.
// :number: 0.943 = table "1/h = 4" kept element=P2 mesh=delaunay
// :number: 1.14e-05 = table "1/h = 4" law element=P2 mesh=delaunay
// :output: 1/h = 4
//
// :live: degree
//
// ## Exercises
//
// 1. A coarse unstructured mesh (1/h = 4) and ε = 1e-4: P1 and P2 both lock under
//    $\sin 2πx$. And under $10 \sin πx$?
// 2. On paper: a mesh of the layer on which P1 has exactly 3 kernel functions.
//
// ## Further reading
//
// - [Babuška and Suri 1992](../guides/bibliography.md#babuska-1992): the definitions of
//   locking and robustness.
// - [Babuška and Suri 1992b](../guides/bibliography.md#babuska-1992b): the same for nearly
//   incompressible materials.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "16_degree",
                       "degrees 1 to 4 on both meshes: less locking, not none",
                       {.epsilon = 1e-4,
                        .least_epsilon = 1e-4,
                        .least_cells = 16,
                        .most_cells = 64,
                        .exercises = exercises},
                       study);
}
