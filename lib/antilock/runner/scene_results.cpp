#include "antilock/runner/scene_results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <variant>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/blas.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/io/write_csv.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/measure/point_values.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "antilock/runner/scene_mesh.hpp"
#include "antilock/runner/solve_scene.hpp"

namespace antilock {
namespace {

using Json = nlohmann::ordered_json;

using Interval = std::optional<std::pair<double, double>>;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }
Json or_null(const Interval& interval) {
  return interval ? Json::array({interval->first, interval->second}) : Json(nullptr);
}

/// JSON has no infinity: a library would write null and say nothing.
double finite(const char* what, double value) {
  if (!std::isfinite(value))
    throw NotConverged(std::string(what) + " of the answer is not finite", value, 0);
  return value;
}

const char* asked_of(const MethodRequest& method) {
  return method.of == Quantity::stress ? "stress" : "displacement";
}

/// The question in full: with it and the mesh file anyone can ask it again.
Json question(const SceneFile& file) {
  const Json words = Json::parse(file.json);
  const MethodRequest& method = file.method;
  Json asked = {
      {"title", file.title},
      {"load", words["load"]["f"]},
      {"layer", nullptr},
      {"gap", nullptr},
      {"mesh", words["mesh"]},
      {"method",
       {{"element", method.element}, {"solver", method.solver}, {"tolerance", method.tolerance}}},
      {"version", ANTILOCK_VERSION}};
  const auto add = [&](const Json& from, const char* key, const std::string& name) {
    if (from.contains(key)) asked[name] = from[key];
  };
  if (words.contains("layer")) {
    const Json& layer = words["layer"];
    asked["layer"] = {{"epsilon", or_null(file.scene.epsilon())},
                      {"model", layer.value("model", "scaled")}};
    for (const std::string key : {"thickness", "stiffness", "load"})
      add(layer, key.c_str(), "layer " + key);
  }
  if (words.contains("contact")) {
    asked["gap"] = words["contact"].value("gap", "0");
    add(words["contact"], "ceiling", "ceiling");
    for (const std::string key : {"slave", "master", "method"})
      add(words["contact"], key.c_str(), "contact " + key);
  }
  if (method.accuracy)
    asked["method"].update({{"accuracy", *method.accuracy},
                            {"of", asked_of(method)},
                            {"most_unknowns", method.most_unknowns}});
  for (const char* section : {"body", "edge", "at", "model"}) add(words, section, section);
  return asked;
}

std::vector<std::string> effects_of(const SceneFile& file) {
  std::vector<std::string> effects = file.scene.effects();
  if (has_contact(file) && !file.scene.contact()) effects.emplace_back("contact");
  return effects;
}

/// What was asked, what is proved, and the way there.
Json certificate(const MethodRequest& method, const CertifiedSolution& certified) {
  const Certificate& proof = certified.certificate;
  Json levels = Json::array();
  const std::string& geometry = certified.result.space.mesh().geometry.file;
  const std::string corners =
      geometry.empty()
          ? ""
          : ", its corners on the curves of " + std::filesystem::path(geometry).filename().string();
  for (const RefinementLevel& level : certified.history)
    levels.push_back(
        {{"unknowns", level.unknowns}, {"bound", level.bound}, {"seconds", level.seconds}});
  return {{"asked", *method.accuracy},
          {"of", asked_of(method)},
          {"relative", finite("the certified error", proof.relative(method.of))},
          {"bound", finite("the certified error", proof.bound(method.of))},
          {"energy_lower", proof.energy_lower},
          {"energy_upper", proof.energy_upper},
          {"proved_of",
           "the polygon of the last mesh" + corners + ", with load, traction and gap as sampled"},
          {"levels", levels}};
}

/// Normal and tangential force, the moment, and the intervals that are proved.
Json contact_force_of(const ContactForce& force, const std::optional<ContactForceBounds>& proved) {
  if (force.moment_y)
    return {{"normal", finite("the contact force", force.normal)},
            {"moment", finite("the moment of the contact force", force.moment)},
            {"moment_y", finite("the moment of the contact force", *force.moment_y)},
            {"unit", "that of f times length^3; of the moments times length^4"}};
  return {{"normal", finite("the contact force", force.normal)},
          {"normal_proved", or_null(proved ? Interval(proved->normal) : Interval())},
          {"tangential", or_null(force.tangential)},
          {"moment", finite("the moment of the contact force", force.moment)},
          {"moment_proved", or_null(proved ? Interval(proved->moment) : Interval())},
          {"unit", "that of f times length^2; of the moment times length^3"}};
}

/// L(u_h), and the interval in which L(u) is proved to lie.
Json compliance_of(const SceneSummary& summary, const CertifiedSolution* certified) {
  Json compliance = {{"value", finite("the compliance", summary.compliance)},
                     {"lower", nullptr},
                     {"upper", nullptr}};
  const Interval proved = certified != nullptr ? proved_compliance(*certified) : Interval();
  if (proved) {
    compliance["lower"] = proved->first;
    compliance["upper"] = proved->second;
  }
  return compliance;
}

/// A line of force_table.
std::string table_line(const std::string& name, double value, const std::string& interval,
                       const std::string& unit) {
  return fmt::format("  {:<22} {:>12.6g}  {:<32} {}\n", name, value, interval, unit);
}

std::string text_of(const Interval& interval) {
  return interval ? fmt::format("{:.6g} to {:.6g}", interval->first, interval->second) : "";
}

std::string proved_text_of(const Interval& interval) {
  return text_of(interval) + (interval ? " (proved)" : "");
}

/// The contact zone; in space the ranges of x and y.
Json contact_zone_of(const ContactZone& zone, bool in_space) {
  Json contact = {{"points", zone.points},
                  {"active", zone.active},
                  {"from", or_null(zone.from)},
                  {"to", or_null(zone.to)}};
  if (in_space) {
    const auto& y = zone.y_range;
    contact["y_from"] = y ? Json(y->first) : Json(nullptr);
    contact["y_to"] = y ? Json(y->second) : Json(nullptr);
  } else {
    contact["from_within"] = or_null(zone.from_within);
    contact["to_within"] = or_null(zone.to_within);
  }
  return contact;
}

/// The values at a point of [at]. `row` has its coordinates and the components of u.
Json values_at_point(const Eigen::RowVectorXd& row, int dimension) {
  Json here = {{"x", row(0)}, {"y", row(1)}};
  if (dimension == 3) here["z"] = row(2);
  if (row.size() == dimension + 1) {
    here["u"] = row(dimension);
  } else {
    here["u_x"] = row(dimension);
    here["u_y"] = row(dimension + 1);
  }
  return here;
}

/// x, in space y, gap and pressure, with the tangential force per length behind them where there is
/// friction.
void write_contact(const std::filesystem::path& path, const Eigen::MatrixXd& table,
                   const std::optional<Eigen::VectorXd>& friction) {
  std::vector<std::string> header{"x", "gap", "pressure"};
  if (table.cols() == 4) header.insert(header.begin() + 1, "y");
  Eigen::MatrixXd all = table;
  if (friction) {
    header.emplace_back("friction");
    all.conservativeResize(Eigen::NoChange, table.cols() + 1);
    all.rightCols<1>() = *friction;
  }
  write_csv(path, header, all);
}

}  // namespace

