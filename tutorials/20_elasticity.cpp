// Nearly incompressible elasticity on a rigid obstacle: the same inequality, the same solver, five discretisations.
//
// Run: 20_elasticity                          epsilon = 1/lambda = 1e-8, 32 cells
// Run: 20_elasticity --epsilon 0 --cells 16   incompressible
//
// What the picture shows. A block of rubber hangs under a rigid plate, its sides free, and is pushed by 0.1 on the
// obstacle y = -(x - 1/2)^2. Rubber keeps its volume, so the block bulges to both sides. P1 triangles cut by parallel
// diagonals hardly can: the left side does not move at all, the pressure is noise, and the obstacle answers with nearly
// three times the true force. Crouzeix-Raviart on the very same triangles bulges evenly.
//
// Why. In plane strain with mu = 1 the energy is int eps(u):eps(u) + (lambda/2) int (div u)^2: the paper's class with
// a0 = int div u div v and epsilon = 1/lambda. As lambda grows, div u = 0 is asked of every triangle, on which div u is
// constant: one condition a triangle. P1 has one unknown a triangle; 2n functions are left, too few. Three cures:
//   - crossed triangles: in every square one of the four conditions follows from the other three;
//   - Crouzeix-Raviart, three unknowns a triangle. With the symmetric gradient it has zero modes that are not rigid (no
//     Korn inequality); the jumps over edges, penalised with weight 1, remove them (Hansbo and Larson 2003);
//   - Kouhia and Stenberg (1995): P1 for one component, Crouzeix-Raviart for the other. Locks no more, needs no jumps.
// Reference for the contact force: Taylor-Hood (P2-P1) on graded meshes, freefem/20_elasticity.edp.

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "antilock/analysis/kernel.hpp"
#include "antilock/core/atomic_file.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/active_set.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

// A discretisation: triangles, an element a component, and whether edges need their jumps penalised.
struct Method {
  std::string name, file;
  TriangleMesh mesh;
  const Element &in_x, &in_y;
  bool jumps, locks;
};

