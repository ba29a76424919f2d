#include "antilock/analysis/locking_beside_columns.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "antilock/analysis/locking_beside_cr.hpp"
#include "antilock/core/error.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/submesh.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

/// The tags of the sides of the layer: of its facets on the boundary that are not of Gamma_C.
std::set<EdgeTag> side_tags(const Mesh& mesh) {
  std::set<EdgeTag> tags;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0 && mesh.edge_tag[e] != EdgeTag::contact &&
        mesh.region[mesh.edge_triangles(e, 0)] == Region::layer)
      tags.insert(mesh.edge_tag[e]);
  return tags;
}

/// Throws Error unless a function on the columns has the conditions of u_h at the sides of the
/// layer: u = 0 on all of them, or none.
void require_same_sides(const Mesh& mesh, const Mesh& columns) {
  const std::set<EdgeTag> sides = side_tags(mesh);
  const bool simple = sides == std::set{EdgeTag::clamped} || sides == std::set{EdgeTag::free};
  if (!simple || side_tags(columns) != sides)
    throw Error("lost energy: accepted: a layer whose sides are all clamped or all free");
}

/// (22) is (23) with s = 1 after the layer is stretched to the depth 1.
Scene stretched(const Scene& scene) {
  const auto* thin = std::get_if<ThinLayer>(&scene.layer());
  if (thin == nullptr) return scene;
  return Scene(scene.body(), StiffLayer{thin->epsilon}, scene.contact(), scene.edges());
}

/// Raises the lower bounds at the vertices of Gamma_C until each P1 function that satisfies them is
/// above the obstacle at the points of a lattice on each face, and lowers the upper bounds
/// likewise. A vertex with a prescribed value cannot be raised, so that the others of its faces are
/// raised by more.
class TightenedBounds {
 public:
  TightenedBounds(const Space& space, const VariationalInequality& problem)
      : space_(space), values_(Eigen::VectorXd::Zero(space.size())), place_(space.size(), -1) {
    const std::vector<int>& bounded = problem.bounds.unknowns;
    for (std::size_t k = 0; k < bounded.size(); ++k) place_[bounded[k]] = static_cast<int>(k);
    for (std::size_t k = 0; k < problem.dirichlet_dofs.size(); ++k)
      values_(problem.dirichlet_dofs[k]) = problem.dirichlet_values(static_cast<Eigen::Index>(k));
  }

  /// The amount by which each limit has to move so that the sign of (function - obstacle) is
  /// `sign`: 1 for a lower obstacle, -1 for an upper one.
  Eigen::VectorXd shifts(const Eigen::VectorXd& limits, const Profile& obstacle, double sign) {
    const Mesh& mesh = space_.mesh();
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (place_[v] >= 0) values_(v) = limits(place_[v]);
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(limits.size());
    const double round_off = 1e-12 * limits.lpNorm<Eigen::Infinity>();
    for (int e = 0; e < mesh.edge_count(); ++e) {
      if (mesh.edge_tag[e] != EdgeTag::contact) continue;
      for (int i = 0; i <= parts; ++i)
        for (int j = 0; i + j <= parts; ++j)
          move(Eigen::RowVector3d(parts - i - j, i, j) / parts, e, obstacle, sign, round_off,
               shift);
    }
    return shift;
  }

 private:
  static constexpr int parts = 8;

  /// Moves the limits at the vertices of a face so far that the function with these limits is on
  /// the right side of the obstacle at the point with the barycentric coordinates `lambda`.
  void move(const Eigen::RowVector3d& lambda, int face, const Profile& obstacle, double sign,
            double round_off, Eigen::VectorXd& shift) const {
    const Mesh& mesh = space_.mesh();
    const auto vertex = mesh.edges.row(face);
    const Position x = lambda * mesh.vertices(vertex, Eigen::indexing::all);
    double missing = obstacle(x(0), x(1)), movable = 0;
    for (int k = 0; k < 3; ++k) {
      missing -= lambda(k) * values_(vertex(k));
      if (place_[vertex(k)] >= 0) movable += lambda(k);
    }
    missing *= sign;
    if (missing <= round_off) return;
    if (movable == 0)
      throw Error("lost energy: a prescribed value is beyond the obstacle at " +
                  mesh.location_text(vertex(0)));
    for (int k = 0; k < 3; ++k)
      if (const int limit = place_[vertex(k)]; limit >= 0)
        shift(limit) = sign * std::max(sign * shift(limit), missing / movable);
  }

