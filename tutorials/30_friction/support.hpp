#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "antilock/io/write_vtu.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/coulomb_friction.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/sweep.hpp"
#include "antilock/study/table.hpp"
#include "course/course.hpp"
#include "course/rubber.hpp"

namespace antilock::tutorial {

/// The floor at one λ: N in all; T on the left half, to the right, as the mean of both
/// halves by symmetry; the slip u_x of the left half that is largest in size; the length
/// that sticks though g > 0. The reference is Taylor–Hood on graded meshes
/// (`freefem/30_friction.edp`).
inline const std::vector<std::string> floor_columns{
    "element", "h",      "lambda",      "epsilon", "locks", "N",    "T",
    "slip",    "sticks", "corrections", "known",   "N off", "T off"};
inline std::vector<TableEntry> floor_row(const Rubber& rubber, int cells, const Space& x,
                                         const VariationalInequality& problem,
                                         const Solution& solution) {
  static const std::map<double, std::pair<double, double>> reference{
      {1, {0.16034, -0.01627}},
      {1e-4, {0.26073, 0.01222}},
      {1e-8, {0.26077, 0.01223}},
      {0, {0.26077, 0.01223}}};
  double normal = 0, tangential = 0, sticks = 0, slip = 0;
  for (Eigen::Index i = 0; i < solution.lambda.size(); ++i) {
    if (!std::isfinite(problem.bounds.force_limit(i))) {
      normal += solution.lambda(i);
      continue;
    }
    const double place = x.dof_coordinates()(problem.bounds.unknowns[i], 0),
                 moved = solution.u(problem.bounds.unknowns[i]);
    tangential += place == 0.5 ? 0 : (place < 0.5 ? 0.5 : -0.5) * solution.lambda(i);
    if (problem.bounds.force_limit(i) == 0) continue;
    if (solution.active[i]) sticks += 1.0 / cells;
    if (place < 0.5 && std::abs(moved) > std::abs(slip)) slip = moved;
  }
  const double epsilon = problem.compliance;
  const auto at = reference.find(epsilon);
  const auto off = [&](double value, double exact) {
    return 100 * std::abs(value / exact - 1);
  };
  const bool known = at != reference.end();
  return {rubber.name,
          1.0 / cells,
          1 / epsilon,
          epsilon,
          rubber.locks,
          normal,
          tangential,
          slip,
          sticks,
          solution.counters.corrections,
          known,
          known ? off(normal, at->second.first) : 0.0,
          known ? off(tangential, at->second.second) : 0.0};
}

/// At most by how many h^2 of itself T is off, and by how many h per cent N.
inline std::pair<double, double> off_by(const Table& floor) {
  double of_t = 0, of_n = 0;
  for (const Table& row : floor.rows()) {
    of_t = std::max(of_t, row.number("T off") * std::pow(row.number("h"), -2) / 100);
    of_n = std::max(of_n, row.number("N off") / row.number("h"));
  }
  return {of_t, of_n};
}

/// The largest difference of u: with g = 0 from the block without friction (an empty g),
/// and with g = 1e6 from the block whose bonds to the floor never give way.
struct Extremes {
  double none, bonded;
};
inline Extremes extremes_of_friction(
    const std::function<VariationalInequality(const Profile& g)>& pressed) {
  const auto great = [](double) { return 1e6; };
  const auto zero = [](double) { return 0.0; };
  VariationalInequality bonded = pressed(great);
  const Eigen::VectorXd holds = active_set(bonded).u;
  bonded.bounds.force_limit.setConstant(std::numeric_limits<double>::infinity());
  return {(active_set(pressed(zero)).u - active_set(pressed({})).u).cwiseAbs().maxCoeff(),
          (holds - active_set(bonded).u).cwiseAbs().maxCoeff()};
}

/// One row per unknown of the floor: its x, T per length, and the slip u_x.
inline Eigen::MatrixX3d on_floor(const Space& in_x, const VariationalInequality& problem,
                                 const Solution& solution) {
  const Eigen::VectorXd lengths = contact_lengths(in_x);
  Eigen::MatrixX3d curves(lengths.size(), 3);
  curves.col(0) = in_x.dof_coordinates().col(0)(in_x.contact_dofs());
  curves.col(1) = solution.lambda.tail(lengths.size()).cwiseQuotient(lengths);
  curves.col(2) = solution.u(problem.bounds.unknowns).tail(lengths.size());
  return curves;
}

/// The bounds of each contact unknown with friction. Those of u_y stand before those of
/// u_x. Both components need one element.
inline std::vector<FrictionPair> friction_pairs(const VariationalInequality& problem) {
  const int count = problem.bounds.count() / 2;
  std::vector<FrictionPair> pairs;
  for (int i = 0; i < count; ++i) pairs.push_back({i, count + i});
  return pairs;
}

/// One row per step of Coulomb's fixed point: the change of the bounds g, the sum of the
/// absolute values relative to the sum of g, and its ratio to that of the step before.
inline const std::vector<std::string> step_columns{"element",   "locks", "F",      "panel",
                                                   "contracts", "step",  "change", "ratio"};
inline void add_steps(const Rubber& rubber, double coefficient, bool contracts,
                      const std::vector<Eigen::VectorXd>& bounds, Table& steps) {
  double before = 0;
  for (std::size_t k = 1; k < bounds.size(); ++k) {
    const double moved = (bounds[k] - bounds[k - 1]).lpNorm<1>();
    if (moved == 0) return;
    steps.add({rubber.name, rubber.locks, coefficient, fmt::format("$F = {}$", coefficient),
               contracts, k, moved / bounds[k].sum(), before > 0 ? moved / before : 0.0});
    before = moved;
  }
}

/// Prints the tables; writes zones.csv, where P1 on parallel triangles (`locked`) and on
/// crossed ones sticks and slips, and lambda.csv, T and the length that sticks against
/// lambda.
inline void show_friction(const std::filesystem::path& out, const Table& checks,
                          const Table& forces, int cells, const Profile& g,
                          const Eigen::MatrixX3d& locked, const Eigen::MatrixX3d& crossed) {
  checks.print("active set and Uzawa", 2);
  const Table here = forces.filter("h", 1.0 / cells);
  here.filter("known", 1)
      .pivot("element", "lambda", "N off")
      .print("error of the normal force in %, by lambda");
  for (const char* what : {"T", "sticks"})
    here.filter_number("lambda", [](double l) { return l <= 100 || std::isinf(l); })
        .pivot("element", "lambda", what)
        .print(std::string(what) + ", by lambda");
  Table zones({"x", "g", "minus_g", "T_locked", "T", "u_locked", "u"}),
      by_lambda({"log_lambda", "T_crossed", "T_cr", "T_ks", "crossed", "cr", "ks"});
  for (Eigen::Index i = 0; i < crossed.rows(); ++i) {
    const double x = crossed(i, 0);
    zones.add({x, g(x), -g(x), locked(i, 1), crossed(i, 1), locked(i, 2), crossed(i, 2)});
  }
  zones.write(out / "zones.csv");
  const Table drawn = here.filter_number("lambda", [](double l) { return l <= 1e4; });
  for (const TableEntry& lambda : drawn.unique("lambda")) {
    std::vector<TableEntry> row{std::log10(lambda.number())};
    for (const char* what : {"T", "sticks"})
      for (const char* element :
           {"P1 crossed triangles", "Crouzeix-Raviart with jumps", "Kouhia-Stenberg"})
        row.push_back(
            drawn.filter("lambda", lambda).filter("element", element).entry(what));
    by_lambda.add(row);
  }
  by_lambda.write(out / "lambda.csv");
}

/// The load of a force per length on one component, on all edges of the boundary.
inline Eigen::VectorXd boundary_load(
    const Space& space, const std::function<double(const Eigen::Vector2d&)>& force) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.size());
  const TriangleMesh& mesh = space.mesh();
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      if (mesh.edge_triangles(e, 1) >= 0) continue;
      const Eigen::Vector3d midpoint =
          0.5 * (Eigen::Vector3d::Ones() - Eigen::Vector3d::Unit(i));
      const Eigen::VectorXi unknowns = space.cell_dofs().row(t);
      load(unknowns) += mesh.edge_length(e) * force(point_in(mesh, t, midpoint)) *
                        space.element().basis(midpoint);
    }
  return load;
}

