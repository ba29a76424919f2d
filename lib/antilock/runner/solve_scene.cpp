#include "antilock/runner/solve_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "antilock/analysis/locking.hpp"
#include "antilock/analysis/solve.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/runner/scene_checks.hpp"
#include "antilock/runner/scene_mesh.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/uzawa.hpp"

namespace antilock {
namespace {

template <class Model>
Model pressed(const SceneFile& file) {
  Model model;
  model.prescribed_displacement = file.elastic->prescribed_displacement;
  model.gap = file.scene.contact()->gap;
  model.friction = file.elastic->friction;
  return model;
}

/// The coating of a scene in plane strain that has a layer.
std::optional<Coating> coating_of(const SceneFile& file) {
  const auto* layer = std::get_if<StiffLayer>(&file.scene.layer());
  if (!file.elastic || layer == nullptr) return {};
  Coating coating = pressed<Coating>(file);
  const Lame& body = coating.body = file.elastic->material;
  coating.thickness = layer->epsilon;
  coating.layer = {layer->s * body.lambda, layer->s * body.mu};
  return coating;
}

/// The solution by the solver and to the tolerance of [method].
Solution solve_as_asked(const SceneFile& file, const Space& space, const VariationalInequality& problem,
                        const ProgressHook& follow) {
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
    if (const auto coating = coating_of(file)) options.penalty = penalty(*coating, {space, space});
    solution = active_set(problem, options);
  }
  if (method.tolerance < tolerance)
    throw NotConverged(fmt::format("{}: relative error about {:.0e} reached after {} corrections, asked for {:.1e}; "
                                   "double precision goes no further",
                                   method.solver, tolerance, solution.counters.corrections, method.tolerance),
                       tolerance, solution.counters.corrections);
  return solution;
}

/// What the mesh says of a scene in plane strain. In a coating conforming elements lock off columns where the length k by
/// which they resist bending is not small beside the thickness (analysis/locking.hpp). Nothing is proved of it.
std::optional<LockingReport> elastic_locking_report(const SceneFile& file, const Space& space) {
  const auto coating = coating_of(file);
  const Element& element = space.element();
  // P1 in rubber, pressed on a round punch: its force is 4 to 10 % too large at h^2 = epsilon / 10 (both meshes, 1/h =
  // 8 and 32), 23 to 40 % at h^2 = epsilon, and it doubles at ten times that
  if (const double h = mesh_width(file, space.mesh());
      !coating && element.conforming() && element.degree() == 1 && h * h > 0.1 * file.elastic->epsilon)
    return LockingReport{fmt::format("P1 can hardly move without a change of volume: h^2 = {:.2g}, beside epsilon = "
                                     "{:g} it locks",
                                     h * h, file.elastic->epsilon),
                         {},
                         "P1 locks in this rubber: the contact force is too large; remedy: element = \"CR\" or \"P2\""};
  if (!coating) return std::nullopt;
  if (!element.conforming())
    return LockingReport{element.name() + " does not lock: its slopes across the coating are free", {}, ""};
  const double k = bending_length(space.mesh()), t = coating->thickness;
  LockingReport report{
      fmt::format("{} resists bending in the coating as over the length {:.2g}", element.name(), k), {}, ""};
  // degree 1: lost / kept = (5.84 k / t)^2 for one wave per unit length, which is a twentieth at k = 0.04 t; above
  // degree 1 the mesh is in the way where it resists more than the coating's own thickness does
  if (k > (element.degree() == 1 ? 0.04 : 1) * t) {
    report.diagnosis += fmt::format(", beside a thickness of {:g} it locks", t);
    report.warning = element.name() +
                     " locks in this coating: the contact force is too large; remedy: element = \"CR\", or "
                     "triangles in columns (kind = \"structured\" or \"layered\")";
  } else {
    report.diagnosis += fmt::format(", which beside a thickness of {:g} does not matter", t);
  }
  return report;
}

/// `solve` for a scene file in plane strain.
Result solve_elastic(const SceneFile& file, const Space& space, const Solver& solver) {
  Result result{.space = space, .problem = problem_of(file, space)};
  result.solution = solver(result.problem);
  result.locking = elastic_locking_report(file, space);
  result.warning = joined(result.locking ? result.locking->warning : "", result.solution.warning);
  return result;
}

}  // namespace

VariationalInequality problem_of(const SceneFile& file, const Space& space) {
  if (!file.elastic) return assemble(file.scene, space);
  const VectorSpace both{space, space};
  const auto problem = [&] {
    if (const auto coating = coating_of(file)) return assemble(*coating, both);
    auto rubber = pressed<PlaneStrain>(file);
    rubber.epsilon = file.elastic->epsilon;
    return assemble(rubber, both);
  };
  VariationalInequality of_both = problem();
  of_both.load.tail(space.size()) = load_vector(space, file.scene.body().load);  // f acts in y
  return of_both;
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
    const AccuracyGoal asked{*method.accuracy,         method.of,   method.most_unknowns, {}, method.tolerance,
                             &element(method.element), follow.solve};
    CertifiedSolution found = solved([&] { return solve_to(file.scene, mesh, asked, follow.level); });
    found.result.seconds = seconds;
    spent(found.result);
    found.result.warning = joined(found.result.warning, joined(polygon_warning(file, mesh), geometry_warning(file)));
    return found;
  }
  begin(fmt::format("assembly: {} on {} triangles", method.element, mesh.triangle_count()));
  const Space space(std::move(mesh), element(method.element));
  if (space.free_count() == 0)
    throw InputError(file.name + ": mesh: every unknown is clamped, none is left to solve for; accepted: a finer mesh");
  std::string data;  // to distrust in what was given
  const auto by_method = [&](const VariationalInequality& problem) {
    data = joined(load_warning(file, space, problem), displacement_warning(file, space.mesh()));
    seconds.assemble = watch.lap();
    begin(fmt::format("solve: {}, {} unknowns", method.solver, problem.free_count()));
    return solve_as_asked(file, space, problem, follow.solve);
  };
  Result result = solved([&] {
    return file.elastic ? solve_elastic(file, space, by_method) : solve(file.scene, space, Solver(by_method));
  });
  const Solution& solution = result.solution;
  result.warning = joined(joined(result.warning, data),
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
  normal.problem.contact.assign(problem.contact.begin(), problem.contact.begin() + all);
  normal.problem.lower = problem.lower.head(all);
  normal.solution.u = solution.u;
  normal.solution.lambda = solution.lambda.head(all);
  normal.solution.active.assign(solution.active.begin(), solution.active.begin() + all);
  return normal;
}

Eigen::VectorXd pressure_of(const SceneFile& file, const Result& result) {
  const Space& space = result.space;
  const Eigen::VectorXd& p = result.solution.p;
  if (const auto coating = coating_of(file)) return pressure(*coating, {space, space}, result.solution.u, p);
  const Eigen::Index triangles = result.space.mesh().triangle_count();
  return -p.reshaped(p.size() / triangles, triangles).colwise().mean().transpose();
}

}  // namespace antilock
