// # Switches
//
// Run: 40_switches               quadrilaterals to 1/h = 16, 11 values of ε; five seconds
// Run: 40_switches --cells 32    two meshes more of each family; half a minute
// Run: 40_switches --exercise 1
// Run: 40_switches --exercise 2
//
// Needs: [07](../07_kernel/07_kernel.cpp) (functions without strain),
// [08](../08_crouzeix_raviart/08_crouzeix_raviart.cpp) (means over edges),
// [13](../13_uniform/13_uniform.cpp) (the worst error over ε),
// [26](../26_elasticity/26_elasticity.cpp) (rubber),
// [28](../28_mixed/28_mixed.cpp) (projected strains, the conditions (i) to (iv)).
// Nothing later needs this chapter.
//
// **Afterwards you can** count what reduced integration, selective integration, B-bar and a
// nonconforming element leave of the stiff condition on quadrilaterals, and say which of
// them cures locking, which one only moves it to a smaller ε, and which one costs
// stability.
//
// **The picture.** A pin presses from below on one node of the contact boundary, at ε = 1,
// where nothing is stiff. *On the left one point per cell: every second node does not see
// the pin. On the right the same with a stabilisation.*
//
// :figure: switches_pin
//
// **Predict.** Programs of engineers have quadrilaterals and switches: full integration,
// reduced integration, selective integration, B-bar. In the *jittered* mesh of squares each
// vertex inside of the body or of the layer has moved by up to $0.2 h$ in $x$ and in $y$.
// (a) Which of the four switches does not lock on the jittered mesh? (b) How much do the
// results of selective integration and of B-bar differ there? (c) How many independent
// functions have no energy if each form has one point per cell, and nothing is clamped?
//
// ## The switches
//
// $Q_1$ is bilinear on the reference square, $u = α + β s + γ t + δ s t$, and so is the map
// to the cell, $x = a + b s + c t + d s t$ and likewise $y$. The unknowns are the values at
// the vertices. As before $a_0$ is the integral of $(∂_y u)^2$ over the layer, and $a_1$
// has all the rest of (23).
//
// - **full**: two by two Gauss points, for $a_0$ and $a_1$.
// - **selective**: one point for $a_0$, the centre of the cell, and two by two for $a_1$
//   (Malkus and Hughes).
// - **B-bar** (Hughes): the stiff part of the strain is replaced by its mean over the cell,
//   and the rest is kept. In elasticity the stiff part is $\operatorname{div} u$, and its
//   mean is called the mean dilatation. In the layer it is $∂_y u$: in the words of chapter
//   28 there is a group for each cell.
// - **reduced**: one point for both.
// - **stabilised** (Flanagan and Belytschko): reduced, and in $a_1$ the energy of the
//   *hourglass part* of $u$. This is $S T$, $S = 2 s - 1$ and $T = 2 t - 1$, which is 1 and
//   -1 at the ends of each edge, times
//   $¼ (g·u - (g·x) ∂_x u - (g·y) ∂_y u)$, where $u$, $x$ and $y$ stand for their values
//   at the corners, $g = (1, -1, 1, -1)$, and the derivatives are those at the centre. It
//   is 0 for affine functions.
// - **rotated** (Rannacher and Turek): not continuous. The functions are those of $1, S, T$
//   and $S^2 - T^2$, and the unknowns are the means over the edges. A function of $x$ and
//   $y$ that is affine has a term in $S T$ on a cell that is no parallelogram. So here
//   $S T$ is the fifth function, whose mean over each edge is 0 (Cai, Douglas, Santos,
//   Sheen and Ye). Without it the patch test fails. (Rannacher and Turek cure this in
//   another way: in place of $S$ and $T$ they take Cartesian coordinates of each cell.)
//
// The cells are convex, and there are three families of meshes: *structured*, squares;
// *jittered*, as above; and *recombined*, gmsh's triangles joined in pairs.
//
// **B-bar is selective integration.** *On any convex quadrilateral of the plane, the mean
// of $∂_y u$ over the cell is its value at the centre.* Let $|J| = x_s y_t - x_t y_s$ be
// the Jacobian of the map. Then
//
// $$ |J|\, ∂_y u = x_s u_t - x_t u_s
//   = (bγ - cβ) + (bδ - dβ) s + (dγ - cδ) t: $$
//
// the terms in $s t$ cancel. So $|J|\, ∂_y u$ is affine in $s$ and $t$, and $|J|$ itself
// is, too. The integral of an affine function over the square is its value at the centre.
// The mean is the quotient of two such integrals. ∎ For hexahedra this is false, and for
// the rotated element as well: on a cell that is no parallelogram its $|J|\, ∂_y u$ has
// squares of $s$ and $t$.
//
// ## Functions without strain
//
// **Full.** An affine function of $s$ and $t$ that is 0 at the two by two points is 0.
// So the three coefficients above are 0 if $u$ has no strain. They are the components of
// the cross product of $(b, c, d)$ and $(β, γ, δ)$, up to signs. So the second vector is
// a multiple of the first, that is, $u = α' + β' x$ on the cell. This leaves two of four
// unknowns: there are two conditions per cell. Two cells that share an edge which is not
// vertical have the same function. The structured mesh keeps $n - 1$ functions, with
// $n = 1/h$, because it is aligned. On the jittered mesh all cells of the layer are tied,
// and 0 is left.
//
// **Selective, B-bar, reduced.** One condition per cell. Let the layer have $N$ cells, and
// $E_Σ$, $E_C$ and $E_D$ edges on Σ, on $Γ_C$ and on the clamped sides. By Euler's formula
// it has $N + ½ (E_Σ + E_C + E_D) + 1$ vertices. $E_D + 2$ of them are clamped, so that
// **at least**
//
// $$ ½ (E_Σ + E_C - E_D) - 1 $$
//
// functions are left on any mesh. This is $-1$ on the meshes here, where the scaled layer
// is a square: *one condition more than there are unknowns*. On the structured mesh the
// conditions depend on each other. The mean of $∂_y u$ over a cell is 0 if
// $u_{i+1} + u_i$ is the same on its top and on its bottom. The difference of two rows
// therefore changes its sign from node to node, and it is 0 at the clamped side. So the
// rows are equal, and $n - 1$ functions are left, those of full integration. On the two
// other families the rank of $B$ is computed, and nothing is left on any mesh of this
// chapter. By [chapter 07](../07_kernel/07_kernel.cpp) *a switch that leaves nothing
// locks*: $u_h$ tends to 0 on the layer as $ε → 0$.
//
// **Rotated, full.** Let now $x = a + b S + c T + d S T$, and
//
// $$ u = α + β S + γ T + δ S T + κ (S^2 - T^2). $$
//
// Then $|J|\, ∂_y u$ is, up to a factor,
//
// $$ (bγ - cβ) + (bδ - dβ - 2cκ)\, S + (dγ - cδ - 2bκ)\, T - 2dκ\, (S^2 + T^2), $$
//
// and $S^2 + T^2$ is $2/3$ at each of the two by two points. So the three numbers
// $bγ - cβ - 4dκ/3$, $bδ - dβ - 2cκ$ and $dγ - cδ - 2bκ$ are 0. Multiply them by $d$, $-c$
// and $-b$, and add. This gives $κ\, (2b^2 + 2c^2 - 4d^2/3) = 0$. On a convex cell $|J|$
// is positive at the corners. It is a constant times $1 + μS + λT$, where the coefficients
// of $S T$ in $x$ and in $y$ are λ times those of $S$ plus μ times those of $T$. So
// $|λ| + |μ| < 1$, hence $d^2 < b^2 + c^2$ and $κ = 0$. As above $u = α' + β' x$ on the
// cell (proved). On each edge inside of the layer the means of two such functions agree.
// The rank of $B$ shows that $n - 1$ functions are left on the structured mesh, and none on
// the other two.
//
// **Rotated, means.** There are $½ (4 N + E_Σ + E_C - E_D)$ unknowns on edges that are not
// clamped, and one in each cell. The $N$ conditions do not follow from each other, by the
// proof of chapter 07 for Crouzeix-Raviart. Hence
//
// $$ 2 N + ½ (E_Σ + E_C - E_D) $$
//
// functions are left on *any* mesh (proved): two per cell on the meshes here.
//
// ## Means over edges and over cells: the cure
//
// *The rotated element with means over cells converges uniformly in ε on each shape-regular
// family of convex quadrilaterals* (proved). Chapter 28 asks for (i) to (iv).
//
// (ii) Let $I_h w$ have the mean of $w$ over each edge, and in each cell the term
// $¼ (g·w)\, S T$, with the values of $w$ at the corners. By Green's formula the mean of
// $∂_y I_h w$ over a cell needs only the means over edges. So it is the mean of $∂_y w$,
// and 0 for a function of $x$ alone: $I_h$ maps the smooth functions of $K_0$ into
// $K_{0h}$, and those of $K$ into $K_h$. Affine functions are reproduced, so that the error
// of $I_h w$ is of order $h$ for a smooth $w$. As in
// [chapter 08](../08_crouzeix_raviart/08_crouzeix_raviart.cpp) smooth functions are enough.
//
// (i) Let on one cell $∂_x v$ be 0 at the two by two points, and let the mean of $∂_y v$ be
// 0. By the first, $v = α' + β' y$: this is the proof for *rotated, full*, with $y$ in
// place of $x$. By the second $β' = 0$. So only constants have no energy. Hence
// $‖∂_x v‖^2 + |T|\, (\text{mean of } ∂_y v)^2 ≥ c ‖∇v‖^2$ on a cell $T$ of the layer.
// There is one $c$ for all cells, because their shapes are in a compact set (shape-regular:
// after scaling, $|J|$ stays away from 0). In the body $a_1$ has the whole gradient. With
// the inequality of Poincaré and Friedrichs for functions whose jumps have the mean 0
// (Brenner) the form is coercive.
//
// (iii), (iv) The means over cells are an $L_2$ projection onto constants per cell, as in
// chapter 28. Jumps have the mean 0 on each edge, so that weak limits lie in $V$, as for
// Crouzeix-Raviart. The two by two points in $a_1$ change no limit: they are exact for
// $|J|\, ∂_x v$ and $|J|\, ∂_y v$, so for a gradient times constants per cell. In each
// limit of chapter 28 one of the two gradients converges, and constants come near it. ∎
//
// $Q_1$ with means has (i), (iii) and (iv), by the same proof: its form is coercive. It
// fails at (ii) alone. *It is stable, and converges for each ε, so that a test at one ε
// may find nothing wrong.*
//
// ## One point for all: modes without energy
//
// The gradient at the centre of a cell is determined by the differences of $u$ along its
// two diagonals. So it is 0 on all cells if and only if $u$ is equal at opposite corners of
// each cell. Colour the vertices with two colours, so that the ends of each edge differ.
// (This is possible in a domain without holes: a closed path of edges surrounds cells with
// four edges each, so that it has an even number of edges.) Opposite corners have one
// colour. All vertices of a colour are connected by diagonals: on a path of edges from one
// to another every second vertex has this colour, and two neighbours of a vertex are
// connected by diagonals of the cells around it. So *two functions have no energy: the
// constants, and the function that is 1 on one colour and -1 on the other, the hourglass
// mode.* A clamped edge has both colours and removes both modes.
//
// But let $w$ be smooth, 0 on the clamped edges, and $v = ± w$ at the vertices, with the
// signs of the colours. The differences along diagonals are those of $w$, up to the sign.
// So $a_1(v, v) + a_0(v, v)$ is at most a constant, while $‖∇v‖ ≥ c h^{-1}$, because $v$
// changes by about $2 w$ along each edge. The coercivity constant, chapter 28's (i), falls
// at least like $h^2$ on shape-regular meshes (proved). A smooth load hardly excites this
// mode (measured below). **A contact force at one node does.**
//
// **Stabilised is selective.** On a cell $u$ is an affine function of $x$ and $y$ plus a
// multiple of $S T$, because $1$, $x$, $y$ and $S T$ are independent there. The gradient of
// $S T$ is 0 at the centre. So its mean is 0, and the mixed term of the energy vanishes.
// The reduced form and the form of the hourglass part together are the full form, on each
// quadrilateral (proved). So what is called *stabilised* here has the full $a_1$, and the
// $a_0$ of one point. Programs multiply the hourglass part by a smaller number. In $a_0$ it
// is left out on purpose: exercise 1.
//
// ## Rubber: the same switch, another count
//
// In [chapter 26](../26_elasticity/26_elasticity.cpp) the condition is
// $\operatorname{div} u = 0$, for a displacement with $Q_1$ in both components. By the same
// cancellation $|J| \operatorname{div} u$ is affine in $s$ and $t$. So B-bar is selective
// integration here, too, and full integration has three conditions per cell, the three
// coefficients. There are about as many vertices as cells, $n^2$ each. Count:
//
// - in the layer of (23): one unknown per vertex, and one condition per cell: about 0 left;
// - in rubber: *two* unknowns per vertex, and one condition per cell: about $n^2$ left.
//   This is as many as chapter 26 asks for. With full integration there are $3 n^2$
//   conditions.
//
// **So the switch that only hides locking in the layer may cure it in rubber.** The number
// of functions that are left decides, and not the switch. (For pressures this number is not
// enough: one pressure per cell is not stable on squares. Chapter 29 is about this.)
//
// ## Where the error goes
//
// Where nothing is left of the layer, the error at ε = 0 is at least the norm of $u^0$ on
// the layer, as in [chapter 13](../13_uniform/13_uniform.cpp).

