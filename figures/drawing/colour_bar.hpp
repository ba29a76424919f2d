#pragma once
#include <optional>
#include <string>

#include "drawing/page.hpp"

namespace antilock::figures {

/// Extent of a quantity that colours (and heights) stand for.
struct Range {
  double low, high;
};

/// Colours of what lies outside a range, where that is to be seen.
struct Beyond {
  Colour below, above;
};

/// A vertical bar of viridis with its numbers to the right and its name above; `beyond` adds a head
/// at each end.
void draw_colour_bar(Page& page, const Box& box, const Range& range, const std::string& name,
                     const std::optional<Beyond>& beyond = {});

/// Throws Error unless the range has two finite ends, the smaller first.
void check(const Range& range);

}  // namespace antilock::figures
