#include "antilock/models/plane_strain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "antilock/core/error.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/form/strain_projection.hpp"
#include "antilock/models/detail/stiffness_range.hpp"
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

namespace {

/// The friction bound of every unknown of u_x: int g phi_i, g taken from the midpoint of each
/// contact edge.
Eigen::VectorXd friction_bounds(const Profile& g, const Space& space) {
  Eigen::VectorXd bounds = Eigen::VectorXd::Zero(space.size());
  const TriangleMesh& mesh = space.mesh();
  require_triangles(mesh, "friction");
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      if (mesh.edge_tag[e] != EdgeTag::contact) continue;
      const Eigen::Vector3d midpoint = 0.5 * (Eigen::Vector3d::Ones() - Eigen::Vector3d::Unit(i));
      const double here = g(point_in(mesh, t, midpoint)(0));
      if (!(here >= 0))
        throw Error(fmt::format("plane strain: friction bound {}; accepted 0 or more", here));
      const Eigen::VectorXd share = means_on_facet(space.element(), i);
      for (Eigen::Index k = 0; k < share.size();
           ++k)  // an infinite g is for the unknowns on the edge alone
        if (std::abs(share(k)) > 1e-15)
          bounds(space.cell_dofs()(t, k)) += mesh.edge_length(e) * here * share(k);
    }
  return bounds;
}

/// Behind the bounds of u_y: u_x = 0 on the free contact unknowns, as long as the force is below
/// its bound.
void add_friction(VariationalInequality& problem, const Profile& g, const Space& in_x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd all = friction_bounds(g, in_x), normal = problem.bounds.lower;
  std::vector<int> unknowns = problem.bounds.unknowns;
  std::vector<double> limits;
  for (const int i : in_x.contact_dofs()) {
    if (std::binary_search(problem.dirichlet_dofs.begin(), problem.dirichlet_dofs.end(), i))
      continue;
    unknowns.push_back(i);
    limits.push_back(all(i));
  }
  const auto tangential = static_cast<Eigen::Index>(limits.size());
  const Eigen::VectorXd sticks = Eigen::VectorXd::Zero(tangential);
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(normal.size(), infinity);
  const Eigen::Index count = normal.size() + tangential;
  Eigen::VectorXd lower(count), upper(count), force_limit(count);
  lower << normal, sticks;
  upper << none, sticks;
  force_limit << none, Eigen::Map<const Eigen::VectorXd>(limits.data(), tangential);
  problem.bounds = {unknowns, {lower, upper, force_limit}};
}

/// Appends the equations of an element, one per triangle, as rows of B with the compliance 0.
/// `first` is the number of the first unknown of the component.
///
/// M does not change the solution, but the number of corrections. In fortin_soulie the difference
/// of the two means of an edge enters the equations of its two triangles with opposite signs, as a
/// flux enters a divergence. To violate them by a given g_T takes an energy v' A1 v of up
/// to 6 sum_T g_T^2 |Omega| / |T|, and not more (measured on structured meshes that are clamped on
/// three sides, 1/h = 4 to 8). A correction multiplies the violation by at most
/// 1 / (1 + M / (6 delta |Omega| / |T|)), with the penalty delta, so that M has the factor
/// |Omega| / |T|. With 300 in front of it there are 4 to 8 corrections to 1e-11, for lambda = 1,
/// 1e4 and infinity and 1/h = 8 to 32. With M = 1 there are more than 60 at lambda = 1, where the
/// penalty is 1 (measured). A much larger M would raise the penalty of div u, which follows from
/// the largest entries of B' M B (problem/choose_penalty.hpp).
void append_equations(VariationalInequality& problem, const Space& space, int first) {
  const Eigen::VectorXd equation = space.element().equation();
  if (equation.size() == 0) return;
  const TriangleMesh& mesh = space.mesh();
  const int count = mesh.triangle_count();
  Triplets entries;
  Eigen::VectorXd areas(count);
  for (int t = 0; t < count; ++t) {
    areas(t) = mesh.area(t);
    for (Eigen::Index i = 0; i < equation.size(); ++i)
      if (equation(i) != 0) entries.emplace_back(t, first + space.cell_dofs()(t, i), equation(i));
  }
  const Eigen::VectorXd m = 300 * areas.sum() * areas.cwiseInverse();
  append_rows(problem, from_triplets<RowMatrix>(count, problem.size(), entries), m,
              Eigen::VectorXd::Zero(count));
}

}  // namespace

void add_block_loading(VariationalInequality& problem, const BlockLoading& press,
                       const VectorSpace& space, const StiffnessRange* range) {
  require_plane(space.x.mesh(), "plane strain");
  if (!std::isfinite(press.prescribed_displacement))
    throw Error("plane strain: push is not finite");
  if (!(press.jump_weight >= 0))
    throw Error(fmt::format("plane strain: jump weight {}; accepted 0 or more", press.jump_weight));
  if (!have_one_mesh(space.x, space.y))
    throw Error(
        "plane strain: the two components live on different meshes; accepted: spaces of one mesh");
  const int shift = space.x.size();
  const bool steps = press.jump_weight > 0;
  if (steps && (range == nullptr || range->fits_in_a1(2 * press.jump_weight)))
    problem.a1 += jump_form(space, press.jump_weight, !press.sliding);
  else if (steps)
    range->append(problem, jump_rows(space, press.jump_weight, !press.sliding));
  problem.a1.makeCompressed();
  problem.load = Eigen::VectorXd::Zero(space.size());

  std::map<int, double> fixed;
  for (int i = 0; press.sliding && i < space.x.size(); ++i)
    if (space.x.dof_coordinates()(i, 0) == 0) fixed[i] = 0;
  for (const int i : space.x.dirichlet_dofs())
    if (!press.sliding) fixed[i] = 0;
  for (const int i : space.y.dirichlet_dofs()) fixed[shift + i] = -press.prescribed_displacement;
  set_dirichlet(problem, fixed);
  std::vector<int> normal;
  for (const int i : space.y.contact_dofs()) normal.push_back(shift + i);
  const auto gap_below = [&](double x, double) { return press.gap(x); };
  problem.bounds =
      Bounds::lower_on(normal, -dof_values(space.y, space.y.contact_dofs(), gap_below));
  if (press.friction) add_friction(problem, press.friction, space.x);
}

VariationalInequality assemble(const PlaneStrain& scene, const VectorSpace& space) {
  require_plane(space.x.mesh(), "plane strain");
  if (!(scene.epsilon >= 0 && scene.epsilon <= 1))
    throw Error(
        fmt::format("plane strain: epsilon = 1/lambda = {}; accepted 0 to 1", scene.epsilon));
  VariationalInequality problem;
  strain_form(space).swap(problem.a1);
  FactoredForm div = divergence(space);
  if (scene.continuous_pressure)
    div = project_strain(div, vertex_projection(space.x.mesh(), div, strain_quadrature(space)));
  problem.b.swap(div.b);
  problem.m = std::move(div.m);
  problem.compliance = scene.epsilon;
  add_block_loading(problem, scene, space);
  append_equations(problem, space.x, 0);
  append_equations(problem, space.y, space.x.size());
  return problem;
}

TriangleMesh with_free_sides(TriangleMesh mesh) {
  require_plane(mesh, "free sides");
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const double x0 = mesh.vertices(mesh.edges(e, 0), 0), x1 = mesh.vertices(mesh.edges(e, 1), 0);
    if (mesh.edge_triangles(e, 1) < 0 && x0 == x1 && (x0 == 0 || x0 == 1))
      mesh.edge_tag[e] = EdgeTag::free;
  }
  return mesh;
}

}  // namespace antilock
