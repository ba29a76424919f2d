// The layer in columns under any body: its shape, its tags, and what it does to P1.
#include "antilock/mesh/layered.hpp"
#include "antilock/adapt/solve_to.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "support/bodies.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"
#include "unit/mesh/helpers.hpp"

namespace antilock::test::mesh_test::layered_test {

struct Case {
  std::string name;
  TriangleMesh body;
  double body_area, outline, sigma;  ///< outline: the clamped length of the body
  int feet;                          ///< intervals of Sigma
};
std::vector<Case> bodies() {
  return {{"square", unstructured_mesh(8, {0}), 1, 3, 1, 1},
          {"L", test::l_shape(8), 0.75, 3, 1, 1},
          {"two feet", test::bridge(8), 0.75, 4.5, 0.5, 2}};
}

TEST(ExtrudedLayer, FillsTheLayerUnderSigmaAndNothingElse) {
  for (const Case& c : bodies())
    for (const double epsilon : {1.0, 0.3, 0.0}) {
      const TriangleMesh mesh = extruded(c.body, epsilon);
      EXPECT_EQ(mesh.vertices.topRows(c.body.vertex_count()), c.body.vertices)
          << "first, and in its order";
      EXPECT_EQ(mesh.triangles.topRows(c.body.triangle_count()), c.body.triangles);
      EXPECT_NEAR(area(mesh, Region::body), c.body_area, 1e-12) << c.name;
      EXPECT_NEAR(area(mesh, Region::layer), c.sigma, 1e-12) << c.name;
      EXPECT_NEAR(length(mesh, EdgeTag::sigma), c.sigma, 1e-12) << c.name;
      EXPECT_NEAR(length(mesh, EdgeTag::contact), c.sigma, 1e-12) << c.name;
      EXPECT_NEAR(length(mesh, EdgeTag::clamped), c.outline + 2 * c.feet, 1e-12)
          << c.name;  // sides of depth 1
      for (int e = 0; e < mesh.edge_count(); ++e) {
        if (mesh.edge_tag[e] != EdgeTag::contact) continue;
        for (const int v : {mesh.edges(e, 0), mesh.edges(e, 1)})
          EXPECT_EQ(mesh.vertices(v, 1), -1) << c.name;
      }
    }
}

TEST(ExtrudedLayer, HasCellsThatAreSquareInTheTrueLayer) {
  const TriangleMesh body = structured_mesh(8, {0});
  for (const auto& [epsilon, rows] :
       {std::pair{1.0, 8}, {0.5, 4}, {0.51, 5}, {0.125, 1}, {1e-6, 1}, {0.0, 1}}) {
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

// B v = 0 on every triangle of a column makes v equal at all its vertices: one function per column
// that is free.
TEST(ExtrudedLayer, LeavesP1OneFunctionInTheKernelPerInteriorColumn) {
  for (const Case& c : bodies())
    for (const double epsilon : {1.0, 0.0}) {
      const TriangleMesh mesh = extruded(c.body, epsilon);
      const Space space(mesh, p1());
      const int interior = count(mesh, EdgeTag::sigma) - c.feet;
      EXPECT_EQ(layer_kernel_dimension(test::stiff_problem(space, 0)), interior)
          << c.name << epsilon;
    }
}

/// Half of the ring between r = 1 and `held`, 2 or 1/2, its bottom Sigma = Gamma_C at r = 1; free
/// on y = 0, held at the other radius.
TriangleMesh half_ring(int cells, double held) {
  TriangleMesh mesh = structured_mesh(cells, {0});
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::clamped) continue;
    const Eigen::Vector2i ends = mesh.edges.row(e);
    const bool is_at_top = mesh.vertices(ends(0), 1) == 1 && mesh.vertices(ends(1), 1) == 1;
    mesh.edge_tag[e] = is_at_top ? dirichlet_group(1) : natural_group(0);
  }
  for (auto row : mesh.vertices.rowwise()) {
    const double r = 1 + (held - 1) * row(1),
                 angle = std::numbers::pi * (held > 1 ? 1 - row(0) : 1 + row(0));
    row << r * std::cos(angle), r * std::sin(angle);
  }
  return mesh;
}

// u = x at the held radius gives u = (a r + b / r) cos in the ring and (c r + d / r) cos in a layer
// of thickness t and modulus s / t, natural at its far side r = rho: c = d / rho^2, a + b = c + d,
// a - b = (s / t) (c - d). Of order h^2, as the polygon is: with J left out the error stays at 2 %
// and more.
TEST(ExtrudedLayer, AlongNormalsIsTheLayerOfARing) {
  const double t = 0.3, s = 0.5;
  const auto zero = [](double, double) { return 0.0; };
  const std::vector<BoundaryCondition> edges{
      {"sides"},
      {"held", BoundaryCondition::Kind::displacement, [](double x, double) { return x; }}};
  for (const double held : {2.0, 0.5})
    for (const Element* element : {&p1(), &crouzeix_raviart(), &p2()}) {
      const double rho = held > 1 ? 1 - t : 1 + t, w = 1 / (rho * rho);
      double a = (1 + w) + s / t * (w - 1), b = (1 + w) - s / t * (w - 1),
             scale = held / (a * held + b / held);
      a *= scale, b *= scale;
      std::vector<double> errors;
      for (const int cells : {8, 16, 32}) {
        const TriangleMesh mesh = extruded(half_ring(cells, held), t, true);
        const Space space(mesh, *element);
        const Solution u =
            active_set(assemble(Scene(Body{zero}, StiffLayer{t, s}, {}, edges), space));
        double error = 0;
        for (int k = 0; k < mesh.triangle_count(); ++k)
          for (const int i : space.cell_dofs().row(k)) {
            const Eigen::RowVector2d x = space.dof_coordinates().row(i);
            const double r = x.norm();
            if (mesh.region[k] == Region::body)
              error = std::max(error, std::abs(u.u(i) - (a + b / (r * r)) * x(0)));
          }
        for (const int i : space.contact_dofs()) {
          const Eigen::RowVector2d foot = space.dof_coordinates().row(i) + Eigen::RowVector2d(0, 1);
          error = std::max(
              error, std::abs(u.u(i) - scale * (2 * w * rho + 2 / rho) * foot(0) / foot.norm()));
        }
        errors.push_back(error);
      }
      EXPECT_LT(errors[2], 4e-3) << element->name() << held;
      EXPECT_GT(errors[1], 3.3 * errors[2]) << element->name() << held;
    }
}

TEST(ExtrudedLayer, AlongNormalsIsRefusedWhereThereIsNoSuchLayer) {
  TriangleMesh ring = half_ring(8, 2), turned = ring;
  expect_refused([&] { extruded(ring, 1, true); }, "meets itself");
  TriangleMesh slot =
      test::submesh(8, [](double x, double y) { return y < 0.25 || y > 0.5 || x < 0.25; });
  for (int e = 0; e < slot.edge_count(); ++e) {
    const Eigen::Vector2d heights = slot.vertices(slot.edges.row(e), 1);
    const bool level = heights(0) == 0.5 && heights(1) == 0.5;
    if (slot.edge_triangles(e, 1) < 0 && level) slot.edge_tag[e] = EdgeTag::contact;
  }
  expect_refused([&] { extruded(slot, 0.1, true); }, "every x once");
  turned.vertices = -ring.vertices;
  expect_refused([&] { extruded(turned, 0.1, true); }, "the body is not above its contact edge");
  expect_refused([&] { extruded(ring, 0.1); }, "on the line y = 0");
  for (EdgeTag& tag : ring.edge_tag)
    if (tag == natural_group(0)) tag = dirichlet_group(0);
  expect_refused([&] { extruded(ring, 0.1, true); }, "a displacement is given at");
  const TriangleMesh grown = extruded(half_ring(8, 2), 0.1, true);
  const Space space(grown, p1());
  const Scene scene(
      Body{paper_load}, StiffLayer{0.1}, UnilateralContact{[](double) { return 1.0; }},
      {{"in"}, {"out", BoundaryCondition::Kind::displacement, [](double, double) { return 0; }}});
  expect_refused([&] { SceneSweep(scene, space).set_epsilon(0.2); }, "along normals");
  expect_refused([&] { solve_to(scene, grown, {0.1}); }, "along the normals");
  TriangleMesh forgotten = grown;
  forgotten.curved_columns.clear();
  expect_refused([&] { assemble(scene, Space(forgotten, p1())); }, "Sigma on the line y = 0");
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
  expect_refused([] { extruded(structured_mesh(4), 1); }, "has a layer");
  expect_refused([] { layered_mesh(0); }, "cells = 0");
}

// A cube whose side x = 0 is held by a group, and whose other sides are free by another one.
TEST(ExtrudedLayer, TakesOverTheConditionsBesideSigmaInSpace) {
  Mesh body = unstructured_mesh(3, {0, CellKind::tetrahedron});
  for (int e = 0; e < body.edge_count(); ++e) {
    if (body.edge_tag[e] != EdgeTag::clamped) continue;
    double farthest = 0;
    for (const int v : body.edges.row(e)) farthest = std::max(farthest, body.vertices(v, 0));
    body.edge_tag[e] = farthest == 0 ? dirichlet_group(0) : natural_group(1);
  }
  for (const double epsilon : {0.0, 1.0}) {
    const Mesh mesh = extruded(body, epsilon);
    const auto area_of = [&](EdgeTag tag) {
      double area = 0;
      for (int e = 0; e < mesh.edge_count(); ++e)
        if (mesh.edge_tag[e] == tag) area += mesh.facet_measure(e);
      return area;
    };
    double volume = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t)
      if (mesh.region[t] == Region::layer) volume += mesh.measure(t);
    EXPECT_NEAR(volume, 1, 1e-13) << epsilon;
    EXPECT_NEAR(area_of(dirichlet_group(0)), 2, 1e-13) << epsilon;  // beside body and layer
    EXPECT_NEAR(area_of(natural_group(1)), 4, 1e-13) << epsilon;
    EXPECT_NEAR(area_of(EdgeTag::free), 3, 1e-13) << epsilon;
    EXPECT_NEAR(area_of(EdgeTag::sigma), 1, 1e-13) << epsilon;
    EXPECT_NEAR(area_of(EdgeTag::contact), 1, 1e-13) << epsilon;
  }
  expect_refused(
      [] {
        extruded(structured_mesh(2, {0, CellKind::quadrilateral}), 1);
      },
      "accepted: triangles and tetrahedra");
}

}  // namespace antilock::test::mesh_test::layered_test
