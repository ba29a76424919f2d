// Effects: a scene is made of those that it calls for, and an absent effect costs nothing.
//
// Run: 09_effects                          five scenes, three models, a change of variable; two seconds
// Run: 09_effects --cells 64 --epsilon 0.1
//
// What the picture shows. One body under one load, five times: alone; resting on an obstacle; held by a stiff layer
// that is not meshed; with the layer meshed below it; with layer and obstacle. Glue a layer that is rigid along itself
// under the body and its lower side, which moved freely by 0.2, moves by 0.045: it has become a stretched string.
//
// The inequality and its parts. With every effect present it is (23),
//
//     u in K:   a+(u, v-u)  +  a_x^-(u, v-u) + epsilon^-2 a_y^-(u, v-u)  >=  (f, v-u)   for all v in K
//               body           layer
//
// - no contact:  K is a space, >= becomes =, and one linear solve is the answer;
// - no layer:    a+ alone, on the body's mesh alone;
// - epsilon = 0: (24), the layer can only follow Sigma: u(x, y) = u(x, 0) there;
// - and then it need not be meshed at all: what is left of it is a_x^- on functions of x, one term on Sigma,
//                int_Sigma d/dx u d/dx v      the condition of Ventcel, (25);
// - before the change of variable y -> epsilon y, the layer is (0,1) x (-epsilon,0) and 1/epsilon times as stiff: (22).
//
// Each of these is a type (scene/scene.hpp), so that what a scene lacks cannot cost anything: there is no code to skip.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <fmt/format.h>

#include <algorithm>

#include "antilock/core/atomic_file.hpp"
#include "antilock/exact/truth.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/study/sweep.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

// A scene from question to answer, and what each step cost.
struct Run {
  Run(const Scene& scene, TriangleMesh its_mesh, const std::string& element_name)
      : mesh(std::move(its_mesh)), space(mesh, element(element_name)) {
    Stopwatch watch;
    problem = assemble(scene, space);
    assemble_seconds = watch.lap();
    solution = active_set(problem);
    solve_seconds = watch.lap();
    zone = contact_zone(space, problem, solution);
    energy = antilock::energy(problem, solution);
  }
  Run(const Run&) = delete;  // the space looks at the mesh
  Run& operator=(const Run&) = delete;

  TriangleMesh mesh;
  Space space;
  VariationalInequality problem;
  Solution solution;
  ContactZone zone;
  double energy = 0, assemble_seconds = 0, solve_seconds = 0;
};

const Body body{paper_load};
const UnilateralContact obstacle{};

struct Named {
  std::string folder, types;
  Scene scene;
};

// 1. The five scenes, from plain Laplace to a stiff layer with contact.
std::vector<Named> five_scenes(double epsilon) {
  return {{"1_body", "Body", Scene(body)},
          {"2_body_contact", "Body, UnilateralContact", Scene(body, NoLayer{}, obstacle)},
          {"3_ventcel", "Body, VentcelLayer", Scene(body, VentcelLayer{})},
          {"4_layer", "Body, StiffLayer", Scene(body, StiffLayer{epsilon})},
          {"5_layer_contact", "Body, StiffLayer, UnilateralContact", Scene(body, StiffLayer{epsilon}, obstacle)}};
}

void each_scene_pays_for_itself(const tutorial::Options& options, tutorial::Report& report) {
  std::string table =
      "scene,triangles,unknowns,factorisations,solves,contact,corrections,assemble_s,solve_s,u_min,u_max\n";
  std::vector<Counters> counters;
  std::vector<int> triangles;
  report.finish();
  fmt::print("\n  {:<36}{:>10}{:>10}{:>8}{:>8}{:>9}{:>13}{:>10}{:>8}\n", "types", "triangles", "unknowns", "factors",
             "solves", "contact", "corrections", "seconds", "u_min");
  for (const Named& named : five_scenes(options.epsilon)) {
    // layer_depth: 0 where no layer is meshed. The mesh is as large as the scene needs.
    const Run run(named.scene, unstructured_mesh(options.cells, {named.scene.layer_depth()}), "CR");
    const Counters& c = counters.emplace_back(run.solution.counters);
    triangles.push_back(run.mesh.triangle_count());
    const double u_min = run.solution.u.minCoeff(), u_max = run.solution.u.maxCoeff();
    fmt::print("  {:<36}{:>10}{:>10}{:>8}{:>8}{:>9}{:>13}{:>10.4f}{:>8.3f}\n", named.types, triangles.back(),
               c.unknowns, c.factorisations, c.solves, c.contact, c.corrections,
               run.assemble_seconds + run.solve_seconds, u_min);
    table += fmt::format("{},{},{},{},{},{},{},{:.6g},{:.6g},{:.17g},{:.17g}\n", named.folder, triangles.back(),
                         c.unknowns, c.factorisations, c.solves, c.contact, c.corrections, run.assemble_seconds,
                         run.solve_seconds, u_min, u_max);
    tutorial::write_results(options.out / named.folder, run.space, run.problem, run.solution);
  }
  write_file(options.out / "results.csv", [&](std::ostream& out) { out << table; });
  fmt::print("\n");
  report.claim(counters[0].solves == 1 && counters[0].contact == 0 && counters[0].corrections == 0,
               "the body alone is one linear solve");
  report.claim(counters[2].unknowns == counters[0].unknowns && triangles[2] == triangles[0] &&
                   counters[2].solves == counters[0].solves,
               "a Ventcel layer costs what the body alone costs: no triangle, no unknown, no solve more");
}

