// Nearly incompressible elasticity on a rigid obstacle: the same inequality, the same solver, five
// discretisations.
//
// Run: 23_elasticity                          epsilon = 1/lambda = 1e-8, 32 cells
// Run: 23_elasticity --epsilon 0 --cells 16   incompressible
//
// Here epsilon is the parameter of the class, (1): epsilon = 1/lambda, not its square as in (23).
//
// What the picture shows. A block of rubber hangs under a rigid plate, its sides free, and is
// pushed by 0.1 on the obstacle y = -(x - 1/2)^2. Rubber keeps its volume, so the block bulges to
// both sides. P1 triangles cut by parallel diagonals hardly can: the left side does not move at
// all, the pressure is noise, and the contact force is nearly three times the true one.
// Crouzeix-Raviart on the very same triangles bulges evenly.
//
// Why. In plane strain with mu = 1 the energy is int eps(u):eps(u) + (lambda/2) int (div u)^2: the
// paper's class with a0 = int div u div v and epsilon = 1/lambda. As lambda grows, div u = 0 is
// asked of every triangle, on which div u is constant: one condition per triangle. P1 has one
// unknown per triangle; 2n functions are left, too few. Three cures:
//   - crossed triangles: in every square one of the four conditions follows from the other three;
//   - Crouzeix-Raviart, three unknowns per triangle. With the symmetric gradient it has zero modes
//     that are not rigid (no Korn inequality); the jumps over edges, penalised with weight 1,
//     remove them (Hansbo and Larson 2003);
//   - Kouhia and Stenberg (1995): P1 for one component, Crouzeix-Raviart for the other. It needs no
//     jumps.
// Reference for the contact force: Taylor-Hood (P2-P1) on graded meshes, freefem/23_elasticity.edp.

#include <cmath>
#include <map>

#include "antilock/analysis/kernel.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

// A discretisation: triangles, an element per component, and whether edges need their jumps
// penalised.
struct Rubber {
  std::string name, file;
  TriangleMesh mesh;
  const Element &in_x, &in_y;
  bool jumps, locks;
};
std::vector<Rubber> make_methods(int cells) {
  const Domain square{0};
  const TriangleMesh right = with_free_sides(structured_mesh(cells, square));
  const TriangleMesh crossed = with_free_sides(structured_mesh(cells, square, Diagonal::crossed));
  const TriangleMesh any = with_free_sides(unstructured_mesh(cells, square));
  return {{"P1 right diagonals", "p1_right", right, p1(), p1(), false, true},
          {"P1 unstructured", "p1_unstructured", any, p1(), p1(), false, true},
          {"P1 crossed triangles", "p1_crossed", crossed, p1(), p1(), false, false},
          {"Crouzeix-Raviart with jumps", "cr", right, crouzeix_raviart(), crouzeix_raviart(), true, false},
          {"Kouhia-Stenberg", "ks", right, p1(), crouzeix_raviart(), false, false}};
}

double gap(double x) { return (x - 0.5) * (x - 0.5); }  // of the obstacle below y = 0

// The problem: u = (0, -0.1) on top, u_y >= -gap below. It fills a1, B, M and the bounds; the rest
// is the scalar problem.
VariationalInequality pushed(const Rubber& rubber, const VectorSpace& space, double jump_weight) {
  PlaneStrain scene;
  scene.gap = gap;
  scene.jump_weight = rubber.jumps ? jump_weight : 0;
  return assemble(scene, space);
}

double patch_error(const Rubber& rubber, double epsilon);
int zero_modes(VariationalInequality problem);
double bulge(const Space& space, const Eigen::VectorXd& u, double side);
Eigen::VectorXd pressure(const Rubber& rubber, const Solution& solution);
void judge(const Table& checks, const Table& forces, const Table& errors, int cells, tutorial::Report& report);

void push(const tutorial::Options& options, tutorial::Report& report) {
  const std::map<double, double> reference{
      {1, 0.158792}, {1e-2, 0.255738}, {1e-4, 0.259131}, {1e-8, 0.259166}, {0, 0.259166}};
  Table checks({"element", "unknowns", "kernel", "patch", "zero_modes", "without_jumps", "bulge left", "right"});
  Table forces({"element", "lambda", "epsilon", "force", "corrections"});
  Table errors({"element", "lambda", "epsilon", "percent", "locks"});
  for (const Rubber& rubber : make_methods(options.cells)) {
    report.stage(rubber.name);
    const Space x(rubber.mesh, rubber.in_x), y(rubber.mesh, rubber.in_y);
    const VectorSpace space{x, y};
    const VariationalInequality problem = pushed(rubber, space, 1);

    // 1. The contact force at every lambda; its error in % where the reference is known. The forms
    //    do not hold lambda, and all large lambda share one factorisation.
    Sweep sweep(problem);
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0.0}) {
      sweep.set_compliance(epsilon);
      const Solution solution = sweep.solve();
      const double force = solution.lambda.sum();
      forces.add({rubber.name, 1 / epsilon, epsilon, force, solution.counters.corrections});
      if (const auto known = reference.find(epsilon); known != reference.end())
        errors.add({rubber.name, 1 / epsilon, epsilon, 100 * (force / known->second - 1), rubber.locks});
    }

    // 2. The deformed block at the epsilon asked for.
    sweep.set_compliance(options.epsilon);
    const Solution solution = sweep.solve();
    write_deformed_vtu(options.out / (rubber.file + ".vtu"), space, solution.u, pressure(rubber, solution));
    if (rubber.file == "p1_right") write_freefem_mesh(options.out / "mesh.freefem.msh", rubber.mesh);

    // 3. The checks that need no reference: what B leaves free, patch test, zero modes.
    checks.add({rubber.name, problem.free_count(), kernel_dimension(problem),
                std::max(patch_error(rubber, 1), patch_error(rubber, options.epsilon)), zero_modes(problem),
                rubber.jumps ? Entry(zero_modes(pushed(rubber, space, 0))) : Entry(""), bulge(x, solution.u, 0),
                bulge(x, solution.u, 1)});
  }
  report.finish();
  checks.print("", 2);
  errors.pivot("element", "lambda", "percent").print("error of the contact force in %, by lambda");
  forces.pivot("element", "lambda", "corrections").print("corrections, by lambda");
  forces.write(options.out / "force.csv");
  Table obstacle({"x", "y"});
  for (int i = 0; i <= 40; ++i) obstacle.add({-0.1 + 0.03 * i, -gap(-0.1 + 0.03 * i)});
  obstacle.write(options.out / "obstacle.csv");
  judge(checks, forces, errors, options.cells, report);
}

