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
  return stiff != nullptr && stiff->epsilon <= thin ? RefinementStrategy::extrude : RefinementStrategy::bisect;
}

/// The answer of a conforming element; that of P1 in K between the vertices, too.
Result conforming_answer(const Scene& scene, const Space& space, const ProgressHook& follow) {
  const Element& element = space.element();
  Result result{.space = space};
  result.problem = element.degree() == 1 ? assemble_in_k(scene, result.space) : assemble(scene, result.space);
  ActiveSetOptions options;
  options.corrections.progress = follow;
  result.solution = active_set(result.problem, options);
  return result;
}

/// Of an answer that locks: what is told of it, where the unknowns that would be needed are more than the limit. The
/// error's square is at least twice what is lost, and lost over kept falls like h^2 for P1 and h^4 for P2. `counted`: the
/// unknowns that the limit is about.
std::string locking_warning(const Scene& scene, const Result& result, const Certificate& certificate,
                            const AccuracyGoal& accuracy, int counted) {
  const auto report = report_locking(scene, result);
  if (!report || report->warning.empty()) return "";
  const double enough = std::pow(accuracy.relative * (certificate.norm + certificate.displacement), 2) / 2;
  const double now = report->estimate / (1 - report->estimate), then = enough / report->reference;  // lost over kept
  const double times = std::pow(now / then, 1.0 / accuracy.element->degree());  // the unknowns, as h^-2
  return counted * times > accuracy.most_unknowns ? report->warning : "";
}

void check_request(const AccuracyGoal& accuracy) {
  if (accuracy.element->degree() > (accuracy.element->conforming() ? 2 : 1) || accuracy.element->dofs_per_cell() > 0)
    throw Error("accuracy: element " + accuracy.element->name() + " is not accepted; accepted: CR, P1, P2");
  if (accuracy.element->conforming() && accuracy.of != Quantity::displacement)
    throw Error("accuracy: the stress is that of CR; accepted with element " + accuracy.element->name() +
                ": the displacement");
  if (!(accuracy.relative > 0 && accuracy.relative < 1))
    throw Error(fmt::format("accuracy: {} is out of range; accepted: above 0, below 1", accuracy.relative));
  if (!(accuracy.most_unknowns >= 1))
    throw Error(
        fmt::format("accuracy: most_unknowns = {} is out of range; accepted: 1 or more", accuracy.most_unknowns));
}

/// A contact set from one mesh to the next, by x: on the piece of the nearest unknowns on both sides, where they agree.
/// Nothing where the last mesh has no contact unknown, or is none.
std::optional<BoundStatuses> transfer_status(const Eigen::VectorXd& x, const BoundStatuses& status,
                                             const Space& space) {
  if (x.size() == 0) return std::nullopt;
  BoundStatuses start;
  for (const int i : space.contact_dofs()) {
    const auto right = std::lower_bound(x.begin(), x.end(), space.dof_coordinates()(i, 0)) - x.begin();
    start.push_back(
        common_status(status[std::min(right, x.size() - 1)], status[std::max<std::ptrdiff_t>(right - 1, 0)]));
  }
  return start;
}

/// The bound relative to |v|_a, which falls like a power of N; a bound relative to what it leaves of |v|_a does not, where
/// both are of one size.
double relative_to_companion(double relative) { return std::isfinite(relative) ? relative / (1 + relative) : 1; }

/// What the levels so far say of the one that will be the last: N grows like of_norm(relative)^(-1/rate), rate 1/2 for a
/// mesh that is adapted, more while it is still on its way there.
void predict(std::vector<RefinementLevel>& history, double asked) {
  if (history.size() < 3) return;
  RefinementLevel& last = history.back();
  const RefinementLevel& before = history[history.size() - 2];
  if (last.relative <= asked) return;
  // a bound that rose, since the mesh has only now met kinks of the gap, tells nothing, nor does the first fall after
  // it
  if (!(last.relative < before.relative && before.relative < history[history.size() - 3].relative)) return;
  const double growth = std::log(double(last.unknowns) / before.unknowns);
  const double rate = std::clamp(
      std::log(relative_to_companion(before.relative) / relative_to_companion(last.relative)) / growth, 0.5, 1.5);
  const double factor = std::pow(relative_to_companion(last.relative) / relative_to_companion(asked), 1 / rate);
  last.predicted_unknowns = last.unknowns * (std::isfinite(factor) ? factor : 1e300);
  const double own =
      last.seconds - before.seconds;  // a level costs like its unknowns to the power 1.2, all before less
  last.predicted_seconds = last.seconds + own * std::pow(factor, 1.2) * 2;
}

