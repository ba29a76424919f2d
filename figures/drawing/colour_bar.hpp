#pragma once
#include <optional>
#include <string>

#include "drawing/page.hpp"

namespace antilock::figures {

/// The range of a quantity that colours (and heights) show.
struct Range {
  double low, high;
};

/// The colours of values below and above a range, where there are any.
struct Beyond {
  std::optional<Colour> below, above;
};
/// Returns the colours of the ends of the range, where data lie outside by more than a hundredth of
/// the length of the range.
Beyond beyond(const Range& range, const Range& data);

/// Draws a vertical bar of viridis with its numbers to the right and its name above. `beyond` adds
/// an arrow head at an end with values outside.
void draw_colour_bar(Page& page, const Box& box, const Range& range, const std::string& name,
                     const Beyond& beyond = {});

constexpr double bar_width = 56;
/// Returns the width of the strip at the right of a page for a bar that is `before` from its left
/// end: `least`, or more where the numbers of the range need it. All are in pixels.
double colour_bar_room(const Range& range, double before, double least);

/// Throws Error unless the range has two finite ends, the smaller first.
void check(const Range& range);

}  // namespace antilock::figures
