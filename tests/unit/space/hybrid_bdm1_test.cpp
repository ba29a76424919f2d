// The element whose unknowns are means: its gradient is the L2 projection of the gradient, and
// controls all of it.
#include <Eigen/Dense>

#include "antilock/mesh/families.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/space.hpp"
#include "support/scenes.hpp"

namespace antilock::test::space_test::hybrid_bdm1_test {

/// Integrals of cubics times affine functions on meshes of a few triangles: a few round-offs of
/// numbers of size 10.
constexpr double round_off = 1e-13;

/// Coefficients (3 x 2, those of lambda_0, lambda_1, lambda_2) of the L2 projection of a field on
/// affine functions on triangle t. The Gram matrix of the lambda_i has the mean (1 + delta_ij) /
/// 12, and its inverse is 12 I - 3.
Eigen::Matrix<double, 3, 2> affine_projection(
    const Space& space, int t, const std::function<Eigen::Vector2d(double, double)>& field) {
  const Quadrature& rule = triangle_rule(8);
  Eigen::Matrix<double, 3, 2> moments = Eigen::Matrix<double, 3, 2>::Zero();
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const Eigen::Vector2d x = point_in(space.mesh(), t, rule.points.row(q));
    moments += rule.weights(q) * rule.points.row(q).transpose() * field(x(0), x(1)).transpose();
  }
  return (12 * Eigen::Matrix3d::Identity() - 3 * Eigen::Matrix3d::Ones()) * moments;
}

/// The gradient of the element at the corners of triangle t (3 x 2).
Eigen::Matrix<double, 3, 2> gradient_at_corners(const Space& space, int t,
                                                const Eigen::VectorXd& u) {
  Eigen::Matrix<double, 3, 2> gradient;
  for (int i = 0; i < 3; ++i)
    gradient.row(i) = u(space.cell_dofs().row(t)).transpose() *
                      space.element().derivative(Eigen::Vector3d::Unit(i)) *
                      barycentric_gradients(space.mesh(), t);
  return gradient;
}

// G(I_h v) = Pi_1 grad v. A smooth v of degree 5, for which all rules are exact.
TEST(HybridBdm1, InterpolationCommutesWithTheProjectionOfTheGradient) {
  const auto v = [](double x, double y) {
    return x * x * x * y * y - 2 * x * y * y * y + 0.5 * x * x + y;
  };
  const auto gradient = [](double x, double y) {
    return Eigen::Vector2d(3 * x * x * y * y - 2 * y * y * y + x,
                           2 * x * x * x * y - 6 * x * y * y + 1);
  };
  for (const char* family : {"structured", "columns", "jittered", "rows", "delaunay"}) {
    const Space space(mesh_family(family).mesh(4), hybrid_bdm1());
    const Eigen::VectorXd u = dof_values(space, v);
    double off = 0;
    for (int t = 0; t < space.mesh().triangle_count(); ++t)
      off = std::max(
          off, (gradient_at_corners(space, t, u) - affine_projection(space, t, gradient)).norm());
    // the weights of gauss_rule are eigenvectors, right to 1e-15; the gradient multiplies the
    // moments of v, up to 2, by numbers up to 12 / h = 48, and some of these terms add up
    EXPECT_LT(off, 4 * 1e-15 * 2 * 48) << family;
  }
}

// v_y = 0 on the layer, so that the rows of B vanish at the interpolant on any mesh.
TEST(HybridBdm1, InterpolantsOfMotionsWithoutStrainAreInTheKernel) {
  for (const MeshFamily& family : mesh_families()) {
    const Space space(family.mesh(6), hybrid_bdm1());
    const Eigen::VectorXd u =
        dof_values(space, [](double x, double) { return x * x * x * (1 - x) * (1 - x); });
    EXPECT_LT((stiff_problem(space, 0).b * u).lpNorm<Eigen::Infinity>(), round_off) << family.name;
  }
}

