// # Rubber on an obstacle
//
// Run: 26_elasticity                          ε = 1/λ = 1e-8, 32 cells, five discretisations
// Run: 26_elasticity --epsilon 0 --cells 16   incompressible
// Run: 26_elasticity --exercise 1
// Run: 26_elasticity --exercise 2
//
// Needs: [06](../06_p1_unstructured/06_p1_unstructured.cpp) for locking,
// [07](../07_kernel/07_kernel.cpp) for kernels,
// [08](../08_crouzeix_raviart/08_crouzeix_raviart.cpp) for Crouzeix–Raviart (CR). **Here ε
// is the parameter of the class (1) itself**, $ε = 1/λ$ (in (23) it is $ε^2$).
//
// **The picture.** A block of rubber hangs under a rigid plate, its sides free, and is
// pushed by 0.1 on the obstacle $y = -(x - 1/2)^2$. *P1 on parallel triangles hardly
// bulges, its left side not at all; its pressure is noise and its contact force nearly
// three times the true one. CR on the very same triangles bulges evenly.*
//
// **Predict.** Rubber keeps its volume: in the limit $\operatorname{div} u = 0$ is asked of
// every triangle. Count on $n × n$ squares cut in two: (a) how many conditions, and how
// many unknowns has P1? (b) And CR?
//
// ## Rubber in the class
//
// The body is in plane strain: nothing moves out of the plane. Its shear modulus is
// $μ = 1$, its strain is $e(u) = ½ (∇u + ∇u^T)$. On this page $λ$ is Lamé's parameter, the
// stiffness against a change of volume, and not the contact force of the other chapters.
// The energy is
//
// $$ ∫ e(u) : e(u) + \frac{λ}{2} ∫ (\operatorname{div} u)^2, $$
//
// the paper's class with $a_0 = ∫ \operatorname{div} u \operatorname{div} v$ and the class
// parameter $1/λ$. On a P1 or CR triangle $\operatorname{div} u$ is constant: one row of
// $B$ per triangle, $2n^2$ conditions. P1 has two unknowns per vertex that is not held:
// $2n(n + 1)$. On parallel triangles $2n$ functions are left.
//
// Is that too few? In chapter 07 structured P1 keeps $n - 1$ of the layer's some $n^2$
// unknowns, and it does not lock. There $G$ holds functions of one variable, and $n - 1$
// values describe them. Here $G$ holds the fields that keep the volume. In the plane these
// are $u = (∂_y φ, -∂_x φ)$ with a *stream function* $φ(x, y)$. A function of two variables
// asks for about $n^2$ values, and $2n$ of them cannot do. Three cures leave about $n^2$ or
// more:
//
// - *crossed triangles*: each square is cut by both diagonals, and one of its four
//   conditions follows from the other three;
// - *CR*, three unknowns per triangle. With $e(u)$ in place of $∇u$ it has motions without
//   energy that are not rigid: the triangles are joined at the midpoints of their edges
//   alone, as by hinges, and neighbours can turn against each other (picture). Then $e(u)$,
//   which does not see a rotation, is 0 on each triangle. The jumps over edges, penalised
//   with weight 1, remove these motions (Hansbo and Larson 2003);
// - *Kouhia–Stenberg* (1995): P1 for one component, CR for the other. It needs no jumps.
//
// :figure: hinges
//
// Two checks need no reference: a *patch test* (a uniform strain must come out exactly on
// any mesh) and the number of motions without energy. The reference of the contact force is
// Taylor–Hood, P2 with a continuous P1 pressure, on graded meshes
// (`freefem/26_elasticity.edp`). (In the file for pictures the pressure of P1 on crossed
// triangles is the mean over each square. Triangle by triangle it carries a checkerboard in
// every square: the fourth condition, which follows from the other three, has no pressure
// of its own. What that means is the subject of
// [pressures](../29_pressure/29_pressure.cpp).)

#include "antilock/study/sweep.hpp"
#include "course/add_row.hpp"
#include "course/rubber.hpp"
#include "support.hpp"

using namespace antilock;
using tutorial::Rubber;

double gap(double x) { return (x - 0.5) * (x - 0.5); }  // of the obstacle below y = 0

