// What an answer says of its own locking, held against a second solve of the same size whose layer cannot lock.
#include "antilock/analysis/lost_energy.hpp"
#include "antilock/analysis/detail/ties.hpp"
#include "antilock/exact/truth.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/mesh/graded.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/refine.hpp"
#include "support/bodies.hpp"
#include "support/scenes.hpp"

namespace antilock::lost_energy_test {
namespace {

/// The share that is lost, by two more solves: on the same body with a layer in columns, and with the layer held.
double share_by_solving(const Scene& scene, const Space& space, double energy_at_hand) {
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  const Scene scaled(scene.body(), stiff != nullptr ? *stiff : StiffLayer{*scene.epsilon()}, scene.contact(),
                     scene.edges());
  const TriangleMesh columns = extruded(space.mesh(), *scene.epsilon());
  const Space free_space(columns, space.element());
  VariationalInequality problem = assemble(scaled, free_space);
  const double best = energy(problem, active_set(problem));
  problem.b.resize(0, problem.size()), problem.m.resize(0);
  problem.contact.clear(), problem.lower.resize(0), problem.upper.resize(0), problem.fixed.clear();
  for (int i = 0, k = 0; i < problem.size(); ++i) {
    while (k < static_cast<int>(free_space.clamped().size()) && free_space.clamped()[k] < i) ++k;
    const bool clamped = k < static_cast<int>(free_space.clamped().size()) && free_space.clamped()[k] == i;
    if (clamped || free_space.points()(i, 1) < 1e-12) problem.fixed.push_back(i);
  }
  problem.fixed_values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.fixed.size()));
  const double motion = energy(problem, active_set(problem)) - best;
  return motion > 1e-8 * std::abs(best) ? (energy_at_hand - best) / motion : 0;  // as LostEnergy::share() has it
}

struct Lost {
  LostEnergy energy;
  LayerReport report;
  double share, by_solving;
};

Lost lost_on(const TriangleMesh& mesh, const Element& element, const Scene& scene) {
  const Space space(mesh, element);
  const VariationalInequality problem = assemble(scene, space);
  const Solution solution = active_set(problem);
  const LostEnergy lost = lost_energy(scene, space, problem, solution);
  return {lost, *report_layer(scene, space, problem, solution), lost.share(lost.found),
          share_by_solving(scene, space, energy(problem, solution))};
}

TEST(LostEnergy, LiesBelowWhatTheTruthSays) {
  for (const double epsilon : {1.0, 0.1, 1e-2, 1e-3, 1e-6, 0.0}) {
    const double truth = Truth(paper_sine_load(), epsilon, true, 14).energy();
    for (const int cells : {8, 32}) {
      const TriangleMesh mesh = unstructured_mesh(cells);
      for (const Element* element : {&p1(), &p2()}) {
        const Space space(mesh, *element);
        const Scene scene = test::stiff_scene(epsilon);
        const VariationalInequality problem = assemble(scene, space);
        const Solution solution = active_set(problem);
        const double lost = lost_energy(scene, space, problem, solution).proved, found = energy(problem, solution);
        // 1e-8: the truth is known to 6e-9 of its energy, 0.44
        EXPECT_GE(found - lost, truth - 1e-8) << epsilon << element->name() << cells << ": J(v) >= J(u)";
        // what is left of the error is that of the body's mesh: at 1/h = 32 the smaller part
        if (element == &p1() && epsilon < 1e-3 && cells == 32) {
          EXPECT_GE(lost, 0.5 * (found - truth)) << epsilon;
        }
      }
    }
  }
}

// The corrections in the body come from a small space, and the columns differ: affine in y with exact squares, where the
// second solve has P1 on triangles, which misses (2 pi h)^2 / 12 of the motion, 1.3 % at 1/h = 16.
TEST(LostEnergy, IsTheShareThatASecondSolveFinds) {
  for (const int cells : {16, 32})
    for (const double epsilon : {0.1, 0.03, 1e-2, 1e-3, 1e-6, 0.0})
      for (const std::string family : {"unstructured", "delaunay", "staggered", "jittered"}) {
        const TriangleMesh mesh = mesh_family(family).mesh(cells);
        for (const Element* element : {&p1(), &p2()}) {
          const Lost found = lost_on(mesh, *element, test::stiff_scene(epsilon));
          EXPECT_NEAR(found.share, std::clamp(found.by_solving, 0.0, 1.0), element == &p1() ? 0.004 : 0.01)
              << family << cells << element->name() << epsilon;
        }
      }
}

