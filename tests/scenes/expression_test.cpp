// Formulas from files mean what they say, to the last digit.
#include <clocale>
#include <thread>

#include "antilock/runner/expression.hpp"
#include "support/scenes.hpp"

namespace antilock::test::expression_test {

double at(const std::string& text, double x, double y) {
  return Expression(text, {"x", "y"})(x, y);
}

TEST(Expression, IsWhatTheSameFormulaIsInCpp) {
  constexpr double pi = std::numbers::pi, x = 0.37, y = 0.81;
  EXPECT_EQ(at("pi", x, y), pi);  // every digit
  EXPECT_DOUBLE_EQ(at("10*sin(2*pi*x)", x, y), 10 * std::sin(2 * pi * x));
  EXPECT_DOUBLE_EQ(at("exp(-x)*cos(y) + sqrt(abs(x - y))", x, y),
                   std::exp(-x) * std::cos(y) + std::sqrt(std::abs(x - y)));
  EXPECT_DOUBLE_EQ(at("x/y/2 - 1e-3", x, y), x / y / 2 - 1e-3);
}

TEST(Expression, PowersBindToTheRightAndBeforeSigns) {
  EXPECT_EQ(at("2^3^2", 0, 0), 512);
  EXPECT_EQ(at("-x^2", 3, 0), -9);
  EXPECT_EQ(at("2^-1", 0, 0), 0.5);
}

TEST(Expression, ConditionsChoose) {
  const std::string steps = "x < 0.3 ? 1 : (x <= 0.6 ? 2 : 3)";
  EXPECT_EQ(at(steps, 0.2, 0), 1);
  EXPECT_EQ(at(steps, 0.6, 0), 2);
  EXPECT_EQ(at(steps, 0.7, 0), 3);
  EXPECT_EQ(at("x > 0.5 && y != 1 || x == 0", 0.6, 0), 1);
  EXPECT_EQ(at("x >= 0.5 ? 1/x : 0", 0, 0), 0);  // the branch not taken may be infinite
}

// py-expression-eval #60, cexprtk #12, mathjs #1262: 0.2 < x < 0.5 was (0.2 < x) < 0.5, which is
// true of every x <= 0.2 and false beyond.
TEST(Expression, AChainOfComparisonsMeansWhatMathematicsMeans) {
  for (const std::string chain :
       {"0.2 < x < 0.5", "0.5 > x > 0.2", "0.2 < x <= 0.5 && 1 > 0", "0 < x - 0.2 < y - 0.2"})
    for (const double x : {-1.0, 0.0, 0.2, 0.3, 0.5, 0.7, 2.0}) {
      const bool holds = 0.2 < x && (chain.find("<= 0.5") != chain.npos ? x <= 0.5 : x < 0.5);
      EXPECT_EQ(at("10*(" + chain + ")", x, 0.5), holds ? 10 : 0) << chain << " at " << x;
      EXPECT_EQ(at(chain + " ? 7 : 3", x, 0.5), holds ? 7 : 3) << chain << " at " << x;
    }
  EXPECT_EQ(at("0 <= x <= y <= 1", 0.3, 0.2), 0);
  EXPECT_EQ(at("0 <= x <= y <= 1", 0.2, 0.3), 1);
  EXPECT_EQ(at("x == y == 0.5", 0.5, 0.5), 1);
  EXPECT_EQ(at("x == y == 0", 0, 0), 1);        // (x == y) == 0 is false there
  EXPECT_EQ(at("x == y == 0", 1, 2), 0);        // and true here
  EXPECT_EQ(at("(0.2 < x) < 0.5", 0.1, 0), 1);  // in brackets: what they say
}

// Other texts that a reader takes in two ways: each has the meaning of mathematics, which C++ or
// numpy may not share, or is refused.
TEST(Expression, HasNoSecondMeaning) {
  EXPECT_EQ(at("-2^2", 0, 0), -4);
  EXPECT_EQ(at("2^-1", 0, 0), 0.5);
  EXPECT_EQ(at("2^3^2", 0, 0), 512);
  EXPECT_EQ(at("2^-2^2", 0, 0), 1.0 / 16);
  EXPECT_EQ(at("1/2", 0, 0), 0.5);  // no division of integers
  EXPECT_EQ(at("7/2*2", 0, 0), 7);
  EXPECT_EQ(at("+x - +1", 3, 0), 2);
  EXPECT_EQ(at("x < 0.3 ? 1 : x < 0.6 ? 2 : 3", 0.7, 0), 3);
  EXPECT_EQ(at("x < 0.3 ? 1 : x < 0.6 ? 2 : 3", 0.1, 0), 1);
  EXPECT_EQ(at("1 > 0 || x > 1 && y > 1", 0, 0), 1);  // && binds tighter
  EXPECT_EQ(at("-x < y && x + 1 > 2*y", 1, 0.5), 1);
  EXPECT_EQ(at("log(exp(2))", 0, 0), 2);             // natural
  for (const std::string text : {"x < y == 1",       // C: (x < y) == 1; mathematics: x < y = 1
                                 "x < y > 0.5",      // two directions
                                 "x != y != 1",      // not transitive
                                 "x == 0.2 || 0.5",  // always true in C: "x is 0.2 or 0.5" is meant
                                 "0.5 && x < 1",
                                 "x ? 1 : 2",
                                 "x < 1 && y ? 1 : 2",
                                 "x + y ? 1 : 2",  // numbers as conditions
                                 "!x",
                                 "x < !y",
                                 "1e3x",
                                 "2x",
                                 "2 x",
                                 "2(x)",
                                 "(x)(y)",
                                 "x(2)",
                                 "1/2x",
                                 "x**2",
                                 "x^^2",
                                 "1.2.3",
                                 "0,5",
                                 "0,5*x",
                                 "1 000",
                                 "1_000",
                                 "sin x",
                                 "sin^2(x)",
                                 "X",
                                 "PI",
                                 "Sin(x)",
                                 "SIN(x)",
                                 "sin(0,5)",
                                 "atan2(0,5, 1)",
                                 "x % 2",
                                 "x = 1",
                                 "x =< 1",
                                 "x => 1",
                                 "x <> 1",
                                 "x < = 1",
                                 "|x|",
                                 "x!",
                                 "x and y",
                                 "not x",
                                 "1e",
                                 "1d3",
                                 "1e400",
                                 "x > 0.2 && < 0.5"})
    EXPECT_NE(refusal([&] { Expression(text, {"x", "y"}); }), "") << text;
  const std::string said = refusal([] { Expression("x < y == 1", {"x", "y"}); });
  EXPECT_NE(said.find("all < and <=, all > and >=, or all =="), std::string::npos) << said;
}

TEST(Expression, DoesNotDependOnTheLocale) {
  const char* const before =
      std::setlocale(LC_ALL, "de_DE.UTF-8");  // a comma for the decimal point, where installed
  EXPECT_EQ(at("0.5*x", 3, 0), 1.5);
  std::setlocale(LC_ALL, "C");
  (void)before;
}

TEST(Expression, KeepsItsOwnVariables) {
  const Expression f("x - y", {"x", "y"}), g("x", {"x"});
  EXPECT_EQ(g(7), 7);
  EXPECT_EQ(f(3, 1), 2);
  const Expression copy =
      f;  // NOLINT(performance-unnecessary-copy-initialization): the copy is what is tested
  EXPECT_EQ(copy(5, 1), 4);
  EXPECT_EQ(f(3, 1), 2);
}

TEST(Expression, ServesSeveralThreads) {
  const Expression f("x*x", {"x"});
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  threads.reserve(wrong.size());
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&f, &wrong, t] {
      for (int i = 0; i < 20000; ++i) wrong[t] += f(t + i) != static_cast<double>(t + i) * (t + i);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(Expression, SaysWhereItIsNotFinite) {
  const Expression f("1/(x - y)", {"x", "y"});
  EXPECT_EQ(f(1, 0.5), 2);
  EXPECT_NE(refusal([&] { f(0.25, 0.25); }).find("x = 0.25, y = 0.25"), std::string::npos);
}

TEST(Expression, RefusesInOneLineWhatItDoesNotUnderstand) {
  std::vector<std::string> texts{"",     " ",     "x +",  "z",     "2x",       "x = 1",
                                 "x, y", "\"x\"", "_pi",  "_e",    "e",        "sin x",
                                 "(x",   "x)",    "x**2", "x ? 1", "f(x)",     "x;y",
                                 "x\ny", "1.2.3", "0x1",  "x'",    "\xc3\xa9", "sin(x,y)"};
  texts.emplace_back("x\0y", 3);
  texts.emplace_back(5000, '(');
  for (const std::string& text : texts) {
    const std::string said = refusal([&] { Expression(text, {"x", "y"}); });
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    EXPECT_NE(said, "") << text;
  }
  EXPECT_THROW(Expression("y", {"x"}), Error);
}

TEST(Expression, TakesAsManyValuesAsItHasNames) {
  const Expression sum("x + y", {"x", "y"});
  const std::array<double, 3> values = {1, 2, 3};
  EXPECT_EQ(sum(std::span(values).first(2)), 3);
  EXPECT_THROW(sum(values), Error);
  EXPECT_THROW(sum(std::span(values).first(1)), Error);
}

}  // namespace antilock::test::expression_test
