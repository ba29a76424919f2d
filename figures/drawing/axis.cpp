#include "drawing/axis.hpp"

#include <fmt/format.h>

#include <cmath>

#include "antilock/core/error.hpp"

namespace antilock::figures {

std::string power_markup(int power) {
  return power == 0   ? "1"
         : power == 1 ? "10"
                      : fmt::format("$10^{{{}{}}}$", power < 0 ? "−" : "", std::abs(power));
}

std::string number_markup(double value) {
  if (value == 0) return "0";
  const std::string sign = value < 0 ? "−" : "";
  const double size = std::abs(value);
  const int exponent = static_cast<int>(std::floor(std::log10(size) + 1e-9));
  if (exponent >= -3 && exponent < 4) return sign + fmt::format("{:.4g}", size);
  const std::string power =
      exponent < 0 ? fmt::format("−{}", -exponent) : fmt::format("{}", exponent);
  const double leading = size / std::pow(10, exponent);
  if (std::abs(leading - 1) < 1e-9) return fmt::format("${}10^{{{}}}$", sign, power);
  return fmt::format("${}{:.3g} × 10^{{{}}}$", sign, leading, power);
}

Axis Axis::widened(double low, double high, double room) {
  if (!(low > 0 && high >= low && std::isfinite(high)))
    throw Error(fmt::format(
        "a logarithmic axis from {} to {} cannot be drawn; accepted: positive values", low, high));
  const double more =
      room > 0 || high == low ? std::max(room, 0.07) * std::max(std::log10(high / low), 0.3) : 1e-9;
  const Axis axis(low * std::pow(10, -more), high * std::pow(10, more), true);
  if (!(axis.low_ > 0 &&
        std::isfinite(axis.high_)))  // its powers of ten would be counted without end
    throw Error(
        fmt::format("a logarithmic axis from {} to {} cannot be drawn; accepted: values with room "
                    "beside them in "
                    "double precision",
                    low, high));
  return axis;
}

Axis Axis::logarithmic(double low, double high, double room, int most) {
  Axis axis = widened(low, high, room);
  const double decades = std::log10(axis.high_ / axis.low_);
  // few decades, or hardly a power of ten in them: 1, 2 and 5 carry numbers
  const bool few =
      decades < 1.6 || std::floor(std::log10(axis.high_)) - std::ceil(std::log10(axis.low_)) < 1;
  const int every = static_cast<int>(std::ceil(decades / most));
  for (int power = static_cast<int>(std::floor(std::log10(axis.low_)));
       std::pow(10, power) <= axis.high_; ++power)
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10, power);
      if (value < axis.low_ || value > axis.high_) continue;
      std::string label;
      if (few) {
        if (digit == 1 || digit == 2 || digit == 5) label = number_markup(value);
      } else if (digit == 1 && power % every == 0) {
        label = power_markup(power);
      }
      if (!label.empty() || decades < 10) axis.ticks_.push_back({value, label});
    }
  return axis;
}

Axis Axis::halving(double low, double high, double room, int most) {
  Axis axis = widened(low, high, room);
  const int first = static_cast<int>(std::ceil(std::log2(axis.low_))),
            last = static_cast<int>(std::floor(std::log2(axis.high_))),
            every = (last - first) / most + 1;
  for (int power = first; power <= last; ++power) {
    const std::string label =
        power < 0 ? fmt::format("1/{}", 1L << -power) : fmt::format("{}", 1L << power);
    axis.ticks_.push_back({std::exp2(power), power % every == 0 ? label : ""});
  }
  return axis;
}

Axis Axis::linear(double low, double high, int about) {
  if (!(high > low && std::isfinite(high - low)))
    throw Error(fmt::format("an axis from {} to {} cannot be drawn", low, high));
  Axis axis(low, high, false);
  const double rough = (high - low) / about, power = std::pow(10, std::floor(std::log10(rough)));
  const double step = power * (rough / power < 1.5   ? 1
                               : rough / power < 3.5 ? 2
                               : rough / power < 7.5 ? 5
                                                     : 10);
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    axis.ticks_.push_back({k * step, number_markup(std::abs(k) < 0.5 ? 0 : k * step)});
  return axis;
}

double Axis::place(double value) const {
  return logarithmic_ ? std::log(value / low_) / std::log(high_ / low_)
                      : (value - low_) / (high_ - low_);
}

}  // namespace antilock::figures
