// The layer in columns under any body: its shape, its tags, and what it does to P1.
#include "antilock/mesh/layered.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/exact/truth.hpp"
#include "support/bodies.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"

namespace antilock::layered_test {
namespace {

using namespace test;

int count(const TriangleMesh& mesh, EdgeTag tag) {
  return static_cast<int>(std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), tag));
}

struct Case {
  std::string name;
  TriangleMesh body;
  double body_area, outline, sigma;  ///< outline: the clamped length of the body
  int feet;                          ///< intervals of Sigma
};
std::vector<Case> bodies() {
  return {{"square", unstructured_mesh(8, {0}), 1, 3, 1, 1},
          {"square with a layer to leave out", unstructured_mesh(8), 1, 3, 1, 1},
          {"L", test::l_shape(8), 0.75, 3, 1, 1},
          {"two feet", test::bridge(8), 0.75, 4.5, 0.5, 2}};
}

TEST(ExtrudedLayer, FillsTheLayerUnderSigmaAndNothingElse) {
  for (const Case& c : bodies())
    for (const double epsilon : {1.0, 0.3, 0.0}) {
      const TriangleMesh mesh = extruded(c.body, epsilon);
      EXPECT_NEAR(area(mesh, Region::body), c.body_area, 1e-12) << c.name;
      EXPECT_NEAR(area(mesh, Region::layer), c.sigma, 1e-12) << c.name;
      EXPECT_NEAR(length(mesh, EdgeTag::sigma), c.sigma, 1e-12) << c.name;
      EXPECT_NEAR(length(mesh, EdgeTag::contact), c.sigma, 1e-12) << c.name;
      EXPECT_NEAR(length(mesh, EdgeTag::clamped), c.outline + 2 * c.feet, 1e-12) << c.name;  // sides of depth 1
      for (int e = 0; e < mesh.edge_count(); ++e) {
        if (mesh.edge_tag[e] != EdgeTag::contact) continue;
        for (const int v : {mesh.edges(e, 0), mesh.edges(e, 1)}) EXPECT_EQ(mesh.vertices(v, 1), -1) << c.name;
      }
    }
}

TEST(ExtrudedLayer, KeepsTheBodyFirstAndInItsOrder) {
  const TriangleMesh body = unstructured_mesh(8, {0}), mesh = extruded(body, 1);
  EXPECT_EQ(mesh.vertices.topRows(body.vertex_count()), body.vertices);
  EXPECT_EQ(mesh.triangles.topRows(body.triangle_count()), body.triangles);
}

TEST(ExtrudedLayer, HasCellsThatAreSquareInTheTrueLayer) {
  const TriangleMesh body = structured_mesh(8, {0});
  for (const auto& [epsilon, rows] : {std::pair{1.0, 8}, {0.5, 4}, {0.51, 5}, {0.125, 1}, {1e-6, 1}, {0.0, 1}}) {
    const TriangleMesh mesh = extruded(body, epsilon);
    EXPECT_EQ(mesh.triangle_count(), body.triangle_count() + 2 * 8 * rows) << epsilon;
    EXPECT_EQ(mesh.vertex_count(), body.vertex_count() + 9 * rows) << epsilon;
  }
  EXPECT_EQ(extruded(structured_mesh(100, {0}), 0.07).vertex_count(), 101 * 108)
      << "0.07 * 100 > 7 in double precision";
}

TEST(ExtrudedLayer, OfAStructuredBodyIsFigureThree) {
  const TriangleMesh mesh = extruded(structured_mesh(5, {0}), 1), figure = structured_mesh(5);
  EXPECT_EQ(mesh.vertex_count(), figure.vertex_count());
  EXPECT_EQ(mesh.edge_count(), figure.edge_count());
  // the same P1 problem in another order: the same energy to round-off
  const auto least = [](const TriangleMesh& m) {
    const Space space(m, p1());
    const auto problem = test::stiff_problem(space, 1e-2);
    return energy(problem, active_set(problem));
  };
  EXPECT_NEAR(least(mesh), least(figure), 1e-10);
}

// B v = 0 on every triangle of a column makes v equal at all its vertices: one function per column that is free.
TEST(ExtrudedLayer, LeavesP1OneFunctionInTheKernelPerInteriorColumn) {
  for (const Case& c : bodies())
    for (const double epsilon : {1.0, 0.0}) {
      const TriangleMesh mesh = extruded(c.body, epsilon);
      const Space space(mesh, p1());
      const int interior = count(mesh, EdgeTag::sigma) - c.feet;
      EXPECT_EQ(layer_kernel_dimension(test::stiff_problem(space, 0)), interior) << c.name << epsilon;
    }
}

TEST(LayeredMesh, CuresP1OfLocking) {
  const Truth truth(paper_sine_load(), 0, true, 14);
  const auto on_layer = [](const TriangleMesh& mesh) {
    const Space space(mesh, p1());
    const auto problem = test::stiff_problem(space, 0);
    const Solution solution = active_set(problem);
    double most = 0;
    for (const int i : problem.contact) most = std::max(most, solution.u(i));
    return most;
  };
  EXPECT_LT(on_layer(unstructured_mesh(16)), 1e-8);  // locked
  // the error at unknowns of P1 where it does not lock: 1.3e-3 on the structured mesh at 1/h = 16
  EXPECT_NEAR(on_layer(layered_mesh(16)), truth.max_on_contact(), 2.6e-3);
  EXPECT_NEAR(on_layer(layered_mesh(16, 0)), truth.max_on_contact(), 2.6e-3) << "one row serves the limit";
}

TEST(ExtrudedLayer, RefusesWhatItCannotStandUnder) {
  const TriangleMesh body = structured_mesh(4, {0});
  for (const double epsilon : {-1e-9, 1.5, nan})
    expect_refused([&] { extruded(body, epsilon); }, "accepted 0 <= epsilon <= 1");
  TriangleMesh lifted = body, clamped = body, low = unstructured_mesh(4, {0});
  lifted.vertices.col(1).array() += 0.5;
  expect_refused([&] { extruded(lifted, 1); }, "on the line y = 0");
  std::fill(clamped.edge_tag.begin(), clamped.edge_tag.end(), EdgeTag::clamped);
  expect_refused([&] { extruded(clamped, 1); }, "no edge in the group");
  low.vertices(low.vertex_count() - 1, 1) = -0.1;
  expect_refused([&] { extruded(low, 1); }, "above y = 0");
  expect_refused([] { layered_mesh(0); }, "cells = 0");
}

}  // namespace
}  // namespace antilock::layered_test