SceneSummary summary_of(const SceneFile& file, const Result& result,
                        const CertifiedSolution* certified) {
  const Solution& solution = result.solution;
  SceneSummary s;
  s.h = mesh_width(file, result.space.mesh());
  s.unknowns = solution.counters.unknowns;
  s.energy = energy(result.problem, solution);
  const Eigen::VectorXd values = values_at_dofs(result.space, solution.u);
  s.u_max = values.maxCoeff();
  s.u_min = values.minCoeff();
  s.compliance = result.problem.load.dot(solution.u);
  if (const auto contact = contact_results(file, result)) {
    s.zone = contact->zone;
    s.force = contact->force;
  }
  if (certified != nullptr) {
    s.proved_force = contact_force_bounds(file.scene, result, certified->certificate);
  }
  const Eigen::Index size = result.space.size(), components = solution.u.size() / size;
  const Eigen::Index d = result.space.mesh().dimension();
  s.at.resize(static_cast<Eigen::Index>(file.at.size()), d + components);
  if (s.at.rows() > 0) {
    const PointValues values(result.space);
    for (Eigen::Index i = 0; i < s.at.rows(); ++i) {
      const Eigen::Vector3d& x = file.at[i];
      const auto place = values.locate(x, 1e-9);
      if (!place)
        throw Error(fmt::format(
            "{}: at.points: ({:g}) is outside the mesh; accepted: points of body and layer",
            file.name, fmt::join(x.data(), x.data() + d, ", ")));
      s.at.row(i).head(d) = x.head(d).transpose();
      for (Eigen::Index k = 0; k < components; ++k)
        s.at(i, d + k) = values.value(solution.u.segment(k * size, size), *place);
    }
  }
  s.kkt = solution.kkt;
  s.contact_steps = solution.counters.contact_iterations;
  s.corrections = solution.counters.corrections;
  s.layer = result.locking;
  s.coulomb = result.coulomb;
  s.warning = result.warning;
  return s;
}

