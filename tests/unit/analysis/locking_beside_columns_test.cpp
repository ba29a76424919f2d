// The energy that P1 and P2 lose on tetrahedra, held against that of the exact solution.
#include "antilock/analysis/locking_beside_columns.hpp"
#include "antilock/analysis/locking_beside_cr.hpp"
#include "antilock/analysis/locking_report.hpp"
#include "antilock/exact/exact_solution_in_space.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "support/scenes.hpp"

namespace antilock::test::analysis_test::locking_beside_columns_test {

using std::numbers::pi;
constexpr CellKind kind = CellKind::tetrahedron;

double load(double x, double y, double z) {
  return 40 * std::pow(1 - z, 3) * std::sin(2 * pi * x) * std::sin(pi * y);
}

/// J(u) = -L(u) / 2 without an obstacle.
double exact_energy(double epsilon) {
  const ExactSolutionInSpace u({{2, 1, {40, -120, 120, -40}}}, epsilon);
  const auto [points, weights] = gauss_rule(20);
  double work = 0;
  for (Eigen::Index q = 0; q < points.size(); ++q)
    work += weights(q) * load(0.25, 0.5, points(q)) * u.value(0.25, 0.5, points(q));
  return -work / 8;  // on each level (sin 2 pi x sin pi y)^2 has the mean 1/4
}

Result solved(const Scene& scene, const Mesh& mesh, const Element& element) {
  Result result{.space = Space(mesh, element)};
  result.problem = assemble(scene, result.space);
  result.solution = active_set(result.problem);
  return result;
}

/// (J(u_h) - J) / (J(v_0) - J) for an energy J.
double true_share(const Result& result, double least) {
  const VariationalInequality at_rest = with_layer_at_rest(result.problem, result.space);
  return (energy(result.problem, result.solution) - least) /
         (energy(at_rest, active_set(at_rest)) - least);
}

const std::vector<Mesh>& meshes() {
  static const std::vector<Mesh> all{jittered_mesh(5, 0.2, {1, kind}),
                                     unstructured_mesh(4, {1, kind}),
                                     unstructured_mesh(6, {1, kind})};
  return all;
}

TEST(LossBesideColumns, HasAShareBelowTheTrueOne) {
  for (const double epsilon : {1.0, 0.1, 1e-2, 1e-4, 0.0}) {
    const Scene scene(Body{load}, StiffLayer{epsilon});
    const double exact = exact_energy(epsilon);
    for (const Mesh& mesh : meshes())
      for (const Element* element : {&p1(kind), &p2(kind)}) {
        if (element == &p2(kind) && mesh.vertex_count() > 300) continue;
        const Result result = solved(scene, mesh, *element);
        const LossBesideColumns loss = loss_beside_columns(scene, result);
        const double share = loss.proved_share(), all = true_share(result, exact);
        EXPECT_EQ(share, loss.estimated_share()) << "there is no obstacle";
        EXPECT_LE(share, all) << element->name() << " " << epsilon;
        EXPECT_LE(loss.lower_bound, energy(result.problem, result.solution) - exact);
        if (element == &p1(kind) && epsilon <= 1e-2) {
          EXPECT_GT(share, 0.5 * all) << epsilon;
        }
        if (element == &p1(kind) && epsilon <= 1e-4) {
          EXPECT_GT(share, 0.99) << epsilon;
        }
      }
  }
}

// A concave gap: the P1 function through the obstacle at vertices lies above it, so that P1 on
// columns is in K, and its energy on a fine mesh is not below J(u).
TEST(LossBesideColumns, HasAShareBelowTheTrueOneInContact) {
  const auto gap = [](double x, double y) { return 0.02 - 0.01 * (x * x + y * y); };
  for (const double epsilon : {0.1, 1e-2, 0.0}) {
    const Scene scene(Body{load}, StiffLayer{epsilon}, UnilateralContact{gap});
    const Result fine = solved(scene, structured_mesh(12, {1, kind}), p1(kind));
    const double least = energy(fine.problem, fine.solution);
    for (const Mesh& mesh : meshes()) {
      const Result result = solved(scene, mesh, p1(kind));
      const LossBesideColumns loss = loss_beside_columns(scene, result);
      EXPECT_EQ(loss.lower_bound, loss.estimate);
      EXPECT_LE(loss.proved_share(), true_share(result, least)) << epsilon;
    }
  }
}

// A needle of the obstacle between two vertices is no bound of u_c, and one of the function in K.
TEST(LossBesideColumns, LiftsAboveTheObstacleBetweenVertices) {
  const auto needle = [](double x, double y) {
    return std::abs(x - 0.5) + std::abs(y - 0.5) < 0.2 ? 0.0 : 0.2;
  };
  const Mesh& mesh = meshes()[1];
  const Scene smooth(Body{load}, StiffLayer{1e-3}, UnilateralContact{[](double) { return 0.2; }});
  const Scene rough(Body{load}, StiffLayer{1e-3}, UnilateralContact{needle});
  const LossBesideColumns without = loss_beside_columns(smooth, solved(smooth, mesh, p1(kind)));
  const LossBesideColumns with = loss_beside_columns(rough, solved(rough, mesh, p1(kind)));
  EXPECT_EQ(without.lower_bound, without.estimate);
  EXPECT_LT(with.lower_bound, 0.9 * with.estimate);
}

// (22) on its own mesh, whose layer has the depth epsilon.
TEST(LossBesideColumns, KnowsTheThinLayer) {
  const Scene thin(Body{load}, ThinLayer{0.125}), scaled(Body{load}, StiffLayer{0.125});
  const Result result = solved(thin, unstructured_mesh(4, {0.125, kind}), p1(kind));
  const LossBesideColumns loss = loss_beside_columns(thin, result);
  EXPECT_LE(loss.proved_share(), true_share(result, exact_energy(0.125)));
  Mesh stretched = result.space.mesh();
  for (double& z : stretched.vertices.col(2))
    if (z < 0) z /= 0.125;
  const LossBesideColumns of_scaled =
      loss_beside_columns(scaled, solved(scaled, stretched, p1(kind)));
  EXPECT_NEAR(loss.estimate, of_scaled.estimate, 1e-9 * loss.reference);
}

// The top is moved, and the layer below a body with free sides follows: neither the loss nor what
// it is compared with changes.
TEST(LossBesideColumns, DoesNotDependOnAMotionAsAWhole) {
  Mesh mesh = meshes()[0];
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::clamped) {
      const bool of_top = (mesh.vertices.col(2)(mesh.edges.row(e)).array() == 1).all();
      mesh.edge_tag[e] = of_top ? dirichlet_group(0) : EdgeTag::free;
    }
  const auto moved_by = [&](double distance) {
    const BoundaryCondition top{"top", BoundaryCondition::Kind::displacement,
                                [=](double) { return distance; }};
    const Scene scene(Body{load}, StiffLayer{1e-2}, std::nullopt, {top});
    return loss_beside_columns(scene, solved(scene, mesh, p1(kind)));
  };
  const LossBesideColumns at_home = moved_by(0);
  EXPECT_GT(at_home.proved_share(), 0.2);  // 0.247: layers with free sides keep affine functions
  for (const double distance : {-1e3, 1.0, 1e3})
    EXPECT_NEAR(moved_by(distance).proved_share(), at_home.proved_share(), 1e-4) << distance;
  // so far away the energies, of the size 0.1, are round-off
  EXPECT_EQ(moved_by(1e9).proved_share(), 0);
}

