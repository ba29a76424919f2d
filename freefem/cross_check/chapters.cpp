// The scripts whose C++ chapter is not a solution on a triangle mesh: the string, P1 by hand,
// kernels, estimates, two glued strings. Each number against the library's own.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "antilock/analysis/kernel.hpp"
#include "antilock/core/error.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/models/project_strain.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/proximal_galerkin.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "cross_check.hpp"
#include "numbers.hpp"
#include "runner.hpp"

namespace antilock::freefem {
namespace {

/// Strings fixed at both ends, one after the other in one vector: A1 = int u' v', the rest of the
/// problem empty.
VariationalInequality strings(const std::vector<int>& cells) {
  VariationalInequality problem;
  std::vector<Eigen::Triplet<double>> entries;
  int first = 0;
  for (const int n : cells) {
    for (int i = first; i < first + n; ++i)
      for (const int j : {i, i + 1})
        for (const int k : {i, i + 1}) entries.emplace_back(j, k, j == k ? n : -n);
    problem.dirichlet_dofs.insert(problem.dirichlet_dofs.end(), {first, first + n});
    first += n + 1;
  }
  problem.a1.resize(first, first);
  problem.a1.setFromTriplets(entries.begin(), entries.end());
  problem.b.resize(0, first);
  problem.load = Eigen::VectorXd::Zero(first);
  problem.dirichlet_values =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.dirichlet_dofs.size()));
  return problem;
}

/// The value at x of hat function `node` on a string of `cells` cells.
double hat(int cells, int node, double x) { return std::max(0.0, 1 - std::abs(x * cells - node)); }

/// B and M of the glue between a string of n + 1 cells and one of n: at two Gauss points of each
/// piece between corners (pointwise), or against the inner hat functions of the lower string
/// (mortar).
void fill_glue(VariationalInequality& problem, int n, bool mortar) {
  std::vector<double> corners{1};
  for (int i = 0; i < n; ++i) corners.push_back(static_cast<double>(i) / n);
  for (int i = 1; i <= n; ++i) corners.push_back(static_cast<double>(i) / (n + 1));
  std::sort(corners.begin(), corners.end());
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(mortar ? n - 1 : 4 * n, problem.size());
  Eigen::VectorXd m = Eigen::VectorXd::Constant(b.rows(), 1.0 / n);
  for (int piece = 0; piece < 2 * n; ++piece)
    for (const int side : {-1, 1}) {
      const double length = corners[piece + 1] - corners[piece];
      const double x = corners[piece] + 0.5 * length * (1 + side / std::sqrt(3.0));
      Eigen::RowVectorXd jump = Eigen::RowVectorXd::Zero(problem.size());  // (u - w)(x)
      for (int i = 0; i <= n + 1; ++i) jump(i) = hat(n + 1, i, x);
      for (int i = 0; i <= n; ++i) jump(n + 2 + i) = -hat(n, i, x);
      if (mortar) {
        for (int i = 1; i < n; ++i) b.row(i - 1) += 0.5 * length * hat(n, i, x) * n * jump;
      } else {
        b.row(2 * piece + (side > 0)) = jump;
        m(2 * piece + (side > 0)) = 0.5 * length;
      }
    }
  problem.b = b.sparseView();
  problem.m = m;
}

}  // namespace

Numbers string_on_an_obstacle(int cells, const std::filesystem::path& folder) {
  run("00_string_on_an_obstacle", {"-cells", std::to_string(cells), "-out", folder});
  const ScriptTable nodes = read_table(folder / "string.csv"),
                    summary = read_table(folder / "summary.csv");
  VariationalInequality problem = strings({cells});
  problem.load.setConstant(-32.0 / cells);
  problem.load(0) = problem.load(cells) = -16.0 / cells;
  std::vector<int> inside(cells - 1);
  std::iota(inside.begin(), inside.end(), 1);
  problem.bounds = Bounds::lower_on(inside, Eigen::VectorXd::Constant(cells - 1, -1));
  const Solution ours = active_set(problem);
  Numbers numbers;
  numbers.unknowns = cells + 1;
  numbers.seconds = ours.seconds.total();
  for (int i = 0; i <= cells; ++i)
    numbers.all.push_back({fmt::format("u at node {}", i), ours.u(i), nodes.column("u")(i), 1});
  numbers.relative("force", ours.lambda.sum(), summary.column("force")(0));
  numbers.relative("energy", energy(problem, ours), summary.column("energy")(0));
  return numbers;
}

