#include "antilock/io/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr std::size_t longest_text = 4000;
constexpr double largest_value = 1e100;  // squared, as an energy is, it still is a double
constexpr int most_nested = 200;

using One = double (*)(double);
using Two = double (*)(double, double);

struct Operator {
  std::string_view sign;
  int binds;  ///< the larger, the tighter; a sign before a value binds as tightly as `sign_binds`
  Two value;
};
constexpr int sign_binds = 6, power_binds = 7;
constexpr std::array<Operator, 13> operators{{{"||", 1, [](double a, double b) { return double(a != 0 || b != 0); }},
                                              {"&&", 2, [](double a, double b) { return double(a != 0 && b != 0); }},
                                              {"<=", 3, [](double a, double b) { return double(a <= b); }},
                                              {">=", 3, [](double a, double b) { return double(a >= b); }},
                                              {"==", 3, [](double a, double b) { return double(a == b); }},
                                              {"!=", 3, [](double a, double b) { return double(a != b); }},
                                              {"<", 3, [](double a, double b) { return double(a < b); }},
                                              {">", 3, [](double a, double b) { return double(a > b); }},
                                              {"+", 4, [](double a, double b) { return a + b; }},
                                              {"-", 4, [](double a, double b) { return a - b; }},
                                              {"*", 5, [](double a, double b) { return a * b; }},
                                              {"/", 5, [](double a, double b) { return a / b; }},
                                              {"^", power_binds, [](double a, double b) { return std::pow(a, b); }}}};

double sign_of(double a) { return double(a > 0) - double(a < 0); }
double half_up(double a) { return std::floor(a + 0.5); }
const std::map<std::string_view, One> functions{
    {"sin", std::sin},   {"cos", std::cos},   {"tan", std::tan},   {"asin", std::asin},   {"acos", std::acos},
    {"atan", std::atan}, {"sinh", std::sinh}, {"cosh", std::cosh}, {"tanh", std::tanh},   {"exp", std::exp},
    {"ln", std::log},    {"log", std::log},   {"log2", std::log2}, {"log10", std::log10}, {"sqrt", std::sqrt},
    {"abs", std::fabs},  {"sign", sign_of},   {"rint", half_up}};
const std::map<std::string_view, Two> functions_of_two{{"min", [](double a, double b) { return std::min(a, b); }},
                                                       {"max", [](double a, double b) { return std::max(a, b); }},
                                                       {"atan2", std::atan2}};

/// A formula is a list of steps on a stack of values.
struct Step {
  enum { number, variable, one, two, jump_unless, jump } kind;
  double value = 0;
  int at = 0;  ///< of the variable, or of the step to go on with
  One of_one = nullptr;
  Two of_two = nullptr;
};

