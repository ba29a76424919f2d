// 09, 12, 13, 17 and 20: errors and distances, for which FreeFEM knows only its own fine mesh in
// place of the truth; so the same is done here, and not with the sine series.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/eigenvalues.hpp"
#include "antilock/core/error.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "numbers.hpp"
#include "runner.hpp"

namespace antilock::freefem {
namespace {

/// A discrete function on the structured mesh of Figure 3 by place; between triangles that of
/// either.
class ByPlace {
 public:
  ByPlace(const Space& space, int cells)
      : space_(space), cells_(cells), triangles_(space.mesh().triangle_count() / 2) {
    for (int t = 0; t < space.mesh().triangle_count(); ++t) {
      const Eigen::Vector2d c = centre(t);
      triangles_[square(c(0), c(1))].push_back(t);
      rows_.push_back(
          t == 0 ? 0 : rows_.back() + (space.mesh().region[t - 1] == Region::layer ? 1 : 0));
    }
  }
  double value(const Eigen::VectorXd& u, double x, double y) const {
    const auto [t, lambda] = place(x, y);
    return space_.element().basis(lambda).dot(u(space_.cell_dofs().row(t)));
  }
  Eigen::Vector2d gradient(const Eigen::VectorXd& u, double x, double y) const {
    const auto [t, lambda] = place(x, y);
    const Eigen::VectorXd local = u(space_.cell_dofs().row(t));
    const Eigen::MatrixX3d derivative = space_.element().derivative(lambda);
    return (derivative * barycentric_gradients(space_.mesh(), t)).transpose() * local;
  }

  /// The stress in the layer, one value per triangle of it.
  double stress(const Eigen::VectorXd& p, double x, double y) const {
    return p(rows_[place(x, y).first]);
  }

 private:
  Eigen::Vector2d centre(int t) const {
    return point_in(space_.mesh(), t, Eigen::Vector3d::Constant(1.0 / 3));
  }
  int square(double x, double y) const {
    const auto cell = [&](double s, int last) {
      return std::clamp(static_cast<int>(std::floor(s * cells_)), 0, last);
    };
    return cell(y + 1, 2 * cells_ - 1) * cells_ + cell(x, cells_ - 1);
  }
  std::pair<int, Eigen::Vector3d> place(double x, double y) const {
    std::pair<int, Eigen::Vector3d> best{-1, Eigen::Vector3d::Constant(-1)};
    for (const int t : triangles_[square(x, y)]) {
      const Eigen::Vector3d lambda =
          barycentric_gradients(space_.mesh(), t) * (Eigen::Vector2d(x, y) - centre(t)) +
          Eigen::Vector3d::Constant(1.0 / 3);
      if (best.first < 0 || lambda.minCoeff() > best.second.minCoeff()) best = {t, lambda};
    }
    return best;
  }

  const Space& space_;
  int cells_;
  std::vector<std::vector<int>> triangles_;  ///< of each square
  std::vector<int> rows_;  ///< of each triangle: how many of the layer come before it
};

}  // namespace

Numbers errors_at_unknowns(const std::filesystem::path& folder) {
  const int cells = 8;
  run("09_convergence", {"-cells", std::to_string(cells), "-out", folder});
  const ScriptTable table = read_table(folder / "results.csv", 3);
  if (table.rows.rows() != 20)
    throw Error(fmt::format("results.csv: {} rows; accepted 20", table.rows.rows()));
  const TriangleMesh mesh = structured_mesh(cells), fine = structured_mesh(4 * cells);
  const Space fine_space(fine, p1());
  const ByPlace by_place(fine_space, 4 * cells);
  const Scene scene(Body{paper_load}, StiffLayer{1}, UnilateralContact{});
  SceneSweep fine_sweep(scene, fine_space);
  Numbers numbers;
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    SceneSweep sweep(scene, space);
    Eigen::Index row = element == &p1() ? 0 : 10;  // behind P1's: its rows on FreeFEM's own mesh
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6}) {
      sweep.set_epsilon(epsilon);
      fine_sweep.set_epsilon(epsilon);
      const Solution solution = sweep.solve(), exact = fine_sweep.solve();
      numbers.solved(space, solution);
      double worst = 0;
      for (int i = 0; i < space.size(); ++i)
        worst = std::max(
            worst, std::abs(solution.u(i) - by_place.value(exact.u, space.dof_coordinates()(i, 0),
                                                           space.dof_coordinates()(i, 1))));
      const std::string at = fmt::format(" {} structured", element->name());
      if (!table.names[row].ends_with(at))
        throw Error("results.csv: " + table.names[row] + "; accepted" + at);
      numbers.took(table.names[row].substr(0, table.names[row].find(' ')));
      numbers.count(fmt::format("{}, epsilon = {:g}: unknowns", element->name(), epsilon),
                    space.size(), table.column("unknowns")(row));
      numbers.relative(fmt::format("{}, epsilon = {:g}: error", element->name(), epsilon), worst,
                       table.column("max_at_unknowns")(row));
      numbers.freefem_seconds += table.column("seconds")(row++);
    }
  }
  return numbers;
}

