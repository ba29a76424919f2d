// The exact solution in space, against its equations, its boundary conditions, and discrete
// solutions.
#include "antilock/exact/exact_solution_in_space.hpp"

#include "antilock/measure/errors.hpp"
#include "support/scenes.hpp"

namespace antilock::test::exact_test::exact_solution_in_space_test {

const std::vector<double> every_epsilon = {1, 0.1, 1e-4, 1e-20, 0};

ExactSolutionInSpace rich(double epsilon) {
  return {{{1, 2, {10, -3}}, {3, 1, {0, 0, 20}}, {2, 2, {-5}}}, epsilon};
}

double second_difference(const std::function<double(double)>& f, double t, double h) {
  return (f(t - h) - 2 * f(t) + f(t + h)) / (h * h);
}

// Differences with h = 1e-3 have errors of about h^2 times fourth derivatives of some 1e3, and
// round-off of about 1e-16 / h^2.
TEST(ExactSolutionInSpace, SolvesTheEquationOfTheBody) {
  constexpr double h = 1e-3;
  for (const double epsilon : every_epsilon) {
    const ExactSolutionInSpace u = rich(epsilon);
    for (const double z : {0.2, 0.5, 0.9}) {
      const double x = 0.3, y = 0.6;
      const double laplacian = second_difference([&](double t) { return u.value(t, y, z); }, x, h) +
                               second_difference([&](double t) { return u.value(x, t, z); }, y, h) +
                               second_difference([&](double t) { return u.value(x, y, t); }, z, h);
      EXPECT_NEAR(-laplacian, u.force(x, y, z), 1e-3) << epsilon << " " << z;
      EXPECT_NEAR(u.gradient(x, y, z)(2), (u.value(x, y, z + h) - u.value(x, y, z - h)) / (2 * h),
                  1e-4);
    }
  }
}

TEST(ExactSolutionInSpace, SolvesTheEquationOfTheLayer) {
  constexpr double h = 1e-3;
  for (const double epsilon : every_epsilon) {
    const ExactSolutionInSpace u = rich(epsilon);
    for (const double z : {-0.9, -0.5, -0.1}) {
      const double x = 0.3, y = 0.6;
      const double along = second_difference([&](double t) { return u.value(t, y, z); }, x, h) +
                           second_difference([&](double t) { return u.value(x, t, z); }, y, h);
      const double across = (u.layer_stress(x, y, z + h) - u.layer_stress(x, y, z - h)) / (2 * h);
      EXPECT_NEAR(along + across, 0, 1e-3) << epsilon << " " << z;
      EXPECT_NEAR(u.gradient(x, y, z)(2), epsilon * epsilon * u.layer_stress(x, y, z), 1e-13);
    }
  }
}

TEST(ExactSolutionInSpace, HasItsBoundaryConditions) {
  for (const double epsilon : every_epsilon) {
    const ExactSolutionInSpace u = rich(epsilon);
    const double x = 0.3, y = 0.6;
    EXPECT_NEAR(u.value(x, y, 1), 0, 1e-13);
    EXPECT_NEAR(u.value(0, y, 0.4), 0, 1e-13);
    EXPECT_NEAR(u.value(1, y, -0.4), 0, 1e-13);
    EXPECT_NEAR(u.value(x, 1, 0.4), 0, 1e-13);
    EXPECT_NEAR(u.layer_stress(x, y, -1), 0, 1e-13);  // free
    // on Sigma both displacement and stress are continuous
    EXPECT_NEAR(u.value(x, y, 0), u.value(x, y, -1e-14), 1e-12);
    EXPECT_NEAR(u.gradient(x, y, 0)(2), u.layer_stress(x, y, 0), 1e-11);
    EXPECT_GT(std::abs(u.value(x, y, 0)), 1e-3);
  }
}

/// The error in the energy norm on n^3 cubes over as many.
double energy_error(const ExactSolutionInSpace& u, double epsilon, const Element& element, int n) {
  const Space space(structured_mesh(n, {1, CellKind::tetrahedron}), element);
  const auto load = [&](double x, double y, double z) { return u.force(x, y, z); };
  const Reference exact{[&](double x, double y, double z) { return u.value(x, y, z); },
                        [&](double x, double y, double z) { return u.gradient(x, y, z); },
                        [&](double x, double y, double z) { return u.layer_stress(x, y, z); }};
  const Solution found = active_set(assemble(Scene({load}, StiffLayer{epsilon}), space));
  return measure_errors(space, found, epsilon, exact).energy;
}

// The mesh has vertical edges, so that P1 does not lock. An order of 1 halves the error, and an
// order of 2 quarters it; at these mesh widths the orders are not yet quite reached.
TEST(ExactSolutionInSpace, IsTheLimitOfDiscreteSolutions) {
  constexpr CellKind kind = CellKind::tetrahedron;
  for (const double epsilon : {1.0, 1e-4}) {
    const ExactSolutionInSpace u({{1, 1, {10}}}, epsilon);
    for (const Element* element : {&p1(kind), &crouzeix_raviart(kind), &p2(kind)}) {
      const double coarse = energy_error(u, epsilon, *element, 4);
      const double fine = energy_error(u, epsilon, *element, 8);
      const double least = element->degree() == 1 ? 1.8 : 3.2;
      EXPECT_GT(coarse / fine, least) << element->name() << " " << epsilon;
    }
  }
}

TEST(ExactSolutionInSpace, RefusesWhatIsOutOfRange) {
  expect_refused([] { ExactSolutionInSpace({{0, 1, {1}}}, 0.1); }, "1 or more");
  expect_refused([] { ExactSolutionInSpace({{1, 1, {1}}}, 2); }, "accepted: 0 to 1");
  expect_refused([] { ExactSolutionInSpace({{1, 1, std::vector<double>(14, 1)}}, 1); }, "up to 13");
  expect_refused([] { rich(1).value(0.5, 0.5, 1.5); }, "is outside");
  expect_refused([] { rich(1).layer_stress(0.5, 0.5, 0.5); }, "is outside");
}

}  // namespace antilock::test::exact_test::exact_solution_in_space_test
