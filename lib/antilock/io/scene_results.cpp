#include "antilock/io/scene_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/blas.hpp"
#include "antilock/core/result_folder.hpp"
#include "antilock/core/stopwatch.hpp"
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

/// The question in full: with it and the mesh file anyone can ask it again.
Json question(const SceneFile& file) {
  const SceneWords& words = file.words;
  Json layer, mesh = {{"kind", words.mesh}};
  if (!words.model.empty()) layer = {{"epsilon", or_null(file.scene.epsilon())}, {"model", words.model}};
  if (file.mesh.kind == MeshRequest::Kind::file)
    mesh["file"] = words.file;
  else
    mesh["cells"] = file.mesh.cells;
  if (file.mesh.refinements > 0) mesh["refinements"] = file.mesh.refinements;
  Json method = {
      {"element", file.method.element}, {"solver", file.method.solver}, {"tolerance", file.method.tolerance}};
  if (file.method.accuracy) {
    method["accuracy"] = *file.method.accuracy;
    method["of"] = file.method.of == Quantity::stress ? "stress" : "displacement";
    method["most_unknowns"] = file.method.most_unknowns;
  }
  return {{"title", file.title},
          {"load", words.load},
          {"layer", layer},
          {"gap", file.scene.contact() ? Json(words.gap) : Json(nullptr)},
          {"mesh", mesh},
          {"method", method},
          {"version", ANTILOCK_VERSION}};
}

/// What was asked, what is proved, and the way there.
Json certificate(const SceneFile& file, const CertifiedSolution& certified) {
  const Certificate& proof = certified.certificate;
  Json levels = Json::array();
  for (const Level& level : certified.history)
    levels.push_back({{"unknowns", level.unknowns}, {"bound", level.bound}, {"seconds", level.seconds}});
  return {{"asked", *file.method.accuracy},
          {"of", file.method.of == Quantity::stress ? "stress" : "displacement"},
          {"relative", finite("the certified error", proof.relative(file.method.of))},
          {"bound", finite("the certified error", proof.bound(file.method.of))},
          {"energy_lower", proof.energy_lower},
          {"energy_upper", proof.energy_upper},
          {"levels", levels}};
}

/// T values of the layer stress: the mean over the rows of B that stand for a triangle, 0 on the body.
Eigen::VectorXd layer_stress(const TriangleMesh& mesh, const Eigen::VectorXd& p) {
  const auto triangles = std::count(mesh.region.begin(), mesh.region.end(), Region::layer);
  if (p.size() == 0 || triangles == 0) return {};
  const Eigen::Index rows = p.size() / triangles;
  Eigen::VectorXd stress = Eigen::VectorXd::Zero(mesh.triangle_count());
  Eigen::Index row = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer) {
      stress(t) = p.segment(row, rows).mean();
      row += rows;
    }
  return stress;
}

Json summary(const SceneFile& file, const Space& space, const VariationalInequality& problem,
             const Solution& solution) {
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
  const Blas used = blas();
  s["blas"] = {{"name", used.name}, {"kernel", used.kernel}, {"threads", used.threads}};
  return s;
}

/// What an earlier run on several ranks left in the folder: its pictures would pass for those of this one.
std::vector<std::string> pieces_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code absent;
  if (!std::filesystem::exists(folder / "solution.pvtu", absent)) return names;
  names.push_back("solution.pvtu");
  const auto piece = [](std::size_t rank) { return fmt::format("solution_{}.vtu", rank); };
  while (std::filesystem::exists(folder / piece(names.size() - 1), absent)) names.push_back(piece(names.size() - 1));
  return names;
}

}  // namespace

std::string question_json(const SceneFile& file) { return question(file).dump(); }

void check_inputs_stay(const std::filesystem::path& folder, const std::filesystem::path& scene, const SceneFile& file,
                       std::vector<std::string> more) {
  more.insert(more.end(), {"summary.json", "solution.csv", "contact.csv", "mesh.msh", "solution.vtu"});
  for (const std::string& name : more)
    for (const std::filesystem::path& input : {scene, file.mesh.file})
      if (std::error_code absent; !input.empty() && std::filesystem::equivalent(folder / name, input, absent))
        throw Error(fmt::format("{}: --out: the result {} would replace {}; accepted: another folder", file.name, name,
                                printable(input.string(), 1000)));
}

void write_scene_results(const std::filesystem::path& folder, const SceneFile& file, const Space& space,
                         const VariationalInequality& problem, const Solution& solution, const RunSeconds& seconds,
                         const std::string& warning, const CertifiedSolution* certified) {
  const Stopwatch watch;
  Json json = summary(file, space, problem, solution);
  if (certified != nullptr) json["certificate"] = certificate(file, *certified);
  json["warning"] = warning;
  json["scene"] = question(file);
  const bool contact = file.scene.contact().has_value();
  const auto write = [&](const std::filesystem::path& draft) {
    write_solution_csv(draft / "solution.csv", space, solution.u);
    VtuFields more{layer_stress(space.mesh(), solution.p), {}};
    if (contact) {
      Eigen::MatrixX3d table = contact_table(space, problem, solution);
      table.rightCols<2>() = table.rightCols<2>().cwiseMax(0.0);  // certified: what is below zero is round-off
      write_csv(draft / "contact.csv", {"x", "gap", "pressure"}, table);
      more.pressure = table.col(2);
    }
    write_msh(draft / "mesh.msh", space.mesh());
    write_vtu(draft / "solution.vtu", space, solution.u, more);
    const auto& [mesh, assemble, factor, solve] = seconds;
    const double files = watch.seconds();  // the summary itself is the last file
    json["seconds"] = {{"mesh", mesh},   {"assemble", assemble}, {"factor", factor},
                       {"solve", solve}, {"files", files},       {"total", mesh + assemble + factor + solve + files}};
    write_file(draft / "summary.json", [&](std::ostream& out) { out << json.dump(2) << "\n"; });
  };
  std::vector<std::string> stale = pieces_in(folder);
  if (!contact) stale.emplace_back("contact.csv");
  write_folder(folder, write, stale);
}

}  // namespace antilock
