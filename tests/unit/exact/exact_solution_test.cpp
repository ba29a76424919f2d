// The truth is checked from outside: against the differential equations, the conditions on Sigma
// and Gamma_C, closed forms, refinement, and the values that an independent script gave.
#include "antilock/exact/exact_solution.hpp"
#include "antilock/exact/contact_line.hpp"
#include "antilock/exact/exact_norms.hpp"
#include "antilock/exact/exact_plate.hpp"
#include "antilock/exact/exact_table.hpp"
#include "antilock/exact/sine_transform.hpp"
#include "antilock/exact/wave.hpp"
#include "support/scenes.hpp"

namespace antilock::test::exact_test::exact_solution_test {

constexpr double pi = std::numbers::pi;
constexpr int moderate = 13;  // 2^13 points: enough where the test is about structure, not digits
const std::vector<double> every_epsilon = {
    1, 0.3, 1e-2, 1e-4, 1e-8, 1e-20, std::numeric_limits<double>::denorm_min(), 0};

SineLoad rich_load() { return {{{1, {0, -30}}, {3, {-20, 5, 9}}, {8, {100}}}}; }
SineLoad lifting_load() { return {{{1, {10}}}}; }
SineLoad pressing_load() { return {{{1, {-10, 0, -3}}}}; }

double second_difference(const std::function<double(double)>& f, double t, double h) {
  return (f(t - h) - 2 * f(t) + f(t + h)) / (h * h);
}
double difference(const std::function<double(double)>& f, double t, double h) {
  return (f(t + h) - f(t - h)) / (2 * h);
}

// ---- Transforms and closed forms.

TEST(SineTransform, SumsSinesAndCosinesAndInverts) {
  Eigen::VectorXd modes = Eigen::VectorXd::Zero(65), cosines = modes;
  modes(1) = 2, modes(5) = -1, modes(63) = 0.5;
  cosines(0) = 3, cosines(7) = 1, cosines(64) = -2;
  Eigen::VectorXd points = modes, even = cosines;
  points_from_modes(points);
  cosine_points(even);
  for (int j = 0; j <= 64; ++j) {
    const double x = j / 64.0;
    EXPECT_NEAR(points(j),
                2 * std::sin(pi * x) - std::sin(5 * pi * x) + 0.5 * std::sin(63 * pi * x), 1e-13);
    EXPECT_NEAR(even(j), 3 + std::cos(7 * pi * x) - 2 * std::cos(64 * pi * x), 1e-13);
  }
  modes_from_points(points);
  EXPECT_LT((points - modes).norm(), 1e-14);
}

TEST(LoadResponse, SolvesItsEquationWithBothEndsHeld) {
  const LoadResponse response(2, {1, -2, 0, 4, 0.5});
  const double a = 2 * pi;
  EXPECT_NEAR(response.value(0), 0, 1e-16);
  EXPECT_NEAR(response.value(1), 0, 1e-16);
  EXPECT_DOUBLE_EQ(response.pull(), response.slope(0));
  double pull = 0, work = 0;  // their integrals, by the midpoint rule: error h^2 / 24 times second
                              // derivatives below 40
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double y = (i + 0.5) / n;
    pull += response.force(y) * std::sinh(a * (1 - y)) / std::sinh(a) / n;
    work += response.force(y) * response.value(y) / n;
  }
  EXPECT_NEAR(response.pull(), pull, 1e-8);
  EXPECT_NEAR(response.work(), work, 1e-8);
  for (const double y : {0.1, 0.5, 0.93}) {
    const double curvature =
        second_difference([&](double t) { return response.value(t); }, y, 1e-3);
    EXPECT_NEAR(-curvature + a * a * response.value(y), response.force(y),
                1e-5);  // h^2 / 12 G'''' with G'''' < 110
    EXPECT_NEAR(difference([&](double t) { return response.value(t); }, y, 1e-4), response.slope(y),
                1e-7);
  }
}

