#pragma once
#include <vector>

#include "drawing/panel.hpp"
#include "drawing/styles.hpp"

namespace antilock::figures {

/// The runs of one curve without a solution, as bars in a strip at the top of a panel. Runs that
/// follow each other have one bar from the first to the last, so that it does not look like data.
struct Failures {
  Colour colour;
  std::vector<std::pair<double, double>> ranges;  ///< of x
};

constexpr double strip_bar = 30;  ///< height in the strip for each curve with failures, in pixels
/// Returns the height of the strip for this number of curves, in pixels.
double strip_height(std::size_t curves);

/// Draws the strip.
void draw_strip(Page& page, const Panel& panel, const std::vector<Failures>& failures,
                std::size_t curves);
/// Draws the sample of a failure for a legend.
void draw_failure(Page& page, const Box& box);

/// Draws triangles whose long sides have the given slopes, side by side in the corner of the panel
/// that has the fewest of the points `taken`.
void draw_slopes(Page& page, const Panel& panel, const std::vector<double>& slopes,
                 const std::vector<Point>& taken);

}  // namespace antilock::figures
