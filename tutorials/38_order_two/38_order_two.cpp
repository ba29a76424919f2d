// # Order two on any mesh
//
// Run: 38_order_two                five families to 1/32, contact to 1/64; ten seconds
// Run: 38_order_two --cells 128    each mesh once more
// Run: 38_order_two --exercise 1
// Run: 38_order_two --exercise 2
// Run: 38_order_two --exercise 3
//
// Needs: [08](../08_crouzeix_raviart/08_crouzeix_raviart.cpp) (CR, means over edges),
// [12](../12_contact_sets/12_contact_sets.cpp) ($K_h$), [13](../13_uniform/13_uniform.cpp)
// (the worst error over ε), [16](../16_degree/16_degree.cpp) (higher degrees lock later,
// but lock). The theorems are proved line by line in [order_two](../guides/order_two.md).
//
// **Afterwards you can** say which moments an element must keep for its strain to be exact
// in the mean, count whether a polynomial space can keep them, and impose contact by means
// that are not negative for any admissible function.
//
// :figure: order_two_unknowns
//
// **The picture.** The unknowns of three elements. *Dots* are values, *bars* are means over
// an edge with the weight that is drawn beside it, and the disc is the mean over the
// triangle.
//
// **Predict.** (a) Give P2 one more function on each triangle,
// $2 - 3 (λ_0^2 + λ_1^2 + λ_2^2)$, which may jump from triangle to triangle ($λ_i$ are the
// barycentric coordinates). How many functions of the layer have no strain then: none that
// are new, as many as the mesh has columns, or as many as it has triangles? (b) On an edge
// take the affine function with the same mean and the same first moment as $u$. Is it at
// least 0 where $u$ is? If not, which two of its values are, for every $u ≥ 0$?
//
// ## Which moments must an element keep?
//
// A method locks where its functions without strain are too few
// ([chapter 07](../07_kernel/07_kernel.cpp)). CR has enough on any mesh for one reason: its
// gradient is the mean of the gradient. Interpolate a function without strain by its means
// over edges; then the interpolant has none. The same condition for degree $k$ is that the
// strain of the interpolant $I_h u$ is the projection of $∂_y u$ on polynomials of degree
// $k - 1$,
//
// $$ ∫_T ∂_y(u - I_h u) q = 0   for all q of degree k - 1. $$
//
// Integrate by parts. Then $u - I_h u$ is multiplied by $q$ on each edge, and by $∂_y q$
// inside of the triangle. So the integral is 0 if $I_h u$ keeps the moments of $u$ against
// polynomials of degree $k - 1$ on each edge and of degree $k - 2$ on the triangle. These
// are $3k + k(k-1)/2$ numbers, and polynomials of degree $k$ have $(k+1)(k+2)/2$
// coefficients. The difference is
//
// $$ 3k + \frac{k(k-1)}{2} - \frac{(k+1)(k+2)}{2} = k - 1. $$
//
// For $k = 1$ it is 0: this is CR. *P2 has one function too few.* The six edge moments of a
// parabola are not free: with $d_j$ the difference of the two on edge $j$,
// $d_0 + d_1 + d_2 = 0$. At $k = 3$ two functions are missing. The element of Crouzeix and
// Falk has cubics. Four of its functions have no strain at $1/h = 4$, and four at
// $1/h = 8$ (the table of functions without strain below): this kernel does not grow here.
//
// ## Seven numbers
//
// So do not require a polynomial. Keep the numbers: on each edge the two means
//
// $$ a^- = \frac{2}{|E|} ∫_E u λ^-,   a^+ = \frac{2}{|E|} ∫_E u λ^+ $$
//
// with the hat functions $λ^-$, $λ^+$ of its ends, and the mean $u_T$ over the triangle.
// The same integration by parts *defines* the gradient. $G u$ is the affine field with
//
// $$ ∫_T G u · q = - u_T ∫_T \mathrm{div} q + ∑_E ∫_E u_E q·n   for all affine q, $$
//
// $u_E$ the affine function with the means $a^-$, $a^+$. By construction $G I_h u$ is the
// $L^2$ projection of $∇u$, for every $u$ and on every mesh. In the literature this is the
// *hybrid form of BDM1* (Brezzi, Douglas and Marini), and a *hybrid high-order method* (Di
// Pietro and Ern). The library calls it `hybrid_bdm1()`, a scene `"BDM1-hybrid"` or `"M2"`.
// Three things have to be checked.
//
// **Is $G u = 0$ for constants alone?** If $G u = 0$, then the edge terms are 0 for all
// $q$, after $u_T$ is subtracted. The normal parts of an affine field on the three edges
// are six free numbers. So $u_E = u_T$ on each edge: $u$ is constant. No term has to be
// added, while other methods of this kind need a *stabilisation*.
//
// **How many functions have no strain?** Each triangle of the layer brings three equations,
// one for each coefficient of $(G u)_y$, and four numbers: its mean, and half of the six on
// its edges. The difference is one. The kernel grows like the triangles, and by the
// projection every function without strain has its interpolant in it.
//
// **Contact.** $a^- ≥ 0$ and $a^+ ≥ 0$ on the edges of $Γ_C$: bounds on unknowns. Means of
// $u ≥ 0$ with the weights $λ^± ≥ 0$ are not negative, so $I_h$ maps $K$ into $K_h$. And
// the force that a bound carries is a multiple of $λ^±$, so that the discrete pressure is
// affine on an edge and *nowhere negative*.
//
// ## A bound with the constant 1
//
// As for CR ([chapter 20](../20_order_h/20_order_h.cpp), step 2), $A$ is constant on a
// triangle, so Pythagoras gives $|∇u - G u_h|_a^2 = |∇u - Π_1 ∇u|_a^2 + |G e|_a^2$ with
// $e = I_h u - u_h$, and $I_h u ∈ K_h$ may be put into the inequality. Take a field τ with
// $\mathrm{div} τ = - Π_0 f$, affine on triangles and with continuous normal parts. Then
// $(τ, G e)$ is the load plus the work of $τ·n$ on $Γ_C$, exactly. So
//
// $$ |G e|_a^2 ≤ (σ - τ, G e) + ∫_{Γ_C} (τ·n) e_E, $$
//
// and if $τ·n ≥ 0$ the last term is at most $∫_{Γ_C} (τ·n) u$. This is *Theorem F*: for
// every ε from 0 to 1, on any mesh,
//
// $$ |∇u - G u_h|_a^2 ≤ |∇u - Π_1 ∇u|_a^2 + |σ - τ|_{A^{-1}}^2 + 2 ∫_{Γ_C} (τ·n) u $$
//
// (with the load on the means $u_T$; exercise 2). No constant, no ε. Without contact τ may
// be the interpolant of the flux σ, and both terms are of size $h^4$: *Theorem G*, order 2
// on any shape-regular mesh, uniformly in ε. With contact the interpolant needs second
// derivatives of $p$, which jumps where contact ends. What is proved then is convergence
// (*Theorem H*) and the orders of CR.

