#include "antilock/adapt/solve_to.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "antilock/adapt/bisection.hpp"
#include "antilock/adapt/marking.hpp"
#include "antilock/analysis/layer_components.hpp"
#include "antilock/analysis/locking_report.hpp"
#include "antilock/certificate/companion.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/submesh.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

constexpr double thin = 0.1;  // up to this epsilon columns are the cheaper layer

Scene with_layer_to_solve(const Scene& scene) {
  if (!std::holds_alternative<VentcelLayer>(scene.layer())) return scene;
  return Scene(scene.body(), StiffLayer{0}, scene.contact(), scene.edges());
}

RefinementStrategy growth_of(const Scene& scene) {
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  return stiff != nullptr && stiff->epsilon <= thin ? RefinementStrategy::extrude
                                                    : RefinementStrategy::bisect;
}

/// The answer of a conforming element; that of P1 in K between the vertices, too.
Result conforming_answer(const Scene& scene, const Space& space, const ProgressHook& follow) {
  const Element& element = space.element();
  Result result{.space = space};
  result.problem =
      element.degree() == 1 ? assemble_in_k(scene, result.space) : assemble(scene, result.space);
  ActiveSetOptions options;
  options.corrections.progress = follow;
  result.solution = active_set(result.problem, options);
  return result;
}

/// The warning of a result that locks, if it would need more unknowns than the limit; else empty.
/// The error's square is at least twice the energy that is lost, and lost over kept falls like h^2
/// for P1 and h^4 for P2. `counted`: the unknowns that the limit is about.
std::string locking_warning(const Scene& scene, const Result& result,
                            const Certificate& certificate, const AccuracyGoal& accuracy,
                            int counted) {
  const auto report = report_locking(scene, result);
  if (!report || report->warning.empty()) return "";
  const double enough =
      std::pow(accuracy.relative * (certificate.norm + certificate.displacement), 2) / 2;
  // lost over kept, in this level and in the last one
  const double now = report->estimate / (1 - report->estimate);
  const double then = enough / report->reference;
  const double growth =
      std::pow(now / then, 1.0 / accuracy.element->degree());  // of the unknowns, as h^-2
  return counted * growth > accuracy.most_unknowns ? report->warning : "";
}

void check_request(const AccuracyGoal& accuracy) {
  const int highest_degree = accuracy.element->conforming() ? 2 : 1;
  if (accuracy.element->degree() > highest_degree || accuracy.element->dofs_per_cell() > 0)
    throw Error("accuracy: element " + accuracy.element->name() +
                " is not accepted; accepted: CR, P1, P2");
  if (accuracy.element->conforming() && accuracy.of != Quantity::displacement)
    throw Error("accuracy: the stress is that of CR; accepted with element " +
                accuracy.element->name() + ": the displacement");
  if (!(accuracy.relative > 0 && accuracy.relative < 1))
    throw Error(
        fmt::format("accuracy: {} is out of range; accepted: above 0, below 1", accuracy.relative));
  if (!(accuracy.most_unknowns >= 1))
    throw Error(fmt::format("accuracy: most_unknowns = {} is out of range; accepted: 1 or more",
                            accuracy.most_unknowns));
}

/// Transfers a contact set to the next mesh, by x: the status that the nearest unknowns on both
/// sides have in common. Empty where the last mesh has no contact unknown, or is none.
std::optional<BoundStatuses> transfer_status(const Eigen::VectorXd& x, const BoundStatuses& status,
                                             const Space& space) {
  if (x.size() == 0) return std::nullopt;
  BoundStatuses start;
  for (const int i : space.contact_dofs()) {
    const auto place =
        std::lower_bound(x.begin(), x.end(), space.dof_coordinates()(i, 0)) - x.begin();
    const std::ptrdiff_t right = std::min(place, x.size() - 1);
    const std::ptrdiff_t left = std::max<std::ptrdiff_t>(place - 1, 0);
    start.push_back(common_status(status[right], status[left]));
  }
  return start;
}

/// The bound relative to |v|_a, which falls like a power of N; a bound relative to what it leaves
/// of |v|_a does not, where both are of one size.
double relative_to_companion(double relative) {
  return std::isfinite(relative) ? relative / (1 + relative) : 1;
}

