#pragma once
#include <string>

#include "drawing/axis.hpp"
#include "drawing/page.hpp"

namespace antilock::figures {

/// Sizes of type, in pixels of a page: 12 and 13 of a picture shown 480 wide, and 9 for the scripts
/// of the smaller one.
constexpr double number_size = 48, name_size = 52;

/// One frame of a chart: axes on a box of the page.
struct Panel {
  Box box;
  Axis x, y;
  Point operator()(double at_x, double at_y) const {
    return {box.x + box.width * x.place(at_x), box.y + box.height * y.place(at_y)};
  }
};

/// What stands around a frame; an empty name leaves the numbers of that axis away too (panels that
/// share an axis).
struct PanelNames {
  std::string title, x, y;
};

/// Grid lines, below the curves.
void draw_grid(Page& page, const Panel& panel);
/// The frame with ticks, numbers and names, above them.
void draw_frame(Page& page, const Panel& panel, const PanelNames& names);

/// The width of the widest number of an axis.
double widest_number(const Page& page, const Axis& axis);

/// The room that the numbers and the name of a vertical axis take at the left of a frame, and those
/// of a horizontal one below it, in pixels.
double left_margin(const Page& page, const Axis& y);
constexpr double foot_margin = 160;
/// The room above a frame for its title.
constexpr double head_margin = 90;

/// The boxes of `count` panels in an area, in rows of equal boxes, top left first. Three panels
/// leave the fourth box of a square to the legend.
std::vector<Box> arrange_panels(std::size_t count, const Box& area, double gap_x, double gap_y);
std::size_t panel_columns(std::size_t count);
std::size_t panel_rows(std::size_t count);

}  // namespace antilock::figures