// 2. One question, three models of the layer: (23) at a small epsilon, (24) on the layer's mesh, (25) without one. All
// are held against the truth at that epsilon, so the last two show the error of their model as well.
void three_models(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("truth at epsilon and at 0: sine series");
  const Truth truth(paper_sine_load(), options.epsilon, true, 14), limit(paper_sine_load(), 0, true, 14);
  const double exact_from = truth.contact_zones().empty() ? 1 : truth.contact_zones().front().first;
  double model_error = 0;
  for (int i = 1; i < 64; ++i)
    model_error = std::max(model_error, std::abs(truth.value(i / 64.0, -1) - limit.value(i / 64.0, -1)));
  report.finish();
  fmt::print("\n  truth: contact from x = {:.4f}, J = {:.6f}; the limit differs by {:.1e} in u on Gamma_C\n",
             exact_from, truth.energy(), model_error);
  fmt::print("  {:<28}{:>10}{:>9}{:>9}{:>11}{:>11}{:>10}\n", "model (CR, unstructured)", "unknowns", "mesh s",
             "solve s", "error", "J_h - J", "from");

  const std::vector<Named> models = {{"scaled", "(23)", Scene(body, StiffLayer{options.epsilon}, obstacle)},
                                     {"limit", "(24), epsilon = 0", Scene(body, StiffLayer{0}, obstacle)},
                                     {"ventcel", "(25), no layer mesh", Scene(body, VentcelLayer{}, obstacle)}};
  const double h = 1.0 / options.cells, energy_error = std::abs(truth.energy() - limit.energy());
  std::string table = "model,unknowns,mesh_s,assemble_s,solve_s,error_on_contact,energy,contact_from\n";
  std::vector<int> unknowns;
  bool agree = true;
  for (const Named& model : models) {
    Stopwatch watch;
    TriangleMesh mesh = unstructured_mesh(options.cells, {model.scene.layer_depth()});
    const double mesh_seconds = watch.lap();
    const Run run(model.scene, std::move(mesh), "CR");
    double error = 0;  // of u at the contact unknowns: gap = u where the obstacle is flat
    const Eigen::MatrixX3d points = contact_table(run.space, run.problem, run.solution);
    for (const auto& point : points.rowwise()) error = std::max(error, std::abs(point(1) - truth.value(point(0), -1)));
    const double from = run.zone.from.value_or(1);
    unknowns.push_back(run.solution.counters.unknowns);
    // h^2 / 2 in energy and up to 1.6 h^2 in u on Gamma_C were measured; the end of contact falls into a cell or the
    // next
    agree = agree && error <= 2 * h * h + model_error &&
            std::abs(run.energy - truth.energy()) <= h * h + energy_error &&
            std::abs(from - exact_from) <= 2 * h + model_error;
    fmt::print("  {:<28}{:>10}{:>9.3f}{:>9.4f}{:>11.1e}{:>11.1e}{:>10.4f}\n", model.folder + " " + model.types,
               unknowns.back(), mesh_seconds, run.assemble_seconds + run.solve_seconds, error,
               run.energy - truth.energy(), from);
    table += fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.17g},{:.17g},{:.17g}\n", model.folder, unknowns.back(),
                         mesh_seconds, run.assemble_seconds, run.solve_seconds, error, run.energy, from);
  }
  write_file(options.out / "models.csv", [&](std::ostream& out) { out << table; });
  fmt::print("\n");
  report.claim(agree,
               fmt::format("three models, one answer: each within 2 h^2 + {:.1e} of the truth on Gamma_C, the second "
                           "number the model's own error",
                           model_error));
  report.claim(unknowns[2] < 0.52 * unknowns[1],
               fmt::format("Ventcel saves half the unknowns: {} in place of {}", unknowns[2], unknowns[1]));
}