Numbers by_hand(int cells, double epsilon, const std::filesystem::path& folder) {
  run("03_by_hand",
      {"-cells", std::to_string(cells), "-epsilon", fmt::format("{}", epsilon), "-out", folder});
  const ScriptTable solution = read_table(folder / "solution.csv"),
                    summary = read_table(folder / "summary.csv");
  const Space space(structured_mesh(cells), p1());
  const VariationalInequality problem =
      assemble(Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}), space);
  const Solution ours = active_set(problem);
  Points places(solution.rows.rows(), 2);
  places << solution.column("x"), solution.column("y");
  const Eigen::VectorXd theirs = solution.column("u")(match(space.dof_coordinates(), places));
  Numbers numbers;
  numbers.road = "mixed";
  numbers.solved(space, ours);
  const double largest = ours.u.cwiseAbs().maxCoeff();
  for (int i = 0; i < space.size(); ++i)
    numbers.all.push_back({fmt::format("u at unknown {}", i), ours.u(i), theirs(i), largest});
  const auto held = std::count(ours.active.begin(), ours.active.end(), true);
  numbers.count("in contact", static_cast<double>(held), summary.column("active")(0));
  numbers.relative("energy", energy(problem, ours), summary.column("energy")(0));
  return numbers;
}

Numbers kernels(int cells, const std::filesystem::path& folder) {
  Numbers numbers;
  const Scene scene(Body{paper_load}, StiffLayer{0});
  const auto add = [&](const ScriptTable& table, Eigen::Index row, const TriangleMesh& mesh,
                       int n) {
    const Space conforming(mesh, p1()), broken(conforming, crouzeix_raviart());
    const int p1_kernel = layer_kernel_dimension(assemble(scene, conforming));
    const auto triangles = std::count(mesh.region.begin(), mesh.region.end(), Region::layer);
    const std::string at = fmt::format("{}, 1/h = {}: ", table.names[row], n);
    numbers.unknowns = std::max(numbers.unknowns, conforming.size());
    numbers.count(at + "layer triangles", static_cast<double>(triangles),
                  table.column("triangles")(row));
    numbers.count(at + "P1 by ties", p1_kernel, table.column("kernel_by_ties")(row));
    if (n > 4) return;  // ranks on the small meshes only
    const int cr_kernel = layer_kernel_dimension(assemble(scene, broken));
    numbers.count(at + "P1 by rank", p1_kernel, table.column("p1_kernel")(row));
    numbers.count(at + "CR by rank", cr_kernel, table.column("cr_kernel")(row));
    numbers.count(at + "CR rank", static_cast<double>(triangles), table.column("cr_rank")(row));
  };
  for (int n = 4; n <= cells; n *= 2) {  // the script takes one unstructured mesh per run
    const TriangleMesh unstructured = unstructured_mesh(n);
    write_freefem_mesh(folder / "mesh.freefem.msh", unstructured);
    run("07_kernel",
        {"-cells", std::to_string(n), "-mesh", folder / "mesh.freefem.msh", "-out", folder});
    const ScriptTable table = read_table(folder / "kernel.csv", 1);
    const Eigen::Index given = table.rows.rows() - 1;
    if (given < 1 || table.names[given] != "given" || table.column("cells")(given - 1) != n)
      throw Error(
          fmt::format("kernel.csv: its last rows are not structured, 1/h = {}, and given", n));
    add(table, given - 1, structured_mesh(n), n);
    add(table, given, unstructured, n);
  }
  return numbers;
}