  const Space& space_;
  Eigen::VectorXd values_;  ///< per vertex: its limit, or the value that is prescribed
  std::vector<int> place_;  ///< per vertex: the number of its bound, or -1
};

/// Tightens the bounds of a problem. Returns whether one of them has moved.
bool tighten_bounds(VariationalInequality& problem, const UnilateralContact& contact,
                    const Space& space) {
  TightenedBounds tightened(space, problem);
  const Profile& gap = contact.gap;
  const Profile lower = [&](double x, double y) { return -gap(x, y); };
  Eigen::VectorXd shift = tightened.shifts(problem.bounds.lower, lower, 1);
  problem.bounds.lower += shift;
  bool moved = !shift.isZero(0);
  if (contact.upper_obstacle) {
    shift = tightened.shifts(problem.bounds.upper, contact.upper_obstacle, -1);
    problem.bounds.upper += shift;
    moved = moved || !shift.isZero(0);
  }
  return moved;
}

/// The height of a layer at rest: 0 where a value is prescribed in it, otherwise the mean of u_h,
/// moved into the bounds. A layer whose sides are free follows a body that is moved as a whole.
double height_at_rest(const Result& result) {
  const Mesh& mesh = result.space.mesh();
  std::set<int> unknowns;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer)
      for (const int unknown : result.space.cell_dofs().row(t)) unknowns.insert(unknown);
  for (const int prescribed : result.problem.dirichlet_dofs)
    if (unknowns.contains(prescribed)) return 0;
  double sum = 0;
  for (const int unknown : unknowns) sum += result.solution.u(unknown);
  const double mean = sum / static_cast<double>(unknowns.size());
  const Bounds& bounds = result.problem.bounds;
  if (bounds.unknowns.empty()) return mean;
  return std::min(std::max(mean, bounds.lower.maxCoeff()), bounds.upper.minCoeff());
}

double least_energy(const VariationalInequality& problem) {
  return energy(problem, active_set(problem));
}

double share_of(double lost, double reference) {
  return reference > 0 ? std::clamp(lost / reference, 0.0, 1.0) : 0;
}

}  // namespace

double LossBesideColumns::estimated_share() const { return share_of(estimate, reference); }
double LossBesideColumns::proved_share() const { return share_of(lower_bound, bound_reference); }

LossBesideColumns loss_beside_columns(const Scene& scene, const Result& result) {
  const Space& space = result.space;
  const bool has_layer = scene.epsilon() && scene.layer_depth() > 0;
  if (space.mesh().kind != CellKind::tetrahedron || !has_layer || !space.element().conforming())
    throw Error("lost energy: accepted: a conforming element on tetrahedra with a layer");
  if (scene.contact() && space.element().degree() > 1)
    throw Error("lost energy: accepted: P1 where there is a contact");
  Mesh columns = extruded(body_submesh(space.mesh()), *scene.epsilon());
  require_same_sides(space.mesh(), columns);
  const Space on_columns(std::move(columns), space.element());
  VariationalInequality problem = assemble(stretched(scene), on_columns);

  const double of_u = energy(result.problem, result.solution);
  const double height = height_at_rest(result);
  double at_rest = least_energy(with_layer_at_rest(result.problem, space, height));
  const double of_columns = least_energy(problem);
  // Each energy is that of a solution with the tolerance 1e-10. A motion as a whole costs no energy
  // but round-off. The layer at the height 0 does not follow it, and has an energy of its size.
  double scale = std::max(std::abs(at_rest), std::abs(of_columns));
  if (height != 0) {
    VariationalInequality without_bounds = result.problem;
    without_bounds.bounds = {};
    const double at_zero = least_energy(with_layer_at_rest(without_bounds, space));
    scale = std::max(scale, std::abs(at_zero));
    const Bounds& bounds = result.problem.bounds;
    if (bounds.unknowns.empty() || (bounds.lower.maxCoeff() <= 0 && bounds.upper.minCoeff() >= 0))
      at_rest = std::min(at_rest, at_zero);
  }
  const double round_off = 1e-10 * scale;
  const auto released_by = [&](double least) {
    return at_rest - least > round_off ? at_rest - least : 0;
  };
  LossBesideColumns loss{of_u - of_columns, of_u - of_columns, released_by(of_columns),
                         released_by(of_columns)};
  if (scene.contact() && tighten_bounds(problem, *scene.contact(), on_columns)) {
    const double in_k = least_energy(problem);
    loss.lower_bound = of_u - in_k;
    loss.bound_reference = released_by(in_k);
  }
  return loss;
}

}  // namespace antilock
