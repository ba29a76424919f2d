// Coulomb's friction in scenes of plane strain.
#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::coulomb_test {

std::string scene(const std::string& model, int cells = 16) {
  return fmt::format(
      "[model]\nkind = \"plane strain\"\n{}[load]\nf = \"0\"\n[contact]\n"
      "gap = \"(x - 0.5)^2\"\n[mesh]\nkind = \"unstructured\"\ncells = {}\n"
      "[method]\nelement = \"CR\"\n",
      model, cells);
}

// The coefficients are so small that some of the contact slips.
TEST(Coulomb, LimitsTheTangentialForceByThePressure) {
  const struct {
    double coefficient;
    std::string effects;
  } blocks[] = {
      {0.3, "epsilon = 1\n"}, {0.1, "epsilon = 1e-3\n"}, {0.1, "[layer]\nepsilon = 0.1\n"}};
  for (const auto& [coefficient, effects] : blocks) {
    const SceneRun run(scene(fmt::format("coulomb = {}\n", coefficient) + effects));
    const auto summary = run.summary();
    const Csv table = read_csv(run.results / "contact.csv");
    ASSERT_EQ(table.header, "x,gap,pressure,friction");
    const Eigen::ArrayXd pressure = table.rows.col(2).array();
    const Eigen::ArrayXd friction = table.rows.col(3).array();
    // the limits are those of the pressure to 1e-8 of their sum, of some 8 edges
    const double off = 1e-6 * pressure.maxCoeff();
    EXPECT_LE((friction.abs() - coefficient * pressure).maxCoeff(), off) << effects;
    const Eigen::ArrayXd below_limit = coefficient * pressure - friction.abs();
    const Eigen::Index slipping = (below_limit.abs() <= off && pressure > off).count();
    EXPECT_GT(slipping, 0) << effects;
    EXPECT_GT(summary["coulomb"]["steps"].get<int>(), 2) << effects;
    // 0.05, 0.007 and 0.23
    EXPECT_LT(summary["coulomb"]["contraction"].get<double>(), 0.5) << effects;
    EXPECT_NEAR(summary["contact_force"]["tangential"].get<double>(), friction.sum() / 16, 1e-9);
  }
}

/// P1 on parallel triangles in nearly incompressible rubber, which locks.
std::string wedge(double coefficient) {
  return fmt::format(
      "[model]\nkind = \"plane strain\"\nepsilon = 1e-8\ncoulomb = {}\n[load]\nf = \"0\"\n"
      "[contact]\ngap = \"(x - 0.5)^2\"\n[mesh]\nkind = \"structured\"\ncells = 16\n"
      "[method]\nelement = \"P1\"\n",
      coefficient);
}

// Chapter 30: where all slips to one side, a step multiplies the change by the coefficient.
TEST(Coulomb, ContractsByTheCoefficientWhereP1Locks) {
  const SceneRun run(wedge(0.1));
  // the last change is 1e-8 of the limits, and the solves have the tolerance 1e-10
  EXPECT_NEAR(run.summary()["coulomb"]["contraction"].get<double>(), 0.1, 1e-3);
  const auto force = run.summary()["contact_force"];
  EXPECT_NEAR(force["tangential"].get<double>(), -0.1 * force["normal"].get<double>(), 1e-7);
}

TEST(Coulomb, IsRefusedWhereTheFixedPointDoesNotContract) {
  const SceneRun run(wedge(1));
  expect_no_answer(
      run, run.scene_path + ": solve: Coulomb friction: the fixed point does not contract", 3);
  EXPECT_NE(run.outcome.err.find("P1 locks"), std::string::npos) << run.outcome.err;
}

// Another program, with P2 on 12 x 12 squares, has the force 0.1604; without friction it is 0.1588.
TEST(Coulomb, HasTheContactForceOfAnotherProgram) {
  const auto force = [](const std::string& friction) {
    const SceneRun run(scene("epsilon = 1\n" + friction, 32));
    return run.summary()["contact_force"]["normal"].get<double>();
  };
  EXPECT_NEAR(force("coulomb = 0.3\n"), 0.1604, 0.01 * 0.1604);
  EXPECT_GT(force("coulomb = 0.3\n"), force(""));
}

// With a large coefficient nearly all of the contact sticks, as with a large bound of Tresca's.
TEST(Coulomb, SticksWithALargeCoefficient) {
  const SceneRun coulomb(scene("epsilon = 1\ncoulomb = 3\n"));
  const SceneRun tresca(scene("epsilon = 1\nfriction = \"100\"\n"));
  const double force = tresca.summary()["contact_force"]["normal"];
  EXPECT_NEAR(coulomb.summary()["contact_force"]["normal"].get<double>(), force, 1e-2 * force);
}

TEST(Coulomb, DoesNotStandBesideTresca) {
  expect_no_answer(SceneRun(scene("coulomb = 0.3\nfriction = \"0.1\"\n")),
                   "model.coulomb: stands beside friction");
  expect_no_answer(SceneRun(scene("coulomb = 0\n")), "model.coulomb: 0 is out of range");
}

}  // namespace antilock::test::coulomb_test
