// antilock exact SCENE.toml < points.csv: the exact solution of a scene at given points.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "antilock/core/atomic_file.hpp"
#include "antilock/exact/exact_table.hpp"
#include "antilock/exact/sine_load.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/measure/point_values.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/runner/scene_mesh.hpp"
#include "programs/program.hpp"
#include "programs/subcommands/csv_reader.hpp"
#include "programs/subcommands/subcommands.hpp"

namespace antilock::subcommands {
namespace {

using nlohmann::json;

/// One row of the answer; p in the layer alone.
struct Row {
  double u = 0;
  Eigen::Vector2d gradient = {0, 0};
  std::optional<double> p = {};
};

/// What is known beside the values at the points: numbers with their accuracies, and how they were
/// found.
struct Known {  // NOLINT(bugprone-exception-escape): JSON is moved without a throw
  std::vector<Row> rows;
  json summary;
};

const char* const outside =
    "outside the domain; accepted: points of the closed body and, with a layer, of the layer";

// Up to this many points each is summed on its own, a millisecond each; beyond, the table is
// cheaper, 0.1 s to build.
constexpr Eigen::Index few = 256;

// Another program's coordinates are rounded: a point so far outside counts as on the boundary. u is
// right to 1e-8.
constexpr double rounded = 1e-9;

/// The norms of the solution: the errors of the function 0, on a mesh whose quadrature leaves 1e-4
/// of them.
json norms_of(const ExactSolution& exact_solution) {
  const Space space(structured_mesh(64), p1());
  Solution zero;
  zero.u.setZero(space.size());
  zero.p.setZero(std::count(space.mesh().region.begin(), space.mesh().region.end(), Region::layer));
  const ExactTable table(exact_solution);
  const Errors norm = measure_errors(space, zero, exact_solution.epsilon(), reference(table));
  return {{"max", norm.max}, {"l2", norm.l2}, {"h1", norm.h1}, {"energy", norm.energy}};
}

Known by_series(const ExactSolution& exact_solution, const Eigen::MatrixXd& points, bool layer) {
  Known known;
  std::optional<ExactTable> table;
  if (points.rows() > few) table.emplace(exact_solution);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double x = std::clamp(points(i, 0), 0.0, 1.0),
                 y = std::clamp(points(i, 1), layer ? -1.0 : 0.0, 1.0);
    if (!(std::hypot(x - points(i, 0), y - points(i, 1)) <= rounded))
      throw Error(fmt::format("points: ({}, {}) is {}", points(i, 0), points(i, 1), outside));
    Row row{table ? table->value(x, y) : exact_solution.value(x, y),
            table ? table->gradient(x, y) : exact_solution.gradient(x, y)};
    if (layer && y <= 0)
      row.p = table ? table->layer_stress(x, y) : exact_solution.layer_stress(x, y);
    known.rows.push_back(row);
  }
  json zones = json::array();
  for (const auto& [from, to] : exact_solution.contact_zones()) zones.push_back({from, to});
  const int n = 1 << 17;
  known.summary = {
      {"kind", "exact"},
      {"energy", exact_solution.energy()},
      {"contact", zones},
      {"max_on_contact", exact_solution.max_on_contact()},
      {"accuracy",
       {{"u", 1e-8},
        {"gradient", fmt::format("4e-6 of the largest; 5e-4 within 1e-4 of an end of contact")},
        {"p", "1e-6; 1e-4 near an end of contact, where it jumps at epsilon = 0"},
        {"contact", 1.0 / n},
        {"norms", "1e-4 of each"},
        {"energy", 1e-8}}}};
  return known;
}

Known by_certificate(const SceneFile& file, double accuracy, const Eigen::MatrixXd& points) {
  const CertifiedSolution found = certified(file, accuracy);
  Known known;
  const Solution& solution = found.result.solution;
  const TriangleMesh& mesh = found.result.space.mesh();
  const PointValues at(found.result.space);
  const bool scaled = std::holds_alternative<StiffLayer>(file.scene.layer());
  const std::vector<int> p_row = stress_rows(mesh);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    Eigen::Vector2d x = points.row(i);
    if (std::abs(x(1)) < rounded) x(1) = rounded;  // on Sigma the gradient is the body's
    const auto place = at.locate({x(0), x(1), 0}, rounded);
    if (!place)
      throw Error(fmt::format("points: ({}, {}) is {}", points(i, 0), points(i, 1), outside));
    Row row{at.value(solution.u, *place), at.gradient(solution.u, *place).head<2>()};
    if (scaled && mesh.region[place->triangle] == Region::layer)
      row.p = solution.p(p_row[place->triangle]);
    known.rows.push_back(row);
  }
  const Certificate& proof = found.certificate;
  known.summary = {{"kind", "certified"},
                   {"energy", {proof.energy_lower, proof.energy_upper}},
                   {"bound", proof.gradient},
                   {"relative", proof.relative(Quantity::displacement)},
                   {"accuracy",
                    "bound: of the energy norm of the error of the gradients, proved; of a value "
                    "nothing is proved"},
                   {"warning", found.result.warning}};
  return known;
}

}  // namespace