std::optional<std::pair<double, double>> proved_compliance(const CertifiedSolution& certified) {
  const VariationalInequality& problem = certified.result.problem;
  const bool is_cone = (problem.bounds.lower.array() == 0).all();
  if (!is_cone || (problem.dirichlet_values.array() != 0).any()) return {};
  const Certificate& proof = certified.certificate;
  // -2 * 0 would be -0
  return std::pair(0.0 - 2 * proof.energy_upper, 0.0 - 2 * proof.energy_lower);
}

std::string force_table(const SceneFile& file, const SceneSummary& summary,
                        const CertifiedSolution* certified) {
  const int d = file.mesh.dimension;
  const std::string force_unit = fmt::format("that of f times length^{}", d);
  const std::string moment_unit = fmt::format("that of f times length^{}", d + 1);
  std::string table = fmt::format("  {:<22} {:>12}  {:<32} {}\n", "", "value", "interval", "unit");
  if (has_contact(file)) {
    const ContactForce& force = summary.force;
    const auto& proved = summary.proved_force;
    const Interval normal = proved ? Interval(proved->normal) : Interval();
    const Interval moment = proved ? Interval(proved->moment) : Interval();
    table += table_line("contact force, upwards", force.normal, proved_text_of(normal), force_unit);
    if (force.tangential)
      table += table_line("friction, to the right", *force.tangential, "", force_unit);
    const char* const name = force.moment_y ? "integral of x pressure" : "moment, anticlockwise";
    table += table_line(name, force.moment, proved_text_of(moment), moment_unit);
    if (force.moment_y)
      table += table_line("integral of y pressure", *force.moment_y, "", moment_unit);
    const ContactZone& zone = summary.zone;
    if (zone.from && zone.to && zone.y_range) {
      table += table_line("contact from x", *zone.from, "", "length");
      table += table_line("contact to x", *zone.to, "", "length");
      table += table_line("contact from y", zone.y_range->first, "", "length");
      table += table_line("contact to y", zone.y_range->second, "", "length");
    } else if (zone.from && zone.to) {
      table += table_line("contact begins at", *zone.from, text_of(zone.from_within), "length");
      table += table_line("contact ends at", *zone.to, text_of(zone.to_within), "length");
    }
  }
  const Interval proved = certified != nullptr ? proved_compliance(*certified) : Interval();
  table += table_line("compliance L(u)", summary.compliance, proved_text_of(proved),
                      fmt::format("that of f u times length^{}", d));
  return table;
}