#include "antilock/analysis/kernel.hpp"
#include "antilock/exact/exact_norms.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "antilock/form/strain_projection.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/models/project_strain.hpp"
#include "course/course.hpp"
#include "course/rubber.hpp"
#include "support.hpp"

using namespace antilock;
using tutorial::Exact;

// ### Mesh
const std::vector<std::string> families{"structured", "jittered", "recombined"};
Mesh family_mesh(const std::string& family, int cells,
                 const Domain& squares = {1, CellKind::quadrilateral}) {
  if (family == "structured") return structured_mesh(cells, squares);
  if (family == "jittered") return jittered_mesh(cells, 0.2, squares);
  return unstructured_mesh(cells, squares);
}

// ### Forms
// A switch is an element, which knows its points, and up to two changes of the problem: the
// layer strain is replaced by its means over cells, and the form of the hourglass part is
// added to $a_1$. In that form the layer has the stiffness 1 along itself, and `across`
// across itself.
struct Switch {
  std::string name;
  const Element* element;
  bool means = false, stabilised = false;
};
const Switch full{"full", &q1()}, selective{"selective", &q1(Integration::selective)},
    b_bar{"B-bar", &q1(), true}, reduced{"reduced", &q1(Integration::reduced)},
    stabilised{"stabilised", &q1(Integration::reduced), false, true},
    rotated{"rotated", &rotated_q1_plus()},
    rotated_means{"rotated, means", &rotated_q1_plus(), true};
