#include "numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "antilock/certificate/certificate.hpp"
#include "antilock/core/error.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/graded.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "runner.hpp"

namespace antilock::freefem {
namespace {

Scene contact_scene(double epsilon) {
  return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{});
}

std::filesystem::path written(const TriangleMesh& mesh, const std::filesystem::path& folder) {
  write_freefem_mesh(folder / "mesh.freefem.msh", mesh);
  return folder / "mesh.freefem.msh";
}

ScriptTable results(const std::filesystem::path& path, Eigen::Index rows, int text = 0) {
  ScriptTable table = read_table(path, text);
  if (table.rows.rows() != rows)
    throw Error(fmt::format("{}: {} rows; accepted {}", path.string(), table.rows.rows(), rows));
  return table;
}

}  // namespace

double Number::difference() const {
  const double d = std::abs(ours - theirs) / scale;
  return std::isfinite(d) ? d : std::numeric_limits<double>::infinity();
}

double Numbers::difference() const {
  double worst = 0;
  for (const Number& number : all) worst = std::max(worst, number.difference());
  return worst;
}

void Numbers::relative(const std::string& name, double ours, double theirs) {
  all.push_back({name, ours, theirs, std::abs(ours)});
}

void Numbers::count(const std::string& name, double ours, double theirs) {
  all.push_back({name, ours, theirs, 1});
}

void Numbers::took(const std::string& roads) {
  std::istringstream words(roads);
  for (std::string word; std::getline(words, word, ';');) {
    word.erase(0, word.find_first_not_of(' '));
    if (road.find(word) == std::string::npos) road += (road.empty() ? "" : ", ") + word;
  }
}

void Numbers::solved(const Space& space, const Solution& solution) {
  unknowns = std::max(unknowns, space.size());
  seconds += solution.seconds.total();
}

Numbers roundoff(const std::string& element, int cells, const std::filesystem::path& folder) {
  const Space space(structured_mesh(cells), antilock::element(element));
  run("18_roundoff", {"-mesh", written(space.mesh(), folder), "-element",
                      element == "CR" ? "P1nc" : "P1", "-out", folder});
  const ScriptTable table = results(folder / "results.csv", 17, 1);
  SceneSweep sweep(contact_scene(1), space);
  Numbers numbers;
  for (int i = 0; i < 17; ++i) {
    const double epsilon = table.column("epsilon")(i);
    numbers.took(table.names[i]);
    const std::string at = fmt::format("{}, epsilon = {:g}: ", element, epsilon);
    numbers.relative(at + "epsilon", std::pow(10.0, -i), epsilon);
    sweep.set_epsilon(epsilon);
    const Solution solution = sweep.solve();
    numbers.solved(space, solution);
    numbers.relative(at + "energy", energy(sweep.problem(), solution), table.column("energy")(i));
    numbers.relative(at + "u_max", solution.u.maxCoeff(), table.column("u_max")(i));
  }
  numbers.freefem_seconds = table.column("seconds").sum();
  return numbers;
}

