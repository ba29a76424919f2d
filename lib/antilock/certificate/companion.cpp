#include "antilock/certificate/companion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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
  for (const std::vector<int>* list :
       {&result.problem.dirichlet_dofs, &result.space.dirichlet_dofs()})
    for (const int e : *list)
      for (const int v : mesh.edges.row(e)) held[v] = 1;
  return held;
}

/// The mean of u_CR over the body's triangles at each vertex; the known values where they are
/// known.
Eigen::VectorXd averages(const Scene& scene, const Result& result, const std::vector<char>& held) {
  const TriangleMesh& mesh = result.space.mesh();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(mesh.vertex_count());
  Eigen::VectorXd count = sum;
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

/// The number of triangles from the layer's first one on.
Eigen::Index layer_triangle_count(const TriangleMesh& mesh) {
  return mesh.region.end() - std::find(mesh.region.begin(), mesh.region.end(), Region::layer);
}

/// Their corners, three rows per triangle.
Points layer_corners(const TriangleMesh& mesh) {
  const auto corners =
      mesh.triangles.bottomRows(layer_triangle_count(mesh)).reshaped<Eigen::RowMajor>();
  return mesh.vertices(corners, Eigen::indexing::all);
}

constexpr int intervals = 32;  // of an edge: the gap is sampled at their ends

/// The obstacle -gap along an edge, from x0 to x1.
Eigen::ArrayXd sampled_obstacle(const Profile& gap, double x0, double x1) {
  const Eigen::ArrayXd s = Eigen::ArrayXd::LinSpaced(intervals + 1, 0, 1);
  Eigen::ArrayXd obstacle = (1 - s) * x0 + s * x1;
  for (double& here : obstacle) {
    const double g = gap(here);
    if (!std::isfinite(g)) throw Error(fmt::format("contact: gap({:.6g}) is not finite", here));
    here = -g;
  }
  return obstacle;
}

/// The bounds at both ends of an edge of which v is prescribed at one: each keeps v above the
/// obstacle alone, where `at` is v at the other end.
Eigen::Array2d bounds_of_one_end(const Eigen::ArrayXd& obstacle, const Eigen::Array2d& at) {
  const Eigen::ArrayXd s = Eigen::ArrayXd::LinSpaced(intervals + 1, 0, 1);
  const Eigen::ArrayXd rest = 1 - s;
  return {((obstacle - s * at[1]) / rest).head(intervals).maxCoeff(),
          ((obstacle - rest * at[0]) / s).tail(intervals).maxCoeff()};
}

/// The bounds at both ends of an edge that lift v least, of the two choices of admissible_bounds.
/// `at` is near v at the ends.
Eigen::Array2d bounds_of_both_ends(const Eigen::ArrayXd& obstacle, const Eigen::Array2d& at) {
  const Eigen::ArrayXd s = Eigen::ArrayXd::LinSpaced(intervals + 1, 0, 1);
  const Eigen::ArrayXd rest = 1 - s;
  const double first = obstacle[0];
  const double last = obstacle[intervals];
  const double raise = std::max(0.0, (obstacle - rest * first - s * last).maxCoeff());
  const Eigen::Array2d smooth(first + raise, last + raise);
  const Eigen::Array2d level = Eigen::Array2d::Constant(obstacle.maxCoeff());
  const auto lifts =
      [&](const Eigen::Array2d& bound) {  // how far v is lifted, and the bounds themselves
        return std::pair((bound - at).max(0).square().sum(), bound.sum());
      };
  return lifts(level) < lifts(smooth) ? level : smooth;
}

/// Per vertex: the number of its contact unknown; -1 where there is none, or v is prescribed.
std::vector<int> contact_numbers(const Space& space) {
  std::vector<int> number(space.mesh().vertex_count(), -1);
  for (std::size_t i = 0; i < space.contact_dofs().size(); ++i)
    number[space.contact_dofs()[i]] = static_cast<int>(i);
  return number;
}

/// Per vertex: whether it is on Sigma, or on Gamma_C where the mesh has no layer.
std::vector<char> vertices_on_line(const Scene& scene, const TriangleMesh& mesh) {
  const EdgeTag tag = scene.layer_depth() > 0 ? EdgeTag::sigma : EdgeTag::contact;
  std::vector<char> on_line(mesh.vertex_count(), 0);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != tag) continue;
    for (const int v : mesh.edges.row(e)) on_line[v] = 1;
  }
  return on_line;
}