/// Predicts the last level: N grows like relative_to_companion(relative)^(-1/rate), with rate 1/2
/// for a mesh that is adapted, and more while it is not yet.
void predict(std::vector<RefinementLevel>& history, double goal) {
  if (history.size() < 3) return;
  RefinementLevel& last = history.back();
  const RefinementLevel& before = history[history.size() - 2];
  const RefinementLevel& first = history[history.size() - 3];
  if (last.relative <= goal) return;
  // A bound that rose, since the mesh has only now met kinks of the gap, tells nothing, nor does
  // the first fall after it.
  const bool falls_twice = last.relative < before.relative && before.relative < first.relative;
  if (!falls_twice) return;
  const double error = relative_to_companion(last.relative);
  const double growth = std::log(double(last.unknowns) / before.unknowns);
  const double fall = std::log(relative_to_companion(before.relative) / error);
  const double rate = std::clamp(fall / growth, 0.5, 1.5);
  const double factor = std::pow(error / relative_to_companion(goal), 1 / rate);
  last.predicted_unknowns = last.unknowns * (std::isfinite(factor) ? factor : 1e300);
  // a level costs like its unknowns to the power 1.2, and all levels before it cost less
  const double own = last.seconds - before.seconds;
  last.predicted_seconds = last.seconds + own * std::pow(factor, 1.2) * 2;
}

/// Doerfler's marking. Towards the last level no more is marked than the prediction asks for, by
/// the unknowns that a mark has brought so far.
Marking marking(const std::vector<RefinementLevel>& history, int marks) {
  Marking marking;
  const RefinementLevel& last = history.back();
  if (last.predicted_unknowns == 0 || marks == 0) return marking;
  const double per_mark = double(last.unknowns - history[history.size() - 2].unknowns) / marks;
  const double wanted = 1.1 * last.predicted_unknowns;  // a tenth more than too little
  const double missing = wanted - last.unknowns;
  if (4 * last.unknowns <= wanted) return marking;  // room for all
  marking.max_marked = std::max(1, static_cast<int>(std::min(missing / per_mark, 1e9)));
  return marking;
}

/// `per_unknown`: unknowns of Crouzeix-Raviart, which the limit counts, per one of the requested
/// element.
[[noreturn]] void give_up(const AccuracyGoal& accuracy, const std::vector<RefinementLevel>& history,
                          double per_unknown, const std::string& why, bool converges = true) {
  const RefinementLevel& last = history.back();
  const double unknowns = per_unknown * last.unknowns;
  const double reachable =
      relative_to_companion(last.relative) * std::sqrt(unknowns / accuracy.most_unknowns);
  std::string in_reach;
  if (converges && reachable < 0.5)
    in_reach =
        fmt::format("; within the limit about {:.2g} can be reached", reachable / (1 - reachable));
  const char* const of_element = accuracy.element->conforming() ? " of Crouzeix-Raviart" : "";
  const char* const plural = history.size() == 1 ? "" : "s";
  throw NotConverged(fmt::format("accuracy: {:.3g} is not reached within {:.0f} unknowns{}: {}; "
                                 "proved so far: {:.3g} with {} "
                                 "unknowns in {} level{}{}",
                                 accuracy.relative, accuracy.most_unknowns, of_element, why,
                                 last.relative, last.unknowns, history.size(), plural, in_reach),
                     last.relative, static_cast<int>(history.size()));
}

/// The conditions on the outer edges of the layer. Each is the tag of an edge with a number for its
/// place: -infinity for the lower side, and for the sides x, to nine digits of the body's size.
std::set<std::pair<double, EdgeTag>> layer_edge_tags(const TriangleMesh& mesh) {
  std::set<std::pair<double, EdgeTag>> tags;
  const double digits = 1e9 / body_size(mesh);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const bool outer = mesh.edge_triangles(e, 1) < 0;
    if (!outer || mesh.region[mesh.edge_triangles(e, 0)] != Region::layer) continue;
    const Eigen::RowVector2i ends = mesh.edges.row(e);
    const double highest_end = std::max(mesh.vertices(ends(0), 1), mesh.vertices(ends(1), 1));
    const bool below = highest_end < -1 + 1e-6;
    for (const int v : ends) {
      const double place = below ? -INFINITY : std::round(digits * mesh.vertices(v, 0));
      tags.emplace(place, mesh.edge_tag[e]);
    }
  }
  return tags;
}

RefinementStrategy strategy_for(const Scene& scene, const TriangleMesh& first,
                                const AccuracyGoal& accuracy) {
  if (accuracy.strategy) return *accuracy.strategy;
  const bool locks_below = accuracy.element->conforming() && !layer_components(first).is_aligned;
  return locks_below ? RefinementStrategy::bisect : growth_of(scene);
}

