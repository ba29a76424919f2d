// (23) on discontinuous P1: the whole jump penalised locks, its mean does not.
#include "antilock/form/interior_penalty.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/analysis/layer_components.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/space/space.hpp"
#include "support/scenes.hpp"

namespace antilock::test::models_test::interior_penalty_test {

VariationalInequality problem_on(const TriangleMesh& mesh, double epsilon, PenalisedJump penalised,
                                 double gamma = 3) {
  return assemble(stiff_scene(epsilon), Space(mesh, discontinuous_p1()),
                  InteriorPenalty{gamma, penalised});
}

double largest_on_contact(const VariationalInequality& problem) {
  return active_set(problem).u(problem.bounds.unknowns).maxCoeff();
}

TEST(InteriorPenaltyProblem, HasTheKernelsThatAreCountedByHand) {
  for (const char* family : {"structured", "staggered", "jittered"}) {
    const TriangleMesh mesh = mesh_family(family).mesh(6);
    const int triangles =
        static_cast<int>(std::count(mesh.region.begin(), mesh.region.end(), Region::layer));
    int stiff_edges = 0;  // between two triangles of the layer, not vertical
    for (int e = 0; e < mesh.edge_count(); ++e)
      stiff_edges += mesh.edge_tag[e] == EdgeTag::interior &&
                     mesh.region[mesh.edge_triangles(e, 0)] == Region::layer &&
                     mesh.vertices(mesh.edges(e, 0), 0) != mesh.vertices(mesh.edges(e, 1), 0);
    EXPECT_EQ(layer_kernel_dimension(problem_on(mesh, 0, PenalisedJump::whole)),
              2 * layer_components(mesh).count)
        << family;
    EXPECT_EQ(layer_kernel_dimension(problem_on(mesh, 0, PenalisedJump::mean)),
              2 * triangles - stiff_edges)
        << family;
  }
}

TEST(InteriorPenaltyProblem, LocksWithTheWholeJumpAndNotWithItsMean) {
  constexpr double height = 0.0457160;  // of the ridge in the limit, by the sine series
  const TriangleMesh mesh = mesh_family("staggered").mesh(16);
  for (const double epsilon : {1e-6, 0.0}) {
    EXPECT_LT(largest_on_contact(problem_on(mesh, epsilon, PenalisedJump::whole)), 0.1 * height);
    // Crouzeix-Raviart's error on this mesh is below 2 h^2
    EXPECT_NEAR(largest_on_contact(problem_on(mesh, epsilon, PenalisedJump::mean)), height,
                2.0 / (16 * 16));
  }
}

// The squares of the slopes depend only on the average of both sides, and the others only on the
// mean of the jump.
TEST(InteriorPenaltyProblem, HasTheAveragesOfCrouzeixRaviartIfOnlyTheMeanIsPenalised) {
  const TriangleMesh mesh = unstructured_mesh(6);
  const Space edges(mesh, crouzeix_raviart()), triangles(mesh, discontinuous_p1());
  for (const double epsilon : {1e-1, 1e-6, 0.0}) {
    const Eigen::VectorXd on_edges = active_set(stiff_problem(edges, epsilon)).u;
    const Eigen::VectorXd u = active_set(problem_on(mesh, epsilon, PenalisedJump::mean)).u;
    double in_layer = 0, in_body = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (int i = 0; i < 3; ++i) {
        double& worst = mesh.region[t] == Region::layer ? in_layer : in_body;
        worst = std::max(
            worst, std::abs(u(triangles.cell_dofs()(t, i)) - on_edges(edges.cell_dofs()(t, i))));
      }
    EXPECT_LT(in_layer, 1e-9)
        << epsilon;  // nothing pulls there, so nothing jumps: the solvers' 1e-10 of |u| < 0.3
    EXPECT_GT(in_body, 1e-4) << epsilon;  // there the load makes u jump
  }
}

TEST(InteriorPenaltyProblem, TendsToCrouzeixRaviartAsThePenaltyOfTheMeanGrows) {
  const TriangleMesh mesh = unstructured_mesh(6);
  const Space edges(mesh, crouzeix_raviart()), triangles(mesh, discontinuous_p1());
  for (const double epsilon : {1e-1, 1e-6}) {
    const Eigen::VectorXd on_edges = active_set(stiff_problem(edges, epsilon)).u;
    std::vector<double> differences;
    for (const double gamma : {1e3, 1e4}) {
      const Eigen::VectorXd u = active_set(problem_on(mesh, epsilon, PenalisedJump::mean, gamma)).u;
      double difference = 0;
      for (int t = 0; t < mesh.triangle_count(); ++t)
        for (int i = 0; i < 3; ++i)
          difference = std::max(difference, std::abs(u(triangles.cell_dofs()(t, i)) -
                                                     on_edges(edges.cell_dofs()(t, i))));
      differences.push_back(difference);
    }
    EXPECT_NEAR(differences[0] / differences[1], 10, 0.5)
        << epsilon;  // the next term of the expansion is 1 / gamma^2
  }
}

TEST(InteriorPenaltyProblem, IsContactAtTheMidpointsOfCrouzeixRaviart) {
  const TriangleMesh mesh = unstructured_mesh(5);
  const Space edges(mesh, crouzeix_raviart()), triangles(mesh, discontinuous_p1());
  EXPECT_TRUE(triangles.dirichlet_dofs().empty());
  ASSERT_EQ(triangles.contact_dofs().size(), edges.contact_dofs().size());
  for (std::size_t i = 0; i < edges.contact_dofs().size(); ++i)
    EXPECT_EQ(Eigen::RowVector2d(triangles.dof_coordinates().row(triangles.contact_dofs()[i])),
              Eigen::RowVector2d(edges.dof_coordinates().row(edges.contact_dofs()[i])));
  EXPECT_EQ(problem_on(mesh, 0.1, PenalisedJump::mean).bounds.unknowns, triangles.contact_dofs());
}

TEST(InteriorPenaltyProblem, RefusesInOneLineWhatItDoesNotHave) {
  const TriangleMesh mesh = structured_mesh(3);
  const Space space(mesh, discontinuous_p1());
  expect_refused([&] { assemble(stiff_scene(0.1), space); },
                 "accepted: such an element with an InteriorPenalty");
  Body stiff{paper_load};
  stiff.stiffness = [](double, double) { return 2.0; };
  expect_refused([&] { assemble(Scene(stiff, StiffLayer{0.1}), space, InteriorPenalty{}); },
                 "stiffness 1");
  EXPECT_THROW(problem_on(mesh, 0.1, PenalisedJump::whole, 0.9), NotConverged);
}

}  // namespace antilock::test::models_test::interior_penalty_test