void judge(const Table& checks, const Table& forces, const Table& errors, int cells, tutorial::Report& report) {
  const Table jumping = checks.where("element", "Crouzeix-Raviart with jumps");
  report.claim(checks.most("patch") < 1e-12, "patch test: every method has the uniform strain to {:.0e}",
               checks.most("patch"));
  report.claim(jumping.number("without_jumps") == 2 * cells && checks.most("zero_modes") == 0,
               "motions of no energy: {} = 2n without jumps, {} in every method here", jumping.number("without_jumps"),
               checks.most("zero_modes"));
  double corrections = 0, worst = 0;
  for (const Entry& element : errors.where("locks", 0).different("element")) {
    const Table own = errors.where("element", element);
    corrections = std::max(corrections, forces.where("element", element).most("corrections"));
    worst = std::max({worst, own.most("percent"), -own.least("percent")});
  }
  report.claim(corrections <= 5, "at most {} corrections at any lambda where nothing locks", corrections);
  if (cells < 8) return report.not_judged("the contact force: fewer than 8 cells do not tell locked from inexact");
  const double locked = errors.where("locks", 1).where("epsilon", 0).least("percent");
  report.claim(locked > 100, "P1 on parallel or arbitrary triangles locks: force {:.0f} % too large or more", locked);
  report.claim(worst < 16.0 / cells, "the other three are off by {:.2f} % at most, at any lambda of the table", worst);
}

// Three things to try:
// - the pressure of P1 (p1_right.vtu in ParaView): up to 46, in stripes, where the true one stays
//   below 0.7.
// - 2 int grad u : grad v for 2 int eps(u) : eps(v) needs no jumps and is 39 % off: other
//   conditions on the free sides.
// - jump weights from 0.1 to 10 (PlaneStrain::jump_weight): the force moves by one per cent.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.least_cells = 2;  // below, no vertex of the obstacle is free in x
  options.epsilon = 1e-8;
  options.epsilon_is = "the class parameter of (1), 1/lambda; 0 is incompressible";
  return tutorial::run(argc, argv, "23_elasticity", "Nearly incompressible elasticity in contact: five discretisations",
                       options, push);
}

// Patch test: a uniform strain, u = (.1/(1 + 2 epsilon) x, -.1 y), is in every space and must come
// out exactly.
double patch_error(const Rubber& rubber, double epsilon) {
  const Space x(rubber.mesh, rubber.in_x), y(rubber.mesh, rubber.in_y);
  PlaneStrain scene;  // flat obstacle, touching
  scene.epsilon = epsilon;
  scene.sliding = true;
  scene.jump_weight = rubber.jumps ? 1 : 0;
  const Eigen::VectorXd u = active_set(assemble(scene, {x, y})).u;
  const Eigen::VectorXd in_x = u.head(x.size()) - 0.1 / (1 + 2 * epsilon) * x.points().col(0);
  return std::max(in_x.cwiseAbs().maxCoeff(), (u.tail(y.size()) + 0.1 * y.points().col(1)).cwiseAbs().maxCoeff());
}

// Dimension of the kernel of a1 on the free unknowns: the motions that cost no energy.
int zero_modes(VariationalInequality problem) {
  problem.b = problem.a1;
  problem.m = Eigen::VectorXd::Ones(problem.size());
  return kernel_dimension(problem);
}

// How far a side moves outwards, on average (the mean of an affine function over an edge is its
// value at the midpoint).
double bulge(const Space& space, const Eigen::VectorXd& u, double side) {
  const TriangleMesh& mesh = space.mesh();
  double mean = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      if (mesh.vertices(mesh.edges(e, 0), 0) != side || mesh.vertices(mesh.edges(e, 1), 0) != side) continue;
      const Eigen::VectorXd at_midpoint =
          space.element().basis(0.5 * (Eigen::Vector3d::Ones() - Eigen::Vector3d::Unit(i)));
      const Eigen::VectorXi unknowns = space.unknowns().row(t);
      mean += mesh.edge_length(e) * at_midpoint.dot(u(unknowns));
    }
  return side == 0 ? -mean : mean;
}

// The pressure -lambda div u. Crossed triangles carry a checkerboard in every square, which its
// mean removes.
Eigen::VectorXd pressure(const Rubber& rubber, const Solution& solution) {
  Eigen::VectorXd p = -solution.p;
  if (rubber.file == "p1_crossed")
    for (Eigen::Index square = 0; square < p.size() / 4; ++square)
      p.segment<4>(4 * square).setConstant(p.segment<4>(4 * square).mean());
  return p;
}