TEST(LoadResponse, LargeWaveNumbersStayFinite) {
  const LoadResponse response(100000, {1, 1});
  const double a = 1e5 * pi;
  EXPECT_NEAR(response.value(0.5) * a * a, 1.5, 1e-12);  // f / a^2 outside the boundary layers
  EXPECT_NEAR(response.pull() * a, 1, 1e-5);             // f(0) / a, next term f'(0) / a^2
}

TEST(Symbols, AreContinuousDownToEpsilonZero) {
  for (const int k : {1, 10, 1000}) {
    const Symbols limit(k, 0);
    EXPECT_DOUBLE_EQ(limit.stiffness, limit.body + limit.a * limit.a);
    for (const double epsilon : {1e-9, 1e-20, std::numeric_limits<double>::denorm_min()}) {
      const Symbols near(k,
                         epsilon);  // mu = epsilon coth(a) tanh(kappa) and kappa^2 are below 1e-10
      EXPECT_NEAR(near.stiffness / limit.stiffness, 1, 1e-10);
      EXPECT_NEAR(near.trace, 1, 1e-10);
      EXPECT_NEAR(near.lift, 0, 1e-10);
    }
  }
  EXPECT_TRUE(std::isfinite(Symbols(1 << 20, 1).stiffness));
}

TEST(ContactLine, SolvesTheObstacleProblemOfAString) {
  // D = a^2 makes it -c'' = q + lambda, c >= 0: a string under q = sin(pi x) - 6 sin(3 pi x), which
  // is even about 1/2.
  const int n = 256;
  Eigen::VectorXd stiffness(n + 1), load = Eigen::VectorXd::Zero(n + 1);
  for (int k = 0; k <= n; ++k) stiffness(k) = std::pow(std::max(k, 1) * pi, 2);
  load(1) = 1, load(3) = -6;
  const ContactLine line = solve_contact_line(stiffness, load);
  int touching = 0;
  for (int j = 1; j < n; ++j) {
    EXPECT_GE(line.displacement(j), 0);
    EXPECT_GE(line.pressure(j), 0);
    EXPECT_EQ(line.displacement(j) * line.pressure(j), 0);
    touching += line.pressure(j) > 0;
  }
  EXPECT_GT(touching, 0);
  EXPECT_LT(touching, n - 1);
  EXPECT_LT((line.displacement - line.displacement.reverse()).norm(), 1e-10);
}

// ---- The linear problem.

TEST(TruthWithoutContact, IsTheClosedFormOfOneWave) {
  // u = f/a^2 (1 - cosh(a(y-1/2)) / cosh(a/2)) + w sinh(a(1-y)) / sinh(a) in the body, w
  // cosh(kappa(1+y)) / cosh(kappa) in the layer, where the fluxes G'(0) - T w and (a/epsilon)
  // tanh(kappa) w agree; at epsilon = 0 that is a^2 w, Ventcel's.
  for (const int k : {1, 2, 8})
    for (const double epsilon : {1.0, 0.3, 1e-3, 0.0}) {
      const ExactSolution exact({{{k, {3}}}}, epsilon, false);
      const double a = k * pi, kappa = epsilon * a, x = 0.5 / k;
      const double layer = epsilon > 0 ? a / epsilon * std::tanh(kappa) : a * a;
      const double w = 3 * std::tanh(a / 2) / a / (a / std::tanh(a) + layer);
      for (const double y : {0.05, 0.3, 0.7, 0.97}) {
        const double held = 3 / (a * a) * (1 - std::cosh(a * (y - 0.5)) / std::cosh(a / 2));
        EXPECT_NEAR(exact.value(x, y), held + w * std::sinh(a * (1 - y)) / std::sinh(a), 1e-15);
        EXPECT_NEAR(exact.value(x, -y), w * std::cosh(kappa * (1 - y)) / std::cosh(kappa), 1e-15);
      }
    }
}