/// The largest error of u in a patch test with friction and slip, which elements that hold
/// affine functions pass: the unit square is pressed by 0.1 on a flat floor with g = 0.1,
/// its left side is dragged to the right, and everything slips, u = (0.05 + a x + g y, -0.1
/// y), a = 0.1 / (1 + 2 epsilon). Top and sides get their share of g as a load.
inline double slipping_patch_error(const VectorSpace& space, double jump_weight,
                                   double epsilon) {
  constexpr double rubs = 0.1, slip = 0.05;
  const Space &x = space.x, &y = space.y;
  PlaneStrain scene;  // flat obstacle, touching
  scene.epsilon = epsilon;
  scene.sliding = true;
  scene.friction = [](double) { return rubs; };
  scene.jump_weight = jump_weight;
  VariationalInequality problem = assemble(scene, space);
  const Eigen::VectorXd exact =
      slip + 0.1 / (1 + 2 * epsilon) * x.dof_coordinates().col(0).array() +
      rubs * x.dof_coordinates().col(1).array();
  for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i)
    if (problem.dirichlet_dofs[i] < x.size())
      problem.dirichlet_values(static_cast<Eigen::Index>(i)) =
          exact(problem.dirichlet_dofs[i]);
  problem.load.head(x.size()) =
      boundary_load(x, [](const auto& at) { return at(1) == 1 ? rubs : 0; });
  problem.load.tail(y.size()) = boundary_load(y, [](const auto& at) {
    return at(0) == 1 ? rubs : at(0) == 0 ? -rubs : 0;
  });
  const Eigen::VectorXd u = active_set(problem).u;
  return std::max(
      (u.head(x.size()) - exact).cwiseAbs().maxCoeff(),
      (u.tail(y.size()) + 0.1 * y.dof_coordinates().col(1)).cwiseAbs().maxCoeff());
}

/// One row per element that does not lock: patch, g = 0 and g = 1e6 as above; steps and
/// seconds of the active set, then of Uzawa, and the largest difference of their
/// displacements.
inline const std::vector<std::string> check_columns{
    "element", "unknowns",    "patch",   "g = 0",   "g = 1e6",
    "steps",   "Uzawa steps", "seconds", "Uzawa s", "apart"};
inline std::vector<TableEntry> check_row(
    const Rubber& rubber, const VectorSpace& space,
    const std::function<VariationalInequality(const Profile& g)>& pressed, double epsilon,
    const Solution& solution, double seconds, const Solution& same,
    double seconds_of_uzawa) {
  const auto [none, bonded] = extremes_of_friction(pressed);
  return {rubber.name,
          solution.counters.unknowns,
          slipping_patch_error(space, rubber.jumps ? 1 : 0, epsilon),
          none,
          bonded,
          solution.counters.contact_iterations,
          same.counters.contact_iterations,
          seconds,
          seconds_of_uzawa,
          (same.u - solution.u).cwiseAbs().maxCoeff()};
}

}  // namespace antilock::tutorial
