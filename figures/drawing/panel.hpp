#pragma once
#include <string>

#include "drawing/axis.hpp"
#include "drawing/page.hpp"

namespace antilock::figures {

/// One frame of a chart: axes on a box of the page.
struct Panel {
  Box box;
  Axis x, y;
  Point operator()(double at_x, double at_y) const {
    return {box.x + box.width * x.place(at_x), box.y + box.height * y.place(at_y)};
  }
};

/// What stands around a frame; an empty name leaves the numbers of that axis away too (panels that share an axis).
struct PanelNames {
  std::string title, x, y;
};

/// Grid lines, below the curves.
void draw_grid(Page& page, const Panel& panel);
/// The frame with ticks, numbers and names, above them.
void draw_frame(Page& page, const Panel& panel, const PanelNames& names);

/// The room that the numbers and the name of a vertical axis take at the left of a frame, in pixels.
double left_margin(const Page& page, const Axis& y);

/// The boxes of `count` panels in an area, in rows of equal boxes with room for names and numbers, top left first.
std::vector<Box> arrange_panels(std::size_t count, const Box& area, double gap_x, double gap_y);
std::size_t panel_columns(std::size_t count);

}  // namespace antilock::figures