std::vector<Numbers> worst_errors(const std::filesystem::path& folder) {
  const int cells = 8;
  run("13_uniform", {"-cells", std::to_string(cells), "-out", folder});
  const ScriptTable table = read_table(folder / "uniform.csv", 4);
  const TriangleMesh mesh = structured_mesh(cells), fine = structured_mesh(4 * cells);
  const Space fine_space(fine, p1());
  const Scene scene(Body{paper_load}, StiffLayer{1}, UnilateralContact{});
  std::vector<Numbers> both;
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const std::string name = " broken $H^1$ norm " + element->name() + " structured";
    const auto row =
        std::find_if(table.names.begin(), table.names.end(),
                     [&](const std::string& n) { return n.find(name) != std::string::npos; }) -
        table.names.begin();
    if (row == table.rows.rows()) throw Error("uniform.csv: no row" + name);
    const Space space(mesh, *element);
    SceneSweep sweep(scene, space), fine_sweep(scene, fine_space);
    const ByPlace by_place(space, cells);
    Numbers numbers;
    double worst = 0;
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 0.0}) {
      sweep.set_epsilon(epsilon);
      fine_sweep.set_epsilon(epsilon);
      const Solution solution = sweep.solve();
      numbers.solved(space, solution);
      // the meshes are nested, so that on a fine triangle both are polynomials, and a rule of it is
      // exact
      const Reference coarse{
          [&](double x, double y) { return by_place.value(solution.u, x, y); },
          [&](double x, double y) { return by_place.gradient(solution.u, x, y); },
          [](double, double) { return 0.0; }};
      worst = std::max(worst, measure_errors(fine_space, fine_sweep.solve(), 1, coarse).h1);
    }
    numbers.took(table.names[row].substr(0, table.names[row].find(name)));
    numbers.count(element->name() + ": unknowns", space.size(), table.column("unknowns")(row));
    numbers.relative(element->name() + ": worst", worst, table.column("worst")(row));
    numbers.freefem_seconds = table.column("seconds")(row);
    both.push_back(numbers);
  }
  return both;
}

Numbers energy_errors(const std::filesystem::path& folder) {
  const int cells = 8;
  run("20_order_h", {"-cells", std::to_string(cells), "-out", folder});
  const ScriptTable table = read_table(folder / "errors.csv", 3);
  if (table.rows.rows() != 12)
    throw Error(fmt::format("errors.csv: {} rows; accepted 12", table.rows.rows()));
  const TriangleMesh mesh = structured_mesh(cells), fine = structured_mesh(4 * cells);
  const Space fine_space(fine, p1());
  const Scene scene(Body{paper_load}, StiffLayer{1}, UnilateralContact{});
  SceneSweep fine_sweep(scene, fine_space);
  Numbers numbers;
  Eigen::Index row = 0;
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    SceneSweep sweep(scene, space);
    const ByPlace by_place(space, cells);
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 0.0}) {
      sweep.set_epsilon(epsilon);
      fine_sweep.set_epsilon(epsilon);
      const Solution solution = sweep.solve();
      numbers.solved(space, solution);
      numbers.took(table.names[row].substr(0, table.names[row].find(' ')));
      const Reference coarse{
          [&](double x, double y) { return by_place.value(solution.u, x, y); },
          [&](double x, double y) { return by_place.gradient(solution.u, x, y); },
          [&](double x, double y) { return by_place.stress(solution.p, x, y); }};
      numbers.relative(fmt::format("{}, epsilon = {:g}", element->name(), epsilon),
                       measure_errors(fine_space, fine_sweep.solve(), epsilon, coarse).energy,
                       table.column("error")(row++));
    }
  }
  numbers.freefem_seconds = table.column("seconds").sum();
  return numbers;
}