// Nothing passed over, no false alarm: decided by the second solve.
TEST(LostEnergy, WarnsOfTwoHundredRandomScenesWhereATenthIsLostAndOnlyWhereThereIsLocking) {
  std::mt19937 random(2028);
  const auto uniform = [&] { return random() / (std::mt19937::max() + 1.0); };
  int warned = 0, silent = 0, uniform_methods = 0;
  for (int k = 0; k < 200; ++k) {
    const MeshFamily& family = mesh_families()[random() % mesh_families().size()];
    const int cells = 8 + 2 * static_cast<int>(random() % 9);
    const Element* const element = std::vector<const Element*>{&p1(), &p1(), &p2(), &crouzeix_raviart()}[random() % 4];
    const double epsilon = random() % 8 == 0 ? 0 : std::pow(10, -6 * uniform());
    std::vector<double> modes(3);
    for (double& mode : modes) mode = 20 * uniform() - 10;
    const int shortest = 3 + static_cast<int>(random() % (cells / 3));  // waves of six edges and longer
    const double tilt = 4 * uniform(), depth = 0.02 * uniform(), at = uniform();
    const Field load = [=](double x, double y) {
      double f = 0;
      for (int i = 0; i < 3; ++i) f += modes[i] * std::sin((i < 2 ? i + 1 : shortest) * std::numbers::pi * x);
      return f * (1 + tilt * y);
    };
    std::optional<UnilateralContact> contact;
    switch (random() % 6) {
      case 0:
        break;
      case 1:
        contact = UnilateralContact{};
        break;
      case 2:  // smooth, with a step, with kinks, with waves
        contact = UnilateralContact{[=](double x) { return depth * x * (1 - x); }};
        break;
      case 3:
        contact = UnilateralContact{[=](double x) { return x <= at ? 1.0 : 0.0; }};
        break;
      case 4:
        contact = UnilateralContact{[=](double x) { return std::abs(std::sin((4 + 16 * at) * std::numbers::pi * x)); }};
        break;
      default:
        contact = UnilateralContact{[=](double x) { return 10 * depth * (1 + std::cos(16 * std::numbers::pi * x)); }};
    }
    const Scene scene({load}, StiffLayer{epsilon}, contact);
    const TriangleMesh mesh = family.mesh(cells);
    const Space space(mesh, *element);
    const VariationalInequality problem = assemble(scene, space);
    const Solution solution = active_set(problem);
    const LayerReport report = *report_layer(scene, space, problem, solution);
    const bool says = report.warning.find("locks") != std::string::npos;
    const std::string name =
        fmt::format("scene {}: {} {} 1/{} epsilon {:g}", k, element->name(), family.name, cells, epsilon);
    EXPECT_EQ(says, !report.warning.empty()) << name;
    if (!element->conforming() || find_ties(mesh).in_columns) {
      EXPECT_FALSE(says) << name << ": converges uniformly";
      ++uniform_methods;
      continue;
    }
    const double share = share_by_solving(scene, space, energy(problem, solution));
    EXPECT_TRUE(says || share < 0.1) << name << ": " << share << " lost, reported " << report.lost.value_or(-1);
    EXPECT_TRUE(!says || share > 0.04) << name << ": " << share << " lost, reported " << report.lost.value_or(-1);
    ++(says ? warned : silent);
  }
  EXPECT_GE(warned, 40);
  EXPECT_GE(silent, 20);
  EXPECT_GE(uniform_methods, 40);
}