#include "antilock/analysis/kernel.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/penalised_cholesky.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using std::numbers::pi, tutorial::Exact;

const std::vector<std::string> families{"structured", "columns", "jittered", "rows",
                                        "delaunay"};
const std::vector<double> epsilons{1, 1e-2, 1e-4, 0};

// The exact solution without contact, or with it.
Exact exact_solution(double epsilon, bool contact) {
  const auto floor = contact ? std::optional(UnilateralContact{}) : std::nullopt;
  return Exact(Scene(Body{paper_load}, StiffLayer{epsilon}, floor), 14);
}

// An element on a mesh and its problem. Fortin and Soulie's element is hybrid BDM1 with one
// equation per triangle.
struct Discretisation {
  Discretisation(const Element& element, const std::string& family, int cells,
                 const Scene& scene)
      // ### Mesh
      : equations(&element == &fortin_soulie()),
        name(equations ? "Fortin-Soulie" : element.name()),
        space(mesh_family(family).mesh(cells), equations ? hybrid_bdm1() : element),
        // ### Forms
        // The same line for each element. For `hybrid_bdm1()` the derivative of the basis
        // is $G$. The equations are rows of $B$ with the compliance 0.
        problem(assemble(scene, space)),
        strains(problem.b.rows()) {
    if (equations) problem = tutorial::with_equations(problem, space);
  }
  // Each equation takes one unknown away.
  int unknowns() const {
    return static_cast<int>(space.free_count() - (problem.b.rows() - strains));
  }
  // The multipliers of the equations are no stresses.
  Errors errors(const Exact& exact, Solution solution) const {
    solution.p.conservativeResize(strains);
    return exact.errors(space, solution);
  }

