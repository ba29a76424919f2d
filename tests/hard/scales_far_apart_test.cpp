// Problems of one's own whose stiffnesses and forces lie far apart, or that are as small as can be:
// what is large in one place must hide nothing in another.
#include "antilock/solve/uzawa.hpp"
#include "hard/quad_reference.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::hard::scales_far_apart_test {

using namespace test;

std::vector<std::vector<bool>> every_start(std::size_t n) {
  std::vector<std::vector<bool>> starts;
  for (std::size_t set = 0; set < (1u << n); ++set) {
    starts.emplace_back(n);
    for (std::size_t i = 0; i < n; ++i) starts.back()[i] = (set >> i & 1) != 0;
  }
  return starts;
}

// CHOLMOD's constrained ordering once wrote past its end here; the sanitizers watch.
TEST(ScalesFarApart, OneUnknownAndItIsInContact) {
  for (const double load : {-1.0, 1.0}) {
    const Solution s =
        active_set(small_problem(Eigen::MatrixXd::Constant(1, 1, 2),
                                 Eigen::VectorXd::Constant(1, load), Eigen::VectorXd::Zero(1)));
    EXPECT_NEAR(s.u(0), load < 0 ? 0 : 0.5, 1e-15);
    EXPECT_NEAR(s.lambda(0), load < 0 ? 1 : 0, 1e-15);
  }
}

// A spring of stiffness K beside one of stiffness 1 that is pulled off its obstacle by next to
// nothing, from every start.
TEST(ScalesFarApart, AStiffUnknownHidesNoPullOnASoftOne) {
  for (const double k : {1e6, 1e9, 1e12, 1e14})
    for (const double off : {1e-2, 1e-4, 1e-6})
      for (const auto& start : every_start(2)) {
        ActiveSetOptions options;
        options.start = held_at_lower(start);
        const Solution s =
            active_set(small_problem(Eigen::Vector2d(k, 1).asDiagonal(),
                                     Eigen::Vector2d(1e-4 * k, -1 + off), Eigen::Vector2d(-1, -1)),
                       options);
        EXPECT_NEAR(s.u(0), 1e-4, 1e-16) << k;
        EXPECT_NEAR(s.u(1), -1 + off, 1e-15) << k;
      }
}

// The same, coupled, and the stiff one in contact with a force of 2 K: the start is the solver's
// own.
TEST(ScalesFarApart, AGreatContactForceHidesNoSmallOne) {
  for (const double k : {1e6, 1e9, 1e12})
    for (const double off : {1e-2, 1e-4}) {
      Eigen::Matrix2d a1;
      a1 << k, -1, -1, 2;
      const Solution s = active_set(
          small_problem(a1, Eigen::Vector2d(-2 * k, -2 + 2 * off), Eigen::Vector2d(0, -1)));
      EXPECT_EQ(s.u(0), 0);
      EXPECT_NEAR(s.u(1), -1 + off, 1e-14) << k;
    }
}

// u_0 is pressed to 0.83 against a row of B alone: a contact force of 0.3 / compliance. u_2 hangs
// on u_1 by a spring and knows the truth (0.31 + 2 u_1) / 2.3, u_1 = 0.1 u_0 / 0.35, as
// compliance -> 0. Right or refused, never in between.
TEST(ScalesFarApart, AContactForceFarAboveTheLoadStaysWhereItIs) {
  Eigen::Matrix3d a1;
  a1 << 3, -1, 0, -1, 3, -2, 0, -2, 2.3;
  Eigen::MatrixXd b(2, 3);
  b << 0.93, 0, 0, 0.1, -0.35, 0;
  const double u_1 = 0.1 / 0.35 * 0.83;
  for (const double compliance : {1e-10, 1e-12, 1e-14, 1e-16, 1e-18, 1e-20}) {
    VariationalInequality v = small_problem(a1, Eigen::Vector3d(0.55, 0, 0.31),
                                            Eigen::VectorXd::Constant(1, 0.83), b, compliance);
    v.m(0) = 0.47;
    ActiveSetOptions options;
    options.penalty = 3.5e-5;
    try {
      const Solution s = active_set(v, options);
      // the truth at this compliance is off the limit by about 50 compliance
      EXPECT_NEAR(s.u(2), (0.31 + 2 * u_1) / 2.3, 1e-12 + 50 * compliance) << compliance;
    } catch (const NotConverged&) {
      EXPECT_LT(compliance, 1e-18) << "refused";
    }
  }
}

