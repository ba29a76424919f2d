#pragma once
#include <string>

#include "drawing/page.hpp"
#include "pictures/pictures.hpp"

namespace antilock::figures {

/// A vertical bar of viridis with its numbers to the right and its name above; `size` of the numbers in pixels.
void draw_colour_bar(Page& page, const Box& box, const Range& range, const std::string& name, double size);

/// Throws Error unless the range has two finite ends, the smaller first.
void check(const Range& range);

}  // namespace antilock::figures
