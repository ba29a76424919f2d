// Refinement where the certificate says so, and the accuracy that is asked for.
#include "antilock/adapt/solve_to.hpp"
#include "antilock/adapt/bisection.hpp"
#include "antilock/certificate/exact_errors.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/exact/exact_solution.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/read_msh.hpp"
#include "support/bodies.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"

namespace antilock::test::adapt_test::solve_to_test {

/// The smallest of twice the area over the square of the longest edge: zero for a flat triangle.
double flattest(const TriangleMesh& mesh) {
  double least = 1;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    double longest = 0;
    for (int i = 0; i < 3; ++i)
      longest = std::max(longest, mesh.edge_length(mesh.triangle_edges(t, i)));
    least = std::min(least, mesh.twice_area(t) / (longest * longest));
  }
  return least;
}

std::vector<test::NamedMesh> first_meshes() {
  return {{"structured", structured_mesh(4)},
          {"gmsh", unstructured_mesh(4)},
          {"file", read_msh(ANTILOCK_TEST_DATA "/two_squares_22.msh")},
          {"L", test::l_shape(4)},
          {"layer under an L", extruded(test::l_shape(4), 0.3)}};
}

TEST(Bisection, KeepsAreasTagsVerticesAndShapes) {
  for (const auto& [name, start] : first_meshes()) {
    TriangleMesh mesh = longest_edge_first(start);
    std::mt19937 random(5);
    for (int level = 0; level < 8; ++level) {
      std::vector<bool> marks(mesh.triangle_count());
      for (int t = 0; t < mesh.triangle_count(); ++t) marks[t] = random() % 8 == 0;
      const TriangleMesh finer = bisected(mesh, marks);  // make_mesh checks that it conforms
      EXPECT_EQ(finer.vertices.topRows(mesh.vertex_count()), mesh.vertices) << name;
      mesh = finer;
      for (const Region region : {Region::body, Region::layer})
        EXPECT_NEAR(area(mesh, region), area(start, region), 1e-12) << name;
      for (const EdgeTag tag : {EdgeTag::sigma, EdgeTag::clamped, EdgeTag::contact})
        EXPECT_NEAR(length(mesh, tag), length(start, tag), 1e-12) << name;
    }
    EXPECT_GT(mesh.triangle_count(), 20 * start.triangle_count()) << name;
    // four shapes per first triangle (Mitchell 1991); the flattest is at worst a quarter of its
    // father in this measure
    EXPECT_GE(flattest(mesh), flattest(start) / 4) << name;
  }
}

TEST(Bisection, StaysWhereTheMarksAre) {
  TriangleMesh mesh = longest_edge_first(unstructured_mesh(8));
  const int before = mesh.triangle_count();
  for (int level = 0; level < 10; ++level) {
    std::vector<bool> marks(mesh.triangle_count(), false);
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (int i = 0; i < 3; ++i)
        if (mesh.vertices(mesh.triangles(t, i), 0) == 0 &&
            mesh.vertices(mesh.triangles(t, i), 1) == 1)
          marks[t] = true;
    mesh = bisected(mesh, marks);
  }
  EXPECT_LT(mesh.triangle_count(), before + 10 * 40);  // a corner: so many per level, not a factor
  std::vector<bool> edges(mesh.edge_count(), false);
  edges[3] = true;
  EXPECT_GT(bisected(mesh, std::vector<bool>(mesh.triangle_count(), false), edges).triangle_count(),
            mesh.triangle_count());
  expect_refused([&] { bisected(mesh, {true}); }, "one mark per triangle");
}

TEST(Marking, TakesTheLargestUpToHalfTheSumAndNeverTooFew) {
  Eigen::VectorXd indicator = Eigen::VectorXd::Constant(100, 1.0);
  indicator(17) = 1000;
  const auto count = [](const std::vector<bool>& m) {
    return std::count(m.begin(), m.end(), true);
  };
  EXPECT_EQ(count(dorfler_mark(indicator, {.min_fraction = 0})), 1);
  EXPECT_TRUE(dorfler_mark(indicator)[17]);
  EXPECT_EQ(count(dorfler_mark(indicator)), 5) << "5 % at least";
  indicator(17) = 1;
  EXPECT_EQ(count(dorfler_mark(indicator)), 100) << "an even error: all";
  EXPECT_EQ(count(dorfler_mark(indicator, {.uniform_above = 1})), 50);
  EXPECT_EQ(count(dorfler_mark(indicator, {.max_marked = 7})), 7);
}