const std::vector<Switch> switches{full,       selective, b_bar,        reduced,
                                   stabilised, rotated,   rotated_means};

VariationalInequality assemble(const Scene& scene, const Space& space, const Switch& choice,
                               double across = 0) {
  VariationalInequality problem = assemble(scene, space);
  if (choice.means) problem = project_strain(problem, cell_projection(layer_strain(space)));
  if (choice.stabilised) {
    const FactoredForm form = hourglass_form(space, {1, 1}, {1, across});
    problem.a1 += SparseMatrix(form.b.transpose() * form.m.asDiagonal() * form.b);
  }
  return problem;
}

// ### Solve
// Between 1e-6 and 0 the conditions of selective integration depend on each other so nearly
// that the solver refuses some meshes with $h < 1/16$ (at ε = 1e-8 from $h = 1/20$ on).
const std::vector<double> epsilons{1,    0.3,  0.1,  0.03, 0.01, 3e-3,
                                   1e-3, 1e-4, 1e-5, 1e-6, 0};

// One switch on one mesh at every ε, in contact.
Table solve_all(const Switch& choice, const std::string& family, int cells,
                const std::vector<Exact>& exact_solutions) {
  const Space space(family_mesh(family, cells), *choice.element);
  Sweep sweep(assemble(tutorial::paper_scene(1), space, choice));
  Table rows(
      {"method", "switch", "mesh", "cells", "h", "unknowns", "epsilon", "h1", "kept"});
  for (const Exact& exact : exact_solutions) {
    sweep.set_compliance(exact.epsilon * exact.epsilon);
    Solution solution = sweep.solve();
    solution.p.resize(0);  // errors of u alone: means are no stresses at points
    const double largest = solution.u(space.contact_dofs()).maxCoeff();
    rows.add({choice.name + " " + family, choice.name, family, cells, 1.0 / cells,
              space.free_count(), exact.epsilon, exact.errors(space, solution).h1,
              largest / exact.solution.max_on_contact()});
  }
  return rows;
}