/// Doerfler's marking; towards the last level only what the quote asks for, at what a mark has brought so far.
Marking marking(const std::vector<RefinementLevel>& history, int marks) {
  Marking marking;
  const RefinementLevel& last = history.back();
  if (last.predicted_unknowns == 0 || marks == 0) return marking;
  const double per_mark = double(last.unknowns - history[history.size() - 2].unknowns) / marks;
  const double missing = 1.1 * last.predicted_unknowns - last.unknowns;    // a tenth more than too little
  if (4 * last.unknowns <= 1.1 * last.predicted_unknowns) return marking;  // room for all
  marking.max_marked = std::max(1, static_cast<int>(std::min(missing / per_mark, 1e9)));
  return marking;
}

/// `per_unknown`: unknowns of Crouzeix-Raviart, which the limit counts, per one of the element that was asked for.
[[noreturn]] void give_up(const AccuracyGoal& accuracy, const std::vector<RefinementLevel>& history, double per_unknown,
                          const std::string& why, bool converges = true) {
  const RefinementLevel& last = history.back();
  const double reachable =
      relative_to_companion(last.relative) * std::sqrt(per_unknown * last.unknowns / accuracy.most_unknowns);
  throw NotConverged(
      fmt::format(
          "accuracy: {:.3g} is not reached within {:.0f} unknowns{}: {}; proved so far: {:.3g} with {} unknowns in "
          "{} level{}{}",
          accuracy.relative, accuracy.most_unknowns, accuracy.element->conforming() ? " of Crouzeix-Raviart" : "", why,
          last.relative, last.unknowns, history.size(), history.size() == 1 ? "" : "s",
          converges && reachable < 0.5
              ? fmt::format("; within the limit about {:.2g} can be reached", reachable / (1 - reachable))
              : ""),
      last.relative, static_cast<int>(history.size()));
}

/// What the layer is held by: the tags of its outer edges, those of the lower side at -infinity, those of the sides at
/// their x, to nine digits of the body's size.
std::set<std::pair<double, EdgeTag>> layer_edge_tags(const TriangleMesh& mesh) {
  std::set<std::pair<double, EdgeTag>> tags;
  const double digits = 1e9 / body_size(mesh);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_triangles(e, 1) >= 0 || mesh.region[mesh.edge_triangles(e, 0)] != Region::layer) continue;
    const bool below = (mesh.vertices(mesh.edges.row(e), 1).array() < -1 + 1e-6).all();
    for (const int v : mesh.edges.row(e))
      tags.emplace(below ? -INFINITY : std::round(digits * mesh.vertices(v, 0)), mesh.edge_tag[e]);
  }
  return tags;
}

}  // namespace