Numbers estimates(int cells, const std::filesystem::path& folder) {
  const TriangleMesh mesh = unstructured_mesh(cells);
  write_freefem_mesh(folder / "mesh.freefem.msh", mesh);
  run("15_promises", {"-mesh", folder / "mesh.freefem.msh", "-out", folder});
  const ScriptTable table = read_table(folder / "estimates.csv", 1);
  const Scene scene(Body{paper_load}, StiffLayer{1}, UnilateralContact{});
  const Space conforming(mesh, p1()), broken(conforming, crouzeix_raviart());
  SceneSweep p1_sweep(scene, conforming), cr_sweep(scene, broken);
  Numbers numbers;
  double largest = 0;
  for (Eigen::Index row = 0; row < table.rows.rows(); ++row) {
    const double epsilon = std::pow(10.0, -0.5 * static_cast<double>(row));
    p1_sweep.set_epsilon(epsilon);
    cr_sweep.set_epsilon(epsilon);
    const Solution locked = p1_sweep.solve(), free = cr_sweep.solve();
    numbers.took(table.names[row]);
    numbers.solved(conforming, locked);
    numbers.solved(broken, free);
    const double kept = locked.u(conforming.contact_dofs()).maxCoeff(),
                 all = free.u(broken.contact_dofs()).maxCoeff();
    largest = std::max({largest, kept, all});
    const std::string at = fmt::format("epsilon = {:g}: ", epsilon);
    numbers.relative(at + "epsilon", epsilon, table.column("epsilon")(row));
    // relative to the largest displacement of the layer: what P1 keeps falls like epsilon^2, far
    // below its digits
    numbers.all.push_back({at + "P1 on Gamma_C", kept, table.column("ridge_p1")(row), largest});
    numbers.all.push_back({at + "CR on Gamma_C", all, table.column("ridge_cr")(row), largest});
  }
  numbers.freefem_seconds = table.column("seconds").sum();
  return numbers;
}

Numbers glued_strings(int cells, const std::filesystem::path& folder) {
  constexpr double load = 32, gap = 0.5;
  run("33_your_own_problem", {"-cells", std::to_string(cells), "-out", folder});
  const ScriptTable table = read_table(folder / "results.csv", 2);
  if (table.rows.rows() != 26)
    throw Error(fmt::format("results.csv: {} rows; accepted 26", table.rows.rows()));
  Numbers numbers;
  Eigen::Index row = 0;
  for (const bool mortar : {false, true}) {
    VariationalInequality problem = strings({cells + 1, cells});
    fill_glue(problem, cells, mortar);
    for (int i = 1; i <= cells; ++i) problem.load(i) = -load / (cells + 1);
    problem.load(0) = problem.load(cells + 1) = -0.5 * load / (cells + 1);
    std::vector<int> inside(cells - 1);
    std::iota(inside.begin(), inside.end(), cells + 3);
    problem.bounds = Bounds::lower_on(inside, Eigen::VectorXd::Constant(cells - 1, -gap));
    for (int k = 0; k <= 12; ++k, ++row) {
      problem.compliance = std::pow(10.0, -k);
      const Solution ours = active_set(problem);
      const std::string at =
          fmt::format("{}, epsilon = 1e-{}: ", mortar ? "mortar" : "pointwise", k);
      numbers.took(table.names[row].substr(0, table.names[row].find(' ')));
      numbers.unknowns = problem.size();
      numbers.seconds += ours.seconds.total();
      numbers.relative(at + "epsilon", problem.compliance, table.column("epsilon")(row));
      numbers.all.push_back(
          {at + "energy", energy(problem, ours), table.column("energy")(row), load * gap});
      numbers.all.push_back(
          {at + "largest |u|", ours.u.cwiseAbs().maxCoeff(), table.column("moved")(row), gap});
      numbers.all.push_back(
          {at + "contact force", ours.lambda.sum(), table.column("force")(row), load});
    }
  }
  return numbers;
}

