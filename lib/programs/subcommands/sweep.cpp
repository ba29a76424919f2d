// antilock sweep SCENE.toml --epsilon 1e0:1e-8:9 --cells 8,16,32 --at 0.25,-1: one table over epsilon and meshes.
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
      throw Error(fmt::format("antilock sweep: {}: \"{:.60}\"; accepted: numbers, with \"{}\" between them", option,
                              text, separator));
    list.push_back(value);
    if (next == end) return list;
    from = next + 1;
  }
}

/// "1e0:1e-8:9": from, to, how many, the same factor between neighbours; or a list, in which 0 may stand.
std::vector<double> epsilons(const std::string& text) {
  if (text.find(':') == std::string::npos) return numbers("--epsilon", text, ',');
  const std::vector<double> range = numbers("--epsilon", text, ':');
  if (range.size() != 3 || range[0] <= 0 || range[1] <= 0 || range[2] < 2 || range[2] > 1000 ||
      range[2] != std::floor(range[2]))
    throw Error("antilock sweep: --epsilon: \"" + text + "\"; accepted: FROM:TO:COUNT, both above 0, 2 to 1000 values");
  std::vector<double> list;
  const int count = static_cast<int>(range[2]);
  list.reserve(count);
  for (int i = 0; i < count; ++i) list.push_back(range[0] * std::pow(range[1] / range[0], double(i) / (count - 1)));
  return list;
}

/// One mesh of the sweep, with the points that are asked for.
struct OnMesh {
  int cells;
  Space space;
  std::vector<PointValues::Location> places;
};

}  // namespace

double layer_displacement(const Space& space, const Eigen::VectorXd& u) {
  double largest = 0;
  for (const int i : space.contact_dofs()) largest = std::max(largest, std::abs(u(i)));
  return largest;
}

int sweep(int argc, char** argv) {
  CLI::App line(
      "One scene, asked for many epsilons on many meshes: a table, printed and as CSV. The questions on "
      "one mesh share assembly and, where they can, the factorisation.",
      "antilock sweep");
  std::filesystem::path scene, out;
  std::string epsilon_text = "1:1e-8:9", cells_text, at_text;
  line.add_option("SCENE", scene, "the scene file, in TOML, with a scaled layer (run_scene --help)")->required();
  line.add_option("--epsilon", epsilon_text, "FROM:TO:COUNT, spaced by one factor, or a list such as 1,1e-2,0");
  line.add_option("--cells", cells_text,
                  "a list of cells per unit side, such as 8,16,32; default: the mesh of the scene");
  line.add_option("--at", at_text, "X,Y, or X,Y,X,Y,...: points whose u is listed");
  line.add_option("--out", out, "the CSV file; default: none, the table is printed alone");
  line.footer(
      "The penalty delta of a mesh is chosen from its matrices. All epsilon with epsilon^2 <= delta share one "
      "factorisation, and are corrected; each larger epsilon has its own, since corrections with a smaller delta need "
      "not converge there, and with a larger one are many. The column factorisations counts them.");
  if (const auto status = tutorial::parse(line, argc, argv)) return *status;

  SceneFile file = read_scene_file(scene);
  check_not_an_input(out, {scene, file.mesh.file});
  require_paper_problem(file, "sweep");
  if (!std::holds_alternative<StiffLayer>(file.scene.layer()))
    throw Error(file.name + ": layer.model: epsilon does not vary in this scene; accepted: a scaled layer");
  std::vector<Scene> scenes;  // an epsilon out of range is refused here
  const std::vector<double> list = epsilons(epsilon_text);
  scenes.reserve(list.size());
  for (const double e : list) scenes.emplace_back(file.scene.body(), StiffLayer{e}, file.scene.contact());
  const std::vector<double> at = at_text.empty() ? std::vector<double>{} : numbers("--at", at_text, ',');
  if (at.size() % 2 != 0)
    throw Error("antilock sweep: --at: \"" + at_text + "\"; accepted: X,Y, or X,Y,X,Y for more points");
  std::vector<OnMesh> meshes;  // a point outside is refused here, before anything is solved
  for (const double n :
       cells_text.empty() ? std::vector<double>{double(file.mesh.cells)} : numbers("--cells", cells_text, ',')) {
    if (!cells_text.empty() && (file.mesh.from_file() || n != std::floor(n) || n < 1 || n > 512))
      throw Error("antilock sweep: --cells: \"" + cells_text +
                  "\"; accepted: whole numbers from 1 to 512, for a scene whose mesh is made");
    file.mesh.cells = static_cast<int>(n);
    OnMesh& on = meshes.emplace_back(OnMesh{file.mesh.cells, Space(make_mesh(file), element(file.method.element)), {}});
    if (on.space.free_count() == 0)
      throw Error(
          fmt::format("{}: mesh: with {} cells every unknown is clamped, none is left to solve for; accepted: a "
                      "finer mesh",
                      file.name, on.cells));
    const PointValues values(on.space);
    for (std::size_t i = 0; i < at.size(); i += 2) {
      const auto place = values.locate({at[i], at[i + 1]});
      if (!place)
        throw Error(fmt::format("antilock sweep: --at: ({}, {}) is outside the mesh; accepted: points of it", at[i],
                                at[i + 1]));
      on.places.push_back(*place);
    }
  }
  std::vector<ExactSolution> exact_solutions;
  std::vector<ExactTable> tables;
  const bool square = !file.mesh.from_file() || is_unit_square(meshes.front().space.mesh());
  for (const Scene& one : scenes) {
    std::optional<ExactSolution> exact = square ? exact_solution_of(one) : std::nullopt;
    if (!exact) break;  // it is the load or the gap: known of every epsilon or of none
    tables.emplace_back(*exact);
    exact_solutions.push_back(std::move(*exact));
  }
  const bool known = !exact_solutions.empty();

  std::vector<std::string> columns{"cells", "epsilon", "unknowns"};
  for (std::size_t i = 1; i <= at.size() / 2; ++i)
    columns.push_back(at.size() == 2 ? "u_at" : fmt::format("u_at_{}", i));
  columns.emplace_back("ridge");
  if (known) columns.insert(columns.end(), {"kept", "error_max", "error_energy"});
  columns.insert(columns.end(), {"factorisations", "corrections", "contact_steps", "seconds"});
  Table table(columns);
  for (const auto& [cells, space, places] : meshes) {
    SceneSweep questions(file.scene, space);
    const PointValues values(space);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Stopwatch watch;
      questions.set_epsilon(list[i]);
      const Solution solution = questions.solve();
      const double seconds = watch.seconds(), found = layer_displacement(space, solution.u);
      std::vector<TableEntry> row{cells, list[i], space.free_count()};
      for (const PointValues::Location& place : places) row.emplace_back(values.value(solution.u, place));
      row.emplace_back(found);
      if (known) {
        const Errors errors = measure_errors(space, solution, list[i], reference(tables[i]));
        row.emplace_back(exact_solutions[i].max_on_contact() > 0 ? found / exact_solutions[i].max_on_contact() : 1);
        row.emplace_back(errors.max_at_unknowns);
        row.emplace_back(errors.energy);
      }
      const Counters& c = solution.counters;
      row.insert(row.end(), {c.factorisations, c.corrections, c.contact_iterations, seconds});
      table.add(row);
    }
  }
  if (!out.empty()) table.write(out);
  table.print(file.title.empty() ? file.name : file.title);
  if (!known)
    fmt::print("  no exact solution is known of this scene: no errors (antilock exact --help says of which)\n");
  return 0;
}

}  // namespace antilock::subcommands
