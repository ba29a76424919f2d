// The plate.
#include "antilock/exact/exact_plate.hpp"

namespace antilock::test::exact_test::exact_plate_test {

TEST(ExactPlate, SolvesItsEquations) {
  for (const double t : {1.0, 0.1, 1e-2, 1e-4, 1e-9, 0.0}) {
    SCOPED_TRACE(t);
    const ExactPlate exact(t);
    const double c = exact.contact_radius();
    EXPECT_NEAR(exact.deflection(1), 0, 1e-12);
    EXPECT_NEAR(exact.deflection(c * (1 + 1e-12)), -1, 1e-9);
    // w'(c) = 0, by three values that leave out the second derivative; the third adds some 1e-10 of
    // itself
    const auto w = [&](double way) { return exact.deflection(c * (1 + way)); };
    EXPECT_NEAR((4 * w(1e-5) - w(2e-5) - 3 * w(1e-12)) / (2e-5 * c), 0, 1e-5);
    EXPECT_GT(exact.contact_force(), 0);
    EXPECT_LT(exact.contact_force(), 256 * std::numbers::pi);
    EXPECT_NEAR(ExactPlate(t, 512, 2).contact_radius(), c, 1e-12);
  }
  EXPECT_NEAR(ExactPlate(1e-9).contact_radius(), ExactPlate(0).contact_radius(), 1e-7);
  EXPECT_THROW(ExactPlate(0, 63), Error);  // w(0) = -63/64 without the obstacle
}

}  // namespace antilock::test::exact_test::exact_plate_test
