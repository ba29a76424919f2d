// Errors on tetrahedra and on quadrilaterals, against functions whose errors are known.
#include "antilock/measure/errors.hpp"

#include "antilock/form/gradient_forms.hpp"
#include "support/scenes.hpp"

namespace antilock::test::measure_test::errors_in_space_test {

constexpr CellKind kind = CellKind::tetrahedron;
constexpr double round_off = 1e-12;

Reference quadratic() {
  return {[](double x, double y, double z) { return x * x - x * y + z * z; },
          [](double x, double y, double z) { return Eigen::Vector3d(2 * x - y, -x, 2 * z); },
          [](double, double, double z) { return 2 * z; }};
}

/// The interpolant and, on layers, the layer stress of epsilon = 1 at the rows of B.
Solution interpolant(const Space& space, const Reference& exact) {
  Solution solution;
  solution.u = dof_values(space, exact.value);
  const FactoredForm strain = layer_strain(space);
  solution.p = strain.b * solution.u;
  return solution;
}

TEST(ErrorsInSpace, VanishForAFunctionOfTheSpace) {
  const Reference exact = quadratic();
  for (const Mesh& mesh : {structured_mesh(2, {1, kind}), jittered_mesh(2, 0.15, {1, kind})}) {
    const Space space(mesh, p2(kind));
    const Errors errors = measure_errors(space, interpolant(space, exact), 1, exact);
    EXPECT_LT(errors.max_at_unknowns, round_off);
    EXPECT_LT(errors.max, round_off);
    EXPECT_LT(errors.h1, round_off);
    EXPECT_LT(errors.energy, round_off);
  }
}

// u_h = u + 1: the error is 1 in L-infinity, and the root of the volume, 2, in L2. Its gradient is
// 0.
TEST(ErrorsInSpace, AreThoseOfAConstant) {
  const Reference exact = quadratic();
  const Space space(structured_mesh(2, {1, kind}), p2(kind));
  Solution solution = interpolant(space, exact);
  solution.u.array() += 1;
  const Errors errors = measure_errors(space, solution, 1, exact);
  EXPECT_NEAR(errors.max_at_unknowns, 1, round_off);
  EXPECT_NEAR(errors.max, 1, round_off);
  EXPECT_NEAR(errors.l2, std::sqrt(2), round_off);
  EXPECT_NEAR(errors.h1, std::sqrt(2), round_off);
  EXPECT_LT(errors.energy, 1e-10);
}

// Each cell of P1 and CR on half the mesh width is one eighth of a cell, so that the interpolant of
// a quadratic has a quarter of the error in L2 and half of the one in H1. Kuhn's tetrahedra of a
// cube are halved into congruent ones.
TEST(ErrorsInSpace, OfInterpolantsOfAffineElementsHaveOrdersOneAndTwo) {
  const Reference exact = quadratic();
  for (const Element* element : {&p1(kind), &crouzeix_raviart(kind)}) {
    std::vector<Errors> errors;
    for (const int cells : {2, 4}) {
      const Space space(structured_mesh(cells, {1, kind}), *element);
      errors.push_back(measure_errors(space, interpolant(space, exact), 1, exact));
    }
    EXPECT_NEAR(errors[0].l2 / errors[1].l2, 4, 1e-9) << element->name();
    const double gradient_coarse = std::sqrt(std::pow(errors[0].h1, 2) - std::pow(errors[0].l2, 2));
    const double gradient_fine = std::sqrt(std::pow(errors[1].h1, 2) - std::pow(errors[1].l2, 2));
    EXPECT_NEAR(gradient_coarse / gradient_fine, 2, 1e-9) << element->name();
  }
}

// u = x y is in Q1 on rectangles, and u_h = u + 1 has the error 1. Its layer stress x is linear.
TEST(ErrorsOnQuadrilaterals, AreThoseOfAConstant) {
  const Reference bilinear{[](double x, double y) { return x * y; },
                           [](double x, double y) { return Eigen::Vector2d(y, x); },
                           [](double x, double) { return x; }};
  const Space space(structured_mesh(3, {1, CellKind::quadrilateral}), q1());
  Solution solution = interpolant(space, bilinear);
  Errors errors = measure_errors(space, solution, 1, bilinear);
  EXPECT_LT(errors.max + errors.h1 + errors.energy, round_off);
  solution.u.array() += 1;
  errors = measure_errors(space, solution, 1, bilinear);
  EXPECT_NEAR(errors.max, 1, round_off);
  EXPECT_NEAR(errors.h1, std::sqrt(2), round_off);
  EXPECT_LT(errors.energy, 1e-10);
}

// The same on cells that are no rectangles, where Q1 has the affine functions, and with one layer
// stress per cell.
TEST(ErrorsOnQuadrilaterals, VanishForAffineFunctions) {
  const Reference affine{[](double x, double y) { return x - 2 * y; },
                         [](double, double) { return Eigen::Vector2d(1, -2); },
                         [](double, double) { return -2.0; }};
  for (const Element* element : {&q1(), &q1(Integration::reduced), &rotated_q1_plus()}) {
    const Space space(jittered_mesh(3, 0.2, {1, CellKind::quadrilateral}), *element);
    const Errors errors = measure_errors(space, interpolant(space, affine), 1, affine);
    EXPECT_LT(errors.max + errors.h1 + errors.energy, round_off) << element->name();
  }
}

}  // namespace antilock::test::measure_test::errors_in_space_test