TEST(LostEnergy, SeesTheThinLayerOf22AsItSees23) {
  // the same layer twice: pressed to its true thickness, and scaled
  const double epsilon = 0.02;
  TriangleMesh mesh = mesh_family("delaunay").mesh(16);
  const double scaled = lost_on(mesh, p1(), test::stiff_scene(epsilon)).share;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.vertices(v, 1) < 0) mesh.vertices(v, 1) *= epsilon;
  const Lost thin = lost_on(mesh, p1(), Scene({paper_load}, ThinLayer{epsilon}, UnilateralContact{}));
  EXPECT_GT(scaled, 0.3);
  EXPECT_NEAR(thin.share, scaled, 1e-9);
  EXPECT_NE(thin.report.warning.find("locks"), std::string::npos);
}

TEST(LostEnergy, IsProvedOfP1BeyondThePapersScenes) {
  TriangleMesh mesh = unstructured_mesh(16);
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.vertices(mesh.edges(e, 0), 1) == 1 && mesh.vertices(mesh.edges(e, 1), 1) == 1)
      mesh.edge_tag[e] = natural_group(0);
  using Kind = EdgeCondition::Kind;
  const auto on_top = [](Kind kind, double value) {
    return std::vector<EdgeCondition>{{"top", kind, [=](double x, double) { return value * (x + 0.2); }}};
  };
  const Body body{paper_load}, two{paper_load, [](double x, double) { return x > 0.5 ? 10 : 1; }};
  UnilateralContact low;
  low.ceiling = [](double) { return 0.1; };
  for (const double epsilon : {0.02, 1e-4})
    for (const Scene& scene : {Scene(two, StiffLayer{epsilon}, UnilateralContact{}, on_top(Kind::free, 0)),
                               Scene(body, StiffLayer{epsilon, 7}, UnilateralContact{}, on_top(Kind::free, 0)),
                               Scene(body, StiffLayer{epsilon}, low, on_top(Kind::free, 0)),
                               Scene(body, StiffLayer{epsilon}, UnilateralContact{}, on_top(Kind::traction, 3)),
                               Scene(body, StiffLayer{epsilon}, std::nullopt, on_top(Kind::spring, 5))}) {
      const Lost found = lost_on(mesh, p1(), scene);
      // at 0.02 v is constant in y and misses (2 pi epsilon)^2 / 3 of one wave, 0.5 %, and 2 % of two
      EXPECT_NEAR(found.share, found.by_solving, 0.015) << epsilon << scene.beyond_the_paper();
      EXPECT_NE(found.report.warning, "") << epsilon << scene.beyond_the_paper();
    }
}

// Short waves, of three to five edges: P3 and P4 have the unknowns for them, and v has those of u_h on Sigma.
TEST(LostEnergy, IsProvedOfEveryDegreeAndOfALoadOnTheLayer) {
  const TriangleMesh mesh = unstructured_mesh(16);
  const auto waves = [](double k) -> Field {
    return [=](double x, double) { return 10 * std::sin(k * std::numbers::pi * x); };
  };
  const Field press = [](double, double) { return -10.0; }, grows = [](double x, double) { return 1 + x; };
  for (const double epsilon : {0.1, 1e-2, 1e-4})
    for (const auto& [element, body, layer_load] : {std::tuple(&p3(), Body{waves(6)}, Field()),
                                                    {&p3(), Body{waves(10)}, Field()},
                                                    {&p4(), Body{waves(6), grows}, Field()},
                                                    {&p4(), Body{waves(12)}, Field()},
                                                    {&p2(), Body{waves(8), grows}, Field()},
                                                    {&p1(), Body{press}, waves(1)},
                                                    {&p3(), Body{press}, waves(2)}}) {
      const Lost found = lost_on(mesh, *element, Scene(body, StiffLayer{epsilon, 1, layer_load}, UnilateralContact{}));
      EXPECT_NEAR(found.share, std::clamp(found.by_solving, 0.0, 1.0), 0.02) << element->name() << epsilon;
      EXPECT_EQ(!found.report.warning.empty(), found.share > 0.05) << element->name() << epsilon << found.share;
    }
}