// ### Mesh
// A `Rubber` is one of five discretisations: triangles, an element per component, jumps to
// be penalised or not.
//
// ### Forms
// The integrals in C++, for a displacement with the unknowns `u`. On a triangle of P1 or CR
// its gradient is a matrix of four numbers: a row per component, summed over three basis
// functions. `assemble` has the same sums as matrices, and a verdict compares both.
struct Forms {
  double shear = 0, volume = 0;  // a_1(u, u) without jumps, and a_0(u, u)
};
Forms integrate(const VectorSpace& space, const Eigen::VectorXd& u) {
  const TriangleMesh& mesh = space.x.mesh();
  const Eigen::Vector3d centre = Eigen::Vector3d::Constant(1.0 / 3);
  Forms forms;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> hats = barycentric_gradients(mesh, t);
    const Eigen::VectorXi in_x = space.x.cell_dofs().row(t);
    const Eigen::VectorXi in_y = space.y.cell_dofs().row(t).array() + space.x.size();
    Eigen::Matrix2d gradient;
    gradient << u(in_x).transpose() * space.x.element().derivative(centre) * hats,
        u(in_y).transpose() * space.y.element().derivative(centre) * hats;
    const Eigen::Matrix2d strain = (gradient + gradient.transpose()) / 2;  // e(u)
    forms.shear += mesh.area(t) * 2 * strain.squaredNorm();                // 2 e(u) : e(u)
    forms.volume += mesh.area(t) * std::pow(gradient.trace(), 2);          // (div u)^2
  }
  return forms;
}

// How far the integrals of a field are from those of the matrices.
double apart(const VariationalInequality& problem, const VectorSpace& space) {
  Eigen::VectorXd u(space.size());
  u << space.x.dof_coordinates().rowwise().prod(), space.y.dof_coordinates().col(0);
  const Forms forms = integrate(space, u);
  return std::max(std::abs(forms.shear / u.dot(problem.a1 * u) - 1),
                  std::abs(forms.volume / (problem.b * u).cwiseAbs2().dot(problem.m) - 1));
}

// $u = (0, -0.1)$ on top, $u_y ≥ -$gap below. It fills $A_1$, $B$, $M$ and the bounds; the
// rest is the scalar problem's.
VariationalInequality pushed(const Rubber& rubber, const VectorSpace& space,
                             double jump_weight) {
  PlaneStrain scene;
  scene.gap = gap;
  scene.jump_weight = rubber.jumps ? jump_weight : 0;
  return assemble(scene, space);
}

// ## Order two, without jumps
//
// CR has motions without energy, because its functions are continuous in the mean of an
// edge alone, and a rotation of a triangle about the midpoint of an edge does not change
// that mean. Continuity in *two* means per edge, those with the hat functions of its ends,
// forbids it: a rotation is affine on the edge. Korn's inequality then holds with one
// constant on all shape-regular meshes, and without jumps (Brenner 2004, proved there).
//
// Parabolas that are continuous in these means are the element of *Fortin and Soulie*
// (1983). Continuity in both means is continuity at the two Gauss points of the edge. In
// this library it is the hybrid form of BDM1
// ([chapter 38](../38_order_two/38_order_two.cpp)) with one linear equation per triangle
// and component, $∑_j (a_j^+ - a_j^-) = 0$ (`space/fortin_soulie.cpp`). The equations are
// rows of $B$ with the compliance 0. So the iterated penalty treats them as it treats
// $\operatorname{div} u = 0$ in the limit.
// (Without them the element has a projected gradient, and no Korn inequality.)
//
// $\operatorname{div} u$ is affine on each triangle: three rows of $B$. The test is a
// smooth $u$ that keeps the volume, with $u = 0$ on three sides and no traction on the
// fourth, at λ = 1 and in the limit.
Table smooth_errors() {
  Table errors({"element", "epsilon", "h", "unknowns", "gradient"});
  for (const Element* element : {&crouzeix_raviart(), &fortin_soulie()})
    for (const double epsilon : {1.0, 0.0})
      for (const int n : {4, 8, 16, 32}) {
        const Space one(structured_mesh(n, Domain{0}), *element);
        PlaneStrain scene;  // with jumps for CR
        scene.epsilon = epsilon;
        scene.prescribed_displacement = 0;
        VariationalInequality problem = assemble(scene, {one, one});
        problem.bounds = {};
        problem.load << load_vector(one, tutorial::Swirl::load_x),
            load_vector(one, tutorial::Swirl::load_y);
        const Eigen::VectorXd u = active_set(problem).u;
        const double squared =
            tutorial::squared_gradient_error(one, u.head(one.size()), 0) +
            tutorial::squared_gradient_error(one, u.tail(one.size()), 1);
        errors.add(
            {element->name(), epsilon, 1.0 / n, problem.free_count(), std::sqrt(squared)});
      }
  return errors;
}

