#include "antilock/io/scene_results.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/result_folder.hpp"
#include "antilock/io/expression.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/errors.hpp"

namespace antilock {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

/// JSON has no infinity: a library would write null and say nothing.
double finite(const char* what, double value) {
  if (!std::isfinite(value)) throw NotConverged(std::string(what) + " of the answer is not finite", value, 0);
  return value;
}

Json summary(const SceneFile& file, const Space& space, const VariationalInequality& problem, const Solution& solution,
             const RunSeconds& seconds) {
  Json s;
  s["element"] = file.method.element;
  s["solver"] = file.method.solver;
  s["epsilon"] = or_null(file.scene.epsilon());
  s["h"] = mesh_width(file, space.mesh());
  s["dofs"] = solution.counters.unknowns;
  s["effects"] = file.scene.effects();
  s["energy"] = finite("the energy", energy(problem, solution));
  s["u_max"] = finite("the maximum", solution.u.maxCoeff());
  s["u_min"] = finite("the minimum", solution.u.minCoeff());
  if (file.scene.contact()) {
    const ContactZone zone = contact_zone(space, problem, solution);
    s["contact"] = {
        {"points", zone.points}, {"active", zone.active}, {"from", or_null(zone.from)}, {"to", or_null(zone.to)}};
    s["kkt"] = {{"min_gap", solution.kkt.min_gap},
                {"min_pressure", solution.kkt.min_pressure},
                {"complementarity", solution.kkt.complementarity},
                {"residual", solution.kkt.residual}};
  } else {
    s["kkt"] = {{"residual", solution.kkt.residual}};
  }
  s["iterations"] = {{"contact", solution.counters.contact}, {"corrections", solution.counters.corrections}};
  s["seconds"] = {{"mesh", seconds.mesh},
                  {"assemble", seconds.assemble},
                  {"factor", seconds.factor},
                  {"solve", seconds.solve},
                  {"total", seconds.total}};
  return s;
}

}  // namespace

void check_inputs_stay(const std::filesystem::path& folder, const std::filesystem::path& scene, const SceneFile& file) {
  for (const char* name : {"summary.json", "solution.csv", "contact.csv", "mesh.msh", "solution.vtu"})
    for (const std::filesystem::path& input : {scene, file.mesh.file})
      if (std::error_code absent; !input.empty() && std::filesystem::equivalent(folder / name, input, absent))
        throw Error(fmt::format("{}: --out: the result {} would replace {}; accepted: another folder", file.name, name,
                                printable(input.string(), 1000)));
}

void write_scene_results(const std::filesystem::path& folder, const SceneFile& file, const Space& space,
                         const VariationalInequality& problem, const Solution& solution, const RunSeconds& seconds) {
  const Json json = summary(file, space, problem, solution, seconds);
  const bool contact = file.scene.contact().has_value();
  const auto write = [&](const std::filesystem::path& draft) {
    write_file(draft / "summary.json", [&](std::ostream& out) { out << json.dump(2) << "\n"; });
    write_solution_csv(draft / "solution.csv", space, solution.u);
    if (contact) {
      Eigen::MatrixX3d table = contact_table(space, problem, solution);
      table.rightCols<2>() = table.rightCols<2>().cwiseMax(0.0);  // certified: what is below zero is round-off
      write_csv(draft / "contact.csv", {"x", "gap", "pressure"}, table);
    }
    write_msh(draft / "mesh.msh", space.mesh());
    write_vtu(draft / "solution.vtu", space, solution.u);
  };
  write_folder(folder, write, contact ? std::vector<std::string>{} : std::vector<std::string>{"contact.csv"});
}

}  // namespace antilock