const Field bump = [](double x, double y) {
  return 400 * std::exp(-(std::pow(x - 0.3, 2) + std::pow(y - 0.6, 2)) / (2 * 0.02 * 0.02));
};
Scene scene_of(const Field& load, double epsilon, UnilateralContact contact = {}) {
  return Scene({load}, StiffLayer{epsilon}, std::move(contact));
}
TriangleMesh first_mesh(double epsilon) {
  return unstructured_mesh(8, {epsilon > 0.1 ? 1.0 : 0.0});
}

TEST(SolveTo, DeliversWhatIsAskedAtEveryEpsilon) {
  for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 0.0}) {
    const ExactTable exact_solution{ExactSolution(paper_sine_load(), epsilon)};
    for (const Quantity of : {Quantity::displacement, Quantity::stress})
      for (const double asked : {1e-1, 3e-2, 1e-2}) {
        // 1e-2 once, since it takes seconds: chapter 22 with --asked 0.01 asks it at every epsilon
        if (asked < 2e-2 && (of == Quantity::displacement || epsilon != 1e-6)) continue;
        const Scene scene = scene_of(paper_load, epsilon);
        const CertifiedSolution found = solve_to(scene, first_mesh(epsilon), {asked, of});
        const std::string at = fmt::format("epsilon = {:g}, asked {:g}", epsilon, asked);
        EXPECT_LE(found.certificate.relative(of), asked) << at;
        EXPECT_GE(found.certificate.relative(of), asked / 2) << at;
        const Result& result = found.result;
        const Space& space = result.space;
        const ConformingCompanion v{
            .at_vertices = found.companion.u, .stress = found.companion.p, .layer = std::nullopt};
        const auto exact =
            exact_errors(space.mesh(), equilibrated_flux(scene, result), v, exact_solution);
        EXPECT_LE(exact.displacement, found.certificate.displacement) << at;
        EXPECT_LE(exact.gradient, found.certificate.gradient) << at;
        EXPECT_LE(exact.stress, found.certificate.stress) << at;
        EXPECT_LE(found.certificate.displacement, 1.4 * exact.displacement) << at;
        const RefinementLevel& last = found.history.back();
        EXPECT_EQ(last.unknowns, space.free_count());
        if (found.history.size() > 3) {
          const double quoted = found.history[found.history.size() - 2].predicted_unknowns;
          EXPECT_NEAR(quoted, last.unknowns, 0.3 * last.unknowns) << at;
        }
      }
  }
}

// Where the layer is not in columns the companion has columns of its own: its values at the mesh's
// vertices are theirs.
TEST(SolveTo, TheCompanionHasValuesInALayerOfAnyTriangles) {
  const CertifiedSolution found =
      solve_to(scene_of(paper_load, 1e-2), unstructured_mesh(8),
               {0.1, Quantity::displacement, 2e6, RefinementStrategy::bisect});
  const ExactTable exact_solution{ExactSolution(paper_sine_load(), 1e-2)};
  const TriangleMesh& mesh = found.result.space.mesh();
  double off = 0, most = 0;
  for (int i = 0; i < mesh.vertex_count(); ++i)
    if (const double exact = exact_solution.value(mesh.vertices(i, 0), mesh.vertices(i, 1));
        mesh.vertices(i, 1) < 0) {
      off = std::max(off, std::abs(found.companion.u(i) - exact));
      most = std::max(most, std::abs(exact));
    }
  EXPECT_LE(off, 0.1 * most);  // what is asked of the energy norm
}

TEST(SolveTo, IsCheapWhereTheSolutionIsLocal) {
  const double epsilon = 1e-6;
  const auto unknowns = [&](const Scene& scene, double asked,
                            std::optional<RefinementStrategy> strategy, bool layer) {
    const CertifiedSolution found = solve_to(scene, unstructured_mesh(8, {layer ? 1.0 : 0.0}),
                                             {asked, Quantity::displacement, 2e6, strategy});
    return found.history.back().unknowns;
  };
  EXPECT_LE(unknowns(scene_of(bump, epsilon), 3e-2, std::nullopt, false), 60000);
  EXPECT_LE(unknowns(scene_of(bump, epsilon), 3e-2, RefinementStrategy::bisect, true), 90000);
  // a needle under the valley, where the load presses: two unknowns touch it; uniform meshes prove
  // 29 % with 14,401
  const Profile needle = [](double x) {
    return 0.1 - 0.12 * std::exp(-std::pow((x - 0.75) / 0.004, 2));
  };
  const CertifiedSolution on_needle =
      solve_to(scene_of(paper_load, epsilon, {needle}), first_mesh(epsilon), {1e-1});
  EXPECT_LE(on_needle.history.back().unknowns, 5000);
  EXPECT_TRUE(std::find(on_needle.result.solution.active.begin(),
                        on_needle.result.solution.active.end(),
                        true) != on_needle.result.solution.active.end());
}

