#include "antilock/io/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr std::size_t longest_text = 4000;
constexpr double largest_value = 1e100;  // squared, as an energy is, it still is a double

std::string accepted(const std::vector<std::string>& variables) {
  return fmt::format(
      "accepted: an expression in {} with + - * / ^, comparisons, c ? a : b, pi, sin, cos, exp, sqrt, abs",
      fmt::join(variables, " and "));
}

/// muParser takes `x = 3` for an order to change x.
bool assigns(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=')
      ++i;
    else if (i == 0 || std::string("<>!").find(text[i - 1]) == std::string::npos)
      return true;
  }
  return false;
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
  std::vector<double> values;  // muParser reads its variables from here
  mu::Parser parser;
  std::mutex in_use;
};

Expression::Expression(const std::string& text, const std::vector<std::string>& variables)
    : parser_(std::make_shared<Parser>()) {
  const auto refuse = [&](const std::string& why) {
    throw Error(fmt::format("\"{}\" {}; {}", printable(text), why, accepted(variables)));
  };
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) refuse("is empty");
  if (text.size() > longest_text) refuse(fmt::format("is longer than {} characters", longest_text));
  if (text.find('"') != std::string::npos) refuse("holds a quotation mark");
  if (text.find('\0') != std::string::npos) refuse("holds a null character");  // muParser would stop there
  if (assigns(text)) refuse("assigns a value with =");
  parser_->text = text;
  parser_->names = variables;
  parser_->values.assign(variables.size(), 0.5);
  int results = 0;
  try {
    mu::Parser& parser = parser_->parser;
    parser.ClearConst();  // _pi and _e
    parser.DefineConst("pi", std::numbers::pi);
    for (std::size_t i = 0; i < variables.size(); ++i) parser.DefineVar(variables[i], &parser_->values[i]);
    parser.SetExpr(text);
    parser.Eval(results);  // the first evaluation parses
  } catch (const mu::ParserError& error) {
    refuse("does not parse: " + printable(error.GetMsg(), 120));
  }
  if (results != 1) refuse(fmt::format("holds {} values", results));
}

double Expression::operator()(std::span<const double> values) const {
  if (values.size() != parser_->values.size())
    throw Error(
        fmt::format("\"{}\" takes {} values, not {}", printable(parser_->text), parser_->values.size(), values.size()));
  const std::lock_guard lock(parser_->in_use);
  std::copy(values.begin(), values.end(), parser_->values.begin());
  double value = 0;
  try {
    value = parser_->parser.Eval();
  } catch (const mu::ParserError& error) {
    throw Error(fmt::format("\"{}\" has no value: {}", printable(parser_->text), printable(error.GetMsg(), 120)));
  }
  if (!(std::abs(value) <= largest_value)) {
    std::string place;
    for (std::size_t i = 0; i < values.size(); ++i)
      place += fmt::format("{}{} = {:.6g}", i > 0 ? ", " : "", parser_->names[i], values[i]);
    throw Error(fmt::format("\"{}\" is {} at {}; accepted: finite values, none beyond {:g}", printable(parser_->text),
                            std::isfinite(value) ? fmt::format("{:g}", value) : "not finite", place, largest_value));
  }
  return value;
}

double Expression::operator()(double x, double y) const {
  const std::array<double, 2> point = {x, y};
  return (*this)(point);
}

}  // namespace antilock
