#include "antilock/io/detail/scene_problem.hpp"

#include <fmt/format.h>

#include "antilock/analysis/locking.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/models/coating.hpp"

namespace antilock {
namespace {

template <class Model>
Model pressed(const SceneFile& file) {
  Model model;
  model.push = file.elastic->push;
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

std::optional<double> penalty_of(const SceneFile& file, const Space& space) {
  const auto coating = coating_of(file);
  return coating ? penalty(*coating, {space, space}) : std::nullopt;
}

NormalContact normal_contact(const Answer& answer) {
  NormalContact normal{answer.problem, answer.solution};
  const std::size_t count = answer.space.contact().size();
  normal.problem.contact.resize(count);
  normal.solution.active.resize(count);
  normal.problem.force_bound.resize(0);
  if (normal.problem.upper.size() > static_cast<Eigen::Index>(count)) normal.problem.upper.resize(0);
  normal.problem.lower.conservativeResize(static_cast<Eigen::Index>(count));
  normal.solution.lambda.conservativeResize(static_cast<Eigen::Index>(count));
  return normal;
}

std::optional<LayerReport> layer_report_of(const SceneFile& file, const Answer& answer) {
  const auto coating = coating_of(file);
  const Element& element = answer.space.element();
  if (!coating)
    return file.elastic ? std::nullopt : report_layer(file.scene, answer.space, answer.problem, answer.solution);
  if (!element.conforming())
    return LayerReport{element.name() + " does not lock: its slopes across the coating are free", {}, ""};
  const double k = bending_length(*answer.mesh), t = coating->thickness;
  LayerReport report{
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

Eigen::VectorXd pressure_of(const SceneFile& file, const Answer& answer) {
  const Space& space = answer.space;
  const Eigen::VectorXd& p = answer.solution.p;
  if (const auto coating = coating_of(file)) return pressure(*coating, {space, space}, answer.solution.u, p);
  const Eigen::Index triangles = answer.mesh->triangle_count();
  return -p.reshaped(p.size() / triangles, triangles).colwise().mean().transpose();
}

}  // namespace antilock
