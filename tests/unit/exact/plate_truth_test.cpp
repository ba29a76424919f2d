// The plate.
#include "antilock/exact/plate_truth.hpp"

namespace antilock::test::exact_test::plate_truth_test {

TEST(PlateTruth, SolvesItsEquations) {
  for (const double t : {1.0, 0.1, 1e-2, 1e-4, 1e-9, 0.0}) {
    SCOPED_TRACE(t);
    const PlateTruth truth(t);
    const double c = truth.contact_radius();
    EXPECT_NEAR(truth.deflection(1), 0, 1e-12);
    EXPECT_NEAR(truth.deflection(c * (1 + 1e-12)), -1, 1e-9);
    // w'(c) = 0, by three values that leave out the second derivative; the third adds some 1e-10 of itself
    const auto w = [&](double way) { return truth.deflection(c * (1 + way)); };
    EXPECT_NEAR((4 * w(1e-5) - w(2e-5) - 3 * w(1e-12)) / (2e-5 * c), 0, 1e-5);
    EXPECT_GT(truth.contact_force(), 0);
    EXPECT_LT(truth.contact_force(), 256 * std::numbers::pi);
    EXPECT_NEAR(PlateTruth(t, 512, 2).contact_radius(), c, 1e-12);
  }
  EXPECT_NEAR(PlateTruth(1e-9).contact_radius(), PlateTruth(0).contact_radius(), 1e-7);
  EXPECT_THROW(PlateTruth(0, 63), Error);  // w(0) = -63/64 without the obstacle
}

}  // namespace antilock::test::exact_test::plate_truth_test
