#pragma once
#include "antilock/core/eigenvalues.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/solve/penalised_cholesky.hpp"
#include "course/certified.hpp"

namespace antilock::tutorial {

/// Uzawa's iteration of chapter 04, lambda = max(0, lambda - rho (u + g)) with rho = 1 /
/// (largest eigenvalue of the compliance on Gamma_C), from lambda = 0, on the unstructured
/// mesh with h = 1/16: bound and error of Crouzeix-Raviart after 1, 2, 4, ... 512 steps, as
/// a table of steps, quantity and value. epsilon must not be 0.
inline Table certify_uzawa(const Exact& exact) {
  const Space space(unstructured_mesh(16), crouzeix_raviart());
  const Scene scene = paper_scene(exact.epsilon);
  const VariationalInequality problem = assemble(scene, space);
  PenalisedCholesky factor(
      problem, problem.compliance);  // K is the problem's own: one solve gives u exactly
  const auto& free = factor.ordering().dof;
  const Eigen::MatrixXd& block =
      factor.contact_block();  // L, the compliance on Gamma_C is (L L')^-1
  const auto compliance = [&](const Eigen::VectorXd& force) -> Eigen::VectorXd {
    const Eigen::VectorXd half = block.triangularView<Eigen::Lower>().solve(force);
    return block.transpose().triangularView<Eigen::Upper>().solve(half);
  };
  const double rho = 1 / largest_eigenvalue(compliance, block.rows());
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(block.rows());
  Solution now;
  Table rows({"steps", "quantity", "value"});
  for (int steps = 0, next = 1; steps <= 512; ++steps) {
    Eigen::VectorXd force = problem.load;
    for (Eigen::Index i = 0; i < lambda.size(); ++i)
      force(problem.bounds.unknowns[i]) += lambda(i);
    now.u = Eigen::VectorXd::Zero(problem.size());
    now.u(free) = factor.cholesky().backward(factor.cholesky().forward(force(free)));
    now.p = problem.b * now.u / problem.compliance;
    for (Eigen::Index i = 0; i < lambda.size(); ++i)
      lambda(i) = std::max(0.0, lambda(i) - rho * (now.u(problem.bounds.unknowns[i]) -
                                                   problem.bounds.lower(i)));
    if (steps < next) continue;
    next *= 2;
    rows.add({steps, "bound",
              certify(scene, {space, problem, now}, {.factor = &factor}).gradient});
    rows.add({steps, "error", exact.errors(space, now).energy});
  }
  return rows;
}

/// The pictures' fields at epsilon = 1e-6: the density of the bound of three functions, and
/// the flux.
inline void write_pictures(const std::filesystem::path& out) {
  const Scene scene = paper_scene(1e-6);
  const Solved unstructured(scene, unstructured_mesh(16)),
      layered(scene, layered_mesh(16, 1e-6));
  const auto density = [&](const char* name, const Solved& run, const Certificate& found) {
    write_density(out / name, run.space.mesh(), found.indicator);
  };
  density("width_cr.vtu", unstructured, unstructured.certified());
  density("width_p1.vtu", unstructured, unstructured.p1_certified());
  density("width_p1_layered.vtu", layered, layered.p1_certified());
  const EquilibratedFlux flux = equilibrated_flux(scene, unstructured);
  write_vtu(out / "flux_x.vtu", unstructured.space.mesh(),
            component(unstructured.space.mesh(), flux, 0));
  write_vtu(out / "flux_y.vtu", unstructured.space.mesh(),
            component(unstructured.space.mesh(), flux, 1));
}

/// Prints the finest meshes' results, writes results.csv, effectivity.csv and uzawa.csv,
/// and the pictures' fields.
inline void show_certificates(const std::filesystem::path& out, const Table& results,
                              const Table& uzawa) {
  const Table finest = results.filter("cells", results.max("cells"));
  finest
      .select({"element", "mesh", "epsilon", "lower", "upper", "bound", "error", "ratio",
               "layer_share"})
      .print(
          "the energy bracket; bound and error in the energy norm; the layer's share of "
          "the bound");
  finest.select({"element", "mesh", "epsilon", "displacement", "stress", "works"})
      .print(
          "what the width consists of, in parts of it (finest mesh); works: of contact, "
          "less (f - f_1, u), which has either sign",
          3);
  results.write(out / "results.csv");
  finest.filter_number("epsilon", [](double epsilon) { return epsilon > 0; })
      .write(out / "effectivity.csv");
  uzawa.write(out / "uzawa.csv");
  write_pictures(out);
}

/// What stands in the identity beside the two errors: the works of contact, int lambda_u
/// v + int lambda_h u, and
/// -(f - f_1, u).
inline double works(const Space& cr, const EquilibratedFlux& flux,
                    const ConformingCompanion& v, const Exact& exact) {
  const TriangleMesh& mesh = cr.mesh();
  const auto [points, weights] = gauss_rule(4);
  double work = 0;
  for (std::size_t place = 0; place < cr.contact_dofs().size(); ++place) {
    const int edge = cr.contact_dofs()[place], from = mesh.edges(edge, 0),
              to = mesh.edges(edge, 1);  // an unknown is an edge
    for (Eigen::Index q = 0; q < points.size(); ++q) {
      const double s = points(q),
                   x = (1 - s) * mesh.vertices(from, 0) + s * mesh.vertices(to, 0);
      const double v_there = v.layer
                                 ? v.layer->value({x, -1})
                                 : (1 - s) * v.at_vertices(from) + s * v.at_vertices(to);
      work += weights(q) * mesh.edge_length(edge) * exact.solution.pressure(x) * v_there;
      work += weights(q) * flux.lambda(static_cast<Eigen::Index>(place)) *
              exact.table.value(x, -1);
    }
  }
  const Quadrature& rule = triangle_rule(8);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (Eigen::Index q = 0; mesh.region[t] == Region::body && q < rule.weights.size();
         ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      const double rest =
          paper_load(x(0), x(1)) - rule.points.row(q).dot(flux.cell[t].f);  // f - f_1
      work -= mesh.area(t) * rule.weights(q) * rest * exact.table.value(x(0), x(1));
    }
  return work;
}

}  // namespace antilock::tutorial