/// Where the layer is extruded, the layer of the first mesh is not used: it must be the same.
void require_same_layer(const TriangleMesh& first, const TriangleMesh& body, double epsilon) {
  const auto tags = layer_edge_tags(first);
  if (!tags.empty() && tags != layer_edge_tags(extruded(body, epsilon)))
    throw Error(
        "accuracy: the layer of the mesh is not that of columns below its body; accepted: sides "
        "that are upright, and "
        "held where the body is beside them, and contact all along the lower side");
}

/// The mesh of the first level. `warning`: that of resolve_load.
AdaptiveMesh first_mesh(const TriangleMesh& first, const Scene& scene, RefinementStrategy strategy,
                        const AccuracyGoal& accuracy, std::string& warning) {
  const bool extrude = strategy == RefinementStrategy::extrude;
  const double epsilon = scene.epsilon().value_or(1);
  AdaptiveMesh mesh;
  mesh.body = longest_edge_first(extrude ? body_submesh(first) : first);
  if (extrude) require_same_layer(first, mesh.body, epsilon);
  // 3/2 edges per triangle, and as much again for the levels that follow
  const int most_triangles = static_cast<int>(std::min(accuracy.most_unknowns / 3, 1e9));
  warning = resolve_load(mesh.body, scene.body().load, most_triangles);
  mesh.mesh = extrude ? extruded(mesh.body, epsilon) : mesh.body;
  return mesh;
}

/// One level: the solution, the function that is certified, and its certificate.
struct Level {
  Result result;
  ConformingCompanion v;
  Certificate certificate = {};
};

/// The contact set of a level, from which the next one starts.
struct ContactSet {
  Eigen::VectorXd x;  ///< of the contact unknowns
  BoundStatuses status;
};

/// Whether P1 on the triangles of the layer may be far worse than on columns.
bool layer_may_lock(const Scene& scene) {
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  return stiff != nullptr && stiff->epsilon <= thin;
}

/// Solves with Crouzeix-Raviart until the algebraic residual is at most a tenth of the constitutive
/// error, as far as double precision goes, and certifies.
void certify_crouzeix_raviart(Level& level, const Scene& scene, const AccuracyGoal& accuracy,
                              PenalisedCholesky& factor, ActiveSetOptions options,
                              const ProgressHook& step) {
  const double finest = CorrectionOptions{}.tolerance;
  Result& result = level.result;
  for (double tolerance = std::min(1e-2 * accuracy.relative, accuracy.tolerance);;
       tolerance *= 1e-2) {
    options.corrections.tolerance = std::max(tolerance, finest);
    result.solution = active_set(result.problem, factor, options);
    options.start = result.solution.status;
    step({});
    level.v = local_companion(scene, result, !layer_may_lock(scene));
    step({});
    level.certificate = certify(scene, result, {.factor = &factor, .companion = &level.v});
    const Certificate& certificate = level.certificate;
    const bool enough = certificate.algebraic_residual_norm <= 0.1 * certificate.constitutive_error;
    if (enough || tolerance <= finest) return;
  }
}

/// Replaces the solution of Crouzeix-Raviart, whose flux is used, by that of the requested element.
/// P1 is certified itself, and P2 by its distance to P1.
void certify_conforming(Level& level, const Scene& scene, const Element& element,
                        PenalisedCholesky& factor, const ProgressHook& step) {
  const Space& space = level.result.space;
  Result own = conforming_answer(scene, Space(space, p1()), step);
  level.v = p1_companion(assemble_fixed_rows(own).solution);
  level.certificate = certify(scene, level.result, {.factor = &factor, .companion = &level.v});
  if (element.degree() > 1) {
    own = conforming_answer(scene, Space(space, element), step);
    level.certificate.displacement = certified_distance(level.certificate, level.v, own);
  }
  level.result = std::move(own);
}

/// Solves on a mesh, and certifies. `contact`: the contact set of the last level, replaced by that
/// of this one.
Level solve_level(const Scene& scene, const Space& space, const AccuracyGoal& accuracy,
                  ContactSet& contact, const ProgressHook& step) {
  Level level{.result = {space, assemble(scene, space)}, .v = {}};
  step({});
  PenalisedCholesky factor(level.result.problem);
  step({});
  ActiveSetOptions options;
  options.corrections.progress = step;
  if (scene.contact()) options.start = transfer_status(contact.x, contact.status, space);
  certify_crouzeix_raviart(level, scene, accuracy, factor, options, step);
  contact.x = space.dof_coordinates().col(0)(space.contact_dofs());
  contact.status = level.result.solution.status;
  if (accuracy.element->conforming())
    certify_conforming(level, scene, *accuracy.element, factor, step);
  level.result.solution.warning.clear();  // the certificate counts what the corrections left
  return level;
}