  bool equations;
  std::string name;
  Space space;
  VariationalInequality problem;
  Eigen::Index strains;  // the rows of B before the equations
};

// One element on one mesh, without contact, at every ε. P2 is factored at the true ε, as in
// chapter 16, because its $B$ nearly misses many functions, and ε = 0 is left out for it.
Table solve_free(const Element& element, const std::string& family, int cells,
                 const std::vector<Exact>& exact) {
  const Discretisation method(element, family, cells, exact[0].scene);
  Sweep sweep(method.problem);
  Table rows({"element", "mesh", "cells", "h", "unknowns", "epsilon", "energy", "l2"});
  for (const Exact& one : exact) {
    if (&element == &p2() && one.epsilon == 0) continue;
    // ### Solve
    sweep.set_compliance(one.epsilon * one.epsilon);
    Solution solution;
    if (&element == &p2()) {
      PenalisedCholesky factor(sweep.problem(), sweep.problem().compliance);
      solution = active_set(sweep.problem(), factor);
    } else {
      solution = sweep.solve();
    }
    const Errors errors = method.errors(one, solution);
    rows.add({method.name, family, cells, 1.0 / cells, method.unknowns(), one.epsilon,
              errors.energy, errors.l2});
  }
  return rows;
}

// Contact at ε = 0: the energy error, relative to $|u|_a = (-2 J(u))^{1/2}$, and its part
// in the layer, $‖∂_x u - (G u_h)_x‖$.
Table solve_contact(const Element& element, const std::string& family, int cells,
                    const Exact& exact) {
  const Discretisation method(element, family, cells, exact.scene);
  const Errors errors = method.errors(exact, active_set(method.problem));
  const double size = std::sqrt(-2 * exact.solution.energy());
  Table row({"element", "mesh", "cells", "h", "unknowns", "energy", "relative", "layer"});
  row.add({method.name, family, cells, 1.0 / cells, method.unknowns(), errors.energy,
           errors.energy / size, tutorial::layer_part(method.space, errors)});
  return row;
}

// The functions without strain of nonconforming polynomials, and of the seven numbers. On
// these meshes no edge inside the layer is vertical.
Table count_kernels() {
  Table kernels({"element", "cells", "triangles", "kernel"});
  for (const int n : {4, 8}) {
    const TriangleMesh mesh = mesh_family("jittered").mesh(n);
    const auto triangles =
        std::count(mesh.region.begin(), mesh.region.end(), Region::layer);
    for (const auto& [name, degree] :
         {std::pair{"CR", 1}, {"Fortin-Soulie", 2}, {"Crouzeix-Falk", 3}})
      kernels.add({name, n, triangles, tutorial::strainless_polynomials(mesh, degree)});
    const Space space(mesh, hybrid_bdm1());
    const Scene rigid(Body{paper_load}, StiffLayer{0});
    kernels.add(
        {"BDM1-hybrid", n, triangles, layer_kernel_dimension(assemble(rigid, space))});
  }
  return kernels;
}

void judge_kernels(const Table& kernels, tutorial::Report& report) {
  for (const int n : {4, 8}) {
    const Table here = kernels.filter("cells", n);
    const auto kernel = [&](const char* element) {
      return static_cast<int>(here.filter("element", element).number("kernel"));
    };
    const int expected = tutorial::one_per_triangle(mesh_family("jittered").mesh(n));
    report.claim(kernel("BDM1-hybrid") == expected,
                 "1/h = {}: {} functions without strain for seven numbers ({}, proved)", n,
                 kernel("BDM1-hybrid"), expected);
    report.claim(kernel("Fortin-Soulie") == 2 * n && kernel("Crouzeix-Falk") == 4,
                 "1/h = {}: {} for parabolas (2/h), {} for cubics (observed)", n,
                 kernel("Fortin-Soulie"), kernel("Crouzeix-Falk"));
  }
}

