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

TEST(Coulomb, LimitsTheTangentialForceByThePressure) {
  for (const std::string effects :
       {"epsilon = 1\n", "epsilon = 1e-3\n", "[layer]\nepsilon = 0.1\n"}) {
    constexpr double coefficient = 0.3;
    const SceneRun run(scene("coulomb = 0.3\n" + effects));
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
    // in another program, with quadratic elements, it is from 0.07 to 0.13 for rubber
    EXPECT_LT(summary["coulomb"]["contraction"].get<double>(), 0.5) << effects;
    EXPECT_NEAR(summary["contact_force"]["tangential"].get<double>(), friction.sum() / 16, 1e-9);
  }
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
