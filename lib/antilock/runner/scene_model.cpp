#include "antilock/runner/scene_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "antilock/analysis/layer_components.hpp"
#include "antilock/analysis/locking.hpp"
#include "antilock/analysis/locking_beside_cr.hpp"
#include "antilock/analysis/locking_report.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/runner/scene_file.hpp"
#include "antilock/runner/scene_mesh.hpp"

namespace antilock {
namespace {

/// The bounds of the contact unknowns with friction. Behind the bounds of u_y stand those of u_x,
/// in the same order, except where u_x is prescribed.
std::vector<FrictionPair> friction_pairs(const VariationalInequality& problem, const Space& space) {
  const std::vector<int>& contact = space.contact_dofs();
  const std::vector<int>& bounded = problem.bounds.unknowns;
  std::vector<FrictionPair> pairs;
  for (std::size_t i = contact.size(); i < bounded.size(); ++i) {
    const auto place = std::find(contact.begin(), contact.end(), bounded[i]) - contact.begin();
    pairs.push_back({static_cast<int>(place), static_cast<int>(i)});
  }
  return pairs;
}

/// T values of the layer stress: the mean over the rows of B that stand for a triangle, 0 on the
/// body.
Eigen::VectorXd layer_stress(const TriangleMesh& mesh, const Eigen::VectorXd& p) {
  const auto triangles = std::count(mesh.region.begin(), mesh.region.end(), Region::layer);
  if (p.size() == 0 || triangles == 0) return {};
  const Eigen::Index rows = p.size() / triangles;
  Eigen::VectorXd stress = Eigen::VectorXd::Zero(mesh.triangle_count());
  for (Eigen::Index t = 0, row = 0; t < stress.size(); ++t)
    if (mesh.region[t] == Region::layer) stress(t) = p.segment(rows * row++, rows).mean();
  return stress;
}

/// The report of TwoBodyModel::solve; empty without a layer. `assemble_on` assembles the problem.
std::optional<LockingReport> two_body_locking(
    const Scene& scene, const Result& result,
    const std::function<VariationalInequality(const Space&)>& assemble_on, const Solver& solver) {
  const Space& space = result.space;
  const bool can_lock = scene.layer_depth() > 0 && space.element().conforming() &&
                        !layer_components(space.mesh()).is_aligned;
  if (!can_lock) return report_locking(scene, result);
  return locking_beside_cr(result, assemble_on, solver,
                           space.element().name() + " in a layer without columns");
}

}  // namespace

Eigen::VectorXd AntiPlaneModel::dirichlet_values(const Scene& scene,
                                                 const TriangleMesh& mesh) const {
  return dirichlet_vertex_values(scene, mesh);
}

VariationalInequality AntiPlaneModel::problem(const Scene& scene, const Space& space) const {
  return assemble(scene, space);
}

std::optional<double> AntiPlaneModel::penalty(const Space&) const { return {}; }

Result AntiPlaneModel::solve(const SceneFile& file, const Space& space,
                             const Solver& solver) const {
  return antilock::solve(file.scene, space, solver);
}

std::optional<Eigen::VectorXd> AntiPlaneModel::friction_forces(const Result&) const { return {}; }

void AntiPlaneModel::write_picture(const std::filesystem::path& path, const Result& result,
                                   const Eigen::VectorXd& pressure) const {
  const Eigen::VectorXd p = layer_stress(
      result.space.mesh(), result.solution.p.head(result.problem.parametric_row_count()));
  write_vtu(path, result.space, result.solution.u, {p, pressure});
}

VariationalInequality TwoBodyModel::problem(const Scene& scene, const Space& space) const {
  return assemble(scene, between, space);
}

Result TwoBodyModel::solve(const SceneFile& file, const Space& space, const Solver& solver) const {
  Result result{.space = space, .problem = problem(file.scene, space)};
  result.solution = solver(result.problem);
  const auto assemble_on = [&](const Space& on) { return problem(file.scene, on); };
  add_locking_report(result, two_body_locking(file.scene, result, assemble_on, solver));
  return result;
}

template <class Block>
Eigen::VectorXd PressedModel<Block>::dirichlet_values(const Scene&,
                                                      const TriangleMesh& mesh) const {
  return Eigen::VectorXd::Constant(mesh.vertex_count(), -block.prescribed_displacement);
}

template <class Block>
VariationalInequality PressedModel<Block>::problem(const Scene& scene, const Space& space) const {
  VariationalInequality of_both = assemble(block, VectorSpace{space, space});
  of_both.load.tail(space.size()) = load_of(scene, space);  // f and tractions act in y
  if (!scene.contact()) of_both.bounds = {};  // the contact edges of the mesh are free
  return of_both;
}

template <class Block>
std::optional<Eigen::VectorXd> PressedModel<Block>::friction_forces(const Result& result) const {
  if (!block.friction) return {};
  const Eigen::VectorXd length = contact_lengths(result.space);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(length.size());
  for (const auto& [normal, tangential] : friction_pairs(result.problem, result.space))
    forces(normal) = result.solution.lambda(tangential) / length(normal);
  return forces;
}

template <class Block>
Result PressedModel<Block>::solve(const SceneFile& file, const Space& space,
                                  const Solver& solver) const {
  Result result{.space = space, .problem = problem(file.scene, space)};
  if (coulomb > 0) {
    const std::vector<FrictionPair> pairs = friction_pairs(result.problem, space);
    try {
      CoulombSolution found = coulomb_friction(result.problem, pairs, {coulomb}, solver);
      result.solution = std::move(found.solution);
      result.coulomb = found.report;
    } catch (const NotConverged& failure) {
      const std::optional<LockingReport> locking = locking_report(file, space);
      if (!locking || locking->warning.empty()) throw;
      throw NotConverged(failure.what() + ("; " + locking->warning), failure.reached,
                         failure.steps);
    }
  } else {
    result.solution = solver(result.problem);
  }
  add_locking_report(result, locking_report(file, space));
  return result;
}

template <class Block>
void PressedModel<Block>::write_picture(const std::filesystem::path& path, const Result& result,
                                        const Eigen::VectorXd&) const {
  write_deformed_vtu(path, {result.space, result.space}, result.solution.u, pressure(result));
}

template struct PressedModel<PlaneStrain>;
template struct PressedModel<Coating>;

template <>
std::optional<double> PressedModel<PlaneStrain>::penalty(const Space&) const {
  return {};
}

template <>
std::optional<LockingReport> PressedModel<PlaneStrain>::locking_report(const SceneFile& file,
                                                                       const Space& space) const {
  const Element& element = space.element();
  const double h = mesh_width(file, space.mesh()) / body_size(space.mesh());
  // P1 in rubber, pressed on a round punch: its force is 4 to 10 % too large at h^2 = epsilon / 10
  // (both meshes, 1/h = 8 and 32), 23 to 40 % at h^2 = epsilon, and it doubles at ten times that
  if (!element.conforming() || element.degree() != 1 || h * h <= 0.1 * block.epsilon) return {};
  return LockingReport{
      fmt::format("P1 can hardly move without a change of volume: h^2 = {:.2g}, beside epsilon = "
                  "{:g} it locks",
                  h * h, block.epsilon),
      {},
      fmt::format("P1 locks in this rubber: {}; remedy: element = \"CR\" or \"P2\"",
                  file.scene.contact() ? "the contact force is too large" : "it is too stiff")};
}

template <>
Eigen::VectorXd PressedModel<PlaneStrain>::pressure(const Result& result) const {
  const Eigen::VectorXd& p = result.solution.p;
  const Eigen::Index triangles = result.space.mesh().triangle_count();
  return -p.reshaped(p.size() / triangles, triangles).colwise().mean().transpose();
}

template <>
std::optional<double> PressedModel<Coating>::penalty(const Space& space) const {
  return antilock::penalty(block, {space, space});
}

template <>
std::optional<LockingReport> PressedModel<Coating>::locking_report(const SceneFile&,
                                                                   const Space& space) const {
  const Element& element = space.element();
  if (!element.conforming())
    return LockingReport{
        element.name() + " does not lock: its slopes across the coating are free", {}, ""};
  const double k = bending_length(space.mesh()), t = block.thickness;
  LockingReport report{
      fmt::format("{} resists bending in the coating as over the length {:.2g}", element.name(), k),
      {},
      ""};
  // degree 1: lost / kept = (5.84 k / t)^2 for one wave per unit length, which is a twentieth at
  // k = 0.04 t; above degree 1 the mesh is in the way where it resists more than the coating's own
  // thickness does
  if (k > (element.degree() == 1 ? 0.04 : 1) * t) {
    report.diagnosis += fmt::format(", beside a thickness of {:g} it locks", t);
    report.warning =
        element.name() +
        " locks in this coating: the contact force is too large; remedy: element = \"CR\", or "
        "triangles in columns (kind = \"structured\" or \"layered\")";
  } else {
    report.diagnosis += fmt::format(", which beside a thickness of {:g} does not matter", t);
  }
  return report;
}

template <>
Eigen::VectorXd PressedModel<Coating>::pressure(const Result& result) const {
  return antilock::pressure(block, {result.space, result.space}, result.solution.u,
                            result.solution.p);
}

}  // namespace antilock