/// The part of the mesh that the local problem needs: the body's triangles with a vertex on the
/// line, and those of the layer where they stay.
Submesh cut_along(const TriangleMesh& mesh, const std::vector<char>& on_line, bool with_layer) {
  return submesh(mesh, [&](int t) {
    if (mesh.region[t] == Region::layer) return with_layer;
    const auto v = mesh.triangles.row(t);
    return on_line[v(0)] || on_line[v(1)] || on_line[v(2)];
  });
}

/// The local problem, a strip of the body along the line and the layer below it.
struct Strip {
  Submesh cut;                 ///< of the mesh: the strip, without columns
  Space space;                 ///< P1 on the strip, with its columns
  std::vector<char> fixed;     ///< per vertex of the space: whether v is known
  Eigen::VectorXd value = {};  ///< per vertex: v, where it is known
};

/// Fixes the body's vertices off the line and the known values; the rest is solved for.
/// `at_vertices`: v on the mesh.
void fix_known(Strip& strip, const Scene& scene, const std::vector<char>& on_line,
               const std::vector<char>& held, const Eigen::VectorXd& at_vertices) {
  const TriangleMesh& mesh = strip.space.mesh();
  strip.fixed.assign(mesh.vertex_count(), 0);
  strip.value = dirichlet_vertex_values(scene, mesh);
  for (const int v : strip.space.dirichlet_dofs()) strip.fixed[v] = 1;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::body) continue;
    for (const int v : mesh.triangles.row(t)) {
      const int old = strip.cut.old_vertex[v];
      strip.fixed[v] = !on_line[old] || held[old];
      if (strip.fixed[v]) strip.value(v) = at_vertices(old);
    }
  }
}

/// Values near v at the vertices of the strip: those of `at_vertices` on the line at the same x.
Eigen::VectorXd values_above(const Strip& strip, const TriangleMesh& mesh,
                             const std::vector<char>& on_line, const Eigen::VectorXd& at_vertices) {
  std::map<double, double> above;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (on_line[v]) above[mesh.vertices(v, 0)] = at_vertices(v);
  const Points& vertices = strip.space.mesh().vertices;
  Eigen::VectorXd near = Eigen::VectorXd::Zero(vertices.rows());
  for (Eigen::Index v = 0; v < near.size(); ++v) {
    const auto found = above.find(vertices(v, 0));
    if (found != above.end()) near(v) = found->second;
  }
  return near;
}

/// Fixes the known values in the problem of a scene on the strip, and gives it bounds that keep v
/// in K. `near` as in admissible_bounds.
void add_conditions(VariationalInequality& problem, const Strip& strip, const Scene& scene,
                    const Eigen::VectorXd& near) {
  if (scene.contact())
    problem.bounds.lower = admissible_bounds(*scene.contact(), strip.space, near);
  problem.dirichlet_dofs.clear();
  for (int v = 0; v < strip.space.size(); ++v)
    if (strip.fixed[v]) problem.dirichlet_dofs.push_back(v);
  problem.dirichlet_values = strip.value(problem.dirichlet_dofs);
  const Bounds& bounds = problem.bounds;
  std::vector<int> unknowns;
  std::vector<int> places;
  for (int i = 0; i < bounds.count(); ++i) {
    if (strip.fixed[bounds.unknowns[i]]) continue;
    unknowns.push_back(bounds.unknowns[i]);
    places.push_back(i);
  }
  problem.bounds = {unknowns, {bounds.lower(places), bounds.upper(places)}};
}

Solution solve_strip(const VariationalInequality& problem, const Eigen::VectorXd& value) {
  if (problem.free_count() > 0) return active_set(problem);
  Solution solution;
  solution.u = value;
  solution.p = Eigen::VectorXd::Zero(problem.b.rows());
  return solution;
}