void judge(const Table& checks, const Table& forces, int cells, tutorial::Report& report);

void judge_smooth(const Table& errors, tutorial::Report& report) {
  for (const double epsilon : {1.0, 0.0}) {
    const Table here = errors.filter("epsilon", epsilon);
    report.claim_order(
        here.filter("element", "CR"), "gradient", "h", 0.8, 1.2,
        fmt::format("CR with jumps, epsilon = {}: gradient (observed)", epsilon));
    report.claim_order(here.filter("element", "FS"), "gradient", "h", 1.8, 2.2,
                       fmt::format("Fortin and Soulie without jumps, epsilon = {}: "
                                   "gradient (observed)",
                                   epsilon));
  }
}

void push(const tutorial::Options& options, tutorial::Report& report) {
  Table checks({"element", "unknowns", "kernel", "patch", "zero_modes", "without_jumps",
                "bulge left", "right", "forms"});
  Table forces({"element", "lambda", "epsilon", "force", "corrections", "percent", "known",
                "locks"});
  for (const Rubber& rubber : tutorial::rubbers(options.cells)) {
    report.stage(rubber.name);
    const Space x(rubber.mesh, rubber.in_x), y(x, rubber.in_y);
    const VectorSpace space{x, y};
    const VariationalInequality problem = pushed(rubber, space, 1);

    // ### Solve
    // The contact force at every λ; its error in % where the reference is known. The forms
    // do not hold λ, and all large λ share one factorisation.
    Sweep sweep(problem);
    for (const double epsilon :
         {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0.0}) {
      sweep.set_compliance(epsilon);
      const Solution solution = sweep.solve();
      const double force = solution.lambda.sum(),
                   percent = tutorial::percent_too_large(force, epsilon);
      tutorial::add_row(forces, {{"element", rubber.name},
                                 {"lambda", 1 / epsilon},
                                 {"epsilon", epsilon},
                                 {"force", force},
                                 {"corrections", solution.counters.corrections},
                                 {"percent", percent},
                                 {"known", !std::isnan(percent)},
                                 {"locks", rubber.locks}});
    }

    // ### Output
    // The deformed block at the ε asked for.
    sweep.set_compliance(options.epsilon);
    const Solution solution = sweep.solve();
    tutorial::write_block(options.out, rubber, space, solution);

    // The checks that need no reference: what $B$ leaves free, patch test, motions without
    // energy.
    const double patch = std::max(tutorial::patch_error(rubber, 1),
                                  tutorial::patch_error(rubber, options.epsilon));
    const VariationalInequality without = pushed(rubber, space, 0);
    tutorial::add_row(
        checks,
        {{"element", rubber.name},
         {"unknowns", problem.free_count()},
         {"kernel", kernel_dimension(problem)},
         {"patch", patch},
         {"zero_modes", tutorial::zero_modes(problem)},
         {"without_jumps", rubber.jumps ? TableEntry(tutorial::zero_modes(without)) : ""},
         {"bulge left", tutorial::bulge(x, solution.u, 0)},
         {"right", tutorial::bulge(x, solution.u, 1)},
         {"forms", apart(without, space)}});
  }
  report.stage("a smooth field that keeps the volume");
  const Table smooth = smooth_errors();
  report.finish();
  tutorial::show_rubber(options.out, checks, forces, gap);
  smooth.filter("epsilon", 0.0)
      .pivot("h", "element", "gradient")
      .print("lambda = infinity, a smooth field: error of the gradient, by h", 3);
  judge(checks, forces, options.cells, report);
  judge_smooth(smooth, report);
}

