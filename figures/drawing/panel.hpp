#pragma once
#include <string>

#include "drawing/axis.hpp"
#include "drawing/page.hpp"

namespace antilock::figures {

/// Sizes of type, in pixels of a page. In a picture that is shown 480 wide they are 12 and 13, and
/// the scripts of the smaller one 9.
constexpr double number_size = 48, name_size = 52;

/// One frame of a chart: axes on a box of the page.
struct Panel {
  Box box;
  Axis x, y;
  Point operator()(double at_x, double at_y) const {
    return {box.x + box.width * x.place(at_x), box.y + box.height * y.place(at_y)};
  }
};

/// The texts around a frame. With an empty name the numbers of that axis are left out, too (for
/// panels that share an axis).
struct PanelNames {
  std::string title, x, y;
};

/// Draws grid lines. It is called before the curves, which lie above them.
void draw_grid(Page& page, const Panel& panel);
/// Draws the frame with ticks, numbers and names. It is called after the curves, and lies above
/// them.
void draw_frame(Page& page, const Panel& panel, const PanelNames& names);

/// Returns the width of the widest number of an axis, in pixels.
double widest_number(const Page& page, const Axis& axis);

/// The width of the numbers and the name of a vertical axis at the left of a frame, and the height
/// of those of a horizontal axis below it, in pixels.
double left_margin(const Page& page, const Axis& y);
constexpr double foot_margin = 160;
/// The height of the title above a frame, in pixels.
constexpr double head_margin = 90;

/// Returns the boxes of `count` panels in an area, in rows of equal boxes, from the top left. With
/// three panels the fourth box is free for the legend.
std::vector<Box> arrange_panels(std::size_t count, const Box& area, double gap_x, double gap_y);
std::size_t panel_columns(std::size_t count);
std::size_t panel_rows(std::size_t count);

}  // namespace antilock::figures