Numbers proximal_steps(int cells, const std::filesystem::path& folder) {
  run("34_solving_the_inequality", {"-cells", std::to_string(cells), "-out", folder});
  const ScriptTable table = read_table(folder / "results.csv", 1);
  const Space space(structured_mesh(cells), p1());
  Numbers numbers;
  for (const double epsilon : {1.0, 1e-2, 1e-6, 0.0}) {
    const auto row = static_cast<Eigen::Index>(numbers.all.size() / 2);
    if (row >= table.rows.rows()) throw Error("results.csv: accepted 4 rows");
    const VariationalInequality problem =
        assemble(Scene({paper_load}, StiffLayer{epsilon}, UnilateralContact{}), space);
    const Solution ours = proximal_galerkin(problem);
    const std::string at = fmt::format("epsilon = {}: ", epsilon);
    numbers.took(table.names[row].substr(0, table.names[row].find(' ')));
    numbers.solved(space, ours);
    numbers.freefem_seconds += table.column("seconds")(row);
    numbers.relative(at + "largest u on Gamma_C", bounded_values(problem.bounds, ours.u).maxCoeff(),
                     table.column("ridge")(row));
    numbers.relative(at + "contact force", ours.lambda.sum(), table.column("force")(row));
  }
  return numbers;
}

namespace {

/// u of a file x, y, u at the points of a space, each relative to the largest of ours.
void compare_values(Numbers& numbers, const std::string& what, const Space& space,
                    const Eigen::VectorXd& ours, const ScriptTable& theirs) {
  Points places(theirs.rows.rows(), 2);
  places << theirs.column("x"), theirs.column("y");
  const Eigen::VectorXd u = theirs.column("u")(match(space.dof_coordinates(), places));
  const double largest = ours.cwiseAbs().maxCoeff();
  for (int i = 0; i < space.size(); ++i)
    numbers.all.push_back({fmt::format("{} at unknown {}", what, i), ours(i), u(i), largest});
}

}  // namespace

Numbers mixed(int cells, double epsilon, const std::filesystem::path& folder) {
  const TriangleMesh squares = unstructured_mesh(cells),
                     block = with_free_sides(structured_mesh(cells, Domain{0}));
  const auto mesh = folder / "mesh.freefem.msh", body = folder / "body.freefem.msh";
  write_freefem_mesh(mesh, squares);
  write_freefem_mesh(body, block);
  run("28_mixed", {"-mesh", mesh, "-body", body, "-cells", std::to_string(cells), "-epsilon",
                   fmt::format("{}", epsilon), "-out", folder});
  const ScriptTable summary = read_table(folder / "summary.csv", 2);
  if (summary.rows.rows() != 3)
    throw Error(fmt::format("summary.csv: {} rows; accepted 3", summary.rows.rows()));
  Numbers numbers;
  const auto took = [&](Eigen::Index row, const Solution& ours) {
    numbers.took(summary.names[row].substr(0, summary.names[row].find(' ')));
    numbers.unknowns = std::max(numbers.unknowns, static_cast<int>(ours.u.size()));
    numbers.seconds += ours.seconds.total();
    numbers.freefem_seconds += summary.column("seconds")(row);
    numbers.relative(summary.names[row] + ": contact force", ours.lambda.sum(),
                     summary.column("force")(row));
  };

  const Space p1_space(squares, p1());
  const StrainProjection boxes =
      box_projection(squares, layer_strain(p1_space), 2.0 / cells, 2.0 / cells);
  const Scene scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{});
  const Solution layer =
      active_set(project_strain(antilock::assemble(scene, p1_space), boxes, 0.5));
  took(0, layer);
  compare_values(numbers, "boxes: u", p1_space, layer.u, read_table(folder / "boxes.csv"));

  Eigen::Index row = 1;
  for (const auto& [element, name] : {std::pair{&p1_bubble(), "MINI"}, {&p2(), "TaylorHood"}}) {
    const Space space(block, *element);
    PlaneStrain rubber;
    rubber.epsilon = epsilon;
    rubber.gap = [](double x) { return (x - 0.5) * (x - 0.5); };
    rubber.continuous_pressure = true;
    const Solution ours = active_set(antilock::assemble(rubber, {space, space}));
    took(row++, ours);
    for (const bool in_x : {true, false})
      compare_values(numbers, fmt::format("{}: u_{}", name, in_x ? "x" : "y"), space,
                     in_x ? ours.u.head(space.size()) : ours.u.tail(space.size()),
                     read_table(folder / fmt::format("{}_{}.csv", name, in_x ? "x" : "y")));
  }
  return numbers;
}

