#include "drawing/axis.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>

#include "antilock/core/error.hpp"

namespace antilock::figures {

std::string power_markup(int power) {
  return power == 0 ? "1" : fmt::format("$10^{{{}{}}}$", power < 0 ? "−" : "", std::abs(power));
}

std::string number_markup(double value) {
  if (value == 0) return "0";
  const std::string sign = value < 0 ? "−" : "";
  const double size = std::abs(value);
  const int exponent = static_cast<int>(std::floor(std::log10(size) + 1e-9));
  if (exponent >= -3 && exponent < 4) return sign + fmt::format("{:.4g}", size);
  const std::string power = exponent < 0 ? fmt::format("−{}", -exponent) : fmt::format("{}", exponent);
  const double leading = size / std::pow(10, exponent);
  if (std::abs(leading - 1) < 1e-9) return fmt::format("${}10^{{{}}}$", sign, power);
  return fmt::format("${}{:.3g} × 10^{{{}}}$", sign, leading, power);
}

std::string entry_markup(const std::string& column, const std::string& value) {
  static const std::map<std::string, std::string> names{{"P1", "$P_1$"},
                                                        {"P2", "$P_2$"},
                                                        {"P3", "$P_3$"},
                                                        {"P4", "$P_4$"},
                                                        {"CR", "Crouzeix–Raviart"},
                                                        {"structured", "structured mesh"},
                                                        {"unstructured", "unstructured mesh"}};
  if (const auto found = names.find(value); found != names.end()) return found->second;
  if (const auto space = value.find(' '); space != value.npos)  // a method: an element and its mesh
    if (const auto element = names.find(value.substr(0, space)); element != names.end())
      return element->second + ", " + entry_markup("", value.substr(space + 1));
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc{} || end != value.data() + value.size()) return value;
  const bool power_of_ten = number > 0 && std::abs(std::log10(number) - std::round(std::log10(number))) < 1e-9;
  std::string written = number_markup(number);
  if (power_of_ten && number < 0.5) written = power_markup(static_cast<int>(std::lround(std::log10(number))));
  return (column == "epsilon" ? "$ε =$ " : column == "h" ? "$h =$ " : column + " = ") + written;
}

Axis Axis::logarithmic(double low, double high, double room) {
  if (!(low > 0 && high >= low && std::isfinite(high)))
    throw Error(fmt::format("a logarithmic axis from {} to {} cannot be drawn; accepted: positive values", low, high));
  const double widened = room > 0 || high == low ? std::max(room, 0.07) * std::max(std::log10(high / low), 0.3) : 1e-9;
  Axis axis(low * std::pow(10, -widened), high * std::pow(10, widened), true);
  const double decades = std::log10(axis.high_ / axis.low_);
  // few decades, or hardly a power of ten in them: 1, 2 and 5 carry numbers
  const bool few = decades < 1.6 || std::floor(std::log10(axis.high_)) - std::ceil(std::log10(axis.low_)) < 1;
  for (int power = static_cast<int>(std::floor(std::log10(axis.low_))); std::pow(10, power) <= axis.high_; ++power)
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10, power);
      if (value < axis.low_ || value > axis.high_) continue;
      std::string label;
      if (few) {
        if (digit == 1 || digit == 2 || digit == 5) label = number_markup(value);
      } else if (digit == 1 && power % static_cast<int>(std::ceil(decades / 8)) == 0) {
        label = power_markup(power);
      }
      if (!label.empty() || decades < 10) axis.ticks_.push_back({value, label});
    }
  return axis;
}

Axis Axis::linear(double low, double high, int about) {
  if (!(high > low && std::isfinite(high - low)))
    throw Error(fmt::format("an axis from {} to {} cannot be drawn", low, high));
  Axis axis(low, high, false);
  const double rough = (high - low) / about, power = std::pow(10, std::floor(std::log10(rough)));
  const double step = power * (rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10);
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    axis.ticks_.push_back({k * step, number_markup(std::abs(k) < 0.5 ? 0 : k * step)});
  return axis;
}

double Axis::place(double value) const {
  return logarithmic_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
}

}  // namespace antilock::figures