/// Sets v in the layer to the solution on columns, which may be those of the mesh.
void take_columns(ConformingCompanion& companion, const TriangleMesh& mesh,
                  const TriangleMesh& columns, Solution solution) {
  const Points ours = layer_corners(mesh);
  const Points theirs = layer_corners(columns);
  const bool same = ours.rows() == theirs.rows() && ours == theirs;
  if (!same) {
    companion.layer.emplace(columns, std::move(solution.u), std::move(solution.p));
    return;
  }
  const auto in_layer = ours.rows() / 3;
  companion.at_vertices(mesh.triangles.bottomRows(in_layer).reshaped<Eigen::RowMajor>()) =
      solution.u(columns.triangles.bottomRows(in_layer).reshaped<Eigen::RowMajor>());
  companion.stress = std::move(solution.p);
}

}  // namespace

Eigen::Vector2d ConformingCompanion::flux(const TriangleMesh& mesh, int t, int row,
                                          const FluxLaw& law) const {
  Eigen::Vector2d flux =
      barycentric_gradients(mesh, t).transpose() * at_vertices(mesh.triangles.row(t));
  if (law.split) flux(1) = stress(row);
  return law.stiffness * flux;
}

Eigen::VectorXd admissible_bounds(const UnilateralContact& contact, const Space& space,
                                  const Eigen::VectorXd& near) {
  require_triangles(space.mesh(), "bounds of K");
  const TriangleMesh& mesh = space.mesh();
  const std::vector<int> number = contact_numbers(space);
  Eigen::VectorXd lower =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(space.contact_dofs().size()),
                                -std::numeric_limits<double>::infinity());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const std::array<int, 2> ends{mesh.edges(e, 0), mesh.edges(e, 1)};
    const Eigen::ArrayXd obstacle =
        sampled_obstacle(contact.gap, mesh.vertices(ends[0], 0), mesh.vertices(ends[1], 0));
    const Eigen::Array2d at(near(ends[0]), near(ends[1]));
    const bool alone =
        number[ends[0]] < 0 || number[ends[1]] < 0;  // where the other end cannot help
    const Eigen::Array2d bound =
        alone ? bounds_of_one_end(obstacle, at) : bounds_of_both_ends(obstacle, at);
    for (int end = 0; end < 2; ++end) {
      const int i = number[ends[end]];
      if (i >= 0) lower(i) = std::max(lower(i), bound[end]);
    }
  }
  return lower;
}

VariationalInequality assemble_in_k(const Scene& scene, const Space& space) {
  require_triangles(space.mesh(), "functions in K");
  VariationalInequality problem = assemble(scene, space);
  if (scene.contact())
    problem.bounds.lower =
        admissible_bounds(*scene.contact(), space, dirichlet_vertex_values(scene, space.mesh()));
  return problem;
}

ConformingCompanion local_companion(const Scene& scene, const Result& result, bool on_mesh) {
  require_triangles(result.space.mesh(), "companion");
  const TriangleMesh& mesh = result.space.mesh();
  const auto* stiff = on_mesh ? nullptr : std::get_if<StiffLayer>(&scene.layer());
  const std::vector<char> held = held_vertices(result);
  const std::vector<char> on_line = vertices_on_line(scene, mesh);
  ConformingCompanion companion;
  companion.at_vertices = averages(scene, result, held);

  Submesh cut = cut_along(mesh, on_line, stiff == nullptr);
  const Space space(stiff != nullptr ? extruded(cut.mesh, stiff->epsilon) : cut.mesh, p1());
  VariationalInequality problem =
      assemble_fixed_rows(assemble(scene, space));  // any v of K will do
  Strip strip{std::move(cut), space, {}};
  fix_known(strip, scene, on_line, held, companion.at_vertices);
  const Eigen::VectorXd near = values_above(strip, mesh, on_line, companion.at_vertices);
  add_conditions(problem, strip, scene, near);
  Solution solution = solve_strip(problem, strip.value);
  companion.unknowns = problem.free_count();

  for (int v = 0; v < strip.cut.mesh.vertex_count(); ++v)
    companion.at_vertices(strip.cut.old_vertex[v]) = solution.u(v);
  if (stiff == nullptr)
    companion.stress = std::move(solution.p);
  else
    take_columns(companion, mesh, space.mesh(), std::move(solution));
  return companion;
}

ConformingCompanion p1_companion(const Solution& p1_solution) {
  return {.at_vertices = p1_solution.u, .stress = p1_solution.p, .layer = std::nullopt};
}

}  // namespace antilock