Numbers interior_penalty(int cells, double epsilon, const std::filesystem::path& folder) {
  const Space space(unstructured_mesh(cells), discontinuous_p1());
  const TriangleMesh& mesh = space.mesh();
  const auto file = folder / "mesh.freefem.msh";
  write_freefem_mesh(file, mesh);
  run("35_interior_penalty",
      {"-mesh", file, "-epsilon", fmt::format("{}", epsilon), "-out", folder});
  const ScriptTable summary = read_table(folder / "summary.csv", 2);
  if (summary.rows.rows() != 2)
    throw Error(fmt::format("summary.csv: {} rows; accepted 2", summary.rows.rows()));
  Points centroids(mesh.triangle_count(), 2);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    centroids.row(t) = point_in(mesh, t, Eigen::Vector3d::Constant(1.0 / 3));
  Numbers numbers;
  const Scene scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{});
  Eigen::Index row = 0;
  for (const auto& [name, penalised] :
       {std::pair{"whole", PenalisedJump::whole}, {"mean", PenalisedJump::mean}}) {
    const VariationalInequality problem =
        antilock::assemble(scene, space, InteriorPenalty{3, penalised});
    const Solution ours = active_set(problem);
    numbers.took("sum");
    numbers.solved(space, ours);
    numbers.freefem_seconds += summary.column("seconds")(row);
    numbers.relative(fmt::format("{}: largest u", name), ours.u(problem.bounds.unknowns).maxCoeff(),
                     summary.column("largest")(row));
    numbers.relative(fmt::format("{}: contact force", name), ours.lambda.sum(),
                     summary.column("force")(row));
    ++row;
    Eigen::MatrixX3d values(mesh.triangle_count(), 3);  // u, d/dx u, d/dy u at the centroids
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      const Eigen::Vector3d u = ours.u(space.cell_dofs().row(t));
      values(t, 0) = u.mean();
      values.row(t).tail<2>() = -2 * u.transpose() * barycentric_gradients(mesh, t);
    }
    const ScriptTable theirs = read_table(folder / fmt::format("{}.csv", name));
    Points places(theirs.rows.rows(), 2);
    places << theirs.column("x"), theirs.column("y");
    const std::vector<int> order = match(centroids, places);
    Eigen::Index column = 0;
    for (const char* what : {"u", "dx", "dy"}) {
      const Eigen::VectorXd other = theirs.column(what)(order);
      const double largest = values.col(column).cwiseAbs().maxCoeff();
      for (int t = 0; t < mesh.triangle_count(); ++t)
        numbers.all.push_back({fmt::format("{}: {} on triangle {}", name, what, t),
                               values(t, column), other(t), largest});
      ++column;
    }
  }
  return numbers;
}

namespace {

/// The columns u, sx, sy, sxx, sxy, syx, syy of stress.csv for hybrid_bdm1 (T x 7).
Eigen::MatrixXd means_and_stresses(const Space& space, const Solution& solution) {
  const TriangleMesh& mesh = space.mesh();
  Eigen::MatrixXd values(mesh.triangle_count(), 7);
  Eigen::Index row = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> slopes = barycentric_gradients(mesh, t);
    const Eigen::VectorXd u = solution.u(space.cell_dofs().row(t));
    Eigen::Matrix<double, 3, 2> corners;  // the stress at the corners
    for (int i = 0; i < 3; ++i)
      corners.row(i) =
          u.transpose() * space.element().derivative(Eigen::Vector3d::Unit(i)) * slopes;
    if (mesh.region[t] == Region::layer) {  // p is affine, known at the midpoints of the edges
      const Eigen::Vector3d p = solution.p.segment<3>(row);
      row += 3;
      corners.col(1) = Eigen::Vector3d::Constant(p.sum()) - 2 * p;
    }
    values(t, 0) = u(6);
    values.row(t).segment<2>(1) = corners.colwise().mean();
    values.row(t).segment<2>(3) = corners.col(0).transpose() * slopes;
    values.row(t).segment<2>(5) = corners.col(1).transpose() * slopes;
  }
  return values;
}

}  // namespace