// The functions without strain, the coercivity constant α of $a_1 + a_0$, and the patch
// test.
Table describe(const std::vector<int>& cells) {
  Table rows({"switch", "mesh", "cells", "kernel", "derived", "alpha", "patch"});
  for (const std::string& family : families)
    for (const int n : cells)
      for (const Switch& choice : switches) {
        const Space space(family_mesh(family, n), *choice.element);
        const VariationalInequality problem =
            assemble(tutorial::paper_scene(1), space, choice);
        const tutorial::LayerCounts layer = tutorial::layer_counts(space.mesh());
        int derived = family == "structured" ? n - 1 : 0;
        if (&choice == &switches.back())
          derived = 2 * layer.cells + (layer.sigma + layer.bottom - layer.sides) / 2;
        // Q1-reduced has the unknowns of Q1, and its norm is that of Q1
        const Element& norm = choice.element->conforming() ? q1() : *choice.element;
        rows.add({choice.name, family, n, layer_kernel_dimension(problem), derived,
                  coercivity(problem, h1_gram_matrix(Space(space, norm))),
                  tutorial::patch_test(space, problem)});
      }
  return rows;
}

// A pin of the height 0.1 below the middle of $Γ_C$, at ε = 1 and without a load. The
// obstacle is far away elsewhere.
Scene pin_scene(int cells) {
  const auto gap = [=](double x) { return std::abs(x - 0.5) < 0.25 / cells ? -0.1 : 1; };
  return Scene(Body{[](double, double) { return 0.0; }}, StiffLayer{1},
               UnilateralContact{gap});
}
Solution solve_pin(const Space& space, int cells, const Switch& choice) {
  return active_set(assemble(pin_scene(cells), space, choice));
}
// The force of the pin, and u at the node beside it over the height of the pin.
Table press(int cells) {
  Table rows({"switch", "mesh", "force", "neighbour"});
  for (const char* family : {"structured", "jittered"})
    for (const Switch& choice : {full, selective, reduced, stabilised}) {
      const Space space(family_mesh(family, cells), *choice.element);
      const Solution solution = solve_pin(space, cells, choice);
      const auto middle = static_cast<int>(space.contact_dofs().size()) / 2;
      rows.add({choice.name, family, solution.lambda.sum(),
                solution.u(space.contact_dofs()[middle + 1]) / 0.1});
    }
  return rows;
}

