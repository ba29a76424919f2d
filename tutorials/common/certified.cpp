#include "common/certified.hpp"

#include <cmath>

#include "antilock/core/eigenvalues.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/layered.hpp"

namespace antilock::tutorial {
namespace {

/// One component of sigma; in the layer the second one is the stress p.
Eigen::MatrixX3d component(const TriangleMesh& mesh, const EquilibratedFlux& flux, int k) {
  Eigen::MatrixX3d corners(mesh.triangle_count(), 3);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    corners.row(t).setConstant(flux.cell[t].s(k));
    if (mesh.region[t] == Region::body)
      corners.row(t) += flux.tau(mesh, t, Eigen::Matrix3d::Identity()).col(k).transpose();
  }
  return corners;
}

/// A Crouzeix-Raviart solution, what was asked, and room for what an exercise does to it.
struct Solved {
  Scene scene;
  Discretisation on;
  VariationalInequality problem;
  Solution solution;

  Solved(const Scene& asked, TriangleMesh mesh)
      : scene(asked),
        on(std::move(mesh), crouzeix_raviart()),
        problem(assemble(scene, on.space())),
        solution(active_set(problem)) {}
  Certificate certified(const Companion* v = nullptr) const {
    return certify(scene, on.space(), problem, solution, {.companion = v});
  }
  Certificate p1_certified() const {
    const Discretisation linear(on, p1());
    const Companion v = p1_companion(active_set(assemble(scene, linear.space())));
    return certified(&v);
  }
};

void write_pictures(const std::filesystem::path& out) {
  const Scene scene = paper_scene(1e-6);
  const Solved unstructured(scene, unstructured_mesh(16)), layered(scene, layered_mesh(16, 1e-6));
  const auto density = [&](const char* name, const Solved& run, const Certificate& found) {
    write_density(out / name, run.on.mesh(), found.indicator);
  };
  density("width_cr.vtu", unstructured, unstructured.certified());
  density("width_p1.vtu", unstructured, unstructured.p1_certified());
  density("width_p1_layered.vtu", layered, layered.p1_certified());
  const EquilibratedFlux flux =
      equilibrated_flux(scene, unstructured.on.space(), unstructured.problem, unstructured.solution);
  write_vtu(out / "flux_x.vtu", unstructured.on.mesh(), component(unstructured.on.mesh(), flux, 0));
  write_vtu(out / "flux_y.vtu", unstructured.on.mesh(), component(unstructured.on.mesh(), flux, 1));
}

// u and p are multiplied by 1.01: r grows from lambda to lambda + 0.01 A u, so that r1 = 0.01 A u on the free edges off
// Gamma_C, and rho = 0.01 |u|_a up to what the clamped and touching edges take.
void scaled_solution(const Options&, Report& report) {
  const Exact exact(paper_scene(1e-2), 14);
  Solved run(paper_scene(exact.epsilon), unstructured_mesh(32));
  const Certificate before = run.certified();
  run.solution.u *= 1.01;
  run.solution.p *= 1.01;
  const Certificate after = run.certified();
  const double error = exact.errors(run.on.space(), run.solution).energy;
  report.claim(after.gradient >= error, "the bound {:.4f} of the wrong answer is not below its error {:.4f}",
               after.gradient, error);
  report.claim_within(after.imbalance / before.norm, 0.009, 0.011, "rho / |v|_a:");
  // with 1.01 f for f the bound were 1.01 times as large: so it grows by rho and a hundredth of itself at most
  report.claim_within((after.gradient - before.gradient) / after.imbalance, 1,
                      1 + 0.01 * before.gradient / after.imbalance, "the bound grows, in parts of rho, by");
}

void other_gap(const Options&, Report& report) {
  const Scene scene({paper_load}, StiffLayer{1e-6}, UnilateralContact{[](double x) { return 0.02 * x * (1 - x); }});
  const Certificate coarse = Solved(scene, unstructured_mesh(16)).certified(),
                    fine = Solved(scene, unstructured_mesh(32)).certified();
  const auto width = [](const Certificate& c) { return c.energy_upper - c.energy_lower; };
  report.claim(coarse.energy_lower <= fine.energy_upper && fine.energy_lower <= coarse.energy_upper,
               "the brackets [{:.5f}, {:.5f}] and [{:.5f}, {:.5f}] have energies in common", coarse.energy_lower,
               coarse.energy_upper, fine.energy_lower, fine.energy_upper);
  report.claim_within(width(coarse) / width(fine), 3.6, 4.4, "half the mesh width, a quarter of the bracket's width:");
}

// v must lie in K: a parabola that is 0 at a vertex and at a midpoint dips below between them.
void parabola(const Options&, Report& report) {
  const Discretisation on(unstructured_mesh(8), p2());
  const Solution solution = active_set(assemble(paper_scene(1e-2), on.space()));
  double lowest = 0;
  for (int t = 0; t < on.mesh().triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = on.mesh().triangle_edges(t, i);
      if (on.mesh().edge_tag[e] != EdgeTag::contact) continue;
      for (int k = 1; k < 32; ++k) {
        Eigen::Vector3d lambda = Eigen::Vector3d::Zero();
        lambda((i + 1) % 3) = k / 32.0;
        lambda((i + 2) % 3) = 1 - k / 32.0;
        lowest = std::min(lowest, on.space().element().basis(lambda).dot(solution.u(on.space().unknowns().row(t))));
      }
    }
  report.claim(lowest < 0, "P2 is nowhere negative at its unknowns on Gamma_C, and {:.1e} between them: not in K",
               lowest);
}

}  // namespace

