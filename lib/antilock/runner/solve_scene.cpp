#include "antilock/runner/solve_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "antilock/core/stopwatch.hpp"
#include "antilock/runner/scene_checks.hpp"
#include "antilock/runner/scene_mesh.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/uzawa.hpp"

namespace antilock {
namespace {

/// The solution by the solver and to the tolerance of [method].
Solution solve_as_asked(const SceneFile& file, const Space& space,
                        const VariationalInequality& problem, const ProgressHook& follow) {
  const MethodRequest& method = file.method;
  const double tolerance = std::max(method.tolerance, MethodRequest::finest_tolerance);
  Solution solution;
  if (method.solver == "uzawa") {
    UzawaOptions options;
    options.tolerance = tolerance;
    options.progress = follow;
    solution = uzawa(problem, options);
  } else {
    ActiveSetOptions options;
    options.corrections.tolerance = tolerance;
    options.corrections.progress = follow;
    options.penalty =
        std::visit([&](const auto& model) { return model.penalty(space); }, file.model);
    solution = active_set(problem, options);
  }
  if (method.tolerance < tolerance)
    throw NotConverged(
        fmt::format(
            "{}: relative error about {:.0e} reached after {} corrections, asked for {:.1e}; "
            "double precision goes no further",
            method.solver, tolerance, solution.counters.corrections, method.tolerance),
        tolerance, solution.counters.corrections);
  return solution;
}

/// The contact of two bodies.
ContactResults interface_results(const TwoBodyContact& between, const Result& result) {
  const InterfaceConstraints constraints =
      interface_constraints(result.space, between.slave, between.master, between.method);
  const Solution& solution = result.solution;
  ContactResults found;
  found.table = interface_table(constraints, result.problem.bounds, solution.u, solution.lambda);
  const Eigen::VectorXd x = found.table.col(0);
  found.zone = contact_zone(x, solution.active, contact_ends(result.space.mesh(), between.slave));
  found.force.normal = solution.lambda.sum();
  // psi_i is not centred at its place beside a prescribed end
  const Eigen::VectorXd mean_x = constraints.means * constraints.points.col(0);
  found.force.moment = solution.lambda.dot(mean_x);
  return found;
}

}  // namespace

VariationalInequality problem_of(const SceneFile& file, const Space& space) {
  return std::visit([&](const auto& model) { return model.problem(file.scene, space); },
                    file.model);
}

CertifiedSolution solve_scene(const SceneFile& file, const Callbacks& follow) {
  const MethodRequest& method = file.method;
  const auto begin = [&](const std::string& what) {
    if (follow.stage) follow.stage(what);
  };
  Stopwatch watch;
  begin("mesh");
  TriangleMesh mesh = make_mesh(file);
  RunSeconds seconds;
  seconds.mesh = watch.lap();
  const auto solved = [&](const auto& solve) {
    try {
      return solve();
    } catch (const NotConverged& failure) {
      throw NotConverged(file.name + ": solve: " + failure.what(), failure.reached, failure.steps);
    } catch (const InputError&) {
      throw;
    } catch (const Error& error) {
      throw InputError(file.name + (method.accuracy ? ": method.accuracy: " : ": ") + error.what());
    }
  };
  const auto spent = [&](Result& result) {
    result.seconds.factor = result.solution.seconds.analyse + result.solution.seconds.factor;
    result.seconds.solve = watch.lap() - result.seconds.factor;
  };
  if (method.accuracy) {
    begin(fmt::format("solve to a relative error of {:g}", *method.accuracy));
    const AccuracyGoal asked{
        *method.accuracy,         method.of,   method.most_unknowns, {}, method.tolerance,
        &element(method.element), follow.solve};
    CertifiedSolution found =
        solved([&] { return solve_to(file.scene, mesh, asked, follow.level); });
    found.result.seconds = seconds;
    spent(found.result);
    found.result.warning =
        joined(found.result.warning, joined(polygon_warning(file, mesh), geometry_warning(file)));
    return found;
  }
  begin(fmt::format("assembly: {} on {} {}", method.element, mesh.triangle_count(),
                    mesh.reference().plural));
  const Element& chosen = element(method.element, mesh.kind);
  const Space space(std::move(mesh), chosen);
  if (space.free_count() == 0)
    throw InputError(
        file.name +
        ": mesh: every unknown is clamped, none is left to solve for; accepted: a finer mesh");
  std::string data;  // to distrust in what was given
  bool is_assembled = false;
  const auto by_method = [&](const VariationalInequality& problem) {
    if (!is_assembled) {  // Coulomb's friction calls the solver again
      data = joined(load_warning(file, space, problem), displacement_warning(file, space.mesh()));
      seconds.assemble = watch.lap();
      begin(fmt::format("solve: {}, {} unknowns", method.solver, problem.free_count()));
      is_assembled = true;
    }
    return solve_as_asked(file, space, problem, follow.solve);
  };
  Result result = solved([&] {
    return std::visit([&](const auto& model) { return model.solve(file, space, by_method); },
                      file.model);
  });
  const Solution& solution = result.solution;
  result.warning =
      joined(joined(result.warning, data),
             joined(gap_warning(file, space, solution), range_warning(file, space, solution)));
  result.warning = joined(result.warning, geometry_warning(file));
  result.seconds = seconds;
  spent(result);
  return {std::move(result), {}, {}, {}};
}

Result normal_contact(const Result& result) {
  const VariationalInequality& problem = result.problem;
  const Solution& solution = result.solution;
  const std::size_t count = result.space.contact_dofs().size();
  const auto all = static_cast<Eigen::Index>(count);
  Result normal{.space = result.space};
  const std::vector<int>& bounded = problem.bounds.unknowns;
  normal.problem.bounds =
      Bounds::lower_on({bounded.begin(), bounded.begin() + all}, problem.bounds.lower.head(all));
  normal.solution.u = solution.u;
  normal.solution.lambda = solution.lambda.head(all);
  normal.solution.active.assign(solution.active.begin(), solution.active.begin() + all);
  return normal;
}

std::optional<ContactResults> contact_results(const SceneFile& file, const Result& result) {
  if (const auto* bodies = std::get_if<TwoBodyModel>(&file.model))
    return interface_results(bodies->between, result);
  if (!file.scene.contact()) return {};
  const Result normal = normal_contact(result);
  ContactResults found{contact_table(normal), contact_zone(normal), contact_force(normal)};
  const auto friction =
      std::visit([&](const auto& model) { return model.friction_forces(result); }, file.model);
  if (friction) found.force.tangential = friction->dot(contact_lengths(result.space));
  return found;
}

}  // namespace antilock
