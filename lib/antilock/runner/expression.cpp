#include "antilock/runner/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>
#include <utility>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr std::size_t longest_text = 4000;
constexpr double largest_value = 1e100;  // squared, as an energy is, it still is a double
constexpr int most_nested = 200;
constexpr std::string_view blanks = " \t\r\n";  // a formula of a scene may have several lines

/// A formula, or a part of one, as a function of its variables.
using Value = std::function<double(const double* variables)>;
using One = double (*)(double);
using Two = double (*)(double, double);

Value one(One f, Value a) {
  return [f, a = std::move(a)](const double* at) { return f(a(at)); };
}
/// The first value, and each of the others put to what has come of those before it.
Value in_turn(Value first, std::vector<std::pair<Two, Value>> rest) {
  if (rest.empty()) return first;
  return [first = std::move(first), rest = std::move(rest)](const double* at) {
    double value = first(at);
    for (const auto& [f, next] : rest) value = f(value, next(at));
    return value;
  };
}

struct Operator {
  std::string_view sign;
  int binds;  ///< the larger, the tighter; a sign before a value binds as tightly as `sign_binds`
  Two value;
};
constexpr int or_binds = 1, and_binds = 2, comparison_binds = 3, sign_binds = 6, power_binds = 7;
constexpr std::array<Operator, 13> operators{
    {{"||", or_binds, [](double a, double b) { return double(a != 0 || b != 0); }},
     {"&&", and_binds, [](double a, double b) { return double(a != 0 && b != 0); }},
     {"<=", comparison_binds, [](double a, double b) { return double(a <= b); }},
     {">=", comparison_binds, [](double a, double b) { return double(a >= b); }},
     {"==", comparison_binds, [](double a, double b) { return double(a == b); }},
     {"!=", comparison_binds, [](double a, double b) { return double(a != b); }},
     {"<", comparison_binds, [](double a, double b) { return double(a < b); }},
     {">", comparison_binds, [](double a, double b) { return double(a > b); }},
     {"+", 4, [](double a, double b) { return a + b; }},
     {"-", 4, [](double a, double b) { return a - b; }},
     {"*", 5, [](double a, double b) { return a * b; }},
     {"/", 5, [](double a, double b) { return a / b; }},
     {"^", power_binds, [](double a, double b) { return std::pow(a, b); }}}};

/// first r1 v1 r2 v2 ... of comparisons r: 1 where v(k-1) rk vk holds for every k, else 0.
Value all_hold(Value first, std::vector<std::pair<Two, Value>> chain) {
  if (chain.size() == 1) return in_turn(std::move(first), std::move(chain));
  return [first = std::move(first), chain = std::move(chain)](const double* at) {
    bool hold = true;
    double left = first(at);
    for (const auto& [compare, next] : chain) {
      const double right = next(at);
      hold = hold && compare(left, right) != 0;
      left = right;
    }
    return double(hold);
  };
}

double sign_of(double a) { return double(a > 0) - double(a < 0); }
double half_up(double a) { return std::floor(a + 0.5); }
const std::map<std::string_view, One> functions{
    {"sin", std::sin},   {"cos", std::cos},     {"tan", std::tan},   {"asin", std::asin},
    {"acos", std::acos}, {"atan", std::atan},   {"sinh", std::sinh}, {"cosh", std::cosh},
    {"tanh", std::tanh}, {"exp", std::exp},     {"ln", std::log},    {"log", std::log},
    {"log2", std::log2}, {"log10", std::log10}, {"sqrt", std::sqrt}, {"abs", std::fabs},
    {"sign", sign_of},   {"rint", half_up}};
const std::map<std::string_view, Two> functions_of_two{
    {"min", [](double a, double b) { return std::isnan(b) ? b : std::min(a, b); }},
    {"max", [](double a, double b) { return std::isnan(b) ? b : std::max(a, b); }},
    {"atan2", std::atan2}};