const std::vector<std::string> certificate_columns{"element", "mesh",        "epsilon",     "cells",  "h",     "lower",
                                                   "upper",   "width",       "cr_below",    "inside", "bound", "error",
                                                   "ratio",   "layer_share", "width_ratio", "shift"};

std::vector<Entry> certified_row(const std::string& element, const std::string& mesh, int cells, const Exact& exact,
                                 const Certificate& found, double error, double cr_energy) {
  const double truth = exact.truth.energy(), lower = found.energy_lower, upper = found.energy_upper;
  const double width = upper - lower, bound = found.displacement;
  return {element,
          mesh,
          exact.epsilon,
          cells,
          1.0 / cells,
          lower,
          upper,
          width,
          truth - cr_energy,
          std::min(truth - lower, upper - truth),
          bound,
          error,
          bound / error,
          found.layer_share,
          std::sqrt(2 * width) / error,
          (cr_energy - lower) * cells * cells};
}

Table certify_uzawa(const Exact& exact) {
  const Discretisation on(unstructured_mesh(16), crouzeix_raviart());
  const Scene scene = paper_scene(exact.epsilon);
  const VariationalInequality problem = assemble(scene, on.space());
  PenaltyFactor factor(problem, problem.compliance);  // K is the problem's own: one solve gives u exactly
  const auto& free = factor.numbering().unknown;
  const Eigen::MatrixXd& block = factor.contact_block();  // L, the compliance on Gamma_C is (L L')^-1
  const auto compliance = [&](const Eigen::VectorXd& force) -> Eigen::VectorXd {
    const Eigen::VectorXd half = block.triangularView<Eigen::Lower>().solve(force);
    return block.transpose().triangularView<Eigen::Upper>().solve(half);
  };
  const double rho = 1 / largest_eigenvalue(compliance, block.rows());
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(block.rows());
  Solution now;
  Table rows({"steps", "quantity", "value"});
  for (int steps = 0, next = 1; steps <= 512; ++steps) {
    Eigen::VectorXd force = problem.load;
    for (Eigen::Index i = 0; i < lambda.size(); ++i) force(problem.contact[i]) += lambda(i);
    now.u = Eigen::VectorXd::Zero(problem.size());
    now.u(free) = factor.backward(factor.forward(force(free)));
    now.p = problem.b * now.u / problem.compliance;
    for (Eigen::Index i = 0; i < lambda.size(); ++i)
      lambda(i) = std::max(0.0, lambda(i) - rho * (now.u(problem.contact[i]) - problem.lower(i)));
    if (steps < next) continue;
    next *= 2;
    rows.add({steps, "bound", certify(scene, on.space(), problem, now, {.factor = &factor}).gradient});
    rows.add({steps, "error", exact.errors(on.space(), now).energy});
  }
  return rows;
}

void show_certificates(const std::filesystem::path& out, const Table& results, const Table& uzawa) {
  const Table finest = results.where("cells", results.most("cells"));
  finest.select({"element", "mesh", "epsilon", "lower", "upper", "bound", "error", "ratio", "layer_share"})
      .print("the energy bracket; bound and error in the energy norm; the layer's share of the bound");
  results.write(out / "results.csv");
  finest.where_number("epsilon", [](double epsilon) { return epsilon > 0; }).write(out / "effectivity.csv");
  uzawa.write(out / "uzawa.csv");
  write_pictures(out);
}

void write_density(const std::filesystem::path& file, const TriangleMesh& mesh, const Eigen::VectorXd& indicator) {
  Eigen::MatrixX3d corners(mesh.triangle_count(), 3);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    corners.row(t).setConstant(std::log10(std::max(indicator(t) / mesh.area(t), 1e-12)));
  write_vtu(file, mesh, corners);
}

std::vector<Exercise> certificate_exercises() {
  return {
      {"u_h and p are multiplied by 1.01. Is the bound still one, and by how much does it grow?",
       "It is. r1 = 0.01 A u_h, so rho = 0.01 |u_h|_a, and the bound grows by rho and a hundredth of itself at most.",
       scaled_solution},
      {"The gap is 0.02 x (1 - x), a problem without an exact solution here. Do the brackets of two meshes agree?",
       "They overlap, since both hold J(u), and half the mesh width makes the bracket four times narrower.", other_gap},
      {"Why may P2 not take the place of P1 in the upper bound?",
       "Between two unknowns that are not negative a parabola may be: P2's solution does not lie in K.", parabola}};
}

}  // namespace antilock::tutorial
