// The forms of (23): what they must vanish on, integrate exactly and be equal to.
#include <Eigen/Core>
#include <Eigen/LU>

#include "antilock/form/edge_forms.hpp"
#include "antilock/form/factored_form.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"
#include "support/dense.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"

namespace antilock::test::form_test::gradient_forms_test {

std::vector<const Element*> elements() {
  return {&p1(), &p2(), &p3(), &p4(), &crouzeix_raviart(), &p1_bubble()};
}

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
      worst = std::max(worst, std::abs(rule_mean(rule, a, b, degree - a - b) -
                                       exact_mean(a, b, degree - a - b)));
  return worst;
}

TEST(Quadrature, EveryTriangleRuleIsExactToItsDegree) {
  const double round_off =
      64 * std::numeric_limits<double>::epsilon();  // weights that sum to 1; measured 6.5 eps
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

/// The sum over triangles of int wx d/dx u d/dx v + wy d/dy u d/dy v, by a dense loop of its own:
/// gradients from the 3 x 3 system of a linear function through the corners, the products by a rule
/// of higher degree than needed.
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
    const Eigen::Matrix3d coefficients =
        corners.inverse();  // column i: lambda_i = c0 + c1 x + c2 y
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector3d l = rule.points.row(q);
      for (int i = 0; i < space.cell_dofs().cols(); ++i)
        for (int j = 0; j < space.cell_dofs().cols(); ++j) {
          const auto d = space.element().derivative(l);
          double product = 0;
          for (int m = 0; m < 3; ++m)
            for (int n = 0; n < 3; ++n)
              product += d(i, m) * d(j, n) *
                         (wx * coefficients(1, m) * coefficients(1, n) +
                          wy * coefficients(2, m) * coefficients(2, n));
          form(space.cell_dofs()(t, i), space.cell_dofs()(t, j)) +=
              rule.weights(q) * area * product;
        }
    }
  }
  return form;
}

TEST(Forms, AreTheDenseLoops) {
  for (const NamedSpace& space : two_square_spaces(3, elements())) {
    const FactoredForm strain = layer_strain(space);
    const Eigen::MatrixXd form = gradient_form(space, {2, 3}, {5, 7}),
                          a0 = test::gram(strain.b, strain.m);
    const Eigen::MatrixXd loop =
        dense_form(space, Region::body, 2, 3) + dense_form(space, Region::layer, 5, 7);
    const Eigen::MatrixXd loop0 = dense_form(space, Region::layer, 0, 1);
    EXPECT_LT((form - loop).cwiseAbs().maxCoeff(), 1e-12 * loop.cwiseAbs().maxCoeff())
        << space.name;
    EXPECT_LT((a0 - loop0).cwiseAbs().maxCoeff(), 1e-12 * loop0.cwiseAbs().maxCoeff())
        << space.name;
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
      EXPECT_EQ(strain.m.size(), layer * strain_quadrature(*element).weights.size());
    }
}

TEST(Forms, EnergyOfAPolynomialOfTheElementsDegreeIsExact) {
  for (const NamedSpace& space :
       two_square_spaces(3, {&p1(), &p2(), &p3(), &p4(), &crouzeix_raviart()})) {
    const int k = space.element().degree();
    const Eigen::VectorXd in_x = space.dof_coordinates().col(0).array().pow(k),
                          in_y = space.dof_coordinates().col(1).array().pow(k);
    const double square = k * k / (2.0 * k - 1);  // int_0^1 (k t^(k-1))^2, on (-1, 0) the same
    EXPECT_NEAR(in_x.dot(gradient_form(space, {2, 3}, {5, 7}) * in_x), 7 * square, 1e-10)
        << space.name << k;
    EXPECT_NEAR(in_y.dot(gradient_form(space, {2, 3}, {5, 7}) * in_y), 10 * square, 1e-10)
        << space.name << k;
    const FactoredForm strain = layer_strain(space);
    const Eigen::VectorXd slope = strain.b * in_y;
    EXPECT_NEAR(slope.dot(strain.m.cwiseProduct(slope)), square, 1e-11) << space.name << k;
  }
}

TEST(Forms, LoadOfAConstantSumsToTheAreaOfTheBodyAndDoesNotReachTheLayer) {
  for (const NamedSpace& space : two_square_spaces(5, elements())) {
    const Eigen::ArrayXd load = load_vector(space, [](double, double) { return 1.0; });
    EXPECT_NEAR(load.sum(), 1, 1e-13) << space.name;
    EXPECT_EQ((space.dof_coordinates().col(1).array() < 0).select(load, 0).abs().maxCoeff(), 0)
        << space.name;
  }
}