class Reader {
 public:
  Reader(std::string_view text, const std::vector<std::string>& names) : text_(text), names_(names) {}
  std::vector<Step> read() {
    choice();
    if (next(), at_ < text_.size()) fail(fmt::format("\"{}\" is not expected", printable({text_[at_]})));
    return std::move(steps_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw Error(fmt::format("{} at position {}", why, at_ + 1)); }
  void next() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  bool took(std::string_view sign) {
    next();
    if (text_.substr(at_, sign.size()) != sign) return false;
    at_ += sign.size();
    return true;
  }
  void expect(std::string_view sign) {
    if (!took(sign)) fail(fmt::format("\"{}\" is missing", sign));
  }
  std::size_t put(Step step) {
    const std::size_t takes = step.kind == Step::two ? 2 : step.kind == Step::one ? 1 : 0;
    const auto values = steps_.end() - static_cast<std::ptrdiff_t>(takes);
    // of numbers, all behind the last place that is jumped to: its value now, not at every point
    if (takes > 0 && steps_.size() >= jumped_to_ + takes &&
        std::all_of(values, steps_.end(), [](const Step& s) { return s.kind == Step::number; })) {
      values->value = takes == 2 ? step.of_two(values[0].value, values[1].value) : step.of_one(values->value);
      steps_.erase(values + 1, steps_.end());
    } else {
      steps_.push_back(step);
    }
    return steps_.size() - 1;
  }

  void choice() {
    binary(1);
    if (took("?")) {
      const std::size_t unless = put({Step::jump_unless});
      choice();
      expect(":");
      const std::size_t past = put({Step::jump});
      steps_[unless].at = static_cast<int>(jumped_to_ = steps_.size());
      choice();
      steps_[past].at = static_cast<int>(jumped_to_ = steps_.size());
    }
  }
  /// A value, and all that binds to it at least as tightly as `least`.
  void binary(int least) {
    if (++nested_ > most_nested) fail("too many values wait for what follows");
    if (took("-")) {
      binary(sign_binds);
      put({.kind = Step::one, .of_one = [](double a) { return -a; }});
    } else if (took("+")) {
      binary(sign_binds);
    } else {
      value();
    }
    for (;;) {
      next();
      const auto* const found = std::find_if(operators.begin(), operators.end(), [&](const Operator& o) {
        return text_.substr(at_, o.sign.size()) == o.sign;
      });
      if (found == operators.end() || found->binds < least) break;
      at_ += found->sign.size();
      binary(found->binds == power_binds ? power_binds : found->binds + 1);  // 2^3^2 = 2^9, but 1-2-3 = (1-2)-3
      put({.kind = Step::two, .of_two = found->value});
    }
    --nested_;
  }
  void value() {
    next();
    const std::string_view rest = text_.substr(at_);
    const auto in = [](char c, char first, char last) { return first <= c && c <= last; };
    const auto letter = [&](char c) { return in(c, 'a', 'z') || in(c, 'A', 'Z') || c == '_'; };
    if (rest.empty()) fail("a value is missing");
    if (took("(")) {
      choice();
      expect(")");
    } else if (in(rest[0], '0', '9') || rest[0] == '.') {
      double number = 0;
      const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
      if (error != std::errc{}) fail("a number is expected");
      at_ += static_cast<std::size_t>(end - rest.data());
      put({.kind = Step::number, .value = number});
    } else if (letter(rest[0])) {
      const auto* const end =
          std::find_if_not(rest.begin(), rest.end(), [&](char c) { return letter(c) || in(c, '0', '9'); });
      name(rest.substr(0, static_cast<std::size_t>(end - rest.begin())));
    } else {
      fail(fmt::format("\"{}\" is not expected", printable({rest[0]})));
    }
  }
  void name(std::string_view name) {
    const auto variable = std::find(names_.begin(), names_.end(), name);
    const auto function = functions.find(name);
    const auto of_two = functions_of_two.find(name);
    if (variable == names_.end() && name != "pi" && function == functions.end() && of_two == functions_of_two.end())
      fail(fmt::format("\"{}\" is unknown", printable(std::string(name))));
    at_ += name.size();
    if (variable != names_.end()) {
      put({.kind = Step::variable, .at = static_cast<int>(variable - names_.begin())});
      return;
    }
    if (name == "pi") {
      put({.kind = Step::number, .value = std::numbers::pi});
      return;
    }
    expect("(");
    choice();
    if (function != functions.end()) {
      put({.kind = Step::one, .of_one = function->second});
    } else {
      do {
        expect(",");
        choice();
        put({.kind = Step::two, .of_two = of_two->second});
      } while (name != "atan2" && (next(), text_.substr(at_, 1) == ","));
    }
    expect(")");
  }

  std::string_view text_;
  const std::vector<std::string>& names_;
  std::vector<Step> steps_;
  std::size_t at_ = 0, jumped_to_ = 0;
  int nested_ = 0;
};

constexpr std::size_t most_at_once = 8;

/// The values at `count` points, at most most_at_once, or at one where the steps jump; variable v is variables[v * stride + k]
/// at point k.
void run(const std::vector<Step>& steps, const double* variables, std::size_t stride, std::size_t count,
         double* values) {
  // a left side and a first argument wait per level at most
  std::array<std::array<double, most_at_once>, 2 * most_nested + 1> stack;
  auto* top = stack.data();  // behind the last value
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& step = steps[i];
    switch (step.kind) {
      case Step::number:
        (top++)->fill(step.value);
        break;
      case Step::variable:
        std::copy_n(variables + static_cast<std::size_t>(step.at) * stride, count, (top++)->begin());
        break;
      case Step::one:
        for (std::size_t k = 0; k < count; ++k) top[-1][k] = step.of_one(top[-1][k]);
        break;
      case Step::two:
        --top;
        for (std::size_t k = 0; k < count; ++k) top[-1][k] = step.of_two(top[-1][k], top[0][k]);
        break;
      case Step::jump_unless:
        if ((--top)->front() == 0) i = static_cast<std::size_t>(step.at) - 1;
        break;
      case Step::jump:
        i = static_cast<std::size_t>(step.at) - 1;
    }
  }
  std::copy_n(stack[0].begin(), count, values);
}

}  // namespace

