#include <Eigen/LU>

#include "antilock/form/detail/averaged.hpp"
#include "antilock/form/elasticity_forms.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/form/quadrature.hpp"
#include "support/dense.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"

namespace antilock::test::form_test {

// ==== The forms of (23): what they must vanish on, integrate exactly and be equal to.

std::vector<const Element*> elements() { return {&p1(), &p2(), &p3(), &p4(), &crouzeix_raviart(), &p1_bubble()}; }

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

/// Mean over a triangle of lambda_0^a lambda_1^b lambda_2^c.
double exact_mean(int a, int b, int c) {
  return 2 * factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 2);
}

double rule_mean(const Quadrature& rule, int a, int b, int c) {
  double sum = 0;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    sum += rule.weights(q) * std::pow(rule.points(q, 0), a) * std::pow(rule.points(q, 1), b) *
           std::pow(rule.points(q, 2), c);
  return sum;
}

double worst_mean(const Quadrature& rule, int degree) {
  double worst = 0;
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; a + b <= degree; ++b)
      worst = std::max(worst, std::abs(rule_mean(rule, a, b, degree - a - b) - exact_mean(a, b, degree - a - b)));
  return worst;
}

TEST(Quadrature, EveryTriangleRuleIsExactToItsDegree) {
  const double round_off = 64 * std::numeric_limits<double>::epsilon();  // weights that sum to 1; measured 6.5 eps
  for (int degree = 0; degree <= 12; ++degree) {
    const Quadrature& rule = triangle_rule(degree);
    for (int lower = 0; lower <= degree; ++lower)
      EXPECT_LT(worst_mean(rule, lower), degree <= 5 ? 1e-15 : round_off) << degree;
    EXPECT_GT(rule.weights.minCoeff(), 0) << degree;  // M of the factored form must be positive
    EXPECT_GE(rule.points.minCoeff(), 0) << degree;
  }
  EXPECT_GT(worst_mean(radon_rule(), 6), 1e-5);
  EXPECT_GT(worst_mean(midpoint_rule(), 3), 1e-3);
  for (const int degree : {-1, 13}) expect_refused([&] { triangle_rule(degree); }, "0 to 12");
}

/// The sum over triangles of int wx d/dx u d/dx v + wy d/dy u d/dy v, by a dense loop of its own: gradients from the
/// 3 x 3 system of a linear function through the corners, the products by a rule of higher degree than needed.
Eigen::MatrixXd dense_form(const Space& space, Region region, double wx, double wy) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = triangle_rule(10);  // none that the forms use
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(space.size(), space.size());
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != region) continue;
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) {
      const auto v = mesh.vertices.row(mesh.triangles(t, i));
      corners.row(i) << 1, v(0), v(1);
    }
    const double area = 0.5 * std::abs(corners.determinant());
    const Eigen::Matrix3d coefficients = corners.inverse();  // column i: lambda_i = c0 + c1 x + c2 y
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector3d l = rule.points.row(q);
      for (int i = 0; i < space.unknowns().cols(); ++i)
        for (int j = 0; j < space.unknowns().cols(); ++j) {
          const auto d = space.element().derivative(l);
          double product = 0;
          for (int m = 0; m < 3; ++m)
            for (int n = 0; n < 3; ++n)
              product += d(i, m) * d(j, n) *
                         (wx * coefficients(1, m) * coefficients(1, n) + wy * coefficients(2, m) * coefficients(2, n));
          form(space.unknowns()(t, i), space.unknowns()(t, j)) += rule.weights(q) * area * product;
        }
    }
  }
  return form;
}

TEST(Forms, AreTheDenseLoops) {
  for (const SpaceOn& space : two_square_spaces(3, elements())) {
    const FactoredForm strain = layer_strain(space);
    const Eigen::MatrixXd form = gradient_form(space, {2, 3}, {5, 7}), a0 = test::gram(strain.b, strain.m);
    const Eigen::MatrixXd loop = dense_form(space, Region::body, 2, 3) + dense_form(space, Region::layer, 5, 7);
    const Eigen::MatrixXd loop0 = dense_form(space, Region::layer, 0, 1);
    EXPECT_LT((form - loop).cwiseAbs().maxCoeff(), 1e-12 * loop.cwiseAbs().maxCoeff()) << space.name;
    EXPECT_LT((a0 - loop0).cwiseAbs().maxCoeff(), 1e-12 * loop0.cwiseAbs().maxCoeff()) << space.name;
  }
}