CertifiedSolution solve_to(const Scene& asked, const TriangleMesh& first, const AccuracyGoal& accuracy,
                           const std::function<void(const RefinementLevel&)>& progress) {
  check_request(accuracy);
  if (first.curved())
    throw Error("accuracy: has no flux for a layer along the normals of a curved edge; accepted: a layer below y = 0");
  Stopwatch watch;
  double seconds = 0;
  const Scene scene = with_layer_to_solve(asked);
  const bool conforming = accuracy.element->conforming();
  const RefinementStrategy strategy = accuracy.strategy.value_or(
      conforming && !layer_components(first).is_aligned ? RefinementStrategy::bisect : growth_of(scene));
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  if (strategy == RefinementStrategy::extrude && stiff == nullptr)
    throw Error("accuracy: there is no scaled layer to extrude; accepted: growth by bisection");
  const bool layer_may_lock = stiff != nullptr && stiff->epsilon <= thin;
  const double epsilon = scene.epsilon().value_or(1);
  std::vector<RefinementLevel> history;
  TriangleMesh body = longest_edge_first(strategy == RefinementStrategy::extrude ? body_submesh(first) : first);
  if (const auto held = layer_edge_tags(first);
      strategy == RefinementStrategy::extrude && !held.empty() && held != layer_edge_tags(extruded(body, epsilon)))
    throw Error(
        "accuracy: the layer of the mesh is not that of columns below its body; accepted: sides that are upright, and "
        "held where the body is beside them, and contact all along the lower side");
  // 3/2 edges per triangle, and as much again for the levels that follow
  const int most_triangles = static_cast<int>(std::min(accuracy.most_unknowns / 3, 1e9));
  const std::string warning = resolve_load(body, scene.body().load, most_triangles);
  AdaptiveMesh now;
  now.mesh = strategy == RefinementStrategy::extrude ? extruded(body, epsilon) : body;
  now.body = std::move(body);

  double per_unknown = 1;
  Eigen::VectorXd contact_x;  // of the last mesh, and what its unknowns do
  BoundStatuses contact_set;
  const auto step = [&](const Progress& = {}) {
    const int level = static_cast<int>(history.size()) + 1;
    const double reached = history.empty() ? 1 : history.back().relative;
    notify_or_throw(accuracy.follow, {"refinement, level", level, reached, accuracy.relative}, "accuracy");
    return true;
  };
  while (true) {
    step();
    const Space space(now.mesh, crouzeix_raviart());
    if (space.free_count() > accuracy.most_unknowns) {
      if (history.empty())
        throw Error(
            fmt::format("accuracy: most_unknowns = {:.0f} cannot hold the first mesh, which has {} unknowns; "
                        "accepted: at least as many, or a coarser first mesh",
                        accuracy.most_unknowns, space.free_count()));
      give_up(accuracy, history, per_unknown, fmt::format("the next mesh has {}", space.free_count()));
    }
    Result result{space, assemble(scene, space)};
    step();
    PenalisedCholesky factor(result.problem);
    step();
    ActiveSetOptions options;
    options.corrections.progress = step;
    if (scene.contact()) options.start = transfer_status(contact_x, contact_set, space);
    ConformingCompanion v;
    Certificate certificate;
    for (double tolerance = std::min(1e-2 * accuracy.relative, accuracy.tolerance);; tolerance *= 1e-2) {
      options.corrections.tolerance = std::max(tolerance, CorrectionOptions{}.tolerance);
      result.solution = active_set(result.problem, factor, options);
      options.start = result.solution.status;
      step();
      v = local_companion(scene, result, !layer_may_lock);
      step();
      certificate = certify(scene, result, {.factor = &factor, .companion = &v});
      const bool enough = certificate.algebraic_residual_norm <= 0.1 * certificate.constitutive_error;
      if (enough || tolerance <= CorrectionOptions{}.tolerance) break;
    }
    contact_x = space.dof_coordinates().col(0)(space.contact_dofs());
    contact_set = result.solution.status;
    if (conforming) {
      Result own = conforming_answer(scene, Space(space, p1()), step);
      v = p1_companion(assemble_fixed_rows(own).solution);
      certificate = certify(scene, result, {.factor = &factor, .companion = &v});
      if (accuracy.element->degree() > 1) {
        own = conforming_answer(scene, Space(space, *accuracy.element), step);
        certificate.displacement = certified_distance(certificate, v, own);
      }
      result = std::move(own);
    }
    result.solution.warning.clear();  // the certificate counts what the corrections left
    seconds += watch.lap();
    per_unknown = double(space.free_count()) / result.space.free_count();
    const double relative = certificate.relative(accuracy.of);
    history.push_back({result.space.free_count(), certificate.bound(accuracy.of), relative, seconds});
    predict(history, accuracy.relative);
    if (progress) progress(history.back());
    if (relative <= accuracy.relative) {
      result.locking = report_locking(scene, result);
      result.warning = joined(result.locking ? result.locking->warning : "", warning);
      Solution companion;
      companion.solver = "strip";
      companion.u = std::move(v.at_vertices);
      companion.p = std::move(v.stress);
      if (v.layer)
        for (int i = 0; i < now.mesh.vertex_count(); ++i)
          if (now.mesh.vertices(i, 1) < 0) companion.u(i) = v.layer->value(now.mesh.vertices.row(i).transpose());
      return {std::move(result), std::move(companion), std::move(certificate), std::move(history)};
    }
    if (conforming)
      if (const std::string why = locking_warning(scene, result, certificate, accuracy, space.free_count());
          !why.empty())
        give_up(accuracy, history, per_unknown, why, false);
    if (const double needed = per_unknown * history.back().predicted_unknowns; needed > accuracy.most_unknowns)
      give_up(accuracy, history, per_unknown, fmt::format("about {:.2g} are needed", needed));
    step();
    now = refine_marked(now, strategy, epsilon, certificate.indicator, marking(history, now.marks));
  }
}

}  // namespace antilock