class Reader {
 public:
  Reader(std::string_view text, const std::vector<std::string>& names)
      : text_(text), names_(names) {}
  Value read() {
    Value all = choice();
    if (next(), at_ < text_.size())
      fail(fmt::format("\"{}\" is not expected", printable(first_character(text_.substr(at_)))));
    return all;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw Error(fmt::format("{} at position {}", why, at_ + 1));
  }
  void next() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }
  bool took(std::string_view sign) {
    next();
    if (text_.substr(at_, sign.size()) != sign) return false;
    at_ += sign.size();
    return true;
  }
  void expect(std::string_view sign) {
    if (!took(sign)) fail(fmt::format("\"{}\" is missing", sign));
  }

  /// Refuses a number where a condition is meant, as in x == 0.2 || 0.5: no comparison was read
  /// since `before`.
  void require_comparison(int before, std::string_view beside) const {
    if (comparisons_ == before) fail(fmt::format("there is no comparison beside \"{}\"", beside));
  }

  Value choice() {
    const int before = comparisons_;
    Value condition = binary(1);
    if (!took("?")) return condition;
    require_comparison(before, "?");
    Value yes = choice();
    expect(":");
    return [condition = std::move(condition), yes = std::move(yes),
            no = choice()](const double* at) { return condition(at) != 0 ? yes(at) : no(at); };
  }
  /// A value, and all that binds to it at least as tightly as `least`.
  Value binary(int least) {
    if (++nested_ > most_nested) fail("too many values wait for what follows");
    const int at_start = comparisons_;
    Value left = took("-")   ? one([](double a) { return -a; }, binary(sign_binds))
                 : took("+") ? binary(sign_binds)
                             : value();
    std::vector<std::pair<Two, Value>>
        rest;  // in a list: a sum of 2,000 terms is no deeper than one of two
    while (const Operator* const found = operator_here(least)) {
      if (found->binds == comparison_binds) {
        left = comparison(in_turn(std::move(left), std::exchange(rest, {})));
        continue;
      }
      const bool of_conditions = found->binds == and_binds || found->binds == or_binds;
      if (of_conditions) require_comparison(at_start, found->sign);
      at_ += found->sign.size();
      const int before = comparisons_;
      // 2^3^2 = 2^9, but 1-2-3 = (1-2)-3
      rest.emplace_back(found->value,
                        binary(found->binds == power_binds ? power_binds : found->binds + 1));
      if (of_conditions) require_comparison(before, found->sign);
    }
    --nested_;
    return in_turn(std::move(left), std::move(rest));
  }
  /// The operator that stands here, if it binds at least as tightly as `least`; else null.
  const Operator* operator_here(int least) {
    next();
    const auto found = std::find_if(operators.begin(), operators.end(), [&](const Operator& o) {
      return text_.substr(at_, o.sign.size()) == o.sign;
    });
    return found == operators.end() || found->binds < least ? nullptr : &*found;
  }
  /// One comparison, or a chain of them: a < b <= c is a < b && b <= c, as in mathematics. A chain
  /// that changes its direction, or that joins == or != to others, has no one meaning there and is
  /// refused.
  Value comparison(Value first) {
    std::vector<std::pair<Two, Value>> chain;
    char direction = 0;
    while (const Operator* const found = operator_here(comparison_binds)) {
      const char here = found->sign[0];
      if (!chain.empty() && (here != direction || here == '!'))
        fail(
            "a chain of comparisons is all < and <=, all > and >=, or all ==; others need brackets "
            "or &&");
      direction = here;
      at_ += found->sign.size();
      ++comparisons_;
      chain.emplace_back(found->value, binary(comparison_binds + 1));
    }
    return all_hold(std::move(first), std::move(chain));
  }
  Value value() {
    next();
    const std::string_view rest = text_.substr(at_);
    const auto in = [](char c, char first, char last) { return first <= c && c <= last; };
    const auto letter = [&](char c) { return in(c, 'a', 'z') || in(c, 'A', 'Z') || c == '_'; };
    if (rest.empty()) fail("a value is missing");
    if (took("(")) {
      Value inside = choice();
      expect(")");
      return inside;
    }
    if (in(rest[0], '0', '9') || rest[0] == '.') {
      double number = 0;
      const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
      if (error != std::errc{}) fail("a number is expected");
      at_ += static_cast<std::size_t>(end - rest.data());
      return [number](const double*) { return number; };
    }
    if (!letter(rest[0]))
      fail(fmt::format("\"{}\" is not expected", printable(first_character(rest))));
    const auto end = std::find_if_not(rest.begin(), rest.end(),
                                      [&](char c) { return letter(c) || in(c, '0', '9'); });
    return name(rest.substr(0, static_cast<std::size_t>(end - rest.begin())));
  }
  Value name(std::string_view name) {
    const auto variable = std::find(names_.begin(), names_.end(), name);
    const auto function = functions.find(name);
    const auto of_two = functions_of_two.find(name);
    if (variable == names_.end() && name != "pi" && function == functions.end() &&
        of_two == functions_of_two.end())
      fail(fmt::format("\"{}\" is unknown", printable(name)));
    at_ += name.size();
    if (variable != names_.end())
      return [i = variable - names_.begin()](const double* at) { return at[i]; };
    if (name == "pi") return [](const double*) { return std::numbers::pi; };
    expect("(");
    Value value = choice();
    if (function != functions.end()) {
      value = one(function->second, std::move(value));
    } else {
      std::vector<std::pair<Two, Value>> rest;
      do {
        expect(",");
        rest.emplace_back(of_two->second, choice());
      } while (name != "atan2" && (next(), text_.substr(at_, 1) == ","));
      value = in_turn(std::move(value), std::move(rest));
    }
    expect(")");
    return value;
  }

  std::string_view text_;
  const std::vector<std::string>& names_;
  std::size_t at_ = 0;
  int nested_ = 0, comparisons_ = 0;  // comparisons: read so far
};

}  // namespace