TEST(Forms, RowsOfBBelongToTheLayerTrianglesAndMMeasuresThem) {
  for (const auto& [name, mesh] : two_square_meshes(4))
    for (const Element* element : elements()) {
      const FactoredForm strain = layer_strain(Space(mesh, *element));
      ASSERT_EQ(strain.b.rows(), strain.m.size());
      ASSERT_EQ(static_cast<Eigen::Index>(strain.cell.size()), strain.m.size());
      for (const int t : strain.cell) ASSERT_EQ(mesh.region[t], Region::layer);
      EXPECT_GT(strain.m.minCoeff(), 0);
      EXPECT_NEAR(strain.m.sum(), 1, 1e-13) << name;
      const auto layer = std::count(mesh.region.begin(), mesh.region.end(), Region::layer);
      EXPECT_EQ(strain.m.size(), layer * strain_rule(*element).weights.size());
    }
}

TEST(Forms, EnergyOfAPolynomialOfTheElementsDegreeIsExact) {
  for (const SpaceOn& space : two_square_spaces(3, {&p1(), &p2(), &p3(), &p4(), &crouzeix_raviart()})) {
    const int k = space.element().degree();
    const Eigen::VectorXd in_x = space.points().col(0).array().pow(k), in_y = space.points().col(1).array().pow(k);
    const double square = k * k / (2.0 * k - 1);  // int_0^1 (k t^(k-1))^2, on (-1, 0) the same
    EXPECT_NEAR(in_x.dot(gradient_form(space, {2, 3}, {5, 7}) * in_x), 7 * square, 1e-10) << space.name << k;
    EXPECT_NEAR(in_y.dot(gradient_form(space, {2, 3}, {5, 7}) * in_y), 10 * square, 1e-10) << space.name << k;
    const FactoredForm strain = layer_strain(space);
    const Eigen::VectorXd slope = strain.b * in_y;
    EXPECT_NEAR(slope.dot(strain.m.cwiseProduct(slope)), square, 1e-11) << space.name << k;
  }
}

TEST(Forms, LoadOfAConstantSumsToTheAreaOfTheBodyAndDoesNotReachTheLayer) {
  for (const SpaceOn& space : two_square_spaces(5, elements())) {
    const Eigen::ArrayXd load = load_vector(space, [](double, double) { return 1.0; });
    EXPECT_NEAR(load.sum(), 1, 1e-13) << space.name;
    EXPECT_EQ((space.points().col(1).array() < 0).select(load, 0).abs().maxCoeff(), 0) << space.name;
  }
}

TEST(Forms, LoadIntegratesPolynomialsExactly) {
  for (const auto& [name, mesh] : two_square_meshes(3)) {
    const Space space(mesh, p1());
    const Eigen::VectorXd load = load_vector(space, [](double x, double y) { return x * x * y * y; });
    EXPECT_NEAR(load.sum(), 1.0 / 9, 1e-14) << name;                        // degree 4
    EXPECT_NEAR(load.dot(space.points().col(0)), 1.0 / 12, 1e-14) << name;  // degree 5: x^3 y^2
  }
}

// P1 has three Gauss points on an edge, which are exact to degree 5.
TEST(Forms, EdgeLoadsAndSpringsIntegratePolynomialsExactlyAndRefuseWhatIsNotFinite) {
  const TriangleMesh mesh = structured_mesh(2);
  const Space space(mesh, p1());
  const auto to = [](int k) { return [k](double x, double) { return std::pow(x, k); }; };
  const Eigen::VectorXd x = space.points().col(0);
  EXPECT_NEAR(edge_load(space, EdgeTag::contact, to(4)).dot(x), 1.0 / 6, 1e-14);
  EXPECT_NEAR(x.dot(edge_mass(space, EdgeTag::contact, to(3)) * x), 1.0 / 6, 1e-14);
  EXPECT_NEAR(edge_load(space, EdgeTag::sigma, to(0)).sum(), 1, 1e-14);  // on both sides
  const auto below = [](double x, double) { return 0.5 - x; };
  expect_refused([&] { edge_mass(space, EdgeTag::contact, below); }, "spring: its stiffness is negative");
  const auto nowhere = [](double x, double) { return std::log(x - 0.5); };
  expect_refused([&] { edge_load(space, EdgeTag::contact, nowhere); }, "not finite");
  expect_refused([&] { load_vector(space, nowhere); }, "not finite");
}