// Rubber on the obstacle of chapter 26, $Q_1$ for both components: the functions without
// divergence over the unknowns that are free, and the contact force.
Table press_rubber(const std::vector<int>& cells) {
  Table rows({"switch", "mesh", "cells", "free", "conditions", "kernel", "percent"});
  for (const std::string& family : families)
    for (const int n : cells) {
      const Domain body{0, CellKind::quadrilateral};
      const Mesh mesh = with_free_sides(family_mesh(family, n, body));
      for (const Switch& choice : {full, selective, b_bar, reduced}) {
        const Space space(mesh, *choice.element);
        PlaneStrain scene;
        scene.epsilon = 1e-8;
        scene.gap = [](double x) { return (x - 0.5) * (x - 0.5); };
        VariationalInequality problem = assemble(scene, VectorSpace{space, space});
        if (choice.means) {
          const FactoredForm div = divergence({space, space});
          problem = project_strain(problem, cell_projection(div));
        }
        const double force = active_set(problem).lambda.sum();
        rows.add({choice.name, family, n, 2 * space.free_count(), problem.b.rows(),
                  kernel_dimension(problem),
                  tutorial::percent_too_large(force, scene.epsilon)});
      }
    }
  return rows;
}

// ### Output
// The mesh and the solutions that the second program compares.
void write_second_opinion(const std::filesystem::path& out) {
  Table values({"switch", "u"});
  const Mesh mesh = family_mesh("jittered", 8);
  for (const Switch& choice :
       {full, selective, b_bar, reduced, stabilised, rotated_means}) {
    const Space space(mesh, *choice.element);
    const Solution solution =
        active_set(assemble(tutorial::paper_scene(0.01), space, choice));
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (const int unknown : space.cell_dofs().row(t))
        values.add({choice.name, solution.u(unknown)});
  }
  tutorial::write_mesh(out, mesh);
  values.write(out / "second_opinion.csv");
}

void judge_forms(const Table& forms, tutorial::Report& report) {
  const Table known = forms.filter_number("derived", [](double n) { return n >= 0; });
  report.claim(known.numbers("kernel") == known.numbers("derived"),
               "functions without strain: as derived in {} cases", known.size());
  double difference = 0, to_full = 0;
  for (const std::string& family : families) {
    const Mesh mesh = family_mesh(family, 6);
    const Scene scene = tutorial::paper_scene(1);
    const auto problem = [&](const Switch& choice) {
      return assemble(scene, Space(mesh, *choice.element), choice);
    };
    const VariationalInequality one = problem(selective), means = problem(b_bar);
    difference = std::max({difference, (one.b - means.b).norm() / one.b.norm(),
                           (one.m - means.m).norm() / one.m.norm()});
    to_full = std::max(to_full, (problem(stabilised).a1 - one.a1).norm() / one.a1.norm());
  }
  report.claim(difference < 1e-13,
               "B-bar is selective integration on all three meshes, to {:.0e} (proved)",
               difference);
  report.claim(
      to_full < 1e-13,
      "stabilised is selective integration on all three meshes, to {:.0e} (proved)",
      to_full);
  for (const Switch& choice : switches)
    report.claim(forms.filter("switch", choice.name).max("patch") < 1e-10,
                 "{} passes the patch test on each mesh (proved): {:.0e}", choice.name,
                 forms.filter("switch", choice.name).max("patch"));
}
void judge_coercivity(const Table& forms, tutorial::Report& report) {
  for (const std::string& family : families) {
    const Table own = forms.filter("mesh", family);
    const double order = own.filter("switch", "reduced").order("alpha", "cells");
    report.claim(
        order < -1.3,
        "{}, reduced: alpha is at most C h^2 (proved), and has the order {:.2f} from 1/4 "
        "to 1/8 (observed)",
        family, -order);
    for (const Switch* choice : {&selective, &stabilised, &rotated_means}) {
      const Table rows = own.filter("switch", choice->name);
      report.claim_within(rows.min("alpha"), 0.2, 0.9129,
                          fmt::format("{}, {}: the smallest alpha (bounded below: proved)",
                                      family, choice->name));
    }
  }
}

// The ε at which half of the displacement is kept: where $1/(1 + k^2/ε^2)$ is the share
// that is kept, as at small ε, it is $k$.
Table lengths(const Table& all) {
  Table rows({"mesh", "h", "switch", "k"});
  constexpr double small = 1e-6;
  for (const Table& row : all.filter("epsilon", small).rows()) {
    if (row.number("kept") > 0.5) continue;  // nothing is lost
    rows.add({row.entry("mesh"), row.number("h"), row.entry("switch"),
              small * std::sqrt(1 / row.number("kept") - 1)});
  }
  return rows;
}