TEST(TruthWithoutContact, LeavesGammaCFree) {
  for (const double epsilon : every_epsilon) {
    const ExactSolution exact(rich_load(), epsilon, false, moderate);
    for (const double x : {0.1, 0.37, 0.9}) {
      EXPECT_EQ(exact.pressure(x), 0);
      EXPECT_NEAR(exact.layer_stress(x, -1), 0, 1e-14);
    }
    EXPECT_TRUE(exact.contact_zones().empty());
    EXPECT_LT(exact.value(0.5, -1), 0);
  }
}

TEST(TruthWithoutContact, ContactThatIsNotReachedChangesNothing) {
  for (const double epsilon : every_epsilon) {
    const ExactSolution free(lifting_load(), epsilon, false, moderate),
        contact(lifting_load(), epsilon, true, moderate);
    EXPECT_EQ(free.value(0.3, -0.4), contact.value(0.3, -0.4));
    EXPECT_EQ(free.energy(), contact.energy());
    EXPECT_TRUE(contact.contact_zones().empty());
  }
}

TEST(ExactSolution, LargeWaveNumbersNeitherOverflowNorVanish) {
  const int k = 8192;
  for (const double epsilon : every_epsilon) {
    const ExactSolution exact({{{k, {1}}}}, epsilon, false);
    const double a = k * pi, x = 0.5 / k;
    EXPECT_NEAR(exact.value(x, 0.5) * a * a, 1, 1e-9);
    EXPECT_TRUE(std::isfinite(exact.value(x, -0.5)) && std::isfinite(exact.layer_stress(x, -0.5)));
  }
}

// ---- The equations.

class TruthEquations : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(EveryEpsilon, TruthEquations, testing::ValuesIn(every_epsilon));

TEST_P(TruthEquations, HoldInTheBody) {
  const SineLoad load = rich_load();
  const ExactSolution exact(load, GetParam(), true, moderate);
  const double h =
      1e-3;  // h^2 / 12 times fourth derivatives up to (8 pi)^2 100: 5e-3 against terms of size 100
  for (const double x : {0.21, 0.55, 0.8})
    for (const double y : {0.2, 0.5, 0.9}) {
      const double u_xx = second_difference([&](double t) { return exact.value(t, y); }, x, h);
      const double u_yy = second_difference([&](double t) { return exact.value(x, t); }, y, h);
      EXPECT_NEAR(-u_xx - u_yy, load(x, y), 1e-2);
      EXPECT_NEAR(exact.d_xx(x, y), u_xx, 1e-2);
      EXPECT_NEAR(exact.gradient(x, y).x(),
                  difference([&](double t) { return exact.value(t, y); }, x, h), 1e-3);
      EXPECT_NEAR(exact.gradient(x, y).y(),
                  difference([&](double t) { return exact.value(x, t); }, y, h), 1e-3);
    }
}

TEST_P(TruthEquations, HoldInTheLayer) {
  const double epsilon = GetParam(), h = 1e-3;
  const ExactSolution exact(paper_sine_load(), epsilon, true, moderate);
  for (const double x : {0.21, 0.45, 0.9})
    for (const double y : {-0.1, -0.5, -0.8}) {
      const double stress_y = difference([&](double t) { return exact.layer_stress(x, t); }, y, h);
      const double u_xx = second_difference([&](double t) { return exact.value(t, y); }, x, h);
      const double u_y = difference([&](double t) { return exact.value(x, t); }, y, h);
      EXPECT_NEAR(stress_y + u_xx, 0,
                  1e-3);  // both of size 1 to 2; differences err by h^2 (2 pi)^4 / 12
      EXPECT_NEAR(exact.d_xx(x, y), u_xx, 1e-3);
      EXPECT_NEAR(u_y, epsilon * epsilon * exact.layer_stress(x, y), 1e-5);
      EXPECT_DOUBLE_EQ(exact.gradient(x, y).y(), epsilon * epsilon * exact.layer_stress(x, y));
    }
}