Numbers contact_sets(const std::filesystem::path& folder) {
  const int cells = 8;
  const double epsilon = 1e-6;
  run("12_contact_sets",
      {"-cells", std::to_string(cells), "-epsilon", fmt::format("{}", epsilon), "-out", folder});
  const ScriptTable table = read_table(folder / "results.csv", 3);
  const auto row = std::find_if(table.names.begin(), table.names.end(),
                                [](const std::string& n) {
                                  return n.find("P1 structured") != std::string::npos;
                                }) -
                   table.names.begin();
  if (row == table.rows.rows()) throw Error("results.csv: no row P1 structured");
  const Space space(structured_mesh(cells), p1()), fine_space(structured_mesh(4 * cells), p1());
  const Scene scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{});
  SceneSweep sweep(scene, fine_space);
  // P1 on the coarse mesh is P1 on the fine one: column i holds the hat function of vertex i at the
  // fine vertices
  const ByPlace by_place(space, cells);
  Eigen::MatrixXd hats(fine_space.size(), space.size());
  for (int i = 0; i < space.size(); ++i)
    for (int j = 0; j < fine_space.size(); ++j)
      hats(j, i) =
          by_place.value(Eigen::VectorXd::Unit(space.size(), i), fine_space.dof_coordinates()(j, 0),
                         fine_space.dof_coordinates()(j, 1));
  const SparseMatrix norm = h1_gram_matrix(fine_space);
  Numbers numbers;
  for (const bool kernel : {false, true}) {
    sweep.set_epsilon(kernel ? 0 : epsilon);
    const Eigen::VectorXd target = sweep.solve().u;
    VariationalInequality nearest = assemble(scene, space);
    nearest.a1 = h1_gram_matrix(space);
    nearest.load = hats.transpose() * (norm * target);
    nearest.compliance = 0;
    if (!kernel) {
      nearest.b.resize(0, nearest.size());
      nearest.m.resize(0);
    }
    const Solution solution = active_set(nearest);
    numbers.solved(space, solution);
    const Eigen::VectorXd apart = target - hats * solution.u;
    numbers.relative(kernel ? "dist(u^0, K_0h)" : "dist(u, K_h)",
                     std::sqrt(apart.dot(norm * apart)),
                     table.column(kernel ? "to_k0" : "to_k")(row));
  }
  numbers.took(table.names[row].substr(0, table.names[row].find(" P1")));
  return numbers;
}

Numbers worst_loads(int cells, const std::filesystem::path& folder) {
  run("17_families_of_loads", {"-cells", std::to_string(cells), "-out", folder});
  const ScriptTable table = read_table(folder / "worst.csv", 1);
  const Space space(structured_mesh(cells), p1()), fine_space(structured_mesh(4 * cells), p1());
  const TriangleMesh& fine = fine_space.mesh();
  // column j: the work of the load 1 / root of its area on body triangle j, so that a vector's norm
  // is the load's in L2
  Eigen::MatrixXd work = Eigen::MatrixXd::Zero(fine_space.size(), fine.triangle_count() / 2);
  Eigen::Index column = 0;
  for (int t = 0; t < fine.triangle_count(); ++t) {
    if (fine.region[t] != Region::body) continue;
    for (int i = 0; i < 3; ++i)
      work(fine_space.cell_dofs()(t, i), column) = std::sqrt(fine.area(t)) / 3;
    ++column;
  }
  const ByPlace by_place(space, cells);
  Eigen::MatrixXd coarse_work = Eigen::MatrixXd::Zero(space.size(), work.cols());
  for (int i = 0; i < space.size(); ++i) {
    Eigen::VectorXd hat(fine_space.size());
    for (int j = 0; j < fine_space.size(); ++j)
      hat(j) =
          by_place.value(Eigen::VectorXd::Unit(space.size(), i), fine_space.dof_coordinates()(j, 0),
                         fine_space.dof_coordinates()(j, 1));
    coarse_work.row(i) = (work.transpose() * hat).transpose();
  }
  Numbers numbers;
  const Scene scene(Body{paper_load}, StiffLayer{1});
  Sweep sweep(assemble(scene, space)), fine_sweep(assemble(scene, fine_space));
  Eigen::Index row = 0;
  for (const double epsilon : {1.0, 1e-2, 1e-6, 0.0}) {
    sweep.set_compliance(epsilon * epsilon);
    fine_sweep.set_compliance(epsilon * epsilon);
    const auto error = [&](const Eigen::VectorXd& f) {
      fine_sweep.set_load(work * f);
      sweep.set_load(coarse_work * f);
      return Eigen::VectorXd(work.transpose() * fine_sweep.solve().u -
                             coarse_work.transpose() * sweep.solve().u);
    };
    const double worst = std::sqrt(largest_eigenvalue(error, work.cols(), 1e-9));
    numbers.unknowns = space.size();
    numbers.count(fmt::format("epsilon = {:g}: unknowns", epsilon), space.size(),
                  table.column("unknowns")(row));
    numbers.relative(fmt::format("epsilon = {:g}: worst error", epsilon), worst,
                     table.column("worst")(row));
    numbers.freefem_seconds += table.column("seconds")(row++);
  }
  numbers.took("penalty");
  return numbers;
}

}  // namespace antilock::freefem