TEST(Forms, VentcelTermIsTheEnergyOfTheTraceOnSigma) {
  for (const TriangleMesh& mesh : {structured_mesh(8, {0}), unstructured_mesh(8, {0})})
    for (const Element* element : {&p1(), &crouzeix_raviart()}) {
      const Space space(mesh, *element);
      const Eigen::MatrixXd form = ventcel_form(space, Eigen::VectorXd::Zero(mesh.vertex_count()));
      EXPECT_LT((form - form.transpose()).cwiseAbs().maxCoeff(), 1e-14);
      // the hat min(x, 1 - x) with its peak at an unknown or between two: slopes are 1 and -1 but near the peak
      const Eigen::ArrayXd x = space.points().col(0).array();
      const Eigen::VectorXd u = x.min(1 - x);
      const double energy = u.dot(form * u);
      EXPECT_NEAR(energy, element == &p1() ? 1 : 1 - 1.0 / 8, 1e-10) << element->name();  // gmsh's points: 1e-12 off
      // nothing but Sigma is touched
      for (int i = 0; i < space.size(); ++i) {
        if (space.points()(i, 1) > 0) {
          ASSERT_EQ(form.row(i).cwiseAbs().sum(), 0);
        }
      }
    }
  TriangleMesh mesh = structured_mesh(2, {0});
  Eigen::VectorXd given = Eigen::VectorXd::Zero(mesh.vertex_count());
  expect_refused([&] { ventcel_form(Space(mesh, p2()), given); }, "Ventcel");
  given(0) = 0.1;
  expect_refused([&] { ventcel_form(Space(mesh, p1()), given); }, "Sigma has an end at (0, 0) with u not 0");
  given(0) = 0;
  TriangleMesh bent = mesh;
  bent.vertices.row(1) += Eigen::RowVector2d(0, 0.1);
  expect_refused([&] { ventcel_form(Space(bent, p1()), given); }, "Sigma leaves its line");
  std::replace(mesh.edge_tag.begin(), mesh.edge_tag.end(), EdgeTag::clamped, EdgeTag::free);
  expect_refused([&] { ventcel_form(Space(mesh, p1()), given); }, "Sigma has an end at (0, 0);");
}

TEST(LoadVector, OfTheLayerIntegratesOverTheLayer) {
  const SpaceOn space(unstructured_mesh(6), crouzeix_raviart());
  const Field height = [](double, double y) { return y; };
  EXPECT_NEAR(load_vector(space, height, Region::layer).sum(), -0.5, 1e-12);
  EXPECT_NEAR(load_vector(space, height).sum(), 0.5, 1e-12);
}

// ==== Means of the rows of B.

Eigen::VectorXd noise(int size) {
  std::mt19937 generator(7);
  Eigen::VectorXd u(size);
  for (double& entry : u) entry = std::uniform_real_distribution(-1.0, 1.0)(generator);
  return u;
}
Shares identity(Eigen::Index rows) {
  Shares shares(rows, rows);
  shares.setIdentity();
  return shares;
}