TEST_P(TruthEquations, SidesAndTopAreHeld) {
  const ExactSolution exact(rich_load(), GetParam(), true, moderate);
  for (const double t : {0.0, 0.3, 0.77, 1.0}) {
    EXPECT_NEAR(exact.value(t, 1), 0, 1e-14);
    for (const double y : {t, -t}) {
      EXPECT_NEAR(exact.value(0, y), 0, 1e-12);
      EXPECT_NEAR(exact.value(1, y), 0, 1e-12);
    }
  }
}

TEST_P(TruthEquations, DisplacementAndFluxPassThroughSigma) {
  const ExactSolution exact(paper_sine_load(), GetParam(), true, moderate);
  const double below = -1e-13;  // slopes of up to 2 in u, 60 in the stress: 1e-11 covers them
  for (const double x : {0.1, 0.25, 0.5, 0.85}) {
    EXPECT_NEAR(exact.value(x, 0), exact.value(x, below), 1e-11);
    // the stress of the layer is filtered near the last waves, whose share of the sum on 2^13
    // points is below 1e-5
    EXPECT_NEAR(exact.gradient(x, 0).y(), exact.layer_stress(x, 0), 1e-5);
    EXPECT_NEAR(exact.layer_stress(x, below), exact.layer_stress(x, 0), 1e-10);
    EXPECT_NEAR(exact.gradient(x, 0).x(), exact.gradient(x, below).x(), 1e-9);
  }
}

TEST_P(TruthEquations, ContactIsComplementary) {
  for (const SineLoad& load : {paper_sine_load(), rich_load()}) {
    const ExactSolution exact(load, GetParam(), true, moderate);
    const int n = 1 << moderate;
    double pressed = 0;
    for (int j = 0; j <= n; ++j) {
      const double x = double(j) / n, u = exact.value(x, -1), lambda = exact.pressure(x);
      ASSERT_GE(u, 0) << x;
      ASSERT_GE(lambda, 0) << x;
      ASSERT_EQ(u * lambda, 0) << x;
      ASSERT_EQ(exact.layer_stress(x, -1), -lambda);
      pressed += lambda / n;
    }
    EXPECT_GT(
        pressed,
        5e-4);  // its smallest: the rich load at epsilon = 1, whose waves hardly reach Gamma_C
    for (const auto& [from, to] : exact.contact_zones()) {
      EXPECT_LE(from, to);
      EXPECT_EQ(exact.value((from + to) / 2, -1), 0);
    }
  }
}

TEST_P(TruthEquations, PressureIsTheLimitOfTheStressFromInside) {
  const ExactSolution exact(paper_sine_load(), GetParam(), true, moderate);
  for (const double x :
       {0.1, 0.4, 0.8, 0.9})  // away from the end of contact; 1e-4 inside, p_y is below 60
    EXPECT_NEAR(exact.layer_stress(x, -1 + 1e-4), -exact.pressure(x), 6e-3);
}

TEST_P(TruthEquations, EnergyIsMinusHalfTheWorkOfTheLoad) {
  const SineLoad load = rich_load();
  const ExactSolution exact(load, GetParam(), true, moderate);
  const int n = 60;
  double work =
      0;  // midpoint rule, second order: exact in x for these waves, h^2 / 24 times 100 in y
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5) / n, y = (j + 0.5) / n;
      work += load(x, y) * exact.value(x, y) / (n * n);
    }
  EXPECT_NEAR(exact.energy(), -work / 2, 1e-3 * std::abs(work));
}