Numbers effects(int cells, double epsilon, const std::filesystem::path& folder) {
  const Body body{paper_load};
  const UnilateralContact obstacle;
  const Scene scenes[] = {Scene(body),
                          Scene(body, NoLayer{}, obstacle),
                          Scene(body, VentcelLayer{}),
                          Scene(body, StiffLayer{epsilon}),
                          Scene(body, StiffLayer{epsilon}, obstacle),
                          Scene(body, StiffLayer{0}, obstacle),
                          Scene(body, VentcelLayer{}, obstacle),
                          Scene(body, ThinLayer{epsilon}, obstacle)};
  run("23_effects",
      {"-cells", std::to_string(cells), "-epsilon", fmt::format("{}", epsilon), "-out", folder});
  const ScriptTable table = results(folder / "effects.csv", 8, 1);
  Numbers numbers;
  for (int i = 0; i < 8; ++i) {
    numbers.took(table.names[i]);
    const Space space(structured_mesh(cells, Domain{scenes[i].layer_depth()}), p1());
    const VariationalInequality problem = assemble(scenes[i], space);
    const Solution solution = active_set(problem);
    numbers.solved(space, solution);
    const std::string in = fmt::format("scene {}: ", i + 1);
    const auto held = std::count(solution.active.begin(), solution.active.end(), true);
    const double largest = solution.u.cwiseAbs().maxCoeff();
    numbers.count(in + "unknowns", space.size(), table.column("unknowns")(i));
    numbers.count(in + "in contact", static_cast<double>(held), table.column("active")(i));
    numbers.relative(in + "energy", energy(problem, solution), table.column("energy")(i));
    numbers.all.push_back({in + "u_min", solution.u.minCoeff(), table.column("u_min")(i), largest});
    numbers.all.push_back({in + "u_max", solution.u.maxCoeff(), table.column("u_max")(i), largest});
  }
  numbers.freefem_seconds = table.column("seconds").sum();
  return numbers;
}

Numbers limits(int cells, const std::filesystem::path& folder) {
  const TriangleMesh structured = structured_mesh(cells), unstructured = unstructured_mesh(cells);
  run("11_propositions",
      {"-cells", std::to_string(cells), "-mesh", written(unstructured, folder), "-out", folder});
  const ScriptTable table = results(folder / "limits.csv", 36, 2);
  const Reference zero{[](double, double) { return 0.0; },
                       [](double, double) { return Eigen::Vector2d::Zero().eval(); },
                       [](double, double) { return 0.0; }};
  Numbers numbers;
  Eigen::Index row = 0;
  for (const Element* element : {&p1(), &crouzeix_raviart()})
    for (const TriangleMesh* mesh : {&structured, &unstructured}) {
      const Space space(*mesh, *element);
      const std::string method =
          element->name() + (mesh == &structured ? " structured" : " unstructured");
      SceneSweep sweep(contact_scene(0), space);
      const Solution limit = sweep.solve();
      double largest = 0;
      for (int k = 0; k <= 8; ++k, ++row) {
        const std::size_t space_at = table.names[row].find(' ');  // "mixed P1 structured"
        if (table.names[row].substr(space_at + 1) != method)
          throw Error("limits.csv: " + table.names[row] + "; accepted " + method);
        numbers.took(table.names[row].substr(0, space_at));
        const double epsilon = std::pow(10.0, -0.5 * k);
        const std::string at = fmt::format("{}, epsilon = {:g}: ", method, epsilon);
        sweep.set_epsilon(epsilon);
        Solution solution = sweep.solve();
        numbers.solved(space, solution);
        solution.u -= limit.u;
        const double distance = measure_errors(space, solution, 1, zero).h1;
        largest = std::max(largest, distance);
        numbers.relative(at + "epsilon", epsilon, table.column("epsilon")(row));
        numbers.all.push_back({at + "distance", distance, table.column("distance")(row), largest});
      }
    }
  numbers.freefem_seconds = table.column("seconds").sum();
  return numbers;
}

