#include "programs/petsc/scene_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "antilock/analysis/layer_components.hpp"
#include "antilock/core/atomic_file.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/distributed/kkt_report.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/form/edge_forms.hpp"
#include "antilock/io/write_csv.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/runner/scene_results.hpp"
#include "programs/petsc/atomic_files.hpp"

namespace antilock::distributed {
namespace {

namespace fs = std::filesystem;

/// J(u) = a(u, u)/2 - L(u), the stiff part as compliance p' M p: a sum over the pieces.
double energy_of_all(const NestedLevel& level) {
  const VariationalInequality& part = level.problem.part();
  const Eigen::VectorXd &u = level.state.u, &p = level.state.p;
  return sum(u.dot(part.a1 * u) / 2 + part.compliance * p.dot(part.m.cwiseProduct(p)) / 2 -
             part.load.dot(u));
}

/// Per unknown of the subdomain: the contact pressure, a density; 0 off Gamma_C. Certified: below
/// zero is round-off.
Eigen::VectorXd pressures(const NestedLevel& level) {
  const DofMap& rows = level.problem.rows();
  const Eigen::VectorXd lambda = contact_forces(level.problem, level.state);
  const Vector v = rows.vector();
  rows.summed(edge_load(level.space, EdgeTag::contact, [](double, double) { return 1.0; }), v);
  {
    Entries values(v);  // the length of Gamma_C that each unknown stands for
    for (int place = 0; place < rows.owned(); ++place)
      values[place] = std::isinf(level.problem.lower()(place))
                          ? 0
                          : std::max(lambda(place) / values[place], 0.0);
  }
  return rows.local(v);
}

/// One row per contact unknown of all ranks, by x: x, gap, pressure.
Eigen::MatrixX3d contact_table_of_all(const NestedLevel& level, const Eigen::VectorXd& pressure) {
  const DofMap& rows = level.problem.rows();
  std::vector<double> mine;
  for (int place = 0; place < rows.owned(); ++place) {
    const double lower = level.problem.lower()(place);
    if (std::isinf(lower)) continue;
    const int i = rows.unknown(place);
    mine.insert(mine.end(), {level.space.dof_coordinates()(i, 0),
                             std::max(level.state.u(i) - lower, 0.0), pressure(i)});
  }
  const std::vector<double> all = all_gather(mine);
  std::vector<std::array<double, 3>> sorted(all.size() / 3);
  for (std::size_t i = 0; i < sorted.size(); ++i)
    sorted[i] = {all[3 * i], all[3 * i + 1], all[3 * i + 2]};
  std::sort(sorted.begin(), sorted.end());
  Eigen::MatrixX3d table(static_cast<Eigen::Index>(sorted.size()), 3);
  for (Eigen::Index i = 0; i < table.rows(); ++i)
    table.row(i) << sorted[i][0], sorted[i][1], sorted[i][2];
  return table;
}

/// Layer stress and pressure as a VTU file takes them: per triangle, and per contact unknown of the
/// subdomain.
VtuFields fields_of(const NestedLevel& level, const Eigen::VectorXd& pressure, bool contact) {
  const TriangleMesh& mesh = level.space.mesh();
  VtuFields fields{Eigen::VectorXd::Zero(mesh.triangle_count()), {}};
  for (int t = 0, row = 0; t < mesh.triangle_count() && row < level.state.p.size(); ++t)
    if (mesh.region[t] == Region::layer)
      fields.p(t) = level.state.p(row++);  // one row of B per layer triangle
  if (contact) fields.pressure = pressure(level.space.contact_dofs());
  return fields;
}

void write_pvtu(const fs::path& path, bool contact) {
  write_file(path, [&](std::ostream& out) {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\" "
           "byte_order=\"LittleEndian\">\n"
           "<PUnstructuredGrid GhostLevel=\"0\">\n"
           "<PPointData Scalars=\"u\">\n<PDataArray type=\"Float64\" Name=\"u\"/>\n"
        << (contact ? "<PDataArray type=\"Float64\" Name=\"pressure\"/>\n" : "")
        << "</PPointData>\n<PCellData Scalars=\"region\">\n<PDataArray type=\"Int32\" "
           "Name=\"region\"/>\n"
           "<PDataArray type=\"Float64\" Name=\"p\"/>\n</PCellData>\n"
           "<PPoints>\n<PDataArray type=\"Float64\" NumberOfComponents=\"3\"/>\n</PPoints>\n";
    for (int r = 0; r < ranks(); ++r) out << "<Piece Source=\"" << piece_name(r) << "\"/>\n";
    out << "</PUnstructuredGrid>\n</VTKFile>\n";
  });
}

/// The contact force: a sum over the ranks, each with the rows that it owns.
ContactForce contact_force_of_all(const NestedLevel& level) {
  const DofMap& rows = level.problem.rows();
  const Eigen::VectorXd lambda = contact_forces(level.problem, level.state);
  ContactForce force;
  for (int place = 0; place < rows.owned(); ++place) {
    force.normal += lambda(place);
    force.moment += lambda(place) * level.space.dof_coordinates()(rows.unknown(place), 0);
  }
  force.normal = sum(force.normal);
  force.moment = sum(force.moment);
  return force;
}

/// Every number of the summary that all ranks must form together.
SceneSummary summary_of_all(const SceneFile& file, const NestedLevel& level,
                            const NestedReport& report, int levels,
                            const std::optional<LockingReport>& layer, const std::string& warning) {
  SceneSummary s;
  s.layer = layer;
  const bool from_file = file.mesh.from_file();
  s.h = from_file ? largest(level.space.mesh().diameter())
                  : 1.0 / (file.mesh.cells << file.mesh.refinements);
  s.unknowns = level.problem.rows().total();
  s.energy = energy_of_all(level);
  s.u_max = largest(level.state.u.maxCoeff());
  s.u_min = -largest(-level.state.u.minCoeff());
  s.compliance = sum(level.problem.part().load.dot(level.state.u));
  if (file.scene.contact()) {
    const ContactSet set = level.contact_set();
    const auto [left, right] = contact_ends(level.space.mesh());  // of this rank
    s.zone = contact_zone(
        Eigen::Map<const Eigen::VectorXd>(set.x.data(), static_cast<Eigen::Index>(set.x.size())),
        {set.active.begin(), set.active.end()}, {-largest(-left), largest(right)});
    s.force = contact_force_of_all(level);
  }
  s.kkt = report.kkt;
  s.contact_steps = report.last.set_changes + 1;
  s.corrections = report.last.corrections;
  s.parallel = {ranks(), petsc_version(), levels, report.linear_iterations, peak_megabytes()};
  s.warning = warning;
  return s;
}

}  // namespace

std::optional<LockingReport> layer_report_of_all(const SceneFile& file, const TriangleMesh& coarse,
                                                 int refinements, const NestedLevel& level) {
  const Scene& scene = file.scene;
  const bool may_lock = scene.layer_depth() > 0 && level.space.element().conforming() &&
                        !layer_components(coarse).is_aligned;
  std::vector<double> values;
  for (int i = 0; may_lock && i < level.space.size(); ++i)
    values.insert(values.end(), {level.space.dof_coordinates()(i, 0),
                                 level.space.dof_coordinates()(i, 1), level.state.u(i)});
  values = all_gather(values);
  std::optional<LockingReport> report;
  collectively([&] {
    if (rank() > 0) return;
    TriangleMesh mesh = coarse;
    for (int i = 0; may_lock && i < refinements; ++i) mesh = refined(mesh);
    Result whole{.space = Space(std::move(mesh), level.space.element())};
    if (may_lock) {
      const Space& space = whole.space;
      // the pieces and this mesh were refined apart: their points agree to round-off
      const auto key = [](double x, double y) {
        return std::pair(std::llround(1e9 * x), std::llround(1e9 * y));
      };
      std::map<std::pair<long long, long long>, double> at;
      for (std::size_t i = 0; i < values.size(); i += 3)
        at[key(values[i], values[i + 1])] = values[i + 2];
      whole.problem = assemble(scene, space);
      Solution& solution = whole.solution;
      solution.u.resize(space.size());
      for (int i = 0; i < space.size(); ++i)
        solution.u(i) = at.at(key(space.dof_coordinates()(i, 0), space.dof_coordinates()(i, 1)));
      solution.p = Eigen::VectorXd::Zero(whole.problem.b.rows());
      if (whole.problem.compliance > 0)
        solution.p = whole.problem.b * solution.u / whole.problem.compliance;
    }
    report = report_locking(scene, whole);
  });
  return report;
}

void write_scene_files(const fs::path& folder, const SceneFile& file, const NestedLevel& level,
                       const NestedReport& report, int levels,
                       const std::optional<LockingReport>& layer, const std::string& warning,
                       const RunSeconds& seconds) {
  const bool contact = file.scene.contact().has_value();
  const bool csv = level.problem.rows().total() <= most_csv_unknowns;
  const SceneSummary summary = summary_of_all(file, level, report, levels, layer, warning);
  const Stopwatch files;
  const auto write = [&](const fs::path& draft) {
    if (csv) write_solution_csv_together(draft / "solution.csv", level);
    write_msh_together(draft / "mesh.msh", level.space);
    const Eigen::VectorXd pressure = pressures(level);
    const Eigen::MatrixX3d table = contact_table_of_all(level, pressure);
    const VtuFields fields = fields_of(level, pressure, contact);
    collectively(
        [&] { write_vtu(draft / piece_name(rank()), level.space, level.state.u, fields); });
    collectively([&] {
      if (rank() > 0) return;
      write_pvtu(draft / "solution.pvtu", contact);
      if (contact) write_csv(draft / "contact.csv", {"x", "gap", "pressure"}, table);
      write_summary(draft / "summary.json", file, summary, seconds, files.seconds());
    });
  };
  write_folder_together(folder, write, result_names(folder));
}

}  // namespace antilock::distributed