// The strain of the interpolant of $x(1 - x)(1 - 2x)$, which has none.
void judge_interpolant(tutorial::Report& report) {
  for (const std::string family : {"rows", "delaunay"}) {
    const Space space(mesh_family(family).mesh(4), hybrid_bdm1());
    const VariationalInequality problem =
        assemble(Scene(Body{paper_load}, StiffLayer{0}), space);
    const Eigen::VectorXd ridge =
        dof_values(space, [](double x, double) { return x * (1 - x) * (1 - 2 * x); });
    // the rules for the means are exact for cubics, so that round-off remains
    const double strain = (problem.b * ridge).lpNorm<Eigen::Infinity>();
    report.claim(strain < 1e-12,
                 "{}: the strain of the interpolant of x (1 - x) (1 - 2 x) is below 1e-12 "
                 "(proved: 0)",
                 family);
  }
}

// ### Output
void judge_free(const Table& worst, tutorial::Report& report) {
  for (const std::string& family : families) {
    const Table here = worst.filter("mesh", family);
    report.claim_order(here.filter("element", "BDM1-hybrid"), "worst", "h", 1.9, 2.1,
                       "hybrid BDM1 on " + family + ", worst over epsilon (proved: 2)");
    report.claim_order(here.filter("element", "CR"), "worst", "h", 0.9, 1.1,
                       "CR on " + family + ", worst over epsilon (observed)");
    report.claim_order(here.filter("element", "Fortin-Soulie"), "worst", "h", 1.8, 2.1,
                       "Fortin-Soulie on " + family + ", worst over epsilon (observed)");
  }
  for (const std::string family : {"structured", "columns"})
    report.claim_order(worst.filter("mesh", family).filter("element", "P2"), "worst", "h",
                       1.9, 2.1, "P2 on " + family + ", worst over epsilon > 0 (observed)");
  for (const std::string family : {"rows", "delaunay"}) {
    const Table here = worst.filter("mesh", family);
    const double parabolas = here.filter("element", "P2").last("worst"),
                 affine = here.filter("element", "CR").last("worst");
    report.claim(parabolas > affine,
                 "P2 locks on {}: on the finest mesh its worst error is {:.2g}, that of CR "
                 "{:.2g} (observed)",
                 family, parabolas, affine);
  }
}

void judge_contact(const Table& contact, tutorial::Report& report) {
  const auto order = [&](const char* element, const char* family, double low, double high) {
    report.claim_order(
        contact.filter("element", element).filter("mesh", family), "layer", "h", low, high,
        fmt::format("{} on {} in contact, part of the layer (observed)", element, family));
  };
  order("CR", "columns", 0.9, 1.1);
  order("CR", "rows", 0.7, 0.9);
  order("BDM1-hybrid", "columns", 1.4, 2.3);
  order("BDM1-hybrid", "rows", 1.0, 1.35);
  order("Fortin-Soulie", "rows", 1.2, 2.0);
}

void judge_prices(const Table& prices, tutorial::Report& report) {
  for (const std::string family : {"columns", "rows"}) {
    const Table here = prices.filter("mesh", family);
    const double seven = here.filter("element", "BDM1-hybrid").number("10 %"),
                 three = here.filter("element", "CR").number("10 %");
    report.claim(4 * seven < three,
                 "10 % on {}: {} unknowns with hybrid BDM1, {} with CR (observed)", family,
                 seven, three);
  }
}

