#include "antilock/certificate/contact_force_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <variant>

#include "antilock/certificate/equilibrated_flux.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

std::set<int> contact_vertices(const TriangleMesh& mesh) {
  std::set<int> vertices;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::contact) vertices.insert({mesh.edges(e, 0), mesh.edges(e, 1)});
  return vertices;
}

/// Returns the interval of (A grad u, grad phi) - L(phi), where phi has the values (V) on the
/// contact vertices, is 0 on the Dirichlet unknowns of the P1 `problem` and has the least energy.
std::pair<double, double> work_on_phi(VariationalInequality problem, const std::set<int>& contact,
                                      const Eigen::VectorXd& values, const EquilibratedFlux& flux,
                                      const Space& space, double flux_error) {
  std::map<int, double> given;
  for (const int vertex : problem.dirichlet_dofs) given[vertex] = 0;
  for (const int vertex : contact) given[vertex] = values(vertex);
  problem.load.setZero();
  problem.bounds = {};
  set_dirichlet(problem, given);
  const Solution phi = active_set(problem);
  const double norm = std::sqrt(2 * energy(problem, phi));
  // Crouzeix-Raviart's unknown of an edge is the value of phi at its midpoint
  const TriangleMesh& mesh = space.mesh();
  double work = 0;
  for (int e = 0; e < mesh.edge_count(); ++e)
    work += flux.residual(e) * (phi.u(mesh.edges(e, 0)) + phi.u(mesh.edges(e, 1))) / 2;
  return {work - flux_error * norm, work + flux_error * norm};
}

}  // namespace

std::optional<ContactForceBounds> contact_force_bounds(const Scene& scene, const Result& result,
                                                       const Certificate& certificate) {
  const Space& space = result.space;
  require_triangles(space.mesh(), "bounds of the contact force");
  if (!scene.contact() || space.element().name() != crouzeix_raviart().name() ||
      std::holds_alternative<VentcelLayer>(scene.layer()))
    return {};
  const Space p1_space(space, p1());
  const VariationalInequality problem = assemble(scene, p1_space);
  const std::set<int> contact = contact_vertices(space.mesh());
  const std::vector<int>& prescribed = problem.dirichlet_dofs;
  if (std::any_of(prescribed.begin(), prescribed.end(),
                  [&](int vertex) { return contact.contains(vertex); }))
    return {};
  const std::size_t given = prescribed.size() + contact.size();
  if (given == static_cast<std::size_t>(p1_space.size())) return {};  // phi has no free vertex
  const EquilibratedFlux flux = equilibrated_flux(scene, result);
  const auto interval = [&](const Eigen::VectorXd& values) {
    return work_on_phi(problem, contact, values, flux, space, certificate.gradient);
  };
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(space.mesh().vertex_count());
  const Eigen::VectorXd x = space.mesh().vertices.col(0);
  return ContactForceBounds{interval(one), interval(x)};
}

}  // namespace antilock