// A gap with kinks between the points: v sinks in there as u_h does, and lifting it out costs more than it has gained.
TEST(LostEnergy, IsToldByTheSecondSolveWhereTheGapIsAsFineAsTheMesh) {
  const UnilateralContact kinks{[](double x) { return 0.1 * std::abs(std::sin(9 * std::numbers::pi * x)); }};
  const TriangleMesh mesh = unstructured_mesh(8);
  for (const double epsilon : {1.0, 0.1}) {
    const Scene scene({[](double x, double) { return x < 0.5 ? -10.0 : 10.0; }}, StiffLayer{epsilon}, kinks);
    const Lost found = lost_on(mesh, p1(), scene);
    EXPECT_NEAR(found.share, std::clamp(found.by_solving, 0.0, 1.0), 0.02) << epsilon;
    EXPECT_EQ(found.report.lost.has_value(), epsilon == 1);
    EXPECT_EQ(found.report.warning.find("second solve") != std::string::npos, epsilon < 1) << found.report.warning;
    // J(v') is above J(u): u of a mesh that has eight points where this one has one
    const TriangleMesh fine = extruded(refined(refined(refined(mesh))), epsilon);
    const Space space(mesh, p1()), fine_space(fine, p1());
    const VariationalInequality problem = assemble(scene, space), fine_problem = assemble(scene, fine_space);
    const double at_hand = energy(problem, active_set(problem)), best = energy(fine_problem, active_set(fine_problem));
    EXPECT_GT(at_hand - found.energy.proved, best) << epsilon;
  }
}

// The obstacle presses the layer in, and a locked layer cannot give way: J(u_h) is far above what the motion is worth.
TEST(LostEnergy, IsAllWhereALockedLayerIsPressedIn) {
  const UnilateralContact pressed{[](double x) { return -0.02 * std::sin(std::numbers::pi * x); }};
  EXPECT_EQ(lost_on(unstructured_mesh(8), p1(), test::stiff_scene(1e-6, pressed)).share, 1);
}

TEST(LostEnergy, IsNoneWhereTheObstacleHoldsTheLayer) {
  // pressed down everywhere: the layer has nowhere to go, and a locked layer is the right one
  const Scene down({[](double x, double) { return -10 * std::sin(std::numbers::pi * x); }}, StiffLayer{1e-6},
                   UnilateralContact{});
  const Lost found = lost_on(unstructured_mesh(16), p1(), down);
  EXPECT_EQ(found.share, 0);
  EXPECT_EQ(found.report.warning, "");
}

// Where the body is low some of the hats reach no vertex; where it is flatter than the edges of Sigma are long they are as
// high as it is.
TEST(LostEnergy, IsFoundUnderABodyThatIsNoSquare) {
  const std::function<double(double x)> heights[] = {[](double x) { return x > 0.5 ? 1.4 - 0.8 * x : 1; },
                                                     [](double) { return 0.05; }};
  for (const auto& height : heights) {
    TriangleMesh mesh = unstructured_mesh(16);
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.vertices(v, 1) > 0) mesh.vertices(v, 1) *= height(mesh.vertices(v, 0));
    for (const double epsilon : {1e-4, 0.02, 0.05}) {
      const Lost found = lost_on(mesh, p1(), test::stiff_scene(epsilon));
      EXPECT_NEAR(found.share, found.by_solving, 0.01) << height(1) << epsilon;
      EXPECT_EQ(found.report.warning.empty(), found.by_solving < 0.05) << height(1) << epsilon;
    }
  }
}

// What presses a thin layer is the mean over its depth: v, with one row, has the load where u_h has it.
TEST(LostEnergy, KnowsALoadThatChangesOverTheDepthAsTheAnswerDoes) {
  const TriangleMesh mesh = unstructured_mesh(16);
  const auto lost = [&](const Profile& over_depth) {
    const Field load = [=](double x, double y) { return 10 * std::sin(std::numbers::pi * x) * over_depth(y); };
    return lost_on(mesh, p1(), Scene({paper_load}, StiffLayer{1e-4, 1, load}, UnilateralContact{})).energy;
  };
  const LostEnergy even = lost([](double) { return 1.0; }),
                   wavy = lost([](double y) { return 1 + 5 * std::cos(8 * std::numbers::pi * y); });
  // 0.02: four edges per wave, which the quadrature of degree 5 integrates to 1 % of its amplitude 5, and less here
  EXPECT_NEAR(wavy.proved / even.proved, 1, 0.02);
}

