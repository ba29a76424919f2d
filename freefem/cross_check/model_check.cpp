#include "model_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "runner.hpp"

namespace antilock::freefem {
namespace {

constexpr int cells = 64;
const char* const columns[] = {"u1", "u2", "u3", "u4", "u5"};

/// u at the five places of model_check.edp, the last three on the lower side, and J(u).
struct Sample {
  std::array<double, 5> u{};
  double energy = 0, seconds = 0;
  int unknowns = 0;
};

Sample sample(const Scene& scene, int n) {
  const Space space(structured_mesh(n, Domain{scene.layer_depth()}), p1());
  const VariationalInequality problem = assemble(scene, space);
  const Solution solution = active_set(problem);
  const double low = -scene.layer_depth();
  const std::array<Eigen::RowVector2d, 5> places{
      Eigen::RowVector2d(0.25, 0.5), Eigen::RowVector2d(0.25, 0.25), Eigen::RowVector2d(0.25, low),
      Eigen::RowVector2d(0.625, low), Eigen::RowVector2d(0.875, low)};
  Sample s{{}, energy(problem, solution), solution.seconds.total(), space.size()};
  for (std::size_t i = 0; i < places.size(); ++i) {
    Eigen::Index vertex = 0;
    const double away =
        (space.dof_coordinates().rowwise() - places[i]).rowwise().norm().minCoeff(&vertex);
    if (away > 1e-9) throw Error("model_check: no vertex at a place of model_check.edp");
    s.u[i] = solution.u(vertex);
  }
  return s;
}

/// From h and h / 2, for errors that fall like h^2.
double extrapolated(double coarse, double fine) { return (4 * fine - coarse) / 3; }

}  // namespace

std::vector<SceneCheck> model_check(const std::filesystem::path& folder, const std::string& mistake,
                                    int their_cells) {
  run("model_check", {"-break", mistake, "-cells", std::to_string(their_cells), "-out", folder});
  const ScriptTable table = read_table(folder / "model_check.csv", 1);
  const Body body{paper_load};
  const UnilateralContact obstacle;
  struct Pair {
    const char *scene, *problem;
    Scene ours;
  };
  const std::vector<Pair> pairs{
      {"Body", "body by a formula", Scene(body)},
      {"Body", "body", Scene(body)},
      {"Body, UnilateralContact", "body on an obstacle", Scene(body, NoLayer{}, obstacle)},
      {"Body, StiffLayer", "layer 0.1", Scene(body, StiffLayer{0.1})},
      {"Body, StiffLayer, UnilateralContact", "layer 0.1 on an obstacle",
       Scene(body, StiffLayer{0.1}, obstacle)},
      {"Body, ThinLayer, UnilateralContact", "layer 0.1 on an obstacle",
       Scene(body, ThinLayer{0.1}, obstacle)},
      {"Body, VentcelLayer", "layer 0.01", Scene(body, VentcelLayer{})},
      {"Body, VentcelLayer, UnilateralContact", "layer 0.01 on an obstacle",
       Scene(body, VentcelLayer{}, obstacle)},
      {"Body, StiffLayer at epsilon = 0, UnilateralContact", "layer 0.01 on an obstacle",
       Scene(body, StiffLayer{0}, obstacle)}};
  std::vector<SceneCheck> checks;
  for (const auto& [scene, problem, ours] : pairs) {
    const auto row =
        std::find(table.names.begin(), table.names.end(), problem) - table.names.begin();
    if (row == table.rows.rows()) throw Error(fmt::format("model_check.csv: no row {}", problem));
    const Sample coarse = sample(ours, cells / 2), fine = sample(ours, cells);
    SceneCheck check{scene, problem, fine.unknowns, 0, 0, coarse.seconds + fine.seconds};
    double largest = 0;
    for (std::size_t i = 0; i < fine.u.size(); ++i) {
      const double theirs = table.column(columns[i])(row);
      largest = std::max(largest, std::abs(theirs));
      check.difference =
          std::max(check.difference, std::abs(theirs - extrapolated(coarse.u[i], fine.u[i])));
    }
    check.difference /= largest;
    const double theirs = table.column("energy")(row);
    check.energy = std::abs(extrapolated(coarse.energy, fine.energy) / theirs - 1);
    checks.push_back(check);
  }
  return checks;
}

}  // namespace antilock::freefem