std::string in_words(const std::vector<std::string>& names) {
  std::string words;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) words += i + 1 == names.size() ? " and " : ", ";
    words += names[i];
  }
  return words;
}

Expression::Expression(std::string text, std::vector<std::string> variables)
    : text_(std::move(text)), names_(std::move(variables)) {
  const auto refuse = [&](const std::string& why) {
    throw Error(fmt::format(
        "\"{}\" {}; accepted: an expression in {} with + - * / ^, comparisons, c ? a : b, pi, sin, "
        "cos, exp, sqrt, abs",
        printable(text_), why, in_words(names_)));
  };
  if (text_.find_first_not_of(blanks) == std::string::npos) refuse("is empty");
  if (text_.size() > longest_text)
    refuse(fmt::format("is longer than {} characters", longest_text));
  try {
    value_ = Reader(text_, names_).read();
  } catch (const Error& error) {
    refuse(std::string("does not parse: ") + error.what());
  }
}

double Expression::operator()(std::span<const double> variables) const {
  if (variables.size() != names_.size())
    throw Error(fmt::format("\"{}\" takes {} values, not {}", printable(text_), names_.size(),
                            variables.size()));
  const double value = value_(variables.data());
  if (std::abs(value) <= largest_value) return value;
  std::string place;
  for (std::size_t i = 0; i < names_.size(); ++i)
    place += fmt::format("{}{} = {:.6g}", i > 0 ? ", " : "", names_[i], variables[i]);
  throw Error(fmt::format(
      "\"{}\" is {} at {}; accepted: finite values, none beyond {:g}", printable(text_),
      std::isfinite(value) ? fmt::format("{:g}", value) : "not finite", place, largest_value));
}

double Expression::operator()(double x, double y) const { return (*this)(std::array{x, y}); }

double Expression::operator()(double x, double y, double z) const {
  return (*this)(std::array{x, y, z});
}

}  // namespace antilock
