// antilock sweep SCENE.toml --epsilon 1e0:1e-8:9 --cells 8,16,32 --at 0.25,-1: one table over
// epsilon and meshes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/exact/sine_load.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/measure/point_values.hpp"
#include "antilock/runner/scene_mesh.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "antilock/study/table.hpp"
#include "programs/program.hpp"
#include "programs/subcommands/subcommands.hpp"

namespace antilock::subcommands {
namespace {

/// The numbers of a list such as "8,16,32"; throws Error, `option` first.
std::vector<double> numbers(const std::string& option, const std::string& text, char separator) {
  std::vector<double> list;
  for (const char *from = text.data(), *const end = from + text.size();;) {
    double value = 0;
    const auto [next, error] = std::from_chars(from, end, value);
    if (error != std::errc() || !std::isfinite(value) || (next != end && *next != separator))
      throw Error(
          fmt::format("antilock sweep: {}: \"{:.60}\"; accepted: numbers, with \"{}\" between them",
                      option, text, separator));
    list.push_back(value);
    if (next == end) return list;
    from = next + 1;
  }
}

/// "1e0:1e-8:9": from, to, how many, the same factor between neighbours; or a list, in which 0 may
/// stand.
std::vector<double> epsilons(const std::string& text) {
  if (text.find(':') == std::string::npos) return numbers("--epsilon", text, ',');
  const std::vector<double> range = numbers("--epsilon", text, ':');
  if (range.size() != 3 || range[0] <= 0 || range[1] <= 0 || range[2] < 2 || range[2] > 1000 ||
      range[2] != std::floor(range[2]))
    throw Error("antilock sweep: --epsilon: \"" + text +
                "\"; accepted: FROM:TO:COUNT, both above 0, 2 to 1000 values");
  std::vector<double> list;
  const int count = static_cast<int>(range[2]);
  list.reserve(count);
  for (int i = 0; i < count; ++i)
    list.push_back(range[0] * std::pow(range[1] / range[0], double(i) / (count - 1)));
  return list;
}

/// One mesh of the sweep, with the points that are asked for.
struct OnMesh {
  int cells;
  Space space;
  std::vector<PointValues::Location> places;
};

/// The arguments of the command line.
struct SweepRequest {
  std::filesystem::path scene;
  std::filesystem::path out;
  std::string epsilons = "1:1e-8:9";
  std::string cells;
  std::string at;
};

void add_sweep_arguments(CLI::App& line, SweepRequest& request) {
  line.add_option("SCENE", request.scene,
                  "the scene file, in TOML, with a scaled layer (run_scene --help)")
      ->required();
  line.add_option("--epsilon", request.epsilons,
                  "FROM:TO:COUNT, spaced by one factor, or a list such as 1,1e-2,0");
  line.add_option("--cells", request.cells,
                  "a list of cells per unit side, such as 8,16,32; default: the mesh of the scene");
  line.add_option("--at", request.at, "X,Y, or X,Y,X,Y,...: points whose u is listed");
  line.add_option("--out", request.out, "the CSV file; default: none, the table is printed alone");
  line.footer(
      "The penalty delta of a mesh is chosen from its matrices. All epsilon with epsilon^2 <= "
      "delta share one "
      "factorisation, and are corrected; each larger epsilon has its own, since corrections with a "
      "smaller delta need "
      "not converge there, and with a larger one are many. The column factorisations counts them.");
}

/// x,y,x,y,...: the points whose u is listed.
std::vector<double> points_to_list(const std::string& text) {
  std::vector<double> at;
  if (!text.empty()) at = numbers("--at", text, ',');
  if (at.size() % 2 != 0)
    throw Error("antilock sweep: --at: \"" + text +
                "\"; accepted: X,Y, or X,Y,X,Y for more points");
  return at;
}

/// The numbers of cells per unit side.
std::vector<double> cells_to_solve(const std::string& text, const MeshRequest& mesh) {
  if (text.empty()) return {double(mesh.cells)};
  return numbers("--cells", text, ',');
}

void check_cells(double n, const std::string& text, const MeshRequest& mesh) {
  if (text.empty()) return;
  if (mesh.from_file() || n != std::floor(n) || n < 1 || n > 512)
    throw Error("antilock sweep: --cells: \"" + text +
                "\"; accepted: whole numbers from 1 to 512, for a scene whose mesh is made");
}

/// The mesh of a scene file, with the points. Throws where a point is outside, before anything is
/// solved.
OnMesh on_mesh(const SceneFile& file, const std::vector<double>& at) {
  OnMesh on{file.mesh.cells, Space(make_mesh(file), element(file.method.element)), {}};
  if (on.space.free_count() == 0)
    throw Error(fmt::format(
        "{}: mesh: with {} cells every unknown is clamped, none is left to solve for; accepted: a "
        "finer mesh",
        file.name, on.cells));
  const PointValues values(on.space);
  for (std::size_t i = 0; i < at.size(); i += 2) {
    const auto place = values.locate({at[i], at[i + 1], 0});
    if (!place)
      throw Error(
          fmt::format("antilock sweep: --at: ({}, {}) is outside the mesh; accepted: points of it",
                      at[i], at[i + 1]));
    on.places.push_back(*place);
  }
  return on;
}

/// The exact solutions of the scenes and their tables: of all of them, or of none.
struct ExactSolutions {
  std::vector<ExactSolution> solutions;
  std::vector<ExactTable> tables;

