#pragma once
#include <array>
#include <cmath>
#include <vector>

namespace antilock::figures {

/// A place on the page in pixels, origin at the lower left corner, y upwards.
struct Point {
  double x, y;
};
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
inline double length(Point a) { return std::hypot(a.x, a.y); }

/// A rectangle of the page in pixels.
struct Box {
  double x, y, width, height;
  double right() const { return x + width; }
  double top() const { return y + height; }
  Point centre() const { return {x + 0.5 * width, y + 0.5 * height}; }
};

/// Red, green and blue in [0, 1].
using Colour = std::array<double, 3>;

}  // namespace antilock::figures
