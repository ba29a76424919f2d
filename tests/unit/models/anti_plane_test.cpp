// Scenes become discrete inequalities.
#include "antilock/models/coating.hpp"
#include "antilock/models/plate.hpp"
#include "support/bodies.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"

namespace antilock::test::models_test::anti_plane_test {

TEST(Assemble, StiffLayerIsEquation23) {
  for (const NamedSpace& space : two_square_spaces(4, {&p1(), &crouzeix_raviart()})) {
    const VariationalInequality problem = stiff_problem(space, 0.1);
    // u = 2 x + 3 y: a1(u, u) = body 4 + 9, layer 4; a0(u, u) = layer 9
    const Eigen::VectorXd u =
        2 * space.dof_coordinates().col(0) + 3 * space.dof_coordinates().col(1);
    EXPECT_NEAR(u.dot(problem.a1 * u), 17, 1e-11) << space.name;
    EXPECT_NEAR(value({problem.b, problem.m, {}}, u), 9, 1e-11) << space.name;
    EXPECT_EQ(problem.dirichlet_dofs, space.dirichlet_dofs());
    EXPECT_TRUE(problem.dirichlet_values.isZero(0));
    EXPECT_NO_THROW(check(problem));
  }
}

TEST(Assemble, AnAbsentEffectLeavesNothingBehind) {
  const TriangleMesh body = structured_mesh(4, {0}), both = structured_mesh(4);
  const VariationalInequality none = assemble(Scene({paper_load}), Space(body, p1()));
  EXPECT_EQ(none.b.rows(), 0);
  EXPECT_EQ(none.m.size(), 0);
  EXPECT_TRUE(none.bounds.unknowns.empty());
  EXPECT_EQ(none.bounds.lower.size(), 0);
  const VariationalInequality layer =
      assemble(Scene({paper_load}, StiffLayer{0.1}), Space(both, p1()));
  EXPECT_EQ(layer.b.rows(), 2 * 16);
  EXPECT_TRUE(layer.bounds.unknowns.empty());
  const VariationalInequality contact =
      assemble(Scene({paper_load}, NoLayer{}, UnilateralContact{}), Space(body, p1()));
  EXPECT_EQ(contact.b.rows(), 0);
  EXPECT_EQ(contact.bounds.unknowns.size(), 3U);
}

TEST(Assemble, TheObstacleIsMinusTheGapAtEachContactUnknown) {
  const TriangleMesh mesh = unstructured_mesh(5);
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    const auto problem = stiff_problem(space, 0.1, {[](double x) { return 0.5 * x; }});
    ASSERT_EQ(problem.bounds.unknowns, space.contact_dofs());
    for (Eigen::Index i = 0; i < problem.bounds.lower.size(); ++i)
      EXPECT_EQ(problem.bounds.lower(i),
                -0.5 * space.dof_coordinates()(problem.bounds.unknowns[i], 0));
  }
  const Space space(mesh, p1());
  expect_refused(
      [&] { stiff_problem(space, 0.1, {[](double x) { return x > 0 && x < 1 ? nan : 0; }}); },
      "is not finite");
}

TEST(Assemble, RefusesASceneThatDoesNotFitItsMesh) {
  TriangleMesh body = structured_mesh(3, {0}), both = structured_mesh(3);
  expect_refused([&] { assemble(Scene({paper_load}, StiffLayer{0.1}), Space(body, p1())); },
                 "no group layer");
  expect_refused([&] { assemble(Scene({paper_load}, ThinLayer{0.1}), Space(body, p1())); },
                 "no group layer");
  expect_refused([&] { assemble(Scene({paper_load}), Space(both, p1())); }, "no layer");
  expect_refused([&] { assemble(Scene({paper_load}, VentcelLayer{}), Space(both, p1())); },
                 "no layer");
  std::replace(body.edge_tag.begin(), body.edge_tag.end(), EdgeTag::clamped, dirichlet_group(0));
  for (const Layer& layer : {Layer(NoLayer{}), Layer(VentcelLayer{})})
    expect_refused([&] { assemble(Scene({paper_load}, layer), Space(body, p1())); },
                   "of which the scene says nothing");
  const TriangleMesh hangs =
      retagged(structured_mesh(4, {0}), [](double, double) { return natural_group(0); });
  const Scene pulled({paper_load}, NoLayer{}, {},
                     {{"rim", BoundaryCondition::Kind::traction, paper_load}});
  expect_refused([&] { assemble(pulled, Space(hangs, p1())); },
                 "nothing holds the component of the mesh");
  for (int v = 0; v < both.vertex_count(); ++v)  // whichever end of an edge it is
    if (both.vertices(v, 1) == 0) {
      TriangleMesh bent = both;
      bent.vertices(v, 1) = 1e-3;
      expect_refused([&] { assemble(Scene({paper_load}, StiffLayer{0.1}), Space(bent, p1())); },
                     "Sigma has a vertex");
    }
}

}  // namespace antilock::test::models_test::anti_plane_test