TEST(ExactSolution, AtEpsilonZeroItIsTheVentcelSignoriniProblem) {
  // (25): d_n u - u_xx = pressure >= 0 on Sigma, n the body's outward normal, so d_n u = -d_y u.
  const ExactSolution exact(paper_sine_load(), 0);
  const double h = 1e-3;
  for (const double x : {0.1, 0.3, 0.6, 0.68, 0.73, 0.8, 0.95}) {
    const double u_xx = second_difference([&](double t) { return exact.value(t, 0); }, x, h);
    const double d_n = -exact.gradient(x, 0).y();
    EXPECT_NEAR(d_n - exact.d_xx(x, 0), exact.pressure(x),
                1e-4);  // series of u_xx, which jumps at x = 0.702
    EXPECT_NEAR(d_n - u_xx, exact.pressure(x),
                1e-3);  // and differences, independent of any series of it
  }
  EXPECT_GT(exact.pressure(0.8), 1);
}

// ---- Digits.

struct Known {
  double epsilon, contact_from, u_half, u_sigma, u_gamma_c, largest, energy;
};
class TruthDigits : public testing::TestWithParam<Known> {};
// From an independent script (another language, another transform library) on 2^17 points; every
// digit printed is held.
INSTANTIATE_TEST_SUITE_P(
    PaperLoad, TruthDigits,
    testing::Values(
        Known{1, 0.60818, 0.23689556, 0.12618750, 0.00054134, 0.00054417, -0.4824546},
        Known{1e-1, 0.65962, 0.23578044, 0.04715121, 0.04071145, 0.04124271, -0.44424493},
        Known{1e-2, 0.69753, 0.23619852, 0.04505664, 0.04498906, 0.04566745, -0.44157558},
        Known{1e-4, 0.70196, 0.23620362, 0.04503589, 0.04503588, 0.04571602, -0.44154446},
        Known{1e-6, 0.70200, 0.23620362, 0.04503588, 0.04503588, 0.04571603, -0.44154446},
        Known{0, 0.70200, 0.23620362, 0.04503588, 0.04503588, 0.04571603, -0.44154446}));

TEST_P(TruthDigits, MatchAnIndependentComputation) {
  const Known known = GetParam();
  const ExactSolution exact(paper_sine_load(), known.epsilon);
  const double last_digit = 0.51e-8;
  EXPECT_NEAR(exact.value(0.25, 0.5), known.u_half, last_digit);
  EXPECT_NEAR(exact.value(0.25, 0), known.u_sigma, last_digit);
  EXPECT_NEAR(exact.value(0.25, -1), known.u_gamma_c, last_digit);
  EXPECT_NEAR(exact.max_on_contact(), known.largest, last_digit);
  EXPECT_NEAR(exact.energy(), known.energy, 0.51e-7);
  ASSERT_EQ(exact.contact_zones().size(), 1u);
  EXPECT_NEAR(exact.contact_zones()[0].first, known.contact_from, 0.51e-5);
  EXPECT_EQ(exact.contact_zones()[0].second, 1);
}

TEST(ExactSolution, DoublingThePointsSettlesTheValues) {
  for (const double epsilon : {1.0, 1e-2, 0.0}) {
    const ExactSolution coarse(paper_sine_load(), epsilon, true, 11),
        middle(paper_sine_load(), epsilon, true, 13), fine(paper_sine_load(), epsilon, true, 15);
    double step1 = 0, step2 = 0;
    for (const double x : {0.25, 0.6, 0.72})
      for (const double y : {0.5, 0.0, -0.5, -0.9}) {
        step1 = std::max(step1, std::abs(coarse.value(x, y) - middle.value(x, y)));
        step2 = std::max(step2, std::abs(middle.value(x, y) - fine.value(x, y)));
      }
    EXPECT_LT(step2, 3e-7);  // the next two doublings give 8 digits
    EXPECT_LT(
        step2,
        0.5 * step1 + 1e-10);  // at least first order, whatever the position of the end of contact
  }
}