// Unknowns times the square of the error is the price of a family of meshes, whatever is asked.
// Adapted meshes are held to 5 % of their own first mesh refined uniformly. gmsh's fine mesh is
// cheaper than that: gmsh's triangles at 1/h = 8 are 6 % dearer, 1 % at 1/h = 16, and refinement
// inherits their shapes.
TEST(SolveTo, CostsNoMoreThanUniformMeshesForASmoothLoad) {
  const double epsilon = 1e-6;
  const Scene scene = scene_of(paper_load, epsilon);
  const auto price = [&](const TriangleMesh& mesh) {
    const Space space(mesh, crouzeix_raviart());
    const VariationalInequality problem = assemble(scene, space);
    const double relative =
        certify(scene, {space, problem, active_set(problem)}).relative(Quantity::displacement);
    return space.free_count() * relative * relative;
  };
  const double gmsh = price(layered_mesh(64, epsilon));
  for (const int first : {8, 16}) {
    TriangleMesh body = longest_edge_first(unstructured_mesh(first, {0}));
    for (int cells = first; cells < 64; cells *= 2)
      body = bisected(body, std::vector<bool>(body.triangle_count(), true));
    const double uniform = price(extruded(body, epsilon));
    EXPECT_LE(uniform, (first == 8 ? 1.07 : 1.02) * gmsh) << first;
    const RefinementLevel last =
        solve_to(scene, unstructured_mesh(first, {0}), {3e-2}).history.back();
    const double adapted = last.unknowns * last.relative * last.relative;
    EXPECT_LE(adapted, 1.05 * uniform) << first;
    EXPECT_LE(adapted, (first == 8 ? 1.1 : 1.05) * gmsh) << first;
  }
}

TEST(SolveTo, WorksOnBodiesOtherThanTheSquareAndWithoutALayer) {
  const auto cost = [](const CertifiedSolution& found) {
    return found.history.back().unknowns * std::pow(found.history.back().relative, 2);
  };
  for (const double epsilon : {1.0, 1e-6, 0.0}) {
    const Scene scene = scene_of([](double, double) { return -5.0; }, epsilon);
    const TriangleMesh first = epsilon > 0.1 ? extruded(test::l_shape(8), 1) : test::l_shape(8);
    const CertifiedSolution found = solve_to(scene, first, {5e-2});
    EXPECT_LE(found.history.back().relative, 5e-2);
    // against the same body refined everywhere: the corner makes that dearer
    const Space space(extruded(test::l_shape(32), epsilon), crouzeix_raviart());
    const VariationalInequality problem = assemble(scene, space);
    const double uniform =
        certify(scene, {space, problem, active_set(problem)}).relative(Quantity::displacement);
    EXPECT_LT(cost(found), 0.7 * space.free_count() * uniform * uniform) << epsilon;
  }
  EXPECT_LE(solve_to(Scene({paper_load}, NoLayer{}, UnilateralContact{}), test::bridge(8), {1e-1})
                .history.back()
                .relative,
            1e-1);
  EXPECT_LE(solve_to(Scene({paper_load}, ThinLayer{0.3}), unstructured_mesh(8, {0.3}), {5e-2})
                .history.back()
                .relative,
            5e-2);
}

TEST(SolveTo, TakesTheVentcelLayerForTheRigidLimit) {
  const CertifiedSolution ventcel =
      solve_to(Scene({paper_load}, VentcelLayer{}, UnilateralContact{}), first_mesh(0), {1e-1});
  const CertifiedSolution rigid = solve_to(scene_of(paper_load, 0), first_mesh(0), {1e-1});
  EXPECT_EQ(ventcel.history.back().bound, rigid.history.back().bound);
}

