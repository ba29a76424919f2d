#pragma once
#include <string>
#include <vector>

namespace antilock::figures {

struct Tick {
  double value;
  std::string label;  ///< markup; empty: a small tick without a number
};

/// A range of numbers with its ticks, on a straight or a logarithmic scale.
class Axis {
 public:
  /// Widens [low, high] by a share `room` of its length, so that no point lies on the frame;
  /// numbers at `most` ticks at most. Throws Error for a range that cannot be drawn.
  static Axis logarithmic(double low, double high, double room = 0.07, int most = 8);
  /// The same with ticks at 1, 1/2, 1/4, ..., as mesh widths are chosen.
  static Axis halving(double low, double high, double room = 0.07, int most = 8);
  /// Exactly [low, high], with about as many ticks as asked for. Throws Error likewise.
  static Axis linear(double low, double high, int about = 5);
  /// Where a value lies between the ends, 0 to 1.
  double place(double value) const;
  const std::vector<Tick>& ticks() const { return ticks_; }
  double low() const { return low_; }
  double high() const { return high_; }

 private:
  static Axis widened(double low, double high, double room);
  Axis(double low, double high, bool logarithmic) : low_(low), high_(high), logarithmic_(logarithmic) {}
  double low_, high_;
  bool logarithmic_;
  std::vector<Tick> ticks_;
};

/// `$10^{−6}$`, and 1 and 10 as they are.
std::string power_markup(int power);

/// A number as a reader writes it: `0.05`, `−0.2`, `$10^{−6}$`.
std::string number_markup(double value);

}  // namespace antilock::figures
