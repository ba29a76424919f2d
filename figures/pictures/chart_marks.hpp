#pragma once
#include <vector>

#include "drawing/panel.hpp"
#include "drawing/styles.hpp"

namespace antilock::figures {

/// The runs of one curve that gave no answer, as bars in a strip at the top of a panel: one bar
/// from the first to the last of the runs that follow each other, so that it does not read as data.
struct Failures {
  Colour colour;
  std::vector<std::pair<double, double>> ranges;  ///< of x
};

constexpr double strip_bar = 30;  ///< height in the strip per curve with failures, in pixels
double strip_height(std::size_t curves);

/// Draws the strip.
void draw_strip(Page& page, const Panel& panel, const std::vector<Failures>& failures, std::size_t curves);
/// Its sample for a legend.
void draw_failure(Page& page, const Box& box);

/// Triangles whose long sides have the given slopes, side by side in the corner of the panel that
/// holds the fewest of these places on the page.
void draw_slopes(Page& page, const Panel& panel, const std::vector<double>& slopes, const std::vector<Point>& taken);

}  // namespace antilock::figures