// The report of a wrong u in a place of small forces, beside a force of 1e12.
TEST(ScalesFarApart, TheReportSeesSmallForcesBesideGreatOnes) {
  const VariationalInequality v =
      small_problem(Eigen::Vector3d(1e12, 1, 1).asDiagonal(), Eigen::Vector3d(-1e12, -2, 1),
                    Eigen::Vector2d(0, -1));
  const Solution right = active_set(v);
  Solution wrong = right;
  wrong.u(2) *= 1 + 1e-4;
  EXPECT_THROW(check_kkt(v, wrong), NotConverged) << "a force out of balance";
  // in balance, but with the wrong contact set
  VariationalInequality pulled = v;
  pulled.load(1) = -0.99;
  wrong = active_set(pulled);
  EXPECT_NEAR(wrong.u(1), -0.99, 1e-15);
  wrong.u(1) = -1, wrong.lambda(1) = -0.01;
  EXPECT_THROW(check_kkt(pulled, wrong), NotConverged) << "a contact that pulls";
  wrong.u(1) = -0.98, wrong.lambda(1) = 0.01;
  EXPECT_THROW(check_kkt(pulled, wrong), NotConverged) << "pressed and open";
}

// Prescribed values alone, and an obstacle that keeps the rest at zero: nothing moves in the first
// correction.
TEST(ScalesFarApart, WhatDoesNotMoveHasSettled) {
  Eigen::Matrix3d a1;
  a1 << 2, -1, -1, -1, 2, 0, -1, 0,
      1;  // u_0 held up by the obstacle, u_1 hangs on it, u_2 is pushed down
  for (const bool in_contact : {true, false}) {
    if (!in_contact) a1 = Eigen::Matrix3d::Identity();
    VariationalInequality v =
        small_problem(a1, Eigen::Vector3d::Zero(), Eigen::VectorXd::Zero(in_contact ? 1 : 0),
                      Eigen::RowVector3d(1, -1, 0), 1e-2);
    v.dirichlet_dofs = {2};
    v.dirichlet_values = Eigen::VectorXd::Constant(1, -1);
    for (const Solution& s : {active_set(v), uzawa(v)}) {
      EXPECT_LT((s.u - Eigen::Vector3d(0, 0, -1)).lpNorm<Eigen::Infinity>(), 1e-15);
      if (in_contact) {
        EXPECT_NEAR(s.lambda(0), 1, 1e-12);
      }
    }
  }
}

/// A chain of 40 springs that a soft one holds, under a load that moves it by about 1.
VariationalInequality hardly_held_chain(double held, const Eigen::MatrixXd& b = {},
                                        double compliance = 1) {
  constexpr int n = 40;
  Eigen::MatrixXd a1 = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd load(n);
  for (int i = 0; i < n; ++i) {
    const double below = i == 0 ? held : 1 + 0.5 * std::sin(i),
                 above = i == n - 1 ? 0 : 1 + 0.5 * std::sin(i + 1);
    a1(i, i) = below + above;
    if (i > 0) a1(i, i - 1) = a1(i - 1, i) = -below;
    load(i) = held * std::cos(i);
  }
  return small_problem(a1, load, {}, b, compliance);
}

/// The same with two rows of B that its softness has nothing to do with.
VariationalInequality hardly_held_stiff_chain(double held, double compliance) {
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(2, 40);
  b(0, 39) = b(1, 5) = 1;
  b(0, 38) = b(1, 7) = -1;
  return hardly_held_chain(held, b, compliance);
}

// Without B too the first solve is not taken on trust: a double keeps 1e-16 / held of it. The
// corrections' residual adds 40 terms in long double, each rounded by 2^-64: 2e-18 / held is left.
// The bound is 10 times that.
TEST(ScalesFarApart, AChainThatIsHardlyHeldIsRightWithoutAStiffForm) {
  for (const double held : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const VariationalInequality v = hardly_held_chain(held);
    const Solution s = active_set(v);
    EXPECT_LE(s.error, CorrectionOptions{}.tolerance)
        << held;  // what was asked for, and no thousandth of it
    EXPECT_LT(distance(s.u, quad_reference(v, {}).u), 1e-10 + 2e-17 / held) << held;
  }
}

// With B as well.
TEST(ScalesFarApart, AChainThatIsHardlyHeldIsRightWithAStiffForm) {
  for (const double held : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 3e-9, 1e-9})
    for (const double penalty : {1e-1, 1e-2, 3e-3, 1e-4})
      for (const double compliance : {0.0, 1e-5}) {
        const VariationalInequality v = hardly_held_stiff_chain(held, compliance);
        ActiveSetOptions options;
        options.penalty = penalty;
        EXPECT_LT(distance(active_set(v, options).u, quad_reference(v, {}).u), 1e-10 + 2e-17 / held)
            << held << " " << penalty << " " << compliance;
      }
}

