#pragma once
#include <optional>
#include <string>

#include "drawing/page.hpp"

namespace antilock::figures {

/// Extent of a quantity that colours (and heights) stand for.
struct Range {
  double low, high;
};

/// Colours of what lies outside a range, where something does.
struct Beyond {
  std::optional<Colour> below, above;
};
/// The marks for data of which a hundredth of the range or more lies outside, in the colours of its ends.
Beyond beyond(const Range& range, const Range& data);

/// A vertical bar of viridis with its numbers to the right and its name above; `beyond` adds a head
/// at an end that has something outside.
void draw_colour_bar(Page& page, const Box& box, const Range& range, const std::string& name,
                     const Beyond& beyond = {});

constexpr double bar_width = 56;
/// The width to leave at the right of a page for a bar that stands `before` from the left end of that strip: `least`, or
/// more where the numbers of the range need it.
double colour_bar_room(const Range& range, double before, double least);

/// Throws Error unless the range has two finite ends, the smaller first.
void check(const Range& range);

}  // namespace antilock::figures