void judge_pressure(const Table& pressure, tutorial::Report& report) {
  const double largest = pressure.max("hats");
  report.claim(pressure.min("hats") > -1e-9 * largest,
               "hat means: the lowest pressure is {:.1e} of the largest (proved: 0)",
               pressure.min("hats") / largest);
  report.claim(pressure.min("gauss") < -0.05 * largest,
               "Gauss points: the lowest pressure is {:.0f} % of the largest (observed)",
               100 * pressure.min("gauss") / largest);
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  std::vector<Exact> free_solutions;
  for (const double epsilon : epsilons)
    free_solutions.push_back(exact_solution(epsilon, false));
  Table all({"element", "mesh", "cells", "h", "unknowns", "epsilon", "energy", "l2"});
  for (const std::string& family : families) {
    report.stage(family + " without contact");
    for (const Element* element :
         {&crouzeix_raviart(), &p2(), &hybrid_bdm1(), &fortin_soulie()})
      for (int n = options.cells / 16; n <= options.cells / 2; n *= 2)
        all.add(solve_free(*element, family, n, free_solutions));
  }
  const Table worst = tutorial::worst_over_epsilon(all);
  const Exact limit = exact_solution(0, true);
  Table contact(
      {"element", "mesh", "cells", "h", "unknowns", "energy", "relative", "layer"});
  for (const std::string family : {"columns", "rows"}) {
    report.stage(family + " in contact");
    for (const Element* element : {&crouzeix_raviart(), &hybrid_bdm1()})
      for (int n = options.cells / 8; n <= options.cells; n *= 2)
        contact.add(solve_contact(*element, family, n, limit));
  }
  // At 1/h = 64 the equations and the strains are nearly dependent: after 100 corrections
  // the error of u is 1e-8, and 1e-10 is asked.
  for (const int n : {4, 8, 16, 32})
    contact.add(solve_contact(fortin_soulie(), "rows", n, limit));
  report.finish();
  const Table pressure = tutorial::pressures(mesh_family("delaunay").mesh(14), limit);
  const Table kernels = count_kernels();
  kernels.print("functions without strain in the layer", 3);
  worst.filter("mesh", "delaunay")
      .select({"mesh", "element", "cells", "h", "unknowns", "worst"})
      .print("delaunay meshes: the worst error over epsilon, without contact", 3);
  contact.print("contact at epsilon = 0", 3);
  const Table prices = tutorial::prices(contact);
  prices.print("unknowns for a relative energy error in contact", 3);
  all.write(options.out / "errors.csv");
  worst.write(options.out / "worst.csv");
  contact.write(options.out / "contact.csv");
  pressure.write(options.out / "pressure.csv");
  tutorial::draw_unknowns(options.out / "unknowns.csv");
  judge_kernels(kernels, report);
  judge_interpolant(report);
  judge_free(worst, report);
  judge_contact(contact, report);
  judge_prices(prices, report);
  judge_pressure(pressure, report);
}