TEST(Forms, LoadIntegratesPolynomialsExactly) {
  for (const auto& [name, mesh] : two_square_meshes(3)) {
    const Space space(mesh, p1());
    const Eigen::VectorXd load =
        load_vector(space, [](double x, double y) { return x * x * y * y; });
    EXPECT_NEAR(load.sum(), 1.0 / 9, 1e-14) << name;  // degree 4
    EXPECT_NEAR(load.dot(space.dof_coordinates().col(0)), 1.0 / 12, 1e-14)
        << name;  // degree 5: x^3 y^2
  }
}

// P1 has three Gauss points on an edge, which are exact to degree 5.
TEST(Forms, EdgeLoadsAndSpringsIntegratePolynomialsExactlyAndRefuseWhatIsNotFinite) {
  const TriangleMesh mesh = structured_mesh(2);
  const Space space(mesh, p1());
  const auto to = [](int k) { return [k](double x, double) { return std::pow(x, k); }; };
  const Eigen::VectorXd x = space.dof_coordinates().col(0);
  EXPECT_NEAR(edge_load(space, EdgeTag::contact, to(4)).dot(x), 1.0 / 6, 1e-14);
  EXPECT_NEAR(x.dot(edge_mass(space, EdgeTag::contact, to(3)) * x), 1.0 / 6, 1e-14);
  EXPECT_NEAR(edge_load(space, EdgeTag::sigma, to(0)).sum(), 1, 1e-14);  // on both sides
  const auto below = [](double x, double) { return 0.5 - x; };
  expect_refused([&] { edge_mass(space, EdgeTag::contact, below); },
                 "spring: its stiffness is negative");
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
      // the hat min(x, 1 - x) with its peak at an unknown or between two: slopes are 1 and -1 but
      // near the peak
      const Eigen::ArrayXd x = space.dof_coordinates().col(0).array();
      const Eigen::VectorXd u = x.min(1 - x);
      const double energy = u.dot(form * u);
      EXPECT_NEAR(energy, element == &p1() ? 1 : 1 - 1.0 / 8, 1e-10)
          << element->name();  // gmsh's points: 1e-12 off
      // nothing but Sigma is touched
      for (int i = 0; i < space.size(); ++i) {
        if (space.dof_coordinates()(i, 1) > 0) {
          ASSERT_EQ(form.row(i).cwiseAbs().sum(), 0);
        }
      }
    }
  TriangleMesh mesh = structured_mesh(2, {0});
  Eigen::VectorXd given = Eigen::VectorXd::Zero(mesh.vertex_count());
  expect_refused([&] { ventcel_form(Space(mesh, p2()), given); }, "Ventcel");
  given(0) = 0.1;
  expect_refused([&] { ventcel_form(Space(mesh, p1()), given); },
                 "Sigma has an end at (0, 0) with u not 0");
  given(0) = 0;
  TriangleMesh bent = mesh;
  bent.vertices.row(1) += Eigen::RowVector2d(0, 0.1);
  expect_refused([&] { ventcel_form(Space(bent, p1()), given); }, "Sigma leaves its line");
  std::replace(mesh.edge_tag.begin(), mesh.edge_tag.end(), EdgeTag::clamped, EdgeTag::free);
  expect_refused([&] { ventcel_form(Space(mesh, p1()), given); }, "Sigma has an end at (0, 0);");
}

TEST(LoadVector, OfTheLayerIntegratesOverTheLayer) {
  const Space space(unstructured_mesh(6), crouzeix_raviart());
  const Field height = [](double, double y) { return y; };
  EXPECT_NEAR(load_vector(space, height, Region::layer).sum(), -0.5, 1e-12);
  EXPECT_NEAR(load_vector(space, height).sum(), 0.5, 1e-12);
}

// For f = 1 the load on the means and the load on the functions are both int v.
TEST(LoadVector, OnTheMeansWorksOnTheMeansAlone) {
  const auto f = [](double x, double y) { return 1 + x * x - 3 * x * y; };
  const auto one = [](double, double) { return 1.0; };
  const Space space(unstructured_mesh(3), hybrid_bdm1());
  const TriangleMesh& mesh = space.mesh();
  const Eigen::VectorXd load = mean_load_vector(space, f);
  EXPECT_LT((mean_load_vector(space, one) - load_vector(space, one)).cwiseAbs().maxCoeff(), 1e-14);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const double body = mesh.region[t] == Region::body ? 1 : 0;
    double mean = 0;  // of f, by the midpoints of the edges, exact for degree 2
    for (const auto point : midpoint_rule().points.rowwise())
      mean += f(point_in(mesh, t, point)(0), point_in(mesh, t, point)(1)) / 3;
    EXPECT_NEAR(load(space.cell_dofs()(t, 6)), body * mesh.area(t) * mean, 1e-14);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(load(space.cell_dofs()(t, i)), 0);
  }
  expect_refused([&] { mean_load_vector(Space(mesh, p1_bubble()), f); }, "no mean per triangle");
}

}  // namespace antilock::test::form_test::gradient_forms_test
