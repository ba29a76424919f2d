#pragma once
#include <vector>

#include "drawing/geometry.hpp"

namespace antilock::figures {

enum class Marker { circle, square, diamond, triangle, down_triangle, cross };

/// Returns the corners of a marker of diameter about 2 around the origin. The cross is drawn along
/// its diagonals.
std::vector<Point> outline(Marker shape);

/// Cuts a line into its dashes. The lengths of the pattern are drawn, skipped, drawn, ..., in
/// pixels.
std::vector<std::vector<Point>> dashed(const std::vector<Point>& points,
                                       const std::vector<double>& pattern);

}  // namespace antilock::figures