// Asked for more digits than a double holds: residuals are exact, so that corrections settle with
// the factor they have.
TEST(ScalesFarApart, MoreDigitsNeedNoOtherFactor) {
  for (const double held : {1e-4, 2e-4, 5e-4})
    for (const double penalty : {1e-2, 3e-3})
      for (const double compliance : {0.0, 1e-5}) {
        ActiveSetOptions options;
        options.corrections.tolerance = 1e-14;
        options.penalty = penalty;
        const Solution s = active_set(hardly_held_stiff_chain(held, compliance), options);
        EXPECT_EQ(s.counters.factorisations, 1) << held << " " << penalty << " " << compliance;
      }
}

// u_0 hangs on u_1, which B holds at 0, and its bound is 0.005. Before B holds it, u_1 lifts u_0
// off; after, u_0 sinks in by less than the round-off of u_2, decoupled and far larger. Zero is not
// admissible: a bound that is not met might be the one trace of a problem without an answer.
TEST(ScalesFarApart, AGreatUHidesNoBoundThatIsReachedLate) {
  Eigen::Matrix3d a1;
  a1 << 1, -0.5, 0, -0.5, 1, 0, 0, 0, 1;
  for (const double great : {1e12, 1e13})
    for (const double penalty : {1.0, 0.1}) {
      ActiveSetOptions options;
      options.penalty = penalty;
      const Solution s = active_set(
          small_problem(a1, Eigen::Vector3d(0, 1, great), Eigen::VectorXd::Constant(1, 0.005),
                        Eigen::RowVector3d(0, 1, 0), 0),
          options);
      EXPECT_EQ(s.u(0), 0.005) << great << " " << penalty;
      EXPECT_NEAR(s.lambda(0), 0.005, 1e-12) << great << " " << penalty;
    }
}

// Rows of B that tie pairs of springs together, u = 1/2 in all of them, beside a prescribed value.
// What has settled beside that one may leave the slower rows far from closed: each holds to 1e-4 of
// its own terms.
TEST(ScalesFarApart, AGreatUHidesNoRowThatIsNotClosed) {
  constexpr int pairs = 8, n = 2 * pairs + 1;
  for (const double great : {1e4, 1e7, 1e8, 1e9, 1e10, 1e12, 1e14}) {
    Eigen::MatrixXd a1 = Eigen::MatrixXd::Identity(n, n), b = Eigen::MatrixXd::Zero(pairs, n);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(n);
    for (int i = 0; i < pairs; ++i) {
      a1(2 * i, 2 * i) = a1(2 * i + 1, 2 * i + 1) = load(2 * i) = std::pow(2, i);
      b(i, 2 * i) = 1;
      b(i, 2 * i + 1) = -1;
    }
    VariationalInequality v = small_problem(a1, load, {}, b, 0);
    v.dirichlet_dofs = {n - 1};
    v.dirichlet_values = Eigen::VectorXd::Constant(1, great);
    ActiveSetOptions options;
    options.penalty = 0.1;
    const Eigen::VectorXd u = active_set(v, options).u;
    for (int i = 0; i < pairs; ++i)
      EXPECT_LE(std::abs(u(2 * i) - u(2 * i + 1)),
                1e-4 * (std::abs(u(2 * i)) + std::abs(u(2 * i + 1))))
          << great << i;
  }
}

// A chain that B locks altogether: u falls to the round-off of its size before, no sooner, and
// stays there.
TEST(ScalesFarApart, ALockedUStopsAtItsRoundOff) {
  for (const int n : {5, 20})
    for (const double penalty : {1e-2, 1e-4})
      for (const double beside : {0.0, 0.4, -0.4999}) {
        Eigen::MatrixXd a1 = Eigen::MatrixXd::Identity(n, n), b = Eigen::MatrixXd::Identity(n, n);
        for (int i = 1; i < n; ++i) {
          a1(i, i - 1) = a1(i - 1, i) = beside;
          b(i, i - 1) = -1;
        }
        ActiveSetOptions options;
        options.penalty = penalty;
        const Solution s = active_set(
            small_problem(
                a1, Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::cos(i); }), {},
                b, 0),
            options);
        EXPECT_LE(s.u.lpNorm<Eigen::Infinity>(), 1e-14 * s.penalised_max_u)
            << n << " " << penalty << " " << beside;
        EXPECT_EQ(s.warning, "") << n << " " << penalty << " " << beside;
        if (penalty == 1e-4) {
          EXPECT_LE(s.counters.corrections, 12) << n << " " << beside;  // measured: 5 to 8
        }
      }
}

}  // namespace antilock::hard::scales_far_apart_test