// The derivative of each basis function is the projection of that of the function, whose gradient
// is found by central differences; those of a cubic are off by 1e-9 with a step of 1e-5.
TEST(HybridBdm1, DerivativeIsTheProjectionOfThatOfTheBasis) {
  const Space space(structured_mesh(1), hybrid_bdm1());
  constexpr double step = 1e-5;
  for (int t = 0; t < space.mesh().triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> slopes = barycentric_gradients(space.mesh(), t);
    const Eigen::Vector2d corner = space.mesh().vertices.row(space.mesh().triangles(t, 0));
    for (int i = 0; i < 7; ++i) {
      const auto phi = [&](double x, double y) {
        Eigen::Vector3d lambda = slopes * (Eigen::Vector2d(x, y) - corner);
        lambda(0) += 1;
        return hybrid_bdm1().basis(lambda)(i);
      };
      const auto gradient = [&](double x, double y) {
        return Eigen::Vector2d((phi(x + step, y) - phi(x - step, y)) / (2 * step),
                               (phi(x, y + step) - phi(x, y - step)) / (2 * step));
      };
      const Eigen::VectorXd unit = Eigen::VectorXd::Unit(space.size(), space.cell_dofs()(t, i));
      EXPECT_LT(
          (gradient_at_corners(space, t, unit) - affine_projection(space, t, gradient)).norm(),
          1e-7)
          << i;
    }
  }
}

// Constants alone have the gradient 0: no stabilisation is needed.
TEST(HybridBdm1, GradientVanishesForConstantsAlone) {
  const Space space(jittered_mesh(3, 0.2), hybrid_bdm1());
  for (int t = 0; t < space.mesh().triangle_count(); ++t) {
    Eigen::Matrix<double, 6, 7> gradient;
    for (int i = 0; i < 7; ++i) {
      const Eigen::VectorXd unit = Eigen::VectorXd::Unit(space.size(), space.cell_dofs()(t, i));
      gradient.col(i) = gradient_at_corners(space, t, unit).reshaped();
    }
    EXPECT_LT((gradient * Eigen::Matrix<double, 7, 1>::Ones()).norm(), 1e-12);
    const Eigen::VectorXd values = gradient.jacobiSvd().singularValues();
    EXPECT_GT(values(5) / values(0), 1e-3);  // the sixth of six: far above round-off
  }
}

// The means of u_h with the hat functions of an edge are the same from both sides, for any
// unknowns.
TEST(HybridBdm1, HatMeansAreContinuousAcrossEdges) {
  const TriangleMesh mesh = unstructured_mesh(4);
  const Space space(mesh, hybrid_bdm1());
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(space.size(), 0, 40).array().sin();
  const auto [points, weights] = gauss_rule(4);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i)
      for (int end = 0; end < 2; ++end) {
        double mean = 0;
        for (Eigen::Index q = 0; q < points.size(); ++q) {
          const double hat = end == 0 ? 1 - points(q) : points(q);
          const Eigen::VectorXd basis = hybrid_bdm1().basis(on_edge(i, points(q)));
          mean += 2 * weights(q) * hat * basis.dot(u(space.cell_dofs().row(t)));
        }
        ASSERT_NEAR(mean, u(space.cell_dofs()(t, 2 * i + end)), round_off);
      }
}

// The value at the support point: exact for the interpolant of a quadratic, which the space
// contains.
TEST(HybridBdm1, ValuesAtTheUnknownsAreThoseOfTheFunctionNotTheMeans) {
  const auto v = [](double x, double y) { return x * x - 3 * x * y + 2 * y * y; };
  const Space space(unstructured_mesh(4), hybrid_bdm1());
  const Eigen::VectorXd means = dof_values(space, v), values = values_at_dofs(space, means);
  double off = 0;
  for (int i = 0; i < space.size(); ++i)
    off = std::max(
        off, std::abs(values(i) - v(space.dof_coordinates()(i, 0), space.dof_coordinates()(i, 1))));
  EXPECT_LT(off, round_off);
  EXPECT_GT((means - values).cwiseAbs().maxCoeff(),
            1e-3);  // of size h^2 times the second derivatives
}

}  // namespace antilock::test::space_test::hybrid_bdm1_test
