#include "drawing/shapes.hpp"

#include <numbers>

namespace antilock::figures {

std::vector<std::vector<Point>> dashed(const std::vector<Point>& points,
                                       const std::vector<double>& pattern) {
  std::vector<std::vector<Point>> dashes;
  std::size_t phase = 0;
  double left = pattern[0];
  std::vector<Point> dash{points.front()};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    Point at = points[i];
    while (length(points[i + 1] - at) > left) {
      at = at + (left / length(points[i + 1] - at)) * (points[i + 1] - at);
      dash.push_back(at);
      if (phase % 2 == 0) dashes.push_back(dash);
      dash = {at};
      left = pattern[++phase % pattern.size()];
    }
    left -= length(points[i + 1] - at);
    dash.push_back(points[i + 1]);
  }
  if (phase % 2 == 0) dashes.push_back(dash);
  return dashes;
}

std::vector<Point> outline(Marker shape) {
  const auto regular = [](int corners, double first, double radius) {
    std::vector<Point> points;
    for (int i = 0; i < corners; ++i) {
      const double angle = first + 2 * std::numbers::pi * i / corners;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return points;
  };
  constexpr double up = std::numbers::pi / 2;
  switch (shape) {
    case Marker::circle:
      return regular(40, 0, 1);
    case Marker::square:
      return regular(4, up / 2, 1.2);
    case Marker::diamond:
      return regular(4, 0, 1.25);
    case Marker::triangle:
      return regular(3, up, 1.25);
    case Marker::down_triangle:
      return regular(3, -up, 1.25);
    case Marker::cross:
      return regular(4, up / 2, 1.1);
  }
  return {};
}

}  // namespace antilock::figures