Numbers mixed_bdm1(int cells, double epsilon, const std::filesystem::path& folder) {
  const Space space(unstructured_mesh(cells), hybrid_bdm1());
  const TriangleMesh& mesh = space.mesh();
  const auto file = folder / "mesh.freefem.msh";
  write_freefem_mesh(file, mesh);
  run("38_order_two", {"-mesh", file, "-epsilon", fmt::format("{}", epsilon), "-out", folder});
  const ScriptTable summary = read_table(folder / "summary.csv", 1);
  if (summary.rows.rows() != 1)
    throw Error(fmt::format("summary.csv: {} rows; accepted 1", summary.rows.rows()));
  VariationalInequality problem =
      antilock::assemble(Scene({paper_load}, StiffLayer{epsilon}), space);
  problem.load = mean_load_vector(space, paper_load, Region::body, radon_rule());  // qf5pT
  const Solution ours = active_set(problem);
  Numbers numbers;
  numbers.took("mixed");
  numbers.solved(space, ours);
  numbers.freefem_seconds += summary.column("seconds")(0);
  const Eigen::MatrixXd values = means_and_stresses(space, ours);
  const ScriptTable theirs = read_table(folder / "stress.csv");
  Points centroids(mesh.triangle_count(), 2), places(theirs.rows.rows(), 2);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    centroids.row(t) = point_in(mesh, t, Eigen::Vector3d::Constant(1.0 / 3));
  places << theirs.column("x"), theirs.column("y");
  const std::vector<int> order = match(centroids, places);
  Eigen::Index column = 0;
  for (const char* what : {"u", "sx", "sy", "sxx", "sxy", "syx", "syy"}) {
    const Eigen::VectorXd other = theirs.column(what)(order);
    const double largest = values.col(column).cwiseAbs().maxCoeff();
    for (int t = 0; t < mesh.triangle_count(); ++t)
      numbers.all.push_back(
          {fmt::format("{} on triangle {}", what, t), values(t, column), other(t), largest});
    ++column;
  }
  return numbers;
}

Numbers three_dimensions(int cells, const std::filesystem::path& folder) {
  const Domain cube_on_layer{1, CellKind::tetrahedron};
  const auto cubic = [](double x, double y) { return 60 * (1 - 2 * x) * y * (1 - y); };
  Numbers numbers;
  for (const auto& [mesh, epsilon] : {std::pair{structured_mesh(cells, cube_on_layer), 1e-6},
                                      {unstructured_mesh(cells, cube_on_layer), 1e-2}}) {
    const Space space(mesh, p1(CellKind::tetrahedron));
    write_freefem_mesh(folder / "tetrahedra.mesh", mesh);
    run("39_three_dimensions", {"-mesh", folder / "tetrahedra.mesh", "-load", "cubic", "-epsilon",
                                fmt::format("{}", epsilon), "-out", folder});
    const ScriptTable summary = read_table(folder / "summary.csv", 1);
    const ScriptTable theirs = read_table(folder / "solution.csv");
    const VariationalInequality problem =
        antilock::assemble(Scene(Body{cubic}, StiffLayer{epsilon}, UnilateralContact{}), space);
    const Solution ours = active_set(problem);
    numbers.took(summary.names[0]);
    numbers.solved(space, ours);
    numbers.freefem_seconds += summary.column("seconds")(0);
    Points places(theirs.rows.rows(), 3);
    places << theirs.column("x"), theirs.column("y"), theirs.column("z");
    const std::vector<int> order = match(space.dof_coordinates(), places);
    const Eigen::VectorXd u = theirs.column("u")(order), force = theirs.column("force")(order);
    const Eigen::VectorXd our_force = bound_forces(problem.bounds, ours.lambda, space.size());
    const double largest_u = ours.u.cwiseAbs().maxCoeff(), largest_force = our_force.maxCoeff();
    for (int i = 0; i < space.size(); ++i) {
      numbers.all.push_back({fmt::format("u at vertex {}", i), ours.u(i), u(i), largest_u});
      numbers.all.push_back(
          {fmt::format("force at vertex {}", i), our_force(i), force(i), largest_force});
    }
    numbers.relative("largest u on Gamma_C", ours.u(problem.bounds.unknowns).maxCoeff(),
                     summary.column("largest")(0));
    numbers.relative("energy", energy(problem, ours), summary.column("energy")(0));
  }
  return numbers;
}

}  // namespace antilock::freefem