/// The function that is certified, at the vertices of the mesh.
Solution companion_solution(ConformingCompanion& v, const TriangleMesh& mesh) {
  Solution companion;
  companion.solver = "strip";
  companion.u = std::move(v.at_vertices);
  companion.p = std::move(v.stress);
  if (!v.layer) return companion;
  for (int i = 0; i < mesh.vertex_count(); ++i)
    if (mesh.vertices(i, 1) < 0) companion.u(i) = v.layer->value(mesh.vertices.row(i).transpose());
  return companion;
}

/// Throws where the unknowns of the next mesh are beyond the limit.
void require_room(const AccuracyGoal& accuracy, const std::vector<RefinementLevel>& history,
                  double per_unknown, int unknowns) {
  if (unknowns <= accuracy.most_unknowns) return;
  if (history.empty())
    throw Error(fmt::format(
        "accuracy: most_unknowns = {:.0f} cannot hold the first mesh, which has {} unknowns; "
        "accepted: at least as many, or a coarser first mesh",
        accuracy.most_unknowns, unknowns));
  give_up(accuracy, history, per_unknown, fmt::format("the next mesh has {}", unknowns));
}

/// Throws where a later level will be beyond the limit: the method locks, or the prediction says
/// so.
void require_goal_in_reach(const Scene& scene, const Level& level, const AccuracyGoal& accuracy,
                           const std::vector<RefinementLevel>& history, double per_unknown,
                           int unknowns) {
  if (accuracy.element->conforming()) {
    const std::string why =
        locking_warning(scene, level.result, level.certificate, accuracy, unknowns);
    if (!why.empty()) give_up(accuracy, history, per_unknown, why, false);
  }
  const double needed = per_unknown * history.back().predicted_unknowns;
  if (needed > accuracy.most_unknowns)
    give_up(accuracy, history, per_unknown, fmt::format("about {:.2g} are needed", needed));
}

}  // namespace

CertifiedSolution solve_to(const Scene& asked, const TriangleMesh& first,
                           const AccuracyGoal& accuracy,
                           const std::function<void(const RefinementLevel&)>& progress) {
  require_triangles(first, "accuracy");
  check_request(accuracy);
  if (first.curved())
    throw Error(
        "accuracy: has no flux for a layer along the normals of a curved edge; accepted: a layer "
        "below y = 0");
  Stopwatch watch;
  double seconds = 0;
  const Scene scene = with_layer_to_solve(asked);
  const RefinementStrategy strategy = strategy_for(scene, first, accuracy);
  if (strategy == RefinementStrategy::extrude && !std::holds_alternative<StiffLayer>(scene.layer()))
    throw Error("accuracy: there is no scaled layer to extrude; accepted: growth by bisection");
  std::string warning;
  AdaptiveMesh now = first_mesh(first, scene, strategy, accuracy, warning);

  std::vector<RefinementLevel> history;
  double per_unknown = 1;
  ContactSet contact;
  const ProgressHook step = [&](const Progress&) {
    const int level = static_cast<int>(history.size()) + 1;
    const double reached = history.empty() ? 1 : history.back().relative;
    notify_or_throw(accuracy.follow, {"refinement, level", level, reached, accuracy.relative},
                    "accuracy");
    return true;
  };
  while (true) {
    step({});
    const Space space(now.mesh, crouzeix_raviart());
    require_room(accuracy, history, per_unknown, space.free_count());
    Level level = solve_level(scene, space, accuracy, contact, step);
    seconds += watch.lap();
    const int unknowns = level.result.space.free_count();
    per_unknown = double(space.free_count()) / unknowns;
    const double bound = level.certificate.bound(accuracy.of);
    const double relative = level.certificate.relative(accuracy.of);
    history.push_back({unknowns, bound, relative, seconds});
    predict(history, accuracy.relative);
    if (progress) progress(history.back());
    if (relative <= accuracy.relative) {
      Result& result = level.result;
      result.warning = warning;
      add_locking_report(result, report_locking(scene, result));
      Solution companion = companion_solution(level.v, now.mesh);
      return {std::move(result), std::move(companion), std::move(level.certificate),
              std::move(history)};
    }
    require_goal_in_reach(scene, level, accuracy, history, per_unknown, space.free_count());
    step({});
    now = refine_marked(now, strategy, scene.epsilon().value_or(1), level.certificate.indicator,
                        marking(history, now.marks));
  }
}

}  // namespace antilock
