#pragma once
// How near each numerical assertion comes to its bound. With ANTILOCK_MARGINS=FILE a test program
// adds a line per assertion with an order or a tolerance: the largest observed / allowed of the run
// (below 1 where it holds), both values, place, test. tests/margins runs the tests under several
// kernels and prints the nearest. Included by the tests' precompiled header.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <type_traits>

namespace antilock::margins {

/// Notes an assertion at `file`, `line`; observed / allowed is the ratio of the two (of magnitudes;
/// 0 where either is 0).
void note(const char* file, int line, const char* what, double observed, double allowed);
extern const bool asked;  ///< whether ANTILOCK_MARGINS is set

/// gtest's own comparisons of floating-point numbers, noted on the way.
struct At {
  At(const char* a_file, int a_line) : file(a_file), line(a_line) {}
  const char* file;
  int line;

  template <class A, class B>
  void at_most(const char* what, const A& observed, const B& allowed) const {
    if constexpr (std::is_floating_point_v<A> && std::is_arithmetic_v<B>)
      if (asked) note(file, line, what, observed, static_cast<double>(allowed));
  }
  /// x `op` y, which Holds computes: the greater side is what is allowed.
  template <class Holds>
  auto ordered(const char* op) const {
    return [*this, op](const char* a, const char* b, const auto& x, const auto& y) {
      op[0] == '<' ? at_most(a, x, y) : at_most(a, y, x);
      return Holds{}(x, y) ? testing::AssertionSuccess()
                           : testing::internal::CmpHelperOpFailure(a, b, x, y, op);
    };
  }
  auto near(const char* a, const char* b, const char* c, double x, double y,
            double tolerance) const {
    at_most(a, std::abs(x - y), tolerance);
    return testing::internal::DoubleNearPredFormat(a, b, c, x, y, tolerance);
  }
};

}  // namespace antilock::margins

// NOLINTBEGIN(cppcoreguidelines-macro-usage): gtest's own names
#define ANTILOCK_AT ::antilock::margins::At(__FILE__, __LINE__)
#undef EXPECT_LT
#undef EXPECT_LE
#undef EXPECT_GT
#undef EXPECT_GE
#undef EXPECT_NEAR
#undef ASSERT_LT
#define EXPECT_LT(a, b) EXPECT_PRED_FORMAT2(ANTILOCK_AT.ordered<std::less<>>("<"), a, b)
#define EXPECT_LE(a, b) EXPECT_PRED_FORMAT2(ANTILOCK_AT.ordered<std::less_equal<>>("<="), a, b)
#define EXPECT_GT(a, b) EXPECT_PRED_FORMAT2(ANTILOCK_AT.ordered<std::greater<>>(">"), a, b)
#define EXPECT_GE(a, b) EXPECT_PRED_FORMAT2(ANTILOCK_AT.ordered<std::greater_equal<>>(">="), a, b)
#define EXPECT_NEAR(a, b, tolerance) EXPECT_PRED_FORMAT3(ANTILOCK_AT.near, a, b, tolerance)
#define ASSERT_LT(a, b) ASSERT_PRED_FORMAT2(ANTILOCK_AT.ordered<std::less<>>("<"), a, b)
// NOLINTEND(cppcoreguidelines-macro-usage)