TEST(Averaged, WithSharesOfOneIsTheFormItself) {
  const SpaceOn space(unstructured_mesh(4), p1());
  const FactoredForm strain = layer_strain(space), same = averaged(strain, identity(strain.m.size()));
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
    const Eigen::VectorXd linear = 2 * space.points().col(0) + 3 * space.points().col(1),
                          bent = space.points().col(1).array().square(), any = noise(space.size());
    for (const Shares& shares :
         {box_shares(mesh, strain, 0.25, 0.25), vertex_shares(mesh, strain, strain_rule(*element))}) {
      const FactoredForm mean = averaged(strain, shares);
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
  const FactoredForm mean = averaged(strain, box_shares(mesh, strain, 0.5, 0.5));
  ASSERT_EQ(mean.m.size(), 4);
  EXPECT_LT((mean.m.array() - 0.25).abs().maxCoeff(), 1e-14);
  // the mean of d/dy u over a square of the mesh is the difference of its edges; u = y^3 at the vertices
  const Eigen::VectorXd u = space.points().col(1).array().cube(), means = mean.b * u;
  Eigen::VectorXd sorted = means;
  std::sort(sorted.begin(), sorted.end());
  const double upper = std::pow(0.5, 3) / 0.5, lower = (1 - std::pow(0.5, 3)) / 0.5;  // (b^3 - a^3) / (b - a)
  EXPECT_LT((sorted - Eigen::Vector4d(upper, upper, lower, lower)).cwiseAbs().maxCoeff(), 1e-13);
  // columns see the difference of two boundaries alone
  const FactoredForm column = averaged(strain, box_shares(mesh, strain, 0.25, 1));
  ASSERT_EQ(column.m.size(), 4);
  EXPECT_LT(((column.b * u).array() - 1).abs().maxCoeff(), 1e-13);
}

TEST(Averaged, OfHatFunctionsIsTheIntegralAgainstThem) {
  const TriangleMesh mesh = unstructured_mesh(4, Domain{0});
  const Space quadratic(mesh, p2()), bubble(mesh, p1_bubble());
  const auto rows = [&](const Space& space) {
    const VectorSpace both{space, space};
    const FactoredForm div = divergence(both);
    return averaged(div, vertex_shares(mesh, div, divergence_rule(both)));
  };
  Eigen::VectorXd hat = Eigen::VectorXd::Zero(mesh.vertex_count()), against_x = hat;  // int phi_i, int 2 x phi_i
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3i v = mesh.triangles.row(t);
    const Eigen::Vector3d x = mesh.vertices.col(0)(v);
    hat(v).array() += mesh.area(t) / 3;
    against_x(v).array() += 2 * mesh.area(t) / 12 * (x.sum() + x.array());
  }
  Eigen::VectorXd square = Eigen::VectorXd::Zero(2 * quadratic.size());  // u = (x^2, 0)
  square.head(quadratic.size()) = quadratic.points().col(0).array().square();
  const FactoredForm taylor_hood = rows(quadratic), mini = rows(bubble);
  EXPECT_LT((taylor_hood.m - hat).norm(), 1e-14);
  EXPECT_LT((taylor_hood.b * square - against_x.cwiseQuotient(hat)).norm(), 1e-12);
  // int phi_i d/dy b = -int b d/dy phi_i = -9/20 |T| d/dy phi_i: 27 l0 l1 l2 has the mean 27 * 2 / 5!
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
  Shares half = 0.5 * identity(rows), negative = identity(rows), empty(rows + 1, rows);
  negative.coeffRef(0, 0) = -1;
  for (Eigen::Index r = 0; r < rows; ++r) empty.insert(r, r) = 1;
  expect_refused([&] { averaged(strain, identity(3)); }, "shares of 3 rows");
  expect_refused([&] { averaged(strain, half); }, "sum to 0.5");
  expect_refused([&] { averaged(strain, (1 + 1e-9) * identity(rows)); }, "sum to 1.000000001");
  expect_refused([&] { averaged(strain, negative); }, "share -1 of row 0");
  expect_refused([&] { averaged(strain, empty); }, "has no row of B");
  expect_refused([&] { box_shares(mesh, strain, 0, 1); }, "accepted: positive lengths");
  expect_refused([&] { box_shares(mesh, strain, 1e-30, 0.1); }, "a billionth");
  EXPECT_EQ(box_shares(mesh, strain, 1e-8, 2).rows(), 4) << "a box per place in x of the centroids";
  FactoredForm cut = layer_strain(quadratic), outside = strain;
  cut.cell.pop_back();
  expect_refused([&] { vertex_shares(mesh, cut, strain_rule(p2())); }, "not a point of the rule");
  const FactoredForm two = strain_rows({space, space}, {{{1, 0, 0, 0}}, {{0, 0, 0, 1}}});  // two strains per point
  expect_refused([&] { vertex_shares(mesh, two, strain_rule(p1())); }, "not a point of the rule");
  outside.cell.back() = mesh.triangle_count();
  expect_refused([&] { box_shares(mesh, outside, 1, 1); }, "in cell 16 of a mesh of 16");
  expect_refused([&] { vertex_shares(mesh, strain, strain_rule(p2())); }, "not a point of the rule");
}

}  // namespace antilock::test::form_test
