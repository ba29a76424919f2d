// antilock sweep SCENE.toml --epsilon 1e0:1e-8:9 --cells 8,16,32 --at 0.25,-1: one table over epsilon and meshes.
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "antilock/core/stopwatch.hpp"
#include "antilock/exact/sine_load.hpp"
#include "antilock/measure/detail/point_values.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/command_line.hpp"
#include "doors/doors.hpp"

namespace antilock::doors {
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
  for (int i = 0; i < count; ++i) list.push_back(range[0] * std::pow(range[1] / range[0], double(i) / (count - 1)));
  return list;
}

Scene with_epsilon(const Scene& scene, double epsilon) {
  return Scene(scene.body(), StiffLayer{epsilon}, scene.contact());
}

/// Largest |u| on the contact boundary: what locking takes away.
double ridge(const Space& space, const Eigen::VectorXd& u) {
  double largest = 0;
  for (const int i : space.contact()) largest = std::max(largest, std::abs(u(i)));
  return largest;
}

}  // namespace

int sweep(int argc, char** argv) {
  tutorial::CommandLine line(
      "One scene, asked for many epsilons on many meshes: a table, printed and as CSV. The questions on "
      "one mesh share assembly and, where they can, the factorisation.",
      "antilock sweep");
  std::filesystem::path scene, out;
  std::string epsilon_text = "1:1e-8:9", cells_text, at_text;
  line.add_required("SCENE", scene, "the scene file, in TOML, with a scaled layer (run_scene --help)");
  line.add("--epsilon", epsilon_text, "FROM:TO:COUNT, spaced by one factor, or a list such as 1,1e-2,0");
  line.add("--cells", cells_text, "a list of cells per unit side, such as 8,16,32; default: the mesh of the scene");
  line.add("--at", at_text, "X,Y: a point whose u is listed");
  line.add("--out", out, "the CSV file; default: none, the table is printed alone");
  if (const auto status = line.parse(argc, argv)) return *status;

  SceneFile file = read_scene_file(scene);
  if (!std::holds_alternative<StiffLayer>(file.scene.layer()))
    throw Error(file.name + ": layer.model: epsilon does not vary in this scene; accepted: a scaled layer");
  const std::vector<double> list = epsilons(epsilon_text);
  std::vector<Truth> truths;  // an epsilon out of range is refused here
  bool known = true;
  for (const double e : list) {
    const Scene one = with_epsilon(file.scene, e);
    if (std::optional<Truth> truth = known ? truth_of(one) : std::nullopt)
      truths.push_back(std::move(*truth));
    else
      known = false;
  }
  std::optional<Eigen::Vector2d> at;
  if (!at_text.empty()) {
    const std::vector<double> xy = numbers("--at", at_text, ',');
    if (xy.size() != 2) throw Error("antilock sweep: --at: \"" + at_text + "\"; accepted: X,Y");
    at.emplace(xy[0], xy[1]);
  }
  std::vector<int> cells;
  for (const double n :
       cells_text.empty() ? std::vector<double>{double(file.mesh.cells)} : numbers("--cells", cells_text, ',')) {
    if (!cells_text.empty() && (file.mesh.kind == MeshRequest::Kind::file || n != std::floor(n) || n < 1 || n > 512))
      throw Error("antilock sweep: --cells: \"" + cells_text +
                  "\"; accepted: whole numbers from 1 to 512, for a scene whose mesh is made");
    cells.push_back(static_cast<int>(n));
  }

  std::vector<std::string> columns{"cells", "epsilon", "unknowns"};
  if (at) columns.emplace_back("u_at");
  columns.emplace_back("ridge");
  if (known) columns.insert(columns.end(), {"kept", "error_max", "error_energy"});
  columns.insert(columns.end(), {"corrections", "contact_steps", "seconds"});
  Table table(columns);
  std::vector<TruthTable> tables;
  if (known)
    for (const Truth& truth : truths) tables.emplace_back(truth);
  for (const int n : cells) {
    file.mesh.cells = n;
    const TriangleMesh mesh = make_mesh(file);
    const Space space(mesh, element(file.method.element));
    SceneSweep questions(file.scene, space);
    const PointValues values(space);
    std::optional<PointValues::Place> place;
    if (at && !(place = values.locate(*at)))
      throw Error(fmt::format("antilock sweep: --at: ({}, {}) is outside the mesh; accepted: a point of it", (*at)(0),
                              (*at)(1)));
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Stopwatch watch;
      questions.set_epsilon(list[i]);
      const Solution solution = questions.solve();
      const double seconds = watch.seconds(), found = ridge(space, solution.u);
      std::vector<Entry> row{n, list[i], space.free_count()};
      if (at) row.emplace_back(values.value(solution.u, *place));
      row.emplace_back(found);
      if (known) {
        const Errors errors = measure_errors(space, solution, list[i], reference(tables[i]));
        row.emplace_back(truths[i].max_on_contact() > 0 ? found / truths[i].max_on_contact() : 1);
        row.emplace_back(errors.max_at_unknowns);
        row.emplace_back(errors.energy);
      }
      row.insert(row.end(), {solution.counters.corrections, solution.counters.contact, seconds});
      table.add(row);
    }
  }
  if (!out.empty()) table.write(out);
  table.print(file.title.empty() ? file.name : file.title);
  if (!known)
    fmt::print("  no exact solution is known of this scene: no errors (antilock truth --help says of which)\n");
  return 0;
}

}  // namespace antilock::doors