TEST(ExactSolution, TendsToTheLimitWithEpsilon) {
  const ExactSolution limit(paper_sine_load(), 0, true, moderate);
  double last = 1;
  for (const double epsilon : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const ExactSolution exact(paper_sine_load(), epsilon, true, moderate);
    double distance = 0;
    for (const double x : {0.2, 0.5, 0.69})
      for (const double y : {0.4, 0.0, -0.7, -1.0})
        distance = std::max(distance, std::abs(exact.value(x, y) - limit.value(x, y)));
    EXPECT_LT(distance, 0.1 * epsilon);
    EXPECT_LT(distance, last / 5);  // first order or better in epsilon
    last = distance;
  }
  for (const double epsilon : {1e-20, std::numeric_limits<double>::denorm_min()}) {
    const ExactSolution exact(paper_sine_load(), epsilon, true, moderate);
    EXPECT_NEAR(exact.value(0.4, -0.5), limit.value(0.4, -0.5), 1e-12);
    EXPECT_NEAR(exact.layer_stress(0.4, -0.5), limit.layer_stress(0.4, -0.5), 1e-7);
  }
}

TEST(TruthDistance, IsTheNormOfTheDifference) {
  // One wave without contact: u = sin(pi x) times a profile linear in the load, so three times the
  // load is twice as far.
  const ExactSolution one({{{1, {2}}}}, 0.3, false), three({{{1, {6}}}}, 0.3, false),
      none({}, 0.3, false);
  EXPECT_EQ(h1_distance(one, one), 0);
  EXPECT_NEAR(h1_distance(three, one), 2 * h1_distance(one, none), 1e-12);
  // int |grad u|^2, with the layer's d/dy u weighted by epsilon^-2, is L(u) = -2 J: at epsilon = 1
  // without weight. The rest is int u^2, here by the midpoint rule in y on 400 rows, int sin^2 =
  // 1/2 in x.
  const ExactSolution unit({{{1, {2}}}}, 1, false);
  double square = 0;
  for (int j = 0; j < 400; ++j)
    square += 0.5 * std::pow(unit.value(0.5, -1 + (j + 0.5) / 200), 2) / 200;
  EXPECT_NEAR(h1_distance(unit, none), std::sqrt(square - 2 * unit.energy()),
              1e-4 * std::sqrt(square));
}

TEST(TruthDistance, IsTheSameFromEitherSide) {
  // a thick layer cuts its series sooner than a thin one
  const ExactSolution thick(paper_sine_load(), 1, true, 8), thin(paper_sine_load(), 0, true, 8);
  EXPECT_NEAR(h1_distance(thick, thin), h1_distance(thin, thick), 1e-15);
}

TEST(TruthDistance, H2NormIsThatOfOneWaveByDifferences) {
  const ExactSolution exact({{{1, {2}}}}, 0.3, false);
  // u = g(y) sin(pi x), g by values at x = 1/2: int g^2 (1 + a^2 + a^4) + g'^2 (1 + 2 a^2) + g''^2,
  // times 1/2. Midpoint rule and differences of step 1/400: 1e-4 of g'' and below.
  const double a2 = pi * pi, h = 1.0 / 400;
  double norms = 0;
  for (const double from : {0.0, -1.0}) {
    double square = 0;
    for (int j = 0; j < 200; ++j) {
      const double y = from + (j + 0.5) / 200;
      const double low = exact.value(0.5, y - h), g = exact.value(0.5, y),
                   high = exact.value(0.5, y + h);
      const double slope = (high - low) / (2 * h), bend = (high - 2 * g + low) / (h * h);
      square +=
          0.5 * (g * g * (1 + a2 + a2 * a2) + slope * slope * (1 + 2 * a2) + bend * bend) / 200;
    }
    norms += std::sqrt(square);
  }
  EXPECT_NEAR(h2_norm(exact), norms, 1e-3 * norms);
}