// 3. The change of variable y -> epsilon y takes (22) to (23). On a mesh whose layer is pressed flat by the same map it
// does so term by term: the same matrices, the same answer. On a mesh made for the thin layer, up to discretisation.
void change_of_variable(const tutorial::Options& options, tutorial::Report& report) {
  report.finish();
  fmt::print("\n  {:<10}{:>14}{:>16}{:>12}{:>12}{:>18}\n", "epsilon", "J thin (22)", "J scaled (23)", "from (22)",
             "from (23)", "u, pressed mesh");
  const double h = 1.0 / options.cells;
  double worst_pressed = 0, worst_energy = 0, worst_from = 0;
  std::string table = "epsilon,energy_thin,energy_scaled,from_thin,from_scaled,difference_on_pressed_mesh\n";
  for (const double epsilon : {1e-1, 1e-2, 1e-3}) {
    const Scene thin(body, ThinLayer{epsilon}, obstacle), scaled(body, StiffLayer{epsilon}, obstacle);
    TriangleMesh pressed = structured_mesh(options.cells);
    for (auto vertex : pressed.vertices.rowwise())
      if (vertex(1) < 0) vertex(1) *= epsilon;
    const Run a(thin, structured_mesh(options.cells, {epsilon}), "CR"), b(scaled, structured_mesh(options.cells), "CR");
    const Run c(thin, std::move(pressed), "CR");
    const double difference = (c.solution.u - b.solution.u).cwiseAbs().maxCoeff();
    const double from_a = a.zone.from.value_or(1), from_b = b.zone.from.value_or(1);
    worst_pressed = std::max(worst_pressed, difference);
    worst_energy = std::max(worst_energy, std::abs(a.energy - b.energy));
    worst_from = std::max(worst_from, std::abs(from_a - from_b));
    fmt::print("  {:<10g}{:>14.6f}{:>16.6f}{:>12.4f}{:>12.4f}{:>18.1e}\n", epsilon, a.energy, b.energy, from_a, from_b,
               difference);
    table += fmt::format("{:g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", epsilon, a.energy, b.energy, from_a, from_b,
                         difference);
  }
  write_file(options.out / "change_of_variable.csv", [&](std::ostream& out) { out << table; });
  fmt::print("\n");
  // round-off times the condition of (22), epsilon^-2 h^-2
  report.claim(worst_pressed <= 1e-16 / (1e-6 * h * h),
               fmt::format("(22) is (23), term by term: u differs by {:.1e} on corresponding meshes", worst_pressed));
  report.claim(worst_energy <= h * h && worst_from <= 1.5 * h,
               fmt::format("and up to discretisation on others: energy within {:.1e}, contact within {:.3f}",
                           worst_energy, worst_from));
}

// 4. Only what is needed holds for many questions, too: the forms of (23) do not contain epsilon, and every epsilon
// below a fraction of h is solved with one and the same factorisation.
void sweep_over_epsilon(const tutorial::Options& options, tutorial::Report& report) {
  const std::vector<double> epsilons = {1e-1, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12, 0};
  const TriangleMesh mesh = unstructured_mesh(options.cells);
  const Space space(mesh, crouzeix_raviart());
  report.stage(fmt::format("{} epsilons, one by one", epsilons.size()));
  Stopwatch watch;
  for (const double epsilon : epsilons) active_set(assemble(Scene(body, StiffLayer{epsilon}, obstacle), space));
  const double apart = watch.lap();
  report.stage("the same in one sweep");
  watch.lap();
  Sweep sweep(Scene(body, StiffLayer{epsilons.front()}, obstacle), space);
  for (const double epsilon : epsilons) {
    sweep.set_epsilon(epsilon);
    sweep.solve();
  }
  const double together = watch.lap();
  const auto above = std::count_if(epsilons.begin(), epsilons.end(),
                                   [&](double epsilon) { return epsilon * epsilon > choose_penalty(sweep.problem()); });
  report.claim(sweep.total().factorisations == above + 1 && sweep.assembled() == mesh.triangle_count(),
               fmt::format("{} epsilons cost one assembly and {} factorisations ({:.3f} s; one by one {:.3f} s)",
                           epsilons.size(), sweep.total().factorisations, together, apart));
}

void effects(const tutorial::Options& options, tutorial::Report& report) {
  each_scene_pays_for_itself(options, report);
  three_models(options, report);
  change_of_variable(options, report);
  sweep_over_epsilon(options, report);
}

// Three things to try:
// - UnilateralContact{[](double) { return 1.0; }} as `obstacle`: out of reach; one solve and a look at the signs.
// - --epsilon 0.3: the limit is no longer a model of the layer; its own error fills the third column of the table.
// - "P1" for "CR" in three_models: the scaled layer locks on its unstructured mesh, Ventcel has nothing to lock.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.epsilon = 1e-2;
  return tutorial::run(argc, argv, "09_effects", "Effects: a scene pays for what it calls for", options, effects);
}
