#include "common/effects.hpp"

#include <cmath>

#include "antilock/core/stopwatch.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock::tutorial {

Run::Run(const Scene& scene, TriangleMesh mesh) : on(std::move(mesh), crouzeix_raviart()) {
  Stopwatch watch;
  problem = assemble(scene, on.space());
  assemble_seconds = watch.lap();
  solution = active_set(problem);
  solve_seconds = watch.lap();
  contact_from = contact_zone(on.space(), problem, solution).from.value_or(1);
  energy = antilock::energy(problem, solution);
}

double Run::error_on_contact(const Truth& truth) const {
  double error = 0;  // gap = u where the obstacle is flat
  const Eigen::MatrixX3d points = contact_table(on.space(), problem, solution);
  for (const auto& point : points.rowwise()) error = std::max(error, std::abs(point(1) - truth.value(point(0), -1)));
  return error;
}

const std::vector<std::string> cost_columns{"scene",   "triangles", "unknowns",    "factorisations",
                                            "solves",  "contact",   "corrections", "assemble_s",
                                            "solve_s", "u_min",     "u_max"};

std::vector<Entry> costs(const std::string& name, const Run& run) {
  const Counters& c = run.solution.counters;
  return {name,
          run.on.mesh().triangle_count(),
          c.unknowns,
          c.factorisations,
          c.solves,
          c.contact,
          c.corrections,
          run.assemble_seconds,
          run.solve_seconds,
          run.solution.u.minCoeff(),
          run.solution.u.maxCoeff()};
}

const std::vector<std::string> model_columns{"model",   "unknowns",         "mesh_s", "assemble_s",
                                             "solve_s", "error_on_contact", "energy", "contact_from"};

std::vector<Entry> model(const std::string& name, const Scene& scene, int cells, const Truth& truth) {
  Stopwatch watch;
  TriangleMesh mesh = unstructured_mesh(cells, {scene.layer_depth()});
  const double mesh_seconds = watch.lap();
  const Run run(scene, std::move(mesh));
  return {name,
          run.solution.counters.unknowns,
          mesh_seconds,
          run.assemble_seconds,
          run.solve_seconds,
          run.error_on_contact(truth),
          run.energy,
          run.contact_from};
}

double judge_models(const Table& models, const Exact& exact, const Exact& limit, int cells, Report& report) {
  double model_error = 0;
  for (int i = 1; i < 64; ++i)
    model_error = std::max(model_error, std::abs(exact.truth.value(i / 64.0, -1) - limit.truth.value(i / 64.0, -1)));
  const double h = 1.0 / cells, truth = exact.truth.energy(), energy_error = std::abs(truth - limit.truth.energy());
  models.print(fmt::format("truth: contact from x = {:.4f}, J = {:.6f}; the limit differs by {:.1e} in u on Gamma_C",
                           exact.contact_from(), truth, model_error));
  // h^2 / 2 in energy and up to 1.6 h^2 in u on Gamma_C were measured; the end of contact falls into a cell or the next
  const auto within = [&](const std::string& column, double wanted, double room) {
    return std::max(models.most(column) - wanted, wanted - models.least(column)) <= room;
  };
  report.claim(models.most("error_on_contact") <= 2 * h * h + model_error &&
                   within("energy", truth, h * h + energy_error) &&
                   within("contact_from", exact.contact_from(), 2 * h + model_error),
               "three models, one answer: each within 2 h^2 + {:.1e} of the truth on Gamma_C, the second number the "
               "model's own error",
               model_error);
  return model_error;
}

double most_apart(const Table& table, const std::string& one, const std::string& other) {
  double apart = 0;
  for (const Table& row : table.rows()) apart = std::max(apart, std::abs(row.number(one) - row.number(other)));
  return apart;
}

TriangleMesh pressed_mesh(int cells, double epsilon) {
  TriangleMesh mesh = structured_mesh(cells);
  for (auto vertex : mesh.vertices.rowwise())
    if (vertex(1) < 0) vertex(1) *= epsilon;
  return mesh;
}

}  // namespace antilock::tutorial