TEST(TruthDistance, SecondDerivativesAreThoseOfTheLoad) {
  // |u|_2^2 + 2 F^2 = |f|^2, contact or not (Theorem A of tutorials/guides/uniform_rate.md); int
  // f^2 is half the sum of the waves'. Where the pressure jumps, a series of n waves leaves a share
  // of 1/n.
  for (const auto& [load, square] : {std::pair{SineLoad{{{2, {10}}}}, 50.0},
                                     {SineLoad{{{1, {-10}}, {2, {10}}}}, 100.0},
                                     {SineLoad{{{1, {3, 5}}, {3, {-7}}}}, 16.0 + 1.0 / 6 + 24.5}})
    for (const double epsilon : {1.0, 1e-1, 1e-3, 0.0}) {
      const Regularity u = regularity(ExactSolution(load, epsilon, true, moderate));
      EXPECT_NEAR(u.body + 2 * u.layer, square, 1e-4 * square) << epsilon;
    }
}

TEST(TruthDistance, FallsLikeEpsilonToThreeHalves) {
  // The pressure jumps at the end of contact: u_k is of size k^-3, and wave k feels (epsilon k)^2
  // up to k = 1/epsilon.
  const ExactSolution limit(paper_sine_load(), 0, true, moderate);
  const auto distance = [&](double epsilon) {
    return h1_distance(ExactSolution(paper_sine_load(), epsilon, true, moderate), limit);
  };
  EXPECT_NEAR(std::log10(distance(3e-3) / distance(3e-4)), 1.5,
              0.1);  // the part of order 2 dies out slowly
}

// ---- Hard and broken input.

TEST(ExactSolution, EverythingInContactHoldsGammaCDown) {
  for (const double epsilon : every_epsilon) {
    const ExactSolution exact(pressing_load(), epsilon, true, moderate);
    const std::vector<std::pair<double, double>> everything{{0.0, 1.0}};
    EXPECT_EQ(exact.contact_zones(), everything);
    EXPECT_EQ(exact.max_on_contact(), 0);
    EXPECT_LE(exact.value(0.5, 0), 0);
    const Symbols symbols(1, epsilon);  // lambda = -q
    EXPECT_NEAR(exact.pressure(0.5), -symbols.trace * LoadResponse(1, {-10, 0, -3}).pull(), 1e-12);
  }
}

TEST(ExactSolution, NoLoadNoDisplacement) {
  for (const bool contact : {true, false})
    for (const SineLoad& load : {SineLoad{}, SineLoad{{{3, {0, 0}}}}, SineLoad{{{3, {}}}}}) {
      const ExactSolution exact(load, 0.1, contact, moderate);
      EXPECT_EQ(exact.value(0.3, 0.3), 0);
      EXPECT_EQ(exact.pressure(0.3), 0);
      EXPECT_EQ(exact.energy(), 0);
      EXPECT_EQ(exact.contact_zones().size(), contact ? 1u : 0u);  // it rests on the obstacle
      EXPECT_EQ(ExactTable(exact).value(0.3, -0.2), 0);
    }
}

TEST(ExactSolution, EqualWavesAddUpAndTheSolutionScalesWithTheLoad) {
  const ExactSolution once(paper_sine_load(), 0.1, true, moderate),
      split({{{2, {4}}, {2, {6}}}}, 0.1, true, moderate);
  EXPECT_NEAR(once.value(0.3, -0.5), split.value(0.3, -0.5), 1e-15);
  for (const double factor : {1e-30, 1e30}) {
    const ExactSolution scaled({{{2, {10 * factor}}}}, 0.1, true, moderate);
    EXPECT_NEAR(scaled.value(0.3, -0.5) / factor, once.value(0.3, -0.5), 1e-9);
    EXPECT_EQ(scaled.contact_zones(), once.contact_zones());
  }
}

