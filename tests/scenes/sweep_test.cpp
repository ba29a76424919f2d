// Only what is needed: an absent effect costs nothing, and what a sweep can share it shares.
// Asserted by counting.
#include "antilock/study/scene_sweep.hpp"
#include "support/scenes.hpp"

namespace antilock::test::sweep_test {

// Both are solved to 1e-10; the way there differs.
constexpr double same = 1e-8;

TEST(OnlyWhatIsNeeded, AnAbsentEffectCostsNothing) {
  const TriangleMesh body = structured_mesh(8, {0}), both = structured_mesh(8);
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space on_body(body, *element), on_both(both, *element);
    const auto cost = [](const Scene& scene, const Space& on) {
      return active_set(assemble(scene, on)).counters;
    };
    for (const Layer& layer : {Layer(NoLayer{}), Layer(VentcelLayer{})}) {
      const Counters c = cost(Scene({paper_load}, layer), on_body);
      EXPECT_EQ(c.unknowns, on_body.size() - static_cast<int>(on_body.dirichlet_dofs().size()));
      EXPECT_EQ(c.factorisations, 1);
      EXPECT_EQ(c.solves, 1) << "no stiff part: a linear solve";
      EXPECT_EQ(c.corrections + c.contact_iterations, 0);
    }
    for (const double gap : {0.0, 1.0}) {
      const Counters c = cost(
          Scene({paper_load}, NoLayer{}, UnilateralContact{[=](double) { return gap; }}), on_body);
      EXPECT_EQ(c.factorisations, 1);
      EXPECT_EQ(c.solves, 1);
      EXPECT_EQ(c.corrections, 0);
      EXPECT_GE(c.contact_iterations, 1);
      EXPECT_LE(c.contact_iterations, gap == 0 ? 4 : 1)
          << "never touched: a look at the signs";  // 4: the nested start's
    }
    for (const double epsilon : {1e-6, 0.0}) {
      const Counters c = cost(Scene({paper_load}, StiffLayer{epsilon}), on_both);
      EXPECT_EQ(c.unknowns, on_both.size() - static_cast<int>(on_both.dirichlet_dofs().size()));
      EXPECT_EQ(c.factorisations, 1);
      EXPECT_EQ(c.contact_iterations, 0);
      EXPECT_GT(c.corrections, 0);
      EXPECT_EQ(c.solves, c.corrections + 1);
    }
    EXPECT_LE(cost(test::stiff_scene(1), on_both).corrections, 1)
        << "one look that nothing is left";
  }
}

// Each function of a scene is asked where its effect is, and nowhere else.
TEST(OnlyWhatIsNeeded, EdgesAndStiffnessAreIntegratedWhereTheyAre) {
  constexpr int n = 16;
  struct Calls {
    int load = 0, stiffness = 0, traction = 0, spring = 0, displacement = 0;
  } calls;
  using Kind = BoundaryCondition::Kind;
  const auto counted = [](int& count) {
    return [&count](double, double) { return 1.0 + 0 * ++count; };
  };
  const Body bare{counted(calls.load)}, stiff{counted(calls.load), counted(calls.stiffness)};
  const std::vector<BoundaryCondition> held{
      {"left", Kind::displacement, counted(calls.displacement)},
      {"right", Kind::traction, counted(calls.traction)},
      {"top", Kind::spring, counted(calls.spring)}};
  for (const Layer& layer : {Layer(NoLayer{}), Layer(StiffLayer{1e-3})}) {
    TriangleMesh mesh = structured_mesh(n, {std::holds_alternative<NoLayer>(layer) ? 0.0 : 1.0});
    for (int e = 0; e < mesh.edge_count(); ++e) {
      const auto x = mesh.vertices(mesh.edges.row(e), Eigen::indexing::all).colwise().mean().eval();
      if (mesh.edge_tag[e] == EdgeTag::clamped && x(1) > 0)
        mesh.edge_tag[e] = x(0) == 0 ? dirichlet_group(0) : natural_group(x(0) == 1 ? 1 : 2);
    }
    const Space space(mesh, crouzeix_raviart());
    calls = {};
    assemble(Scene(bare, layer, {},
                   {{"left", Kind::displacement, counted(calls.displacement)}, {"right"}, {"top"}}),
             space);
    const int points = calls.load;
    EXPECT_EQ(calls.stiffness + calls.traction + calls.spring, 0);
    calls = {};
    assemble(Scene(stiff, layer, {}, held), space);
    EXPECT_EQ(calls.load, points);
    EXPECT_EQ(calls.stiffness, 2 * n * n) << "the body's triangles";
    EXPECT_EQ(calls.traction, 3 * n) << "three Gauss points per edge";
    EXPECT_EQ(calls.spring, 3 * n);
    EXPECT_EQ(calls.displacement, n);
  }
}