void judge(const Table& checks, const Table& forces, int cells, tutorial::Report& report) {
  const Table jumping = checks.filter("element", "Crouzeix-Raviart with jumps");
  report.claim(checks.max("patch") < 1e-12,
               "(proved) patch test: every method has the uniform strain to {:.0e}",
               checks.max("patch"));
  report.claim(checks.max("forms") < 1e-12,
               "(proved) u = (x y, x): the integrals are those of the matrices to {:.0e}",
               checks.max("forms"));
  report.claim(
      jumping.number("without_jumps") == 2 * cells && checks.max("zero_modes") == 0,
      "(observed) motions of no energy: {} = 2n without jumps, {} in every method here",
      jumping.number("without_jumps"), checks.max("zero_modes"));
  const auto kernel = [&](const char* element) {
    return checks.filter("element", element).number("kernel");
  };
  report.claim(kernel("P1 right diagonals") == 2 * cells &&
                   kernel("P1 crossed triangles") == cells * (cells + 2),
               "(observed) dim G_h of P1: {} = 2n on parallel triangles, {} on arbitrary "
               "ones, {} = n^2 + 2n on crossed ones",
               kernel("P1 right diagonals"), kernel("P1 unstructured"),
               kernel("P1 crossed triangles"));
  const Table free = forces.filter("locks", 0), known = free.filter("known", 1);
  const double corrections = free.max("corrections"),
               worst = std::max(known.max("percent"), -known.min("percent"));
  report.claim(corrections <= 4,
               "(observed) {} corrections at most at any lambda where nothing locks",
               corrections);
  if (cells < 8)
    return report.not_judged(
        "the contact force: fewer than 8 cells do not tell locked from inexact");
  const Table limit = forces.filter("locks", 1).filter("epsilon", 0),
              soft = forces.filter("locks", 1).filter("epsilon", 1);
  report.claim(
      limit.min("percent") > 150 &&
          soft.max("percent") < 100 * std::pow(cells, -1.5),  // 51 to 86 on 8 to 64 cells
      "(observed) P1 on parallel or arbitrary triangles locks: force {:.0f} % too large or "
      "more in the limit, right "
      "to {:.2f} % at lambda = 1",
      limit.min("percent"), soft.max("percent"));
  // The end of contact is known to a cell: a multiple of $h$ that jumps from mesh to mesh.
  report.claim(
      worst < 22.0 / cells,
      "(observed) the other three are off by {:.0f} h per cent, at any lambda of the table",
      worst * cells);
}

// ## What came out
//
// (a) $2n^2$ conditions and about as many unknowns. (b) As many conditions, and three times
// as many unknowns. Where nothing locks the force is right to 11 h per cent at every λ
// ($h = 1/32$), in at most 2 corrections. P1 on parallel or arbitrary triangles is right at
// λ = 1, and more than 100 % off in the limit. The pressure of P1 reaches 46 in stripes,
// where that of CR stays below 0.7, and Taylor–Hood's at about 1 (chapter 29).
// :number: 11 = line "are off by {} h per cent"
//
// Fortin and Soulie's element has order 2 for the smooth field, at λ = 1 and in the limit,
// and CR with its jumps has order 1. It needs no jumps.
// :output: lambda = infinity, a smooth field
//
// :figure: elasticity_force
// :live: rubber
//
// ## Exercises
//
// 1. CR penalises its jumps with weight 1. Between weight 0.1 and 10, how much does the
//    contact force change, on 8 and on 16 cells?
// 2. Count what is left at 1/h = 4 and 8: how does $\dim G_h$ of P1 grow under refinement?
//    And that of CR?
// 3. On paper: in a crossed square, why does the fourth condition follow from three?
//
// ## Further reading
//
// - S. C. Brenner, *Korn's inequalities for piecewise $H^1$ vector fields*, Math. Comp. 73
//   (2004), doi:10.1090/S0025-5718-03-01579-5
// - M. Fortin, M. Soulie, *A non-conforming piecewise quadratic finite element on
//   triangles*, Int. J. Numer. Methods Eng. 19 (1983), doi:10.1002/nme.1620190405

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "26_elasticity",
      "Nearly incompressible elasticity in contact: five discretisations",
      {.epsilon = 1e-8,
       .epsilon_is = "the class parameter of (1), 1/lambda; 0 is incompressible",
       .least_cells = 2,  // below, no vertex of the obstacle is free in x
       .exercises = exercises},
      push);
}