TEST(LostEnergy, IsFoundUnderPiecesOfSigmaThatAreFarApart) {
  TriangleMesh mesh = extruded(test::bridge(32), 0.5);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    double& x = mesh.vertices(v, 0);
    const bool end = x == 0 || x == 0.25 || x == 0.75 || x == 1;
    if (mesh.vertices(v, 1) < 0 && !end) x += 0.01 * std::sin(7 * v);
    x += 40 * std::clamp(2 * x - 0.5, 0.0, 1.0);  // the right foot moves away, what is between them is stretched
  }
  const Lost found = lost_on(mesh, p1(), test::stiff_scene(1e-4));
  EXPECT_GT(found.by_solving, 0.9);
  EXPECT_NEAR(found.share, found.by_solving, 0.02);
}

// A layer of few rows is coarse, which is not locking: the same mesh in columns has the same energy.
TEST(LostEnergy, IsNotWhatACoarseLayerCosts) {
  TriangleMesh mesh = extruded(unstructured_mesh(16, {0}), 0);
  ASSERT_EQ(mesh.vertices.col(1).minCoeff(), -1);
  const double columns = lost_on(mesh, p1(), test::stiff_scene(1)).by_solving;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (const double x = mesh.vertices(v, 0); mesh.vertices(v, 1) == -1 && x > 0 && x < 1)
      mesh.vertices(v, 0) += 0.02 * std::sin(7 * v);
  ASSERT_FALSE(find_ties(mesh).in_columns);
  const Lost found = lost_on(mesh, p1(), test::stiff_scene(1));
  EXPECT_NEAR(found.by_solving, columns, 0.02) << "one row where the second solve has sixteen";
  EXPECT_GT(columns, 0.3);
  EXPECT_LT(found.share, 0.01);
  EXPECT_EQ(found.report.warning, "");
}

TEST(LostEnergy, IsAskedOfConformingElementsWithALayerAlone) {
  const TriangleMesh mesh = unstructured_mesh(4), body = unstructured_mesh(4, {0});
  const auto refuse = [](const TriangleMesh& on, const Element& element, const Scene& scene) {
    const Space space(on, element);
    const VariationalInequality problem = assemble(scene, space);
    test::expect_refused([&] { lost_energy(scene, space, problem, active_set(problem)); }, "lost energy: accepted: ");
  };
  refuse(mesh, crouzeix_raviart(), test::stiff_scene(1));
  refuse(body, p1(), Scene({paper_load}));
  refuse(body, p1(), Scene({paper_load}, VentcelLayer{}));
}

TEST(Ties, LeaveAGroupPerColumnWhereThereAreColumns) {
  for (const MeshFamily& family : mesh_families()) {
    const bool columns = family.name == "structured" || family.name == "layered" || family.name == "columns";
    const TriangleMesh mesh = family.mesh(8);
    EXPECT_EQ(find_ties(mesh).in_columns, columns) << family.name;
    EXPECT_EQ(find_ties(mesh).groups > 1, columns) << family.name;
  }
  // crossed cells: triangles without a vertical edge, which tie no neighbour
  const std::vector<double> x{0, 0.25, 0.5, 0.75, 1}, y{-1, -0.5, 0, 0.5, 1};
  TriangleMesh crossed = tensor_mesh(x, y, Diagonal::crossed);
  EXPECT_TRUE(find_ties(crossed).in_columns);
  // its right half sheared: four groups have become two, which are side by side as well
  for (int v = 0; v < crossed.vertex_count(); ++v)
    if (crossed.vertices(v, 0) == 0.75 && crossed.vertices(v, 1) < 0) crossed.vertices(v, 0) = 0.76;
  EXPECT_FALSE(find_ties(crossed).in_columns);
}

}  // namespace
}  // namespace antilock::lost_energy_test