// ## What came out
//
// :figure: order_two
// :output: delaunay meshes
//
// Order 2 on each of the five families, for the worst of four ε, as Theorem G says. P2 has
// it on columns. On a Delaunay mesh its worst error is 0.167 at $1/h = 8$ and still 0.145
// at $1/h = 32$. CR has order 1. The element of Fortin and Soulie has order 1.96 on Delaunay
// meshes (observed). An interpolation that keeps the strain is not known for it, so that
// Theorem G does not apply to it.
// :number: 0.167 = table "delaunay meshes" worst element=P2 cells=8
// :number: 0.145 = table "delaunay meshes" worst element=P2 cells=32
// :number: 1.96 = line "Fortin-Soulie on delaunay, worst over epsilon (observed): order {}"
//
// :output: contact at epsilon
// :figure: order_two_pressure
//
// :output: functions without strain
//
// (a) Like the columns, $2/h$ (Fortin and Soulie; exercise 1). With seven numbers
// they grow like the triangles. A kernel that grows need not contain the interpolants of
// all functions without strain.
//
// (b) No: the affine function with the moments of $u(s) = (1 - 4s)_+$ is negative from
// $s = 0.7$ on. Its values at one and at two thirds of the edge are the hat means of $u$,
// so they are at least 0. Its values at the two Gauss points need not be. If these values
// are bounded all the same, the pressure that works on them may be negative on the edge on
// which contact ends: in the picture down to -14 % of the largest pressure.
// :number: -14 = line "Gauss points: the lowest pressure is {} % of"
//
// In contact $∂_{xx} u$ jumps at ε = 0, and the interpolant of the flux is no longer of
// order 2. In the layer the order is 2.13 on columns, where it varies with the place in its
// edge at which contact ends. On rows it is 1.23 and falls from mesh to mesh. There CR has
// 0.79. Fortin and Soulie's element, with bounds on the hat means, has 1.64 there down to
// $h = 1/32$, which falls as well. On finer rows its equations and the strains are nearly
// dependent. For hybrid BDM1 order 1 on columns and order 1/2 on any shape-regular mesh are
// proved (Corollary I).
// **Open:** the orders that are measured are not proved, and it is not known here whether an
// element has an order above 1 in contact on every mesh.
// :number: 2.13 = line "BDM1-hybrid on columns in contact, part of the layer (observed): order {}"
// :number: 1.23 = line "BDM1-hybrid on rows in contact, part of the layer (observed): order {}"
// :number: 1.64 = line "Fortin-Soulie on rows in contact, part of the layer (observed): order {}"
// :number: 0.79 = line "CR on rows in contact, part of the layer (observed): order {}"
//
// :output: unknowns for a relative
//
// For a relative error of 10 % on rows CR needs 6611 unknowns, and hybrid BDM1 needs 1091.
// CR reaches 3 % on none of these meshes. Hybrid BDM1 reaches 0.3 % with 17675.
// :number: 6611 = table "unknowns for a relative" "10 %" element=CR mesh=rows
// :number: 1091 = table "unknowns for a relative" "10 %" element=BDM1-hybrid mesh=rows
// :number: 17675 = table "unknowns for a relative" "0.3 %" element=BDM1-hybrid mesh=rows
//
// :live: orders
//
// ## Exercises
//
// 1. Fortin and Soulie's element is this one with one equation per triangle,
//    $d_0 + d_1 + d_2 = 0$. Which dimension has its kernel on a jittered mesh with
//    $n$ cells per unit side, and which has that of P2?
// 2. Let the load work on the means, $L(v) = ∑_T v_T ∫_T f$. What happens to the order in
//    $L^2$, and what to the flux $A G u_h$ from triangle to triangle?
// 3. P2 again, with its strain averaged by the hat functions of the vertices, and half of
//    $a_0$ kept ([chapter 28](../28_mixed/28_mixed.cpp)). Does it lock on Delaunay meshes?
// 4. On paper: why do the six Gauss points of a triangle's edges lie on a conic, and what
//    has that to do with $d_0 + d_1 + d_2$?
//
// ## Further reading
//
// - D. N. Arnold, F. Brezzi, *Mixed and nonconforming finite element methods*, RAIRO 19
//   (1985), 7-32,
//   [doi:10.1051/m2an/1985190100071](https://doi.org/10.1051/m2an/1985190100071).
// - F. Brezzi, J. Douglas, L. D. Marini, *Two families of mixed finite elements for second
//   order elliptic problems*, Numer. Math. 47 (1985), 217-235,
//   [doi:10.1007/BF01389710](https://doi.org/10.1007/BF01389710).
// - M. Crouzeix, R. S. Falk, *Nonconforming finite elements for the Stokes problem*, Math.
//   Comp. 52 (1989), 437-456.
// - D. A. Di Pietro, A. Ern, *A hybrid high-order locking-free method for linear elasticity
//   on general meshes*, Comput. Methods Appl. Mech. Engrg. 283 (2015), 1-21,
//   [doi:10.1016/j.cma.2014.09.009](https://doi.org/10.1016/j.cma.2014.09.009).
// - M. Fortin, M. Soulie, *A non-conforming piecewise quadratic finite element on
//   triangles*, Int. J. Numer. Methods Eng. 19 (1983), 505-520,
//   [doi:10.1002/nme.1620190405](https://doi.org/10.1002/nme.1620190405).

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "38_order_two",
      "order 2 at every epsilon on any mesh, by seven numbers per triangle",
      {.takes_epsilon = false,
       .cells = 64,
       .least_cells = 32,
       .most_cells = 128,
       .exercises = exercises},
      study);
}