TEST(Sweep, GivesTheAnswersOfScenesSolvedOneByOne) {
  const Space space(unstructured_mesh(12), crouzeix_raviart());
  SceneSweep sweep(test::stiff_scene(1), space);
  for (const double epsilon : {1.0, 0.1, 1e-3, 1e-6, 0.0, 0.3}) {
    sweep.set_epsilon(epsilon);
    const Scene alone({paper_load}, StiffLayer{epsilon}, UnilateralContact{});
    EXPECT_LE(test::relative_difference(sweep.solve().u, active_set(assemble(alone, space)).u),
              same)
        << epsilon;
  }
}

TEST(Sweep, SharesOneFactorisationBelowThePenalty) {
  const Space space(structured_mesh(16), p1());
  int asked = 0;  // of the stiffness: by the forms alone
  const Field stiffness = [&asked](double, double) { return 1.0 + 0 * ++asked; };
  SceneSweep sweep(Scene({paper_load, stiffness}, StiffLayer{0}, UnilateralContact{}), space);
  const int assembled = asked;
  // epsilon^2 is below the penalty, 6e-8 to a small factor, for all of these
  for (const double epsilon : {0.0, 1e-12, 1e-8, 1e-4}) {
    sweep.set_epsilon(epsilon);
    EXPECT_EQ(sweep.solve().counters.factorisations, epsilon == 0 ? 1 : 0) << epsilon;
  }
  sweep.set_epsilon(0.1);
  EXPECT_EQ(sweep.solve().counters.factorisations, 1);
  EXPECT_EQ(sweep.total().factorisations, 2);
  EXPECT_EQ(asked, assembled) << "the forms stay as they are";
  const double* forms = sweep.problem().a1.valuePtr();
  sweep.set_load([](double x, double y) { return 0.5 * paper_load(x, y); });
  sweep.solve();
  EXPECT_EQ(sweep.problem().a1.valuePtr(), forms);
}

TEST(Sweep, LoadsShareOneFactorisation) {
  const Space space(structured_mesh(16), crouzeix_raviart());
  SceneSweep sweep(test::stiff_scene(1e-3), space);
  sweep.solve();
  for (const double size : {0.5, 2.0, -1.0}) {
    const Field load = [size](double x, double y) { return size * paper_load(x, y); };
    sweep.set_load(load);
    const Solution swept = sweep.solve();
    EXPECT_EQ(swept.counters.factorisations, 0);
    const Scene alone({load}, StiffLayer{1e-3}, UnilateralContact{});
    EXPECT_LE(test::relative_difference(swept.u, active_set(assemble(alone, space)).u), same)
        << size;
  }
}

TEST(Sweep, StartsFromTheContactSetBefore) {
  const Space space(structured_mesh(64), p1());
  SceneSweep sweep(test::stiff_scene(1e-3), space);
  sweep.solve();
  sweep.set_epsilon(0.9e-3);  // moves the contact zone by less than a cell
  EXPECT_LE(sweep.solve().counters.contact_iterations, 2);
}

TEST(Sweep, ServesScenesWithoutEpsilonToo) {
  const Space space(structured_mesh(8, {0}), p1());
  SceneSweep sweep(Scene({paper_load}), space);
  const Solution first = sweep.solve();
  sweep.set_load([](double x, double y) { return -3 * paper_load(x, y); });
  const Solution second = sweep.solve();
  EXPECT_EQ(second.counters.factorisations, 0);
  EXPECT_LE((second.u + 3 * first.u).cwiseAbs().maxCoeff(), 1e-14);  // linear
}

TEST(Sweep, RefusesWhatTheSceneDoesNotHave) {
  const TriangleMesh body = structured_mesh(8, {0}), both = structured_mesh(8);
  const Space space(body, p1()), space_with_layer(both, p1());
  SceneSweep ventcel(Scene({paper_load}, VentcelLayer{}), space);
  EXPECT_THROW(ventcel.set_epsilon(0.1), Error);
  EXPECT_THROW(ventcel.set_load(Field{}), Error);
  SceneSweep stiff(Scene({paper_load}, StiffLayer{0.1}), space_with_layer);
  EXPECT_THROW(stiff.set_epsilon(-1), Error);
  EXPECT_THROW(stiff.set_epsilon(std::nan("")), Error);
}

}  // namespace antilock::test::sweep_test
