// The sentence on locking that every door says.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antilock/analysis/detail/ties.hpp"
#include "antilock/analysis/lost_energy.hpp"
#include "antilock/core/error.hpp"
#include "antilock/form/forms.hpp"

namespace antilock {
namespace {

/// The law of bending: one wave over the length of Sigma moves the layer and the body, at the price `soft`, and the
/// interpolant of that wave has slopes in y, which cost x times that. The share that is lost is then x / (1 + x).
double by_bending(const Scene& scene, const Space& space) {
  const bool thin = std::holds_alternative<ThinLayer>(scene.layer());
  const TriangleMesh& mesh = space.mesh();
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  double length = 0, body = 0;  // the body's stiffness over Sigma, times its length
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::sigma) continue;
    const int side = mesh.region[mesh.edge_triangles(e, 0)] == Region::body ? 0 : 1;
    const Eigen::Vector2d x = point_in(mesh, mesh.edge_triangles(e, side), Eigen::Vector3d::Constant(1.0 / 3));
    length += mesh.edge_length(e);
    body += mesh.edge_length(e) * (scene.body().stiffness ? scene.body().stiffness(x(0), x(1)) : 1);
  }
  const double epsilon = *scene.epsilon(), c = 2 * std::numbers::pi / length;
  const Eigen::VectorXd wave = (c * space.points().col(0)).array().sin();
  const double soft = (c * c * length + c * body / (stiff != nullptr ? stiff->s : 1)) / 2,
               slopes = wave.dot(gradient_form(space, {0, 0}, {0, 1}) * wave);
  return slopes / (slopes + soft * (thin ? epsilon : epsilon * epsilon));
}

}  // namespace

std::optional<LayerReport> report_layer(const Scene& scene, const Space& space, const VariationalInequality& problem,
                                        const Solution& solution) {
  const Element& element = space.element();
  const TriangleMesh& mesh = space.mesh();
  if (!scene.epsilon()) return std::nullopt;
  if (!(scene.layer_depth() > 0)) return LayerReport{"no layer mesh: nothing here can lock", {}, ""};
  if (!element.conforming())
    return LayerReport{
        element.name() + " does not lock: half a motion without strain per layer triangle, on any mesh (Theorem 7)",
        {},
        ""};
  if (in_columns(mesh))
    return LayerReport{element.name() + " does not lock here: the columns of the layer are free of each other", {}, ""};
  LayerReport report;
  const int groups = tied_groups(mesh);
  report.diagnosis = fmt::format(
      "below {} edges of Sigma the layer's triangles are tied into {} group{} by edges that are not vertical; without "
      "strain {} is one polynomial of degree {} in x on each",
      std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), EdgeTag::sigma), groups, groups == 1 ? "" : "s",
      element.name(), element.degree());
  const auto& active = solution.active;
  const bool pressed = !active.empty() && std::find(active.begin(), active.end(), false) == active.end();
  try {
    const LostEnergy energy = lost_energy(scene, space, problem, solution);
    report.lost = energy.share(), report.motion = energy.motion;
  } catch (const Error& error) {  // the answer stands, whatever becomes of what is told about it
    report.diagnosis += std::string("; nothing is proved of what it costs (") + error.what() + ")";
    if (pressed) return report;  // nothing would move
  }
  const double share = report.lost ? *report.lost : by_bending(scene, space);
  const double least = report.lost
                           ? LostEnergy::telling
                           : 2 * LostEnergy::telling;  // the law is an upper bound: it names who has lost a tenth
  if (share < least) {
    report.diagnosis +=
        fmt::format("; at epsilon = {:g} this costs less than {:.0f} % of the energy", *scene.epsilon(), 100 * least);
    return report;
  }
  report.diagnosis += fmt::format("; at epsilon = {:g} it locks", *scene.epsilon());
  report.warning = fmt::format(
      "{} locks in this layer: it loses {} {:.0f} % of the energy that the layer's motion releases ({}); "
      "remedy: element = \"CR\", or a layer in columns (kind = \"layered\")",
      element.name(), report.lost ? "at least" : "about", std::min(std::floor(100 * share), 99.0),
      report.lost ? "proved" : "by the law of bending");
  return report;
}

}  // namespace antilock