Numbers certificate(int cells, const std::filesystem::path& folder) {
  const TriangleMesh mesh = unstructured_mesh(cells);
  run("19_certificate", {"-mesh", written(mesh, folder), "-out", folder});
  const ScriptTable table = results(folder / "results.csv", 5, 1);
  const Space above(mesh, p1()), below(above, crouzeix_raviart());
  SceneSweep upper(contact_scene(1), above), lower(contact_scene(1), below);
  Numbers numbers;
  const double epsilons[] = {1, 1e-1, 1e-2, 1e-4, 0};
  for (int i = 0; i < 5; ++i) {
    const std::string at = fmt::format("epsilon = {:g}: ", epsilons[i]);
    numbers.took(table.names[i]);
    upper.set_epsilon(epsilons[i]);
    lower.set_epsilon(epsilons[i]);
    const Solution high = upper.solve(), low = lower.solve();
    numbers.solved(above, high);
    numbers.solved(below, low);
    const ConformingCompanion v = p1_companion(high);
    const Certificate found =
        certify(contact_scene(epsilons[i]), {below, lower.problem(), low}, {.companion = &v});
    numbers.count(at + "epsilon", epsilons[i], table.column("epsilon")(i));
    numbers.relative(at + "upper", energy(upper.problem(), high), table.column("upper")(i));
    numbers.relative(at + "cr", energy(lower.problem(), low), table.column("cr")(i));
    numbers.relative(at + "lower", found.energy_lower, table.column("lower")(i));
    numbers.relative(at + "bound", found.displacement, table.column("bound")(i));
    numbers.relative(at + "in the layer", found.layer_share, table.column("in_layer")(i));
  }
  numbers.freefem_seconds = table.column("seconds").sum();
  return numbers;
}

std::vector<Numbers> degrees(int cells, const std::filesystem::path& folder) {
  const TriangleMesh mesh = unstructured_mesh(cells);
  run("16_degree", {"-mesh", written(mesh, folder), "-epsilon", "1e-2", "-out", folder});
  const ScriptTable table = results(folder / "results.csv", 2, 1);
  std::vector<Numbers> both(2);
  for (int i = 0; i < 2; ++i) {
    const Space space(mesh, i == 0 ? p1() : p2());
    const VariationalInequality problem = assemble(contact_scene(1e-2), space);
    const Solution solution = active_set(problem);
    const Eigen::VectorXd w = (2 * std::acos(-1) * space.dof_coordinates().col(0).array()).sin(),
                          slope = problem.b * w;
    const std::string of = space.element().name() + ": ";
    both[i].took(table.names[i]);
    both[i].solved(space, solution);
    both[i].count(of + "unknowns", space.size(), table.column("unknowns")(i));
    both[i].relative(of + "cost", std::sqrt(slope.dot(problem.m.cwiseProduct(slope))),
                     table.column("cost")(i));
    both[i].relative(of + "ridge", solution.u(space.contact_dofs()).maxCoeff(),
                     table.column("ridge")(i));
    both[i].relative(of + "energy", energy(problem, solution), table.column("energy")(i));
    both[i].freefem_seconds = table.column("seconds")(i);
  }
  return both;
}

std::vector<Numbers> graded_layers(int cells, const std::filesystem::path& folder) {
  std::vector<Numbers> both(2);
  for (const auto& [epsilon, end] : {std::pair{1.0, 0.6081771}, {1e-2, 0.6975326}}) {
    run("31_hp", {"-cells", std::to_string(cells), "-epsilon", fmt::format("{}", epsilon), "-end",
                  fmt::format("{}", end), "-out", folder});
    const ScriptTable table = results(folder / "results.csv", 2, 1);
    const TriangleMesh mesh = graded_mesh(end, 1.0 / cells, 4, 0.25, epsilon);
    for (int i = 0; i < 2; ++i) {
      const Space space(mesh, lagrange(i + 1));
      const VariationalInequality problem = assemble(contact_scene(epsilon), space);
      const Solution solution = active_set(problem);
      const auto held = std::count(solution.active.begin(), solution.active.end(), true);
      const std::string of = fmt::format("{}, epsilon = {:g}: ", space.element().name(), epsilon);
      both[i].took(table.names[i]);
      both[i].solved(space, solution);
      both[i].count(of + "unknowns", space.size(), table.column("unknowns")(i));
      both[i].count(of + "in contact", static_cast<double>(held), table.column("held")(i));
      both[i].relative(of + "largest u on Gamma_C", solution.u(space.contact_dofs()).maxCoeff(),
                       table.column("largest")(i));
      both[i].relative(of + "energy", energy(problem, solution), table.column("energy")(i));
      both[i].freefem_seconds += table.column("seconds")(i);
    }
  }
  return both;
}

}  // namespace antilock::freefem