std::vector<Method> make_methods(int cells) {
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

// The platen: u = (0, -0.1) on top, u_y >= -gap below. It fills a1, B, M and the bounds; the rest is the scalar
// problem.
VariationalInequality platen(const Method& method, const VectorSpace& space, double jump_weight) {
  PlaneStrain scene;
  scene.gap = gap;
  scene.jump_weight = method.jumps ? jump_weight : 0;
  return assemble(scene, space);
}

// Patch test: a uniform strain, u = (.1/(1 + 2 epsilon) x, -.1 y), is in every space and must come out exactly.
double patch_error(const Method& method, double epsilon) {
  const Space x(method.mesh, method.in_x), y(method.mesh, method.in_y);
  PlaneStrain scene;  // flat obstacle, touching
  scene.epsilon = epsilon;
  scene.sliding = true;
  scene.jump_weight = method.jumps ? 1 : 0;
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

// How far a side moves outwards, on average (the mean of an affine function over an edge is its value at the midpoint).
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

// The pressure -lambda div u. Crossed triangles carry a checkerboard in every square, which its mean removes.
Eigen::VectorXd pressure(const Method& method, const Solution& solution) {
  Eigen::VectorXd p = -solution.p;
  if (method.file == "p1_crossed")
    for (Eigen::Index square = 0; square < p.size() / 4; ++square)
      p.segment<4>(4 * square).setConstant(p.segment<4>(4 * square).mean());
  return p;
}

// One method at every lambda: the forms do not hold it, and all lambda >= 1e4 share one factorisation.
std::vector<Solution> sweep(VariationalInequality problem, const std::vector<double>& epsilons) {
  PenaltyFactor factor(problem);
  std::vector<Solution> solutions;
  for (const double epsilon : epsilons) {
    problem.compliance = epsilon;
    const double delta = moderate_delta(problem);
    if (delta != factor.delta()) factor.refactor(problem, delta);
    solutions.push_back(active_set(problem, factor));
  }
  return solutions;
}

void push(const tutorial::Options& options, tutorial::Report& report) {
  const std::vector<double> epsilons{1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0};
  const std::map<double, double> reference{
      {1, 0.158792}, {1e-2, 0.255738}, {1e-4, 0.259131}, {1e-8, 0.259166}, {0, 0.259166}};
  report.stage("meshes");
  const std::vector<Method> methods = make_methods(options.cells);
  write_freefem_mesh(options.out / "mesh.freefem.msh", methods.front().mesh);
  double patch = 0, worst = 0, least_locked = HUGE_VAL;
  int most_corrections = 0, floppy = 0, stiff = 0;
  std::string table, csv = "element,lambda,epsilon,force,corrections\n";

  for (const Method& method : methods) {
    report.stage(method.name);
    const Space x(method.mesh, method.in_x), y(method.mesh, method.in_y);
    const VectorSpace space{x, y};
    VariationalInequality problem = platen(method, space, 1);

    // 1. The checks that need no reference: patch test, zero modes, what B leaves free.
    patch = std::max({patch, patch_error(method, 1), patch_error(method, options.epsilon)});
    if (method.jumps) floppy = zero_modes(platen(method, space, 0));
    stiff = std::max(stiff, zero_modes(problem));
    table += fmt::format("  {:<28} {:9} {:7}", method.name, problem.free_count(), kernel_dimension(problem));

    // 2. The contact force at every lambda; error in % where the reference is known.
    const std::vector<Solution> solutions = sweep(problem, epsilons);
    int corrections = 0;
    for (std::size_t k = 0; k < epsilons.size(); ++k) {
      const double force = solutions[k].lambda.sum();
      corrections = std::max(corrections, solutions[k].counters.corrections);
      csv += fmt::format("{},{},{},{},{}\n", method.name, 1 / epsilons[k], epsilons[k], force,
                         solutions[k].counters.corrections);
      const auto known = reference.find(epsilons[k]);
      if (known == reference.end()) continue;
      const double percent = 100 * (force / known->second - 1);
      table += fmt::format(" {:9.2f}", percent);
      if (!method.locks) worst = std::max(worst, std::abs(percent));
      if (method.locks && epsilons[k] == 0) least_locked = std::min(least_locked, percent);
    }
    if (!method.locks) most_corrections = std::max(most_corrections, corrections);

    // 3. The deformed block at the epsilon asked for.
    problem.compliance = options.epsilon;
    const Solution solution = active_set(problem);
    write_deformed_vtu(options.out / (method.file + ".vtu"), space, solution.u, pressure(method, solution));
    table += fmt::format(" {:7} {:9.3f} {:7.3f}\n", corrections, bulge(x, solution.u, 0), bulge(x, solution.u, 1));
  }
  write_file(options.out / "force.csv", [&](std::ostream& out) { out << csv; });
  Eigen::MatrixXd obstacle(41, 2);
  for (int i = 0; i <= 40; ++i) obstacle.row(i) << -0.1 + 0.03 * i, -gap(-0.1 + 0.03 * i);
  write_csv(options.out / "obstacle.csv", {"x", "y"}, obstacle);
  report.finish();
  fmt::print("\n  {:<28} {:>9} {:>7} {:^49} {:>7} {:>17}\n", "", "", "",
             "error of the contact force in %, lambda =", "most", "mean bulge of side");
  fmt::print("  {:<28} {:>9} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7} {:>9} {:>7}\n{}\n", "", "unknowns", "kernel",
             "1", "100", "1e4", "1e8", "inf", "correct.", "left", "right", table);

  report.claim(patch < 1e-12, fmt::format("patch test: every method has the uniform strain to {:.0e}", patch));
  report.claim(floppy == 2 * options.cells && stiff == 0,
               fmt::format("motions of no energy: {} = 2n without jumps, {} in every method here", floppy, stiff));
  report.claim(most_corrections <= 5,
               fmt::format("at most {} corrections at any lambda where nothing locks", most_corrections));
  if (options.cells < 8) return;  // too coarse to tell locked from inexact
  report.claim(
      least_locked > 100,
      fmt::format("P1 on parallel or arbitrary triangles locks: force {:.0f} % too large or more", least_locked));
  report.claim(worst < 16.0 / options.cells,
               fmt::format("the other three are off by {:.2f} % at most, at any lambda of the table", worst));
}

// Three things to try:
// - the pressure of P1 (p1_right.vtu in ParaView): up to 46, in stripes, where the true one stays below 0.7.
// - 2 int grad u : grad v for 2 int eps(u) : eps(v) needs no jumps and is 39 % off: other conditions on the free sides.
// - jump weights from 0.1 to 10 (PlaneStrain::jump_weight): the force moves by one per cent.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.least_cells = 2;  // below, no vertex of the obstacle is free in x
  options.epsilon = 1e-8;
  return tutorial::run(argc, argv, "20_elasticity", "Nearly incompressible elasticity in contact: five discretisations",
                       options, push);
}