TEST(SolveTo, LooksForASpikeThatTheQuadratureMisses) {
  const Field spike = [](double x, double y) {
    return paper_load(x, y) +
           20000 * std::exp(-(std::pow(x - 0.31, 2) + std::pow(y - 0.62, 2)) / (0.002 * 0.002));
  };
  TriangleMesh mesh = longest_edge_first(first_mesh(0));
  const int before = mesh.triangle_count();
  EXPECT_EQ(resolve_load(mesh, spike, 100000), "");
  EXPECT_GT(mesh.triangle_count(), before);
  double least = 1;
  for (int t = 0; t < mesh.triangle_count(); ++t) least = std::min(least, mesh.area(t));
  EXPECT_LT(least, 1e-4) << "small triangles at the spike";
  TriangleMesh smooth = longest_edge_first(first_mesh(0));
  EXPECT_EQ(resolve_load(smooth, paper_load, 100000), "");
  EXPECT_EQ(smooth.triangle_count(), before) << "nothing to do";

  // too fine for any mesh within the limit: said, not hidden
  const Field dust = [](double x, double y) {
    return std::sin(4000 * x) * std::sin(4000 * y) > 0.9 ? 1.0 : 0.0;
  };
  EXPECT_NE(resolve_load(smooth, dust, 2 * before).find("as sampled"), std::string::npos);
  // a strip per column that no point of the rule meets: each triangle misses a thousandth of the
  // load, all of them all
  const Field strips = [](double x, double) {
    return std::abs(32 * x - std::floor(32 * x) - 0.2) < 0.03 ? 100.0 : 0.0;
  };
  EXPECT_GT(solve_to(Scene({strips}), structured_mesh(32, {0}), {0.2}).certificate.norm,
            1);                                   // 1.4 on coarser meshes
  TriangleMesh signs = structured_mesh(32, {0});  // the same with a square of 1 everywhere
  resolve_load(
      signs, [&](double x, double y) { return strips(x, y) > 0 ? 1.0 : -1.0; }, 100000);
  EXPECT_GT(signs.triangle_count(), 4096);
}

TEST(SolveTo, RefusesWithASentence) {
  const Scene scene = scene_of(paper_load, 1e-2);
  for (const double asked : {0.0, 1.0, -1.0, std::nan("")})
    expect_refused([&] { solve_to(scene, first_mesh(0), {asked}); }, "above 0, below 1");
  expect_refused(
      [&] {
        solve_to(scene, first_mesh(0), {1e-1, Quantity::displacement, 100});
      },
      "cannot hold the first");
  expect_refused(
      [&] {
        solve_to(scene, first_mesh(0), {1e-1, Quantity::displacement, -1});
      },
      "1 or more");
  expect_refused(
      [&] {
        solve_to(Scene({paper_load}), first_mesh(0),
                 {1e-1, Quantity::displacement, 1e6, RefinementStrategy::extrude});
      },
      "no scaled layer");
  TriangleMesh free_below =
      structured_mesh(8);  // the layer that is asked about is not that of columns
  for (int e = 0; e < free_below.edge_count(); ++e)
    if (free_below.edge_tag[e] == EdgeTag::contact &&
        free_below.vertices(free_below.edges(e, 0), 0) < 0.5)
      free_below.edge_tag[e] = EdgeTag::free;
  expect_refused([&] { solve_to(scene, free_below, {1e-1}); }, "not that of columns");
  const auto millions = [&] {
    solve_to(scene, first_mesh(0), {1e-3, Quantity::displacement, 20000});
  };
  expect_refused(millions, "can be reached");
  const auto error = thrown<NotConverged>(millions);
  EXPECT_GT(error.reached, 1e-3);
  EXPECT_LE(error.steps, 6) << "refused by the quote, not by running into the limit";
}

// The kinks of this gap are finer than the first meshes, whose bounds rise as they meet them:
// extrapolated from there, more unknowns would seem to be needed than there may be.
TEST(SolveTo, QuotesNothingWhileTheBoundRises) {
  const Scene scene({paper_load}, StiffLayer{1e-2}, UnilateralContact{[](double x) {
                      return std::abs(std::sin(16 * std::numbers::pi * x));
                    }});
  const auto found = solve_to(scene, layered_mesh(8, 1e-2), {0.2, Quantity::displacement, 15000});
  EXPECT_GT(found.history.size(), 7u);
  for (std::size_t k = 1; k < found.history.size(); ++k)
    if (found.history[k].relative >= found.history[k - 1].relative) {
      EXPECT_EQ(found.history[k].predicted_unknowns, 0) << k;
    }
}

}  // namespace antilock::test::adapt_test::solve_to_test