std::string printable(const std::string& text, std::size_t longest) {
  std::string line = text.size() > longest ? text.substr(0, longest) + "..." : text;
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c >= 0x7f; }, '?');
  return line;
}

struct Expression::Parser {
  std::string text;
  std::vector<std::string> names;
  std::vector<Step> steps;
  std::size_t at_once;
};

Expression::Expression(const std::string& text, const std::vector<std::string>& variables) {
  const auto refuse = [&](const std::string& why) {
    throw Error(
        fmt::format("\"{}\" {}; accepted: an expression in {} with + - * / ^, comparisons, c ? a : b, pi, sin, "
                    "cos, exp, sqrt, abs",
                    printable(text), why, fmt::join(variables, " and ")));
  };
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) refuse("is empty");
  if (text.size() > longest_text) refuse(fmt::format("is longer than {} characters", longest_text));
  try {
    std::vector<Step> steps = Reader(text, variables).read();
    const bool jumps =
        std::any_of(steps.begin(), steps.end(), [](const Step& s) { return s.kind >= Step::jump_unless; });
    parser_ = std::make_shared<const Parser>(Parser{text, variables, std::move(steps), jumps ? 1 : most_at_once});
  } catch (const Error& error) {
    refuse(std::string("does not parse: ") + error.what());
  }
}

void Expression::operator()(std::span<const double> variables, std::span<double> values) const {
  const auto& [text, names, steps, at_once] = *parser_;
  const std::size_t points = values.size();
  if (variables.size() != names.size() * points)
    throw Error(
        fmt::format("\"{}\" takes {} values, not {}", printable(text), names.size() * points, variables.size()));
  for (std::size_t k = 0; k < points; k += at_once)
    run(steps, variables.data() + k, points, std::min(at_once, points - k), values.data() + k);
  for (std::size_t k = 0; k < points; ++k) {
    if (std::abs(values[k]) <= largest_value) continue;
    std::string place;
    for (std::size_t i = 0; i < names.size(); ++i)
      place += fmt::format("{}{} = {:.6g}", i > 0 ? ", " : "", names[i], variables[i * points + k]);
    throw Error(fmt::format("\"{}\" is {} at {}; accepted: finite values, none beyond {:g}", printable(text),
                            std::isfinite(values[k]) ? fmt::format("{:g}", values[k]) : "not finite", place,
                            largest_value));
  }
}

double Expression::operator()(std::span<const double> variables) const {
  double value = 0;
  (*this)(variables, {&value, 1});
  return value;
}

double Expression::operator()(double x, double y) const {
  const std::array<double, 2> point = {x, y};
  return (*this)(point);
}

}  // namespace antilock
