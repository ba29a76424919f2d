#include "antilock/certificate/companion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "antilock/core/error.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/submesh.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

/// The vertices whose value is known: ends of fixed and of clamped edges.
std::vector<char> held_vertices(const Result& result) {
  const TriangleMesh& mesh = result.space.mesh();
  std::vector<char> held(mesh.vertex_count(), 0);
  for (const std::vector<int>* list : {&result.problem.dirichlet_dofs, &result.space.dirichlet_dofs()})
    for (const int e : *list) held[mesh.edges(e, 0)] = held[mesh.edges(e, 1)] = 1;
  return held;
}

/// The mean of u_CR over the body's triangles at each vertex; the known values where they are known.
Eigen::VectorXd averages(const Scene& scene, const Result& result, const std::vector<char>& held) {
  const TriangleMesh& mesh = result.space.mesh();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(mesh.vertex_count()), count = sum;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::body) continue;
    const Eigen::Vector3d u = result.solution.u(result.space.cell_dofs().row(t));
    const double stiffness = stiffness_on(scene.body().stiffness, mesh, t);
    for (int i = 0; i < 3; ++i) {
      sum(mesh.triangles(t, i)) += stiffness * (u.sum() - 2 * u(i));  // phi_i = 1 - 2 lambda_i
      count(mesh.triangles(t, i)) += stiffness;
    }
  }
  const Eigen::VectorXd known = dirichlet_vertex_values(scene, mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (held[v])
      sum(v) = known(v);
    else if (count(v) > 0)
      sum(v) /= count(v);
  }
  return sum;
}

/// The corners of all triangles from the layer's first one on, three rows per triangle.
Points layer_corners(const TriangleMesh& mesh) {
  const auto before = std::find(mesh.region.begin(), mesh.region.end(), Region::layer) - mesh.region.begin();
  return mesh.vertices(mesh.triangles.bottomRows(mesh.triangle_count() - before).reshaped<Eigen::RowMajor>(),
                       Eigen::all);
}

}  // namespace

Eigen::Vector2d ConformingCompanion::flux(const TriangleMesh& mesh, int t, int row, const FluxLaw& law) const {
  Eigen::Vector2d flux = barycentric_gradients(mesh, t).transpose() * at_vertices(mesh.triangles.row(t));
  if (law.split) flux(1) = stress(row);
  return law.stiffness * flux;
}

Eigen::VectorXd admissible_bounds(const UnilateralContact& contact, const Space& space, const Eigen::VectorXd& near) {
  constexpr int samples = 32;
  const Eigen::ArrayXd s = Eigen::ArrayXd::LinSpaced(samples + 1, 0, 1), rest = 1 - s;
  const TriangleMesh& mesh = space.mesh();
  std::vector<int> bound_of(mesh.vertex_count(), -1);  // -1: v is prescribed there
  for (std::size_t i = 0; i < space.contact_dofs().size(); ++i) bound_of[space.contact_dofs()[i]] = static_cast<int>(i);
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(space.contact_dofs().size()),
                                                    -std::numeric_limits<double>::infinity());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    Eigen::Array2d x, at;  // of its two ends: v there, or a value near it
    std::array<int, 2> place;
    for (int end = 0; end < 2; ++end) {
      const int v = mesh.edges(e, end);
      x[end] = mesh.vertices(v, 0), at[end] = near(v), place[end] = bound_of[v];
    }
    Eigen::ArrayXd obstacle = rest * x[0] + s * x[1];
    for (double& here : obstacle) {
      const double gap = contact.gap(here);
      if (!std::isfinite(gap)) throw Error(fmt::format("contact: gap({:.6g}) is not finite", here));
      here = -gap;
    }
    const double first = obstacle[0], last = obstacle[samples];
    const double raise = std::max(0.0, (obstacle - rest * first - s * last).maxCoeff());
    const Eigen::Array2d smooth(first + raise, last + raise), level = Eigen::Array2d::Constant(obstacle.maxCoeff());
    // where the other end cannot help
    const Eigen::Array2d beside(((obstacle - s * at[1]) / rest).head(samples).maxCoeff(),
                                ((obstacle - rest * at[0]) / s).tail(samples).maxCoeff());
    const auto lifts = [&](const Eigen::Array2d& bound) {  // how far v is lifted, and the bounds themselves
      return std::pair((bound - at).max(0).square().sum(), bound.sum());
    };
    const bool alone = place[0] < 0 || place[1] < 0;
    const Eigen::Array2d bound = alone ? beside : lifts(level) < lifts(smooth) ? level : smooth;
    for (int end = 0; end < 2; ++end)
      if (place[end] >= 0) lower(place[end]) = std::max(lower(place[end]), bound[end]);
  }
  return lower;
}

