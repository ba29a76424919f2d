// The rotated element: its unknowns, and its interpolant.
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/strain_projection.hpp"
#include "antilock/space/cell_map.hpp"
#include "support/scenes.hpp"

namespace antilock::test::space_test::rotated_q1_test {

constexpr CellKind kind = CellKind::quadrilateral;
/// The weights of gauss_rule are right to 1e-15, and a functional has some twenty.
constexpr double round_off = 1e-13;

TEST(RotatedQ1, FunctionalsAreDualToTheBasisAndSumToOne) {
  for (const Element* element : {&rotated_q1(), &rotated_q1_plus()})
    for (int i = 0; i < element->dofs(); ++i) {
      const DofFunctional functional = element->functional(i);
      EXPECT_NEAR(functional.weights.sum(), 1, round_off) << element->name();
      Eigen::VectorXd values = Eigen::VectorXd::Zero(element->dofs());
      for (Eigen::Index q = 0; q < functional.weights.size(); ++q)
        values += functional.weights(q) * element->basis(functional.points.row(q));
      EXPECT_LT((values - Eigen::VectorXd::Unit(element->dofs(), i)).norm(), round_off)
          << element->name() << i;
    }
}

TEST(RotatedQ1, DerivativesAreThoseOfTheBasis) {
  const Eigen::Vector2d xi(0.3, 0.8);
  const double step = 1e-3;  // quadratics: a central difference is exact
  for (const Element* element : {&rotated_q1(), &rotated_q1_plus()})
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d up = xi + step * Eigen::Vector2d::Unit(k),
                            down = xi - step * Eigen::Vector2d::Unit(k);
      const Eigen::VectorXd slope = (element->basis(up) - element->basis(down)) / (2 * step);
      EXPECT_LT((slope - element->derivative(xi).col(k)).norm(), 1e-11) << element->name();
    }
}

// A function of x alone has the mean strain 0 on each cell, whatever its shape.
TEST(RotatedQ1, InterpolantsOfFunctionsOfXHaveNoMeanStrain) {
  for (const Mesh& mesh : {jittered_mesh(4, 0.2, {1, kind}), unstructured_mesh(4, {1, kind})})
    for (const Element* element : {&rotated_q1(), &rotated_q1_plus()}) {
      const Space space(mesh, *element);
      // of degree 7 on an edge, for which the means are exact
      const Eigen::VectorXd u = dof_values(space, [](double x, double) { return std::pow(x, 7); });
      const FactoredForm strain = layer_strain(space);
      const FactoredForm mean = project_strain(strain, cell_projection(strain));
      EXPECT_LT((mean.b * u).cwiseAbs().maxCoeff(), 100 * round_off) << element->name();
      EXPECT_GT((strain.b * u).cwiseAbs().maxCoeff(), 0.01) << element->name();
    }
}

}  // namespace antilock::test::space_test::rotated_q1_test