void judge_errors(const Table& all, double lost, tutorial::Report& report) {
  const auto worst = [&](const std::string& method) {
    return tutorial::supremum(all.filter("method", method), "h1", "epsilon").rows;
  };
  for (const std::string& family : families)
    report.claim_order(worst("rotated, means " + family), "worst", "h", 0.8, 1.2,
                       fmt::format("rotated, means, {}: worst H1 error over epsilon "
                                   "(it falls: proved; order observed)",
                                   family));
  for (const char* choice : {"full", "selective", "stabilised"})
    report.claim_order(worst(std::string(choice) + " structured"), "worst", "h", 0.8, 1.2,
                       fmt::format("{}, structured: worst H1 error (observed)", choice));
  for (const char* family : {"jittered", "recombined"})
    for (const char* choice : {"full", "selective", "reduced", "stabilised", "rotated"}) {
      const Table rows = all.filter("switch", choice).filter("mesh", family);
      const Table rigid = rows.filter("epsilon", 0);
      report.claim(rigid.max("kept") < 1e-6 && rigid.min("h1") >= lost,
                   "{}, {}: nothing is left of the layer at epsilon = 0, and the error is "
                   "at least {:.3f} (proved), on the finest mesh {:.3f}",
                   choice, family, lost, rigid.last("h1"));
    }
}

void judge_lengths(const Table& k, tutorial::Report& report) {
  for (const char* family : {"jittered", "recombined"}) {
    const auto length_of = [&](const char* name) {
      return k.filter("mesh", family)
          .filter("switch", name)
          .filter("h", 1.0 / 16)
          .number("k");
    };
    const double ratio = length_of("full") / length_of("selective");
    report.claim(
        ratio > 10,
        "{}, h = 1/16: selective integration loses half at epsilon = {:.2g}, {:.0f} "
        "times smaller than full integration (observed)",
        family, length_of("selective"), ratio);
  }
}

void judge_rubber(const Table& rubber, tutorial::Report& report) {
  for (const std::string& family : families) {
    const auto rows_of = [&](const Switch& one) {
      return rubber.filter("mesh", family).filter("switch", one.name);
    };
    const Table one = rows_of(selective);
    bool independent = true;
    for (const Table& row : one.rows())
      independent = independent &&
                    row.number("kernel") == row.number("free") - row.number("conditions");
    report.claim(
        independent,
        "rubber, {}: no condition of selective integration follows from the others "
        "(observed)",
        family);
    report.claim(std::abs(one.last("percent") - rows_of(b_bar).last("percent")) < 1e-3,
                 "rubber, {}: B-bar has the same force (proved)", family);
    report.claim(std::abs(one.last("percent")) < 1 && rows_of(full).last("percent") > 1000,
                 "rubber, {}: the force is {:.2f} % too large with one condition per cell, "
                 "and {:.2g} % with full integration (observed)",
                 family, one.last("percent"), rows_of(full).last("percent"));
  }
}

void print_tables(const Table& forms, const Table& all, const Table& pins,
                  const Table& rubber) {
  forms.filter("cells", 6)
      .pivot("switch", "mesh", "kernel")
      .print("functions without strain, 1/h = 6");
  forms.filter("cells", 8)
      .pivot("switch", "mesh", "alpha")
      .print("coercivity constant, 1/h = 8", 3);
  const Table finest = all.filter("cells", all.max("cells"));
  for (const std::string& family : families)
    finest.filter("mesh", family)
        .pivot("epsilon", "switch", "kept")
        .print("kept, " + family, 3);
  for (const std::string& family : families)
    finest.filter("mesh", family)
        .pivot("epsilon", "switch", "h1")
        .print("H1 error, " + family, 3);
  Table suprema({"mesh", "h", "switch", "worst"});
  for (const std::string& family : families)
    for (const Switch& choice : switches)
      if (choice.name != b_bar.name)
        for (const Table& row :
             tutorial::supremum(all.filter("method", choice.name + " " + family), "h1",
                                "epsilon")
                 .rows.rows())
          suprema.add({family, row.number("h"), choice.name, row.number("worst")});
  for (const std::string& family : families)
    suprema.filter("mesh", family)
        .pivot("h", "switch", "worst")
        .print("worst H1 error over epsilon, " + family, 3);
  pins.print("force of the pin", 3);
  rubber.filter("cells", 32).print("rubber, 1/h = 32, lambda = 1e8", 3);
  for (const char* family : {"jittered", "recombined"})
    lengths(all)
        .filter("mesh", family)
        .pivot("h", "switch", "k")
        .print(fmt::format("epsilon at which half is kept, {}", family), 3);
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  std::vector<int> cells;
  for (const int n : {6, 8, 12, 16, 24, 32})
    if (n <= options.cells) cells.push_back(n);
  report.stage("kernels, coercivity, patch test");
  const Table forms = describe({4, 6, 8});
  report.stage("exact solutions");
  const std::vector<Exact> exact = tutorial::exact_solutions(epsilons, 14);
  Table all(
      {"method", "switch", "mesh", "cells", "h", "unknowns", "epsilon", "h1", "kept"});
  for (const std::string& family : families) {
    report.stage(family);
    for (const Switch& choice : switches)
      if (choice.name != b_bar.name)
        for (const int n : cells) all.add(solve_all(choice, family, n, exact));
  }
  report.stage("a pin");
  const Table pins = press(16);
  for (const Switch& choice : {reduced, stabilised}) {
    const Space space(family_mesh("structured", 16), *choice.element);
    write_vtu(options.out / (choice.name + "_pin.vtu"), space,
              solve_pin(space, 16, choice).u);
  }
  write_second_opinion(options.out);
  report.stage("rubber");
  const Table rubber = press_rubber({8, 16, 32});
  report.finish();
  print_tables(forms, all, pins, rubber);
  all.write(options.out / "runs.csv");
  all.filter("cells", cells.back())
      .filter("mesh", "recombined")
      .filter_number("epsilon", [](double epsilon) { return epsilon > 1e-7; })
      .write(options.out / "errors.csv");
  judge_forms(forms, report);
  judge_coercivity(forms, report);
  judge_errors(all, layer_norm(exact.back().solution), report);
  judge_lengths(lengths(all), report);
  judge_rubber(rubber, report);
}

