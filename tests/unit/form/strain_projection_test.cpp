// Means of the rows of B.
#include <Eigen/Core>

#include "antilock/form/elasticity_forms.hpp"
#include "antilock/form/factored_form.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/strain_projection.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/space.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"

namespace antilock::test::form_test::strain_projection_test {

Eigen::VectorXd noise(int size) {
  std::mt19937 generator(7);
  Eigen::VectorXd u(size);
  for (double& entry : u) entry = std::uniform_real_distribution(-1.0, 1.0)(generator);
  return u;
}
StrainProjection identity(Eigen::Index rows) {
  StrainProjection shares(rows, rows);
  shares.setIdentity();
  return shares;
}

TEST(Averaged, WithSharesOfOneIsTheFormItself) {
  const Space space(unstructured_mesh(4), p1());
  const FactoredForm strain = layer_strain(space),
                     same = project_strain(strain, identity(strain.m.size()));
  EXPECT_EQ((same.m - strain.m).norm(), 0);
  EXPECT_LT((same.b - strain.b).norm(), 1e-14 * strain.b.norm());
  EXPECT_EQ(same.cell, strain.cell);
}

TEST(Averaged, IsNeverLargerAndKeepsWhatItsMeansSee) {
  const TriangleMesh mesh = unstructured_mesh(8);
  for (const Element* element : {&p1(), &p2(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    const FactoredForm strain = layer_strain(space);
    // u = 2 x + 3 y has one strain; u = y^2 has several per mean, so that something is lost
    const Eigen::VectorXd linear = 2 * space.dof_coordinates().col(0) +
                                   3 * space.dof_coordinates().col(1),
                          bent = space.dof_coordinates().col(1).array().square(),
                          any = noise(space.size());
    for (const StrainProjection& shares :
         {box_projection(mesh, strain, 0.25, 0.25),
          vertex_projection(mesh, strain, strain_quadrature(*element))}) {
      const FactoredForm mean = project_strain(strain, shares);
      EXPECT_NEAR(mean.m.sum(), 1, 1e-12);  // the area of the layer
      EXPECT_NEAR(value(mean, linear), 9, 1e-11);
      EXPECT_LT(value(mean, any), 0.9 * value(strain, any));
      EXPECT_LT(value(mean, bent), value(strain, bent) - 1e-3);
      EXPECT_EQ(mean.cell.size(), static_cast<std::size_t>(mean.m.size()));
    }
  }
}

TEST(Averaged, OfBoxesIsTheProjectionOntoConstantsPerBox) {
  const TriangleMesh mesh = structured_mesh(4);
  const Space space(mesh, p1());
  const FactoredForm strain = layer_strain(space);
  const FactoredForm mean = project_strain(strain, box_projection(mesh, strain, 0.5, 0.5));
  ASSERT_EQ(mean.m.size(), 4);
  EXPECT_LT((mean.m.array() - 0.25).abs().maxCoeff(), 1e-14);
  // the mean of d/dy u over a square of the mesh is the difference of its edges; u = y^3 at the
  // vertices
  const Eigen::VectorXd u = space.dof_coordinates().col(1).array().cube(), means = mean.b * u;
  Eigen::VectorXd sorted = means;
  std::sort(sorted.begin(), sorted.end());
  const double upper = std::pow(0.5, 3) / 0.5,
               lower = (1 - std::pow(0.5, 3)) / 0.5;  // (b^3 - a^3) / (b - a)
  EXPECT_LT((sorted - Eigen::Vector4d(upper, upper, lower, lower)).cwiseAbs().maxCoeff(), 1e-13);
  // columns see the difference of two boundaries alone
  const FactoredForm column = project_strain(strain, box_projection(mesh, strain, 0.25, 1));
  ASSERT_EQ(column.m.size(), 4);
  EXPECT_LT(((column.b * u).array() - 1).abs().maxCoeff(), 1e-13);
}

TEST(Averaged, OfHatFunctionsIsTheIntegralAgainstThem) {
  const TriangleMesh mesh = unstructured_mesh(4, Domain{0});
  const Space quadratic(mesh, p2()), bubble(mesh, p1_bubble());
  const auto rows = [&](const Space& space) {
    const VectorSpace both{space, space};
    const FactoredForm div = divergence(both);
    return project_strain(div, vertex_projection(mesh, div, strain_quadrature(both)));
  };
  Eigen::VectorXd hat = Eigen::VectorXd::Zero(mesh.vertex_count()),
                  against_x = hat;  // int phi_i, int 2 x phi_i
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3i v = mesh.triangles.row(t);
    const Eigen::Vector3d x = mesh.vertices.col(0)(v);
    hat(v).array() += mesh.area(t) / 3;
    against_x(v).array() += 2 * mesh.area(t) / 12 * (x.sum() + x.array());
  }
  Eigen::VectorXd square = Eigen::VectorXd::Zero(2 * quadratic.size());  // u = (x^2, 0)
  square.head(quadratic.size()) = quadratic.dof_coordinates().col(0).array().square();
  const FactoredForm taylor_hood = rows(quadratic), mini = rows(bubble);
  EXPECT_LT((taylor_hood.m - hat).norm(), 1e-14);
  EXPECT_LT((taylor_hood.b * square - against_x.cwiseQuotient(hat)).norm(), 1e-12);
  // int phi_i d/dy b = -int b d/dy phi_i = -9/20 |T| d/dy phi_i: 27 l0 l1 l2 has the mean 27 * 2 /
  // 5!
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::VectorXd column = mini.b.col(bubble.size() + mesh.vertex_count() + t);
    const Eigen::Vector3d expected = -0.45 * mesh.area(t) * barycentric_gradients(mesh, t).col(1);
    for (int i = 0; i < 3; ++i) {
      const int v = mesh.triangles(t, i);
      EXPECT_NEAR(column(v) * hat(v), expected(i), 1e-14);
    }
  }
}

TEST(Averaged, RefusesSharesThatDoNotFit) {
  const TriangleMesh mesh = structured_mesh(2);
  const Space space(mesh, p1()), quadratic(mesh, p2());
  const FactoredForm strain = layer_strain(space);
  const auto rows = strain.m.size();
  StrainProjection half = 0.5 * identity(rows), negative = identity(rows), empty(rows + 1, rows);
  negative.coeffRef(0, 0) = -1;
  for (Eigen::Index r = 0; r < rows; ++r) empty.insert(r, r) = 1;
  expect_refused([&] { project_strain(strain, identity(3)); }, "weights of 3 rows");
  expect_refused([&] { project_strain(strain, half); }, "sum to 0.5");
  expect_refused([&] { project_strain(strain, (1 + 1e-9) * identity(rows)); },
                 "sum to 1.000000001");
  expect_refused([&] { project_strain(strain, negative); }, "weight -1 of row 0");
  expect_refused([&] { project_strain(strain, empty); }, "has no row of B");
  expect_refused([&] { box_projection(mesh, strain, 0, 1); }, "accepted: positive lengths");
  expect_refused([&] { box_projection(mesh, strain, 1e-30, 0.1); }, "a billionth");
  EXPECT_EQ(box_projection(mesh, strain, 1e-8, 2).rows(), 4)
      << "a box per place in x of the centroids";
  FactoredForm cut = layer_strain(quadratic), outside = strain;
  cut.cell.pop_back();
  expect_refused([&] { vertex_projection(mesh, cut, strain_quadrature(p2())); },
                 "not a point of the rule");
  const FactoredForm two = strain_form_factored(
      {space, space}, {{{1, 0, 0, 0}}, {{0, 0, 0, 1}}});  // two strains per point
  expect_refused([&] { vertex_projection(mesh, two, strain_quadrature(p1())); },
                 "not a point of the rule");
  outside.cell.back() = mesh.triangle_count();
  expect_refused([&] { box_projection(mesh, outside, 1, 1); }, "in cell 16 of a mesh of 16");
  expect_refused([&] { vertex_projection(mesh, strain, strain_quadrature(p2())); },
                 "not a point of the rule");
}

}  // namespace antilock::test::form_test::strain_projection_test