TEST(LossBesideColumns, RefusesOtherSides) {
  const Scene scene(Body{load}, StiffLayer{1e-2});
  Result result = solved(scene, meshes()[1], p1(kind));
  EXPECT_NO_THROW(loss_beside_columns(scene, result));
  Mesh mixed = meshes()[1];
  for (int e = 0; e < mixed.edge_count(); ++e) {
    const bool of_layer = mixed.region[mixed.edge_triangles(e, 0)] == Region::layer;
    if (of_layer && mixed.edge_tag[e] == EdgeTag::clamped &&
        mixed.vertices(mixed.edges(e, 0), 0) == 0)
      mixed.edge_tag[e] = EdgeTag::free;
  }
  result = solved(scene, mixed, p1(kind));
  EXPECT_NE(refusal([&] { loss_beside_columns(scene, result); }).find("all clamped or all free"),
            std::string::npos);
  // the report has an estimate
  const LockingReport report = *report_locking(scene, result);
  EXPECT_FALSE(report.lost);
  EXPECT_NE(report.text().find("with CR"), std::string::npos) << report.text();
  EXPECT_NE(refusal([&] {
              loss_beside_columns(scene, solved(scene, unstructured_mesh(4), p1()));
            }).find("on tetrahedra"),
            std::string::npos);
}

}  // namespace antilock::test::analysis_test::locking_beside_columns_test