std::string summary_text(const SceneFile& file, const SceneSummary& summary,
                         const RunSeconds& seconds, double files,
                         const CertifiedSolution* certified) {
  Json s;
  s["element"] = file.method.element;
  s["solver"] = file.method.solver;
  s["epsilon"] = or_null(file.scene.epsilon());
  s["h"] = summary.h;
  s["dofs"] = summary.unknowns;
  s["effects"] = effects_of(file);
  s["energy"] = finite("the energy", summary.energy);
  s["compliance"] = compliance_of(summary, certified);
  s["u_max"] = finite("the maximum", summary.u_max);
  s["u_min"] = finite("the minimum", summary.u_min);
  if (has_contact(file)) {
    s["contact"] = contact_zone_of(summary.zone, file.mesh.dimension == 3);
    s["contact_force"] = contact_force_of(summary.force, summary.proved_force);
    s["kkt"] = {{"min_gap", summary.kkt.min_gap},
                {"min_pressure", summary.kkt.min_pressure},
                {"complementarity", summary.kkt.complementarity},
                {"residual", summary.kkt.residual}};
  } else {
    s["kkt"] = {{"residual", summary.kkt.residual}};
  }
  s["iterations"] = {{"contact", summary.contact_steps}, {"corrections", summary.corrections}};
  if (summary.coulomb)
    s["coulomb"] = {{"steps", summary.coulomb->steps},
                    {"contraction", summary.coulomb->contraction}};
  const Blas used = blas();
  s["blas"] = {{"name", used.name}, {"kernel", used.kernel}, {"threads", used.threads}};
  if (summary.layer) {
    const std::optional<double>& lost = summary.layer->lost;
    s["locking"] = {{"diagnosis", summary.layer->diagnosis},
                    {"kept", lost ? Json(1 - *lost) : Json(nullptr)},
                    {"lost_energy", or_null(lost)}};
  }
  if (summary.parallel)
    s["parallel"] = {{"ranks", summary.parallel->ranks},
                     {"petsc", summary.parallel->petsc},
                     {"levels", summary.parallel->levels},
                     {"linear_iterations", summary.parallel->linear_iterations},
                     {"memory_mb", summary.parallel->memory_mb}};
  for (Eigen::Index i = 0; i < summary.at.rows(); ++i)
    s["at"].push_back(values_at_point(summary.at.row(i), file.mesh.dimension));
  if (certified != nullptr) s["certificate"] = certificate(file.method, *certified);
  s["warning"] = summary.warning;
  s["scene"] = question(file);
  const auto& [mesh, assemble, factor, solve] = seconds;
  s["seconds"] = {{"mesh", mesh},     {"assemble", assemble},
                  {"factor", factor}, {"solve", solve},
                  {"files", files},   {"total", mesh + assemble + factor + solve + files}};
  return s.dump(2) + "\n";
}

void write_summary(const std::filesystem::path& path, const SceneFile& file,
                   const SceneSummary& summary, const RunSeconds& seconds, double files,
                   const CertifiedSolution* certified) {
  const std::string text = summary_text(file, summary, seconds, files, certified);
  write_file(path, [&](std::ostream& out) { out << text; });
}

std::string piece_name(int rank) { return fmt::format("solution_{}.vtu", rank); }

std::vector<std::string> result_names(const std::filesystem::path& folder, int ranks) {
  std::vector<std::string> names{"summary.json", "solution.csv", "contact.csv",
                                 "mesh.msh",     "solution.vtu", "solution.pvtu"};
  std::error_code absent;
  const bool earlier = ranks > 0 || std::filesystem::exists(folder / "solution.pvtu", absent);
  for (int r = 0; r < ranks || (earlier && std::filesystem::exists(folder / piece_name(r), absent));
       ++r)
    names.push_back(piece_name(r));
  return names;
}