VariationalInequality assemble_in_k(const Scene& scene, const Space& space) {
  VariationalInequality problem = assemble(scene, space);
  if (scene.contact())
    problem.lower = admissible_bounds(*scene.contact(), space, dirichlet_vertex_values(scene, space.mesh()));
  return problem;
}

ConformingCompanion local_companion(const Scene& scene, const Result& result, bool on_mesh) {
  const TriangleMesh& mesh = result.space.mesh();
  const auto* stiff = on_mesh ? nullptr : std::get_if<StiffLayer>(&scene.layer());
  const std::vector<char> held = held_vertices(result);
  ConformingCompanion companion;
  companion.at_vertices = averages(scene, result, held);

  const EdgeTag line_tag = scene.layer_depth() > 0 ? EdgeTag::sigma : EdgeTag::contact;
  std::vector<char> on_line(mesh.vertex_count(), 0);
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == line_tag) on_line[mesh.edges(e, 0)] = on_line[mesh.edges(e, 1)] = 1;
  // the body's triangles with a vertex on the line, and the layer's where it stays
  const Submesh piece = submesh(mesh, [&](int t) {
    const auto v = mesh.triangles.row(t);
    return mesh.region[t] == Region::layer ? stiff == nullptr : on_line[v(0)] || on_line[v(1)] || on_line[v(2)];
  });
  const TriangleMesh& cut = piece.mesh;
  const Space p1_space(stiff != nullptr ? extruded(cut, stiff->epsilon) : cut, p1());
  const TriangleMesh& columns = p1_space.mesh();

  // the body's vertices off the line and the known values are fixed; the rest is solved for
  VariationalInequality strip = assemble_fixed_rows(assemble(scene, p1_space));  // any v of K will do
  std::vector<char> fixed(columns.vertex_count(), 0);
  Eigen::VectorXd value = dirichlet_vertex_values(scene, columns);
  for (const int v : p1_space.dirichlet_dofs()) fixed[v] = 1;
  for (int t = 0; t < columns.triangle_count(); ++t) {
    if (columns.region[t] != Region::body) continue;
    for (int i = 0; i < 3; ++i) {
      const int v = columns.triangles(t, i), old = piece.old_vertex[v];
      fixed[v] = !on_line[old] || held[old];
      if (fixed[v]) value(v) = companion.at_vertices(old);
    }
  }
  std::map<double, double> above;  // near v on Gamma_C is u_CR on Sigma, at the same x
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (on_line[v]) above[mesh.vertices(v, 0)] = companion.at_vertices(v);
  Eigen::VectorXd near = Eigen::VectorXd::Zero(columns.vertex_count());
  for (int v = 0; v < columns.vertex_count(); ++v)
    if (const auto found = above.find(columns.vertices(v, 0)); found != above.end()) near(v) = found->second;
  if (scene.contact()) strip.lower = admissible_bounds(*scene.contact(), p1_space, near);
  strip.dirichlet_dofs.clear();
  for (int v = 0; v < columns.vertex_count(); ++v)
    if (fixed[v]) strip.dirichlet_dofs.push_back(v);
  strip.dirichlet_values = value(strip.dirichlet_dofs);
  std::vector<Eigen::Index> bounded;
  for (Eigen::Index i = 0; i < strip.lower.size(); ++i)
    if (!fixed[strip.contact[i]]) bounded.push_back(i);
  strip.lower = strip.lower(bounded).eval();
  std::erase_if(strip.contact, [&](int v) { return fixed[v] != 0; });
  Solution answer;
  if (strip.free_count() > 0) {
    answer = active_set(strip);
  } else {
    answer.u = value;
    answer.p = Eigen::VectorXd::Zero(strip.b.rows());
  }
  companion.unknowns = strip.free_count();

  for (int v = 0; v < cut.vertex_count(); ++v) companion.at_vertices(piece.old_vertex[v]) = answer.u(v);
  if (stiff == nullptr) {
    companion.stress = std::move(answer.p);
    return companion;
  }
  const Points ours = layer_corners(mesh), theirs = layer_corners(columns);
  if (ours.rows() == theirs.rows() && ours == theirs) {  // the mesh has these columns already
    const auto in_layer = ours.rows() / 3;
    companion.at_vertices(mesh.triangles.bottomRows(in_layer).reshaped<Eigen::RowMajor>()) =
        answer.u(columns.triangles.bottomRows(in_layer).reshaped<Eigen::RowMajor>());
    companion.stress = std::move(answer.p);
    return companion;
  }
  companion.layer.emplace(columns, std::move(answer.u), std::move(answer.p));
  return companion;
}

ConformingCompanion p1_companion(const Solution& p1_solution) {
  return {.at_vertices = p1_solution.u, .stress = p1_solution.p, .layer = std::nullopt};
}

}  // namespace antilock
