#pragma once
#include <string>
#include <vector>

namespace antilock::figures {

struct Tick {
  double value;
  std::string label;  ///< markup; empty: a small tick without a number
};

/// A range of numbers with its ticks, on a linear or a logarithmic scale.
class Axis {
 public:
  /// Widens [low, high] by a fraction `room` of its length, so that no point lies on the frame. At
  /// most `most` ticks have numbers. Throws Error for a range that cannot be drawn.
  static Axis logarithmic(double low, double high, double room = 0.07, int most = 8);
  /// Does the same with ticks at 1, 1/2, 1/4, ..., the usual mesh widths.
  static Axis halving(double low, double high, double room = 0.07, int most = 8);
  /// Makes the axis of exactly [low, high], with about `about` ticks. Throws Error likewise.
  static Axis linear(double low, double high, int about = 5);
  /// Returns the place of a value between the ends, 0 to 1.
  double place(double value) const;
  const std::vector<Tick>& ticks() const { return ticks_; }
  double low() const { return low_; }
  double high() const { return high_; }

 private:
  static Axis widened(double low, double high, double room);
  Axis(double low, double high, bool logarithmic)
      : low_(low), high_(high), logarithmic_(logarithmic) {}
  double low_, high_;
  bool logarithmic_;
  std::vector<Tick> ticks_;
};

/// Returns the markup of a power of ten: `$10^{−6}$`, but 1 and 10 without an exponent.
std::string power_markup(int power);

/// Returns the markup of a number in the usual notation: `0.05`, `−0.2`, `$10^{−6}$`.
std::string number_markup(double value);

}  // namespace antilock::figures
