// The text on locking that every program prints.
#include "antilock/analysis/locking_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "antilock/analysis/layer_components.hpp"
#include "antilock/analysis/locking_beside_columns.hpp"
#include "antilock/analysis/locking_beside_cr.hpp"
#include "antilock/analysis/locking_loss.hpp"
#include "antilock/core/error.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

/// Shares of the energy that the motion of the layer releases, and the one from which a loss is
/// attributed to locking.
struct Shares {
  double estimate, lower_bound, threshold;
};

LockingReport with_shares(LockingReport report, const Scene& scene, const Element& element,
                          const Shares& shares, double reference) {
  const auto& [estimate, lower_bound, threshold] = shares;
  const bool locks = estimate >= threshold;
  const bool by_proof = !locks || lower_bound >= threshold;
  if (by_proof) report.lost = lower_bound;
  report.estimate = estimate;
  report.reference = reference;
  if (!locks) {
    report.diagnosis +=
        reference > 0
            ? fmt::format("; at epsilon = {:g} this costs less than {:.0f} % of the energy",
                          *scene.epsilon(), 100 * threshold)
            : "; the layer moves no further than round-off here";
    return report;
  }
  report.diagnosis += fmt::format("; at epsilon = {:g} it locks", *scene.epsilon());
  const double share = by_proof ? lower_bound : estimate;
  const double per_cent = std::min(std::floor(100 * share), 99.0);
  const char* const how_sure = by_proof ? "at least" : "about";
  const char* const origin = by_proof ? "proved" : "by a second solve, with columns";
  report.warning = fmt::format(
      "{} locks in this layer: it loses {} {:.0f} % of the energy that the layer's motion releases "
      "({}); remedy: element = \"CR\", or a layer in columns (kind = \"layered\")",
      element.name(), how_sure, per_cent, origin);
  return report;
}

/// The report on a conforming element on tetrahedra that are not aligned, where the mesh is too
/// fine for a number.
LockingReport without_number(LockingReport report, const Element& element, int most_faces) {
  report.diagnosis +=
      fmt::format("; what it costs is not computed on more than {} faces", most_faces);
  report.warning =
      element.name() +
      " locks in this layer where epsilon is small against the mesh width, since its tetrahedra "
      "are tied to each other; remedy: element = \"CR\", or a layer in columns (kind = "
      "\"layered\")";
  return report;
}

/// The same with a number, by two or three solves on columns, which cost about as much as that of
/// u_h each. Where nothing can be proved, the estimate takes solves by Crouzeix-Raviart, whose
/// unknowns are the faces: on gmsh's mesh with 1/h = 16 (4,866 unknowns of P1, 84,000 faces) they
/// take 1.6 s, and the rest of the run takes 1.8 s.
LockingReport loss_in_space(const Scene& scene, const Result& result, LockingReport report) {
  constexpr int most_faces = 1'000'000, most_faces_of_cr = 100'000;
  const Space& space = result.space;
  const int faces = space.mesh().edge_count();
  if (faces > most_faces) return without_number(std::move(report), space.element(), most_faces);
  LossBesideColumns loss;
  try {
    loss = loss_beside_columns(scene, result);
  } catch (const Error&) {  // an estimate is possible where nothing is proved
    if (faces > most_faces_of_cr)
      return without_number(std::move(report), space.element(), most_faces_of_cr);
    const auto assemble_on = [&](const Space& on) { return assemble(scene, on); };
    const auto solver = [](const VariationalInequality& problem) { return active_set(problem); };
    return locking_beside_cr(result, assemble_on, solver, report.diagnosis);
  }
  // A load on the layer is integrated on two meshes, and the proof leaves out the errors of these
  // two quadratures.
  const auto* const layer = std::get_if<StiffLayer>(&scene.layer());
  const double proved = layer != nullptr && layer->load ? 0 : loss.proved_share();
  return with_shares(std::move(report), scene, space.element(),
                     {loss.estimated_share(), proved, comparison_significance}, loss.reference);
}

}  // namespace

std::optional<LockingReport> report_locking(const Scene& scene, const Result& result) {
  const Element& element = result.space.element();
  const TriangleMesh& mesh = result.space.mesh();
  if (!scene.epsilon()) return std::nullopt;
  if (!(scene.layer_depth() > 0)) return LockingReport{"no layer mesh: nothing here can lock"};
  if (&element == &hybrid_bdm1())
    return LockingReport{
        element.name() +
        " does not lock: a motion without strain per layer triangle, on any mesh (Theorem 4)"};
  if (!mesh.reference().simplex)
    return LockingReport{"nothing is known of locking on quadrilaterals"};
  const bool in_space = mesh.dimension() == 3;
  if (!element.conforming() && in_space)
    return LockingReport{
        element.name() +
        " does not lock: about one motion without strain per layer tetrahedron, on any "
        "mesh (Theorem 7; its proof holds in space)"};
  if (!element.conforming())
    return LockingReport{
        element.name() +
        " does not lock: half a motion without strain per layer triangle, on any mesh (Theorem 7)"};
  const LayerComponents components = layer_components(mesh);
  if (components.is_aligned)
    return LockingReport{element.name() +
                         " does not lock here: the columns of the layer are free of each other"};
  LockingReport report;
  report.diagnosis = fmt::format(
      "below {} {} of Sigma the layer's {} are tied into {} group{} by {} that are not vertical; "
      "without strain {} is one polynomial of degree {} in {} on each",
      std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), EdgeTag::sigma),
      in_space ? "faces" : "edges", mesh.reference().plural, components.count,
      components.count == 1 ? "" : "s", in_space ? "faces" : "edges", element.name(),
      element.degree(), in_space ? "x and y" : "x");
  if (in_space) return loss_in_space(scene, result, std::move(report));
  LockingLoss energy;
  try {
    energy = locking_loss(scene, result);
  } catch (const Error& error) {  // the solution is valid even where no report on it can be made
    report.diagnosis += std::string("; nothing is known of what it costs (") + error.what() + ")";
    return report;
  }
  return with_shares(
      std::move(report), scene, element,
      {energy.share(energy.estimate), energy.share(energy.lower_bound), significance},
      energy.reference);
}

}  // namespace antilock
