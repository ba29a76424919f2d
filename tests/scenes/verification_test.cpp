// The benchmarks of tutorials/guides/verification.md that scene files can say. Each reference value
// is a closed form, or is from a program that shares no line with this library.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::verification_test {

std::string example(const std::string& name) {
  return contents(std::string(EXAMPLE_SCENES) + "/" + name + ".toml");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the scene has no " + from);
  return text.replace(at, from.size(), to);
}

std::string with_element(const std::string& text, const std::string& element) {
  return replaced(text, "\"CR\"", "\"" + element + "\"");
}

// Poisson's ratio is 0, so u_x = 0. Block and coating are springs in a row: the block of stiffness
// 1 is shortened by p, and the coating of modulus 1 / t and thickness t by t^2 p.
TEST(Verification, ContactPatchTestHasAConstantPressure) {
  constexpr double pressure = 0.1 / (1 + 0.1 * 0.1);
  for (const std::string element : {"P1", "CR", "P2"}) {
    const SceneRun run(with_element(example("patch_test"), element));
    const auto summary = run.summary();
    const Csv table = read_csv(run.results / "contact.csv");
    // affine functions are in every space; the solve has the tolerance 1e-10
    EXPECT_LE((table.rows.col(2).array() - pressure).abs().maxCoeff(), 1e-8) << element;
    EXPECT_NEAR(summary["contact_force"]["normal"].get<double>(), pressure, 1e-8) << element;
    EXPECT_NEAR(summary["contact_force"]["moment"].get<double>(), pressure / 2, 1e-8) << element;
  }
}

/// Contact of a block with the parabola y = (x - 1/2)^2 of radius 1/2.
struct HertzContact {
  double force;
  double half_width;  ///< 2 (int p (x - 1/2)^2 / int p)^(1/2), a for Hertz's half ellipse
  double largest_pressure;
};

HertzContact hertz_contact(const SceneRun& run) {
  const Csv table = read_csv(run.results / "contact.csv");  // the edges have one length
  const Eigen::ArrayXd from_middle = table.rows.col(0).array() - 0.5;
  const Eigen::ArrayXd pressure = table.rows.col(2).array();
  const double second_moment = (pressure * from_middle.square()).sum() / pressure.sum();
  const double force = run.summary()["contact_force"]["normal"].get<double>();
  return {force, 2 * std::sqrt(second_moment), pressure.maxCoeff()};
}

TEST(Verification, HertzContactHasHalfWidthAndPressureOfItsForce) {
  const SceneRun run(example("hertz"));
  const HertzContact found = hertz_contact(run);
  constexpr double lambda = 1, mu = 1, radius = 0.5;
  const double modulus = 4 * mu * (lambda + mu) / (lambda + 2 * mu);
  const double a = std::sqrt(4 * found.force * radius / (std::numbers::pi * modulus));
  // The block is no half plane: with quadratic elements on graded meshes, in another program, the
  // half width is 0.55 % smaller than Hertz's. The rest is for the mesh, of which 12 edges are in
  // contact.
  EXPECT_NEAR(found.half_width, a, 0.03 * a);
  // An edge is a sixth of a. On it the half ellipse varies by 1 % in the middle.
  const double largest = 2 * found.force / (std::numbers::pi * a);
  EXPECT_NEAR(found.largest_pressure, largest, 0.06 * largest);
  // the force of the other program: 0.037751 and 0.037750 with 25 and 50 edges in contact
  EXPECT_NEAR(found.force, 0.03775, 0.02 * 0.03775);
  EXPECT_EQ(run.summary()["warning"], "");
}

// lambda = 1e4: the other program has the force 0.0613 to 0.0607 on its meshes.
TEST(Verification, HertzContactOfRubberLocksForP1) {
  const std::string rubber = replaced(example("hertz"), "epsilon = 1\n", "epsilon = 1e-4\n");
  constexpr double reference = 0.0610;
  const SceneRun cr(rubber);
  EXPECT_NEAR(hertz_contact(cr).force, reference, 0.03 * reference);
  EXPECT_EQ(cr.summary()["warning"], "");
  const SceneRun p1(with_element(rubber, "P1"));
  EXPECT_GT(hertz_contact(p1).force, 1.2 * reference);  // h^2 = 2.4 epsilon
  EXPECT_NE(p1.summary()["warning"].get<std::string>().find("locks"), std::string::npos);
}

// The numbers and tolerances of tests/unit/models/cook_test.cpp: the mean of u_y over the right
// side, which is mu times the work of the force 1 / mu.
TEST(Verification, CooksMembraneLocksForP1) {
  const std::string scene =
      replaced(example("cook"), "cook.msh", std::string(EXAMPLE_SCENES) + "/cook.msh");
  constexpr double mu = 0.375;
  for (const auto& [element, deflection, locks] : {std::tuple{"CR", 16.644870979853, false},
                                                   {"P2", 16.059639198545, false},
                                                   {"P1", 4.662290796348, true}}) {
    const SceneRun run(with_element(scene, element));
    const auto summary = run.summary();
    const double mean = mu * summary["compliance"]["value"].get<double>();
    EXPECT_NEAR(mean, deflection, 1e-7 * deflection) << element;
    const std::string warning = summary["warning"];
    EXPECT_EQ(warning.find("locks") != warning.npos, locks) << element << ": " << warning;
    EXPECT_FALSE(summary.contains("contact_force")) << element;
  }
}

/// u(1/2, 0) and u(1/2, -1) for the load sin(pi x). u = sin(pi x) g(y): g = a cosh(epsilon pi (y +
/// 1)) in the layer and g = 1 / pi^2 + b cosh(pi y) + c sinh(pi y) in the body. g and its flux are
/// continuous, and g(1) = 0.
std::pair<double, double> through_the_slab(double epsilon) {
  const double pi = std::numbers::pi;
  // c = a sinh(epsilon pi) / epsilon and b = a cosh(epsilon pi) - 1 / pi^2
  const double factor =
      std::cosh(epsilon * pi) * std::cosh(pi) + std::sinh(epsilon * pi) / epsilon * std::sinh(pi);
  const double a = (std::cosh(pi) - 1) / (pi * pi * factor);
  return {a * std::cosh(epsilon * pi), a};
}

TEST(Verification, AnisotropicDiffusionLocksForP1) {
  const auto [upper, lower] = through_the_slab(1e-5);
  EXPECT_NEAR(lower, 0.022417240299, 1e-12);  // the same system, solved by another program
  const SceneRun cr(example("anisotropic"));
  const auto found = cr.summary();
  // order h, h = 1/32, at a point
  EXPECT_NEAR(found["at"][0]["u"].get<double>(), upper, 0.05 * upper);
  EXPECT_NEAR(found["at"][1]["u"].get<double>(), lower, 0.05 * lower);
  EXPECT_EQ(found["warning"], "");
  const SceneRun p1(with_element(example("anisotropic"), "P1"));
  const auto locked = p1.summary();
  EXPECT_LT(std::abs(locked["at"][1]["u"].get<double>()), 0.5 * lower);
  EXPECT_NE(locked["warning"].get<std::string>().find("locks"), std::string::npos);
}

}  // namespace antilock::test::verification_test