  bool known() const { return !solutions.empty(); }
};

ExactSolutions exact_solutions_of(const std::vector<Scene>& scenes) {
  ExactSolutions exact;
  for (const Scene& scene : scenes) {
    std::optional<ExactSolution> solution = exact_solution_of(scene);
    if (!solution) break;  // it is the load or the gap: known of every epsilon or of none
    exact.tables.emplace_back(*solution);
    exact.solutions.push_back(std::move(*solution));
  }
  return exact;
}

std::vector<std::string> sweep_columns(std::size_t points, bool known) {
  std::vector<std::string> columns{"cells", "epsilon", "unknowns"};
  for (std::size_t i = 1; i <= points; ++i)
    columns.push_back(points == 1 ? "u_at" : fmt::format("u_at_{}", i));
  columns.emplace_back("ridge");
  if (known) columns.insert(columns.end(), {"kept", "error_max", "error_energy"});
  columns.insert(columns.end(), {"factorisations", "corrections", "contact_steps", "seconds"});
  return columns;
}

/// Solves on a mesh for each epsilon of the list, and adds a row each.
void add_rows(Table& table, const Scene& scene, const OnMesh& on, const std::vector<double>& list,
              const ExactSolutions& exact) {
  SceneSweep questions(scene, on.space);
  const PointValues values(on.space);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Stopwatch watch;
    questions.set_epsilon(list[i]);
    const Solution solution = questions.solve();
    const double seconds = watch.seconds();
    const double found = layer_displacement(on.space, solution.u);
    std::vector<TableEntry> row{on.cells, list[i], on.space.free_count()};
    for (const PointValues::Location& place : on.places)
      row.emplace_back(values.value(solution.u, place));
    row.emplace_back(found);
    if (exact.known()) {
      const Errors errors = measure_errors(on.space, solution, list[i], reference(exact.tables[i]));
      const double whole = exact.solutions[i].max_on_contact();
      row.emplace_back(whole > 0 ? found / whole : 1);
      row.emplace_back(errors.max_at_unknowns);
      row.emplace_back(errors.energy);
    }
    const Counters& c = solution.counters;
    row.insert(row.end(), {c.factorisations, c.corrections, c.contact_iterations, seconds});
    table.add(row);
  }
}

}  // namespace

double layer_displacement(const Space& space, const Eigen::VectorXd& u) {
  double largest = 0;
  for (const int i : space.contact_dofs()) largest = std::max(largest, std::abs(u(i)));
  return largest;
}

int sweep(int argc, char** argv) {
  CLI::App line(
      "One scene, asked for many epsilons on many meshes: a table, printed and as CSV. The "
      "questions on "
      "one mesh share assembly and, where they can, the factorisation.",
      "antilock sweep");
  SweepRequest request;
  add_sweep_arguments(line, request);
  if (const auto status = tutorial::parse(line, argc, argv)) return *status;

  SceneFile file = read_scene_file(request.scene);
  check_not_an_input(request.out, {request.scene, file.mesh.file});
  require_paper_problem(file, "sweep");
  if (!std::holds_alternative<StiffLayer>(file.scene.layer()))
    throw Error(file.name +
                ": layer.model: epsilon does not vary in this scene; accepted: a scaled layer");
  std::vector<Scene> scenes;  // an epsilon out of range is refused here
  const std::vector<double> list = epsilons(request.epsilons);
  scenes.reserve(list.size());
  for (const double e : list)
    scenes.emplace_back(file.scene.body(), StiffLayer{e}, file.scene.contact());
  const std::vector<double> at = points_to_list(request.at);
  std::vector<OnMesh> meshes;
  for (const double n : cells_to_solve(request.cells, file.mesh)) {
    check_cells(n, request.cells, file.mesh);
    file.mesh.cells = static_cast<int>(n);
    meshes.push_back(on_mesh(file, at));
  }
  ExactSolutions exact;
  const bool square = !file.mesh.from_file() || is_unit_square(meshes.front().space.mesh());
  if (square) exact = exact_solutions_of(scenes);

  Table table(sweep_columns(at.size() / 2, exact.known()));
  for (const OnMesh& on : meshes) add_rows(table, file.scene, on, list, exact);
  if (!request.out.empty()) table.write(request.out);
  table.print(file.title.empty() ? file.name : file.title);
  if (!exact.known())
    fmt::print(
        "  no exact solution is known of this scene: no errors (antilock exact --help says of "
        "which)\n");
  return 0;
}

}  // namespace antilock::subcommands