void check_inputs_stay(const std::filesystem::path& folder, const std::filesystem::path& scene,
                       const SceneFile& file, int ranks) {
  for (const std::string& name : result_names(folder, ranks)) {
    std::error_code
        unknown;  // a folder that cannot be looked into is refused when it is written to
    if (std::filesystem::is_directory(folder / name, unknown))
      throw Error(fmt::format(
          "{}: --out: {} is a folder, where the result {} is to stand; accepted: another folder",
          file.name, printable((folder / name).string(), 1000), name));
    for (const std::filesystem::path& input : {scene, file.mesh.file, file.mesh.geometry})
      if (std::error_code absent;
          !input.empty() && std::filesystem::equivalent(folder / name, input, absent))
        throw Error(
            fmt::format("{}: --out: the result {} would replace {}; accepted: another folder",
                        file.name, name, printable(input.string(), 1000)));
  }
}

ResultFiles result_files(const std::string& words) {
  ResultFiles asked;
  std::istringstream in(words);
  for (std::string word; std::getline(in, word, ',');) {
    if (word != "summary" && word != "csv" && word != "mesh" && word != "vtu")
      throw Error(fmt::format(
          "--files: {:?} is none of the files; accepted: summary, csv, mesh, vtu, with commas",
          printable(word)));
    asked.insert(word);
  }
  if (asked.empty())
    throw Error("--files: names no file; accepted: summary, csv, mesh, vtu, with commas");
  return asked;
}

std::filesystem::path default_results_folder(const std::filesystem::path& scene) {
  const std::filesystem::path name = scene.stem();
  if (name.empty() || name == "." || name == "..")
    throw Error(fmt::format(
        "{}: --out: the name of the scene file without its extension, \"{}\", names no folder of "
        "its own; accepted: --out FOLDER, or another name",
        printable(scene.string(), 1000), name.string()));
  const std::filesystem::path results = "results", folder = results / name;
  for (const std::filesystem::path& part : {results, folder})
    if (std::error_code absent; std::filesystem::is_symlink(part, absent))
      throw Error(fmt::format(
          "{}: --out: {} is a link, which came with the scene, perhaps, and no --out names it; "
          "accepted: --out FOLDER",
          printable(scene.string(), 1000), printable(part.string(), 1000)));
  return folder;
}

void write_scene_results(const std::filesystem::path& folder, const SceneFile& file,
                         const Result& result, const SceneSummary& summary,
                         const CertifiedSolution* certified, const ResultFiles& asked) {
  const Stopwatch watch;
  const bool csv = asked.contains("csv"), vtu = asked.contains("vtu");
  const auto write = [&](const std::filesystem::path& draft) {
    if (csv) write_solution_csv(draft / "solution.csv", result.space, result.solution.u);
    Eigen::VectorXd pressure;  // empty without contact
    if (const auto contact = contact_results(file, result)) {
      Eigen::MatrixXd table = contact->table;
      const bool has_ceiling = file.scene.contact() && file.scene.contact()->upper_obstacle;
      if (!has_ceiling)  // which presses downwards: a pressure below 0
        table.rightCols<2>() =
            table.rightCols<2>().cwiseMax(0.0);  // certified: what is below zero is round-off
      if (file.scene.contact()) pressure = table.rightCols<1>();  // of the unknowns on Gamma_C
      const auto friction =
          std::visit([&](const auto& model) { return model.friction_forces(result); }, file.model);
      if (csv) write_contact(draft / "contact.csv", table, friction);
    }
    if (asked.contains("mesh"))
      write_msh(draft / "mesh.msh", result.space.mesh(), file.scene.edges());
    if (vtu)
      std::visit(
          [&](const auto& model) { model.write_picture(draft / "solution.vtu", result, pressure); },
          file.model);
    write_summary(draft / "summary.json", file, summary, result.seconds, watch.seconds(),
                  certified);
  };
  write_folder(folder, write, result_names(folder));
}

}  // namespace antilock