// ## What came out
//
// :output: functions without strain
//
// (a) **None of the four.** On the jittered and on the recombined mesh (gmsh's triangles,
// joined in pairs) each of them has no function without strain. The rotated element of full
// integration has none either: being nonconforming alone is no cure. With means over cells
// it has 72 functions on the two meshes of squares, two for each of 36 cells.
// :number: 72 = table "functions without strain" jittered switch="rotated, means"
// :number: 36 = 0.5 * table "functions without strain" jittered switch="rotated, means"
//
// (b) Not at all: the matrices agree to round-off. (c) Two: the constants and the
// hourglass mode.
//
// :figure: switches_errors
//
// :output: kept, recombined
//
// **Selective integration hides locking.** On the recombined mesh with $h = 1/16$ it keeps
// 0.988 of the displacement at ε = 1e-3, where full integration keeps 0.00255. At ε = 1e-5
// it keeps 0.006. A test at one ε finds nothing wrong.
// :number: 0.988 = table "kept, recombined" selective epsilon=0.001
// :number: 0.00255 = table "kept, recombined" full epsilon=0.001
// :number: 0.006 = table "kept, recombined" selective epsilon=1e-05
//
// :output: epsilon at which half is kept, jittered
//
// :output: epsilon at which half is kept, recombined
//
// With full integration half is lost at ε = 0.27 $h$ on the jittered meshes. With one
// condition per cell it is lost at a much smaller ε, in which no law is seen: from
// $h = 1/12$ to $1/16$ on recombined meshes it *rises*, from 3.87e-05 to 0.000129. There is
// one condition more than there are unknowns, and it depends on the mesh how nearly the
// conditions depend on each other.
// :number: 0.27 = 16 * table "epsilon at which half is kept, jittered" full h=0.0625
// :number: 3.87e-05 = table "epsilon at which half is kept, recombined" selective h=0.0833
// :number: 0.000129 = table "epsilon at which half is kept, recombined" selective h=0.0625
//
// :output: worst H1 error over epsilon, recombined
//
// So the worst error over ε is the same as with full integration: 0.172 at $h = 1/16$. The
// rotated element with means has 0.12, and its order is 1 on all three families (observed).
// On an aligned mesh, where nothing has to be cured, its worst error is 5 % above that of
// $Q_1$, with three times as many unknowns.
// :number: 0.172 = table "worst H1 error over epsilon, recombined" selective h=0.0625
// :number: 0.12 = table "worst H1 error over epsilon, recombined" "rotated, means" h=0.0625
//
// :output: coercivity constant
//
// :output: force of the pin
//
// One point for all has a coercivity constant of 0.0592 on squares with $h = 1/8$, where
// full integration has 0.914. (From $h = 1/4$ to $1/8$ it falls more slowly than $h^2$:
// the proof is about small $h$.) The pin at ε = 1 finds the mode: on squares the neighbour
// of the pin stays at 0, and the force is 0.0437 in place of 0.07. On the jittered mesh the
// neighbour has 0.0418 of the height. With the paper's smooth load nothing of this is seen:
// the errors of *reduced* and *selective* differ by less than 5 % at each ε.
// :number: 0.0592 = table "coercivity constant" structured switch=reduced
// :number: 0.914 = table "coercivity constant" structured switch=full
// :number: 0.0437 = table "force of the pin" force switch=reduced mesh=structured
// :number: 0.07 = table "force of the pin" force switch=full mesh=structured
// :number: 0.0418 = table "force of the pin" neighbour switch=reduced mesh=jittered
//
// :output: rubber, 1/h
//
// In rubber the same switch cures. With full integration 32 functions are left on squares,
// of 2112 unknowns, and 1 on the jittered mesh: the contact force is thousands of times too
// large. With one condition per cell 1088 are left, as many as there are unknowns less
// conditions, and the force is right to 0.3 % on each mesh.
// :number: 2112 = table "rubber, 1/h = 32" free switch=full mesh=structured
// :number: 1088 = table "rubber, 1/h = 32" kernel switch=selective mesh=structured
//
// **Which switch?**
//
// | switch | cures | hides | costs |
// | --- | --- | --- | --- |
// | full integration | nothing; right on aligned meshes | | |
// | selective, B-bar (in the plane the same) | rubber, in its displacement; in the layer nothing, unless the cells are aligned | locking, down to an ε that depends on the mesh by chance | nothing: a quarter of the rows of $B$ |
// | reduced | nothing | the same, and its own modes under smooth loads | stability: α falls like $h^2$, and contact at a node finds it |
// | stabilised (with the factor 1 the same as selective) | the modes of reduced, not locking | as selective | a parameter; with the modulus of the layer it locks as full integration does (exercise 1) |
// | rotated, full integration | nothing | as selective | three times as many unknowns |
// | rotated, means over cells | locking, on shape-regular meshes (proved) | nothing | the same; without $S T$ the patch test (exercise 2) |
//
// The cure is neither of the two alone. *Means over cells ask one condition per cell, and
// means over edges have the functions that satisfy it*: both are the same Green's formula.
// Aligned cells are a cure as well, and a cheaper one.
//
// **A second opinion.** FreeFEM has no quadrilaterals. So the tests have a program in plain
// Python (`tests/chapters/switches/independent.py`) that uses nothing of the library. It
// assembles the six forms from their definitions on the jittered mesh with $h = 1/8$, and
// solves the inequality at ε = 0.01. Each solution agrees to 1e-12 of its largest value.
//
// ## Exercises
//
// 1. Stabilise the layer with its own modulus: add $ε^{-2}$ times the energy of the
//    hourglass part across the layer. What becomes of locking on the jittered mesh?
// 2. The rotated element of four functions, with means over cells. How many functions
//    without strain has it, does it lock, and does it converge on the jittered meshes?
// 3. On paper: let Σ and $Γ_C$ have $n$ edges, and each of the two sides of the layer $m$.
//    How many functions does selective integration leave at least, on any mesh?
//
// ## Further reading
//
// - S. C. Brenner, *Poincaré-Friedrichs inequalities for piecewise $H^1$ functions*, SIAM
//   J. Numer. Anal. 41 (2003), 306-324,
//   [doi:10.1137/S0036142902401311](https://doi.org/10.1137/S0036142902401311).
// - Z. Cai, J. Douglas, J. E. Santos, D. Sheen, X. Ye, *Nonconforming quadrilateral finite
//   elements: a correction*, Calcolo 37 (2000), 253-254. The fifth function.
// - D. P. Flanagan, T. Belytschko, *A uniform strain hexahedron and quadrilateral with
//   orthogonal hourglass control*, Int. J. Numer. Methods Eng. 17 (1981), 679-706,
//   [doi:10.1002/nme.1620170504](https://doi.org/10.1002/nme.1620170504).
// - T. J. R. Hughes, *Generalization of selective integration procedures to anisotropic and
//   nonlinear media*, Int. J. Numer. Methods Eng. 15 (1980), 1413-1418,
//   [doi:10.1002/nme.1620150914](https://doi.org/10.1002/nme.1620150914). B-bar.
// - D. S. Malkus, T. J. R. Hughes, *Mixed finite element methods, reduced and selective
//   integration techniques: a unification of concepts*, Comput. Methods Appl. Mech. Eng. 15
//   (1978), 63-81,
//   [doi:10.1016/0045-7825(78)90005-1](https://doi.org/10.1016/0045-7825%2878%2990005-1).
// - R. Rannacher, S. Turek, *Simple nonconforming quadrilateral Stokes element*, Numer.
//   Methods Partial Differ. Equ. 8 (1992), 97-111,
//   [doi:10.1002/num.1690080202](https://doi.org/10.1002/num.1690080202).

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "40_switches",
      "switches against locking on quadrilaterals: what each of them cures",
      {.takes_epsilon = false,
       .cells = 16,
       .least_cells = 16,
       .most_cells = 32,
       .exercises = exercises},
      study);
}
