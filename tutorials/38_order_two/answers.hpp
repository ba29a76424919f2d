#pragma once
// The answers to the exercises of 38_order_two, whose page includes this one: to be read
// after predicting.
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/strain_projection.hpp"
#include "antilock/models/project_strain.hpp"

/// Returns the largest jump of the normal part of G u_h at the ends of the inner edges of
/// the body.
double largest_jump(const Space& space, const Eigen::VectorXd& u) {
  const TriangleMesh& mesh = space.mesh();
  Eigen::MatrixX2d jump = Eigen::MatrixX2d::Zero(mesh.edge_count(), 2);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> slopes = barycentric_gradients(mesh, t);
    for (int i = 0; i < 3; ++i)
      for (const int corner : {(i + 1) % 3, (i + 2) % 3}) {
        const Eigen::MatrixX3d derivative =
            space.element().derivative(Eigen::Vector3d::Unit(corner));
        const Eigen::RowVector2d gradient =
            u(space.cell_dofs().row(t)).transpose() * derivative * slopes;
        const int e = mesh.triangle_edges(t, i),
                  end = mesh.edges(e, 0) == mesh.triangles(t, corner) ? 0 : 1;
        jump(e, end) -= gradient.dot(slopes.row(i).normalized());
      }
  }
  double largest = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int other = mesh.edge_triangles(e, 1);
    const bool inside = other >= 0 && mesh.region[other] == Region::body &&
                        mesh.region[mesh.edge_triangles(e, 0)] == Region::body;
    if (inside) largest = std::max(largest, jump.row(e).cwiseAbs().maxCoeff());
  }
  return largest;
}

const std::vector<tutorial::Exercise> exercises{
    {"Fortin and Soulie: one equation per triangle, d_0 + d_1 + d_2 = 0. Which dimension "
     "has the kernel on a jittered mesh with n cells per unit side, and which has that of "
     "P2?",
     "2 n on this mesh, as on columns: it grows, but like the columns and not like the "
     "triangles. That of P2 is 1, however fine the mesh is",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Scene scene(Body{paper_load}, StiffLayer{0});
       for (const int n : {4, 8}) {
         const TriangleMesh mesh = mesh_family("jittered").mesh(n);
         const int kernel = tutorial::strainless_polynomials(mesh, 2);
         report.claim(kernel == 2 * n,
                      "1/h = {}: {} functions without strain (2 n = {}; observed)", n,
                      kernel, 2 * n);
         const int conforming = layer_kernel_dimension(assemble(scene, Space(mesh, p2())));
         report.claim(conforming == 1, "1/h = {}: {} for P2 (observed)", n, conforming);
       }
       const Space space(mesh_family("jittered").mesh(4), hybrid_bdm1());
       // the equations of the body leave the layer's functions as they are
       const int dimension = layer_kernel_dimension(
           tutorial::with_equations(assemble(scene, space), space, true));
       report.claim(dimension == 8,
                    "1/h = 4: {} for seven numbers with one equation per triangle",
                    dimension);
     }},
    {"Let the load work on the means alone. What happens to the order in L2, and what to "
     "the flux A G u_h from triangle to triangle?",
     "The order in L2 falls from 3 to 2. The normal parts of the flux become continuous, "
     "to round-off: it is in equilibrium with the mean of f on each triangle",
     [](const tutorial::Options&, tutorial::Report& report) {
       const Exact exact = exact_solution(1e-2, false);
       Table errors({"load", "h", "l2", "jump"});
       for (const int n : {4, 8, 16, 32}) {
         const Space space(mesh_family("delaunay").mesh(n), hybrid_bdm1());
         VariationalInequality problem = assemble(exact.scene, space);
         for (const bool means : {false, true}) {
           if (means) problem.load = mean_load_vector(space, paper_load);
           const Solution solution = active_set(problem);
           errors.add({means ? "means" : "functions", 1.0 / n,
                       exact.errors(space, solution).l2, largest_jump(space, solution.u)});
         }
       }
       const Table functions = errors.filter("load", "functions"),
                   means = errors.filter("load", "means");
       report.claim_order(functions, "l2", "h", 2.8, 3.2, "load on the functions, L2");
       report.claim_order(means, "l2", "h", 1.8, 2.2, "load on the means, L2");
       report.claim(
           means.max("jump") < 1e-7 && functions.last("jump") > 1e-4,
           "the flux jumps by {:.1e} (load on the functions) and {:.1e} (on the means)",
           functions.last("jump"), means.max("jump"));
     }},
    {"P2 with its strain averaged by the hat functions of the vertices, half of a0 kept. "
     "Does it lock on Delaunay meshes?",
     "It does not on these meshes: its order in H1 is 2 at epsilon = 0.1 and at 1e-4. A "
     "proof is missing",
     [](const tutorial::Options&, tutorial::Report& report) {
       for (const double epsilon : {0.1, 1e-4}) {
         const Exact exact = exact_solution(epsilon, false);
         Table errors({"h", "h1"});
         for (const int n : {4, 8, 16, 32}) {
           const Space space(mesh_family("delaunay").mesh(n), p2());
           const FactoredForm strain = layer_strain(space);
           const VariationalInequality problem = project_strain(
               assemble(exact.scene, space),
               vertex_projection(space.mesh(), strain, strain_quadrature(p2())), 0.5);
           Solution solution = active_set(problem);
           solution.p.resize(0);  // one per vertex, not per triangle: the errors of u alone
           errors.add({1.0 / n, exact.errors(space, solution).h1});
         }
         report.claim_order(errors, "h1", "h", 1.8, 2.2,
                            fmt::format("P2, averaged, epsilon = {} (observed)", epsilon));
       }
     }}};

// ## Answers on paper
//
// **4.** With $q$ a parabola, $d_j$ is, up to a factor, the difference of $q$ at the two
// Gauss points of edge $j$. The sum round the triangle of these differences is 0 for
// $q = λ_i$ and for $q = λ_i λ_j$, hence for each parabola. So the six values are not
// independent, and there is a parabola that is 0 at all six:
// $2 - 3 (λ_0^2 + λ_1^2 + λ_2^2)$. Its zeros are the conic.