TEST(ExactSolution, RefusesWhatItCannotAnswer) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double epsilon : {-1e-3, 1.5, nan})
    EXPECT_THROW(ExactSolution(paper_sine_load(), epsilon), Error);
  for (const int log2_points : {-1, 5, 21})
    EXPECT_THROW(ExactSolution(paper_sine_load(), 0.1, true, log2_points), Error);
  EXPECT_THROW(ExactSolution({{{0, {1}}}}, 0.1), Error);
  EXPECT_THROW(ExactSolution({{{-2, {1}}}}, 0.1), Error);
  EXPECT_THROW(ExactSolution({{{5, {1}}}}, 0.1, true, 6), Error);
  EXPECT_THROW(ExactSolution({{{1, {nan}}}}, 0.1), Error);
  EXPECT_THROW(ExactSolution({{{1, std::vector<double>(14, 1.0)}}}, 0.1), Error);
  const ExactSolution exact(paper_sine_load(), 0.1, true, moderate);
  EXPECT_THROW(exact.value(1.1, 0), Error);
  EXPECT_THROW(exact.value(0.5, nan), Error);
  EXPECT_THROW(exact.gradient(0.5, -1.01), Error);
  EXPECT_THROW(exact.pressure(-0.1), Error);
  EXPECT_THROW(exact.layer_stress(0.5, 0.1), Error);
  const ExactTable table(exact);
  EXPECT_THROW(table.value(0.5, 1.1), Error);
  EXPECT_THROW(table.layer_stress(0.5, 0.1), Error);
  EXPECT_THROW(ExactTable(ExactSolution({{{33, {1}}}}, 0.1, false)), Error);
}

TEST(SineLoad, EvaluatesItsTerms) {
  EXPECT_NEAR(paper_sine_load()(0.25, 0.9), 10, 1e-14);
  EXPECT_NEAR(rich_load()(0.5, 0.5), -15 + (20 - 2.5 - 2.25), 1e-12);
}

// ---- The table.

class TruthTabulated : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(EveryEpsilon, TruthTabulated,
                         testing::Values(1, 0.1, 1e-3, 1e-5, 1e-20, 0));

TEST_P(TruthTabulated, MatchesTheSums) {
  const ExactSolution exact(rich_load(), GetParam(), true, 14);
  const ExactTable table(exact);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  double value = 0, gradient = 0, stress = 0;
  const auto ends = exact.contact_zones();
  for (int i = 0; i < 360; ++i) {
    const double near = std::pow(10, -6 * uniform(random));
    const double end = ends.front().second + (i % 8 < 4 ? 0.2 : -0.2) * near;
    const double x = i < 240 ? uniform(random) : std::clamp(end, 0.0, 1.0);
    const double y = std::vector{2 * uniform(random) - 1, near, -near, -1 + near}[i % 4];
    value = std::max(value, std::abs(table.value(x, y) - exact.value(x, y)));
    bool smooth = true;
    for (const auto& [from, to] : ends)
      smooth = smooth && std::abs(x - from) > 0.01 && std::abs(x - to) > 0.01;
    if (!smooth) continue;
    gradient = std::max(gradient, (table.gradient(x, y) - exact.gradient(x, y)).norm());
    if (y <= 0)
      stress = std::max(stress, std::abs(table.layer_stress(x, y) - exact.layer_stress(x, y)));
  }
  EXPECT_LT(value, 2e-8);     // of 0.3
  EXPECT_LT(gradient, 2e-5);  // of 8
  EXPECT_LT(stress, 1e-3);    // of 7
}

TEST_P(TruthTabulated, IsExactlyTheTruthOnItsEdges) {
  const ExactSolution exact(paper_sine_load(), GetParam(), true, moderate);
  const ExactTable table(exact);
  for (const double x : {0.0, 0.25, 0.5, 1.0})
    for (const double y : {-1.0, 0.0, 1.0}) {
      EXPECT_NEAR(table.value(x, y), exact.value(x, y),
                  1e-13);  // points of the table: no interpolation
      if (y <= 0) {
        EXPECT_NEAR(table.layer_stress(x, y), exact.layer_stress(x, y), 1e-5);
      }
    }
}

}  // namespace antilock::test::exact_test::exact_solution_test