bool is_unit_square(const TriangleMesh& mesh) {
  for (const Region region : {Region::body, Region::layer}) {
    Eigen::AlignedBox2d box;
    double area = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.region[t] != region) continue;
      area += mesh.area(t);
      for (int i = 0; i < 3; ++i) box.extend(mesh.vertices.row(mesh.triangles(t, i)).transpose());
    }
    if (box.isEmpty()) continue;  // Ventcel's term has no layer
    const Eigen::Vector2d low(0, region == Region::body ? 0 : -1);
    constexpr double digits = 1e-6;  // of a file
    if ((box.min() - low).norm() > digits ||
        (box.max() - low - Eigen::Vector2d(1, 1)).norm() > digits || std::abs(area - 1) > digits)
      return false;
  }
  const double lowest = mesh.vertices.col(1).minCoeff();
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_triangles(e, 1) >= 0) continue;
    const double highest_end =
        std::max(mesh.vertices(mesh.edges(e, 0), 1), mesh.vertices(mesh.edges(e, 1), 1));
    const EdgeTag expected = highest_end < lowest + 1e-6 ? EdgeTag::contact : EdgeTag::clamped;
    if (mesh.edge_tag[e] != expected) return false;
  }
  return true;
}

std::vector<int> stress_rows(const TriangleMesh& mesh) {
  std::vector<int> row(mesh.region.size());
  for (std::size_t t = 1; t < row.size(); ++t)
    row[t] = row[t - 1] + (mesh.region[t - 1] == Region::layer);
  return row;
}

CertifiedSolution certified(const SceneFile& file, double accuracy) {
  return solve_to(file.scene, make_mesh(file),
                  AccuracyGoal{accuracy, Quantity::displacement, file.method.most_unknowns});
}

int exact(int argc, char** argv) {
  CLI::App line(
      "The solution of a scene at given points. Standard input: CSV with the header x,y. Standard "
      "output: CSV with the "
      "header "
      "x,y,u,u_x,u_y,p. p is the layer stress, epsilon^-2 u_y, and empty in the body; on the "
      "contact boundary -p is "
      "the "
      "pressure. On Sigma, u_y is the body's.",
      "antilock exact");
  std::filesystem::path scene, summary;
  double accuracy = 1e-2;
  int digits = 17;
  line.add_option("SCENE", scene, "the scene file, in TOML (run_scene --help)")->required();
  line.add_option("--accuracy", accuracy,
                  "where no series is known: the proved relative error of the certified answer")
      ->check(CLI::Range(1e-4, 0.5));
  line.add_option("--digits", digits, "significant digits; 17 read back as the same double")
      ->check(CLI::Range(4, 17));
  line.add_option("--summary", summary,
                  "a JSON file: energy J, ends of contact, and the accuracy of every number");
  line.footer(
      "A load that is a sum of sines in x with polynomials in y has an exact solution, a series "
      "(scaled layer or its "
      "limit, "
      "obstacle at the distance 0). Any other scene is solved to a proved accuracy.\n"
      "Example: printf 'x,y\\n0.25,-1\\n' | antilock exact tutorials/scenes/figure8.toml");
  if (const auto status = tutorial::parse(line, argc, argv)) return *status;
  const SceneFile file = read_scene_file(scene);
  check_not_an_input(summary, {scene, file.mesh.file});
  require_paper_problem(file, argv[0]);
  const Eigen::MatrixXd points = read_csv(std::cin, "standard input", {"x", "y"});
  const bool square = !file.mesh.from_file() || is_unit_square(make_mesh(file));
  const std::optional<ExactSolution> series = square ? exact_solution_of(file.scene) : std::nullopt;
  Known known =
      series ? by_series(*series, points, std::holds_alternative<StiffLayer>(file.scene.layer()))
             : by_certificate(file, accuracy, points);
  known.summary["units"] = "everything is dimensionless";
  const json words = json::parse(file.json);
  known.summary["load"] = words["load"]["f"];
  known.summary["epsilon"] = file.scene.epsilon() ? json(*file.scene.epsilon()) : json(nullptr);
  known.summary["gap"] =
      file.scene.contact() ? json(words["contact"].value("gap", "0")) : json(nullptr);
  if (!summary.empty() && series && file.scene.layer_depth() > 0)
    known.summary["norms"] = norms_of(*series);
  if (!summary.empty())
    write_file(summary, [&](std::ostream& out) { out << known.summary.dump(2) << '\n'; });
  fmt::print("x,y,u,u_x,u_y,p\n");
  for (std::size_t i = 0; i < known.rows.size(); ++i) {
    const Row& row = known.rows[i];
    const auto n = static_cast<Eigen::Index>(i);
    const auto text = [digits](double value) { return fmt::format("{:.{}g}", value, digits); };
    fmt::print("{},{},{},{},{},{}\n", points(n, 0), points(n, 1), text(row.u),
               text(row.gradient(0)), text(row.gradient(1)), row.p ? text(*row.p) : "");
  }
  fmt::print(stderr, "antilock {}: {}, J = {}\n", argv[0], known.summary["kind"].get<std::string>(),
             known.summary["energy"].dump());
  return 0;
}

}  // namespace antilock::subcommands
