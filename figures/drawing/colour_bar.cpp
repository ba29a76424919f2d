#include "drawing/colour_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"
#include "drawing/axis.hpp"
#include "drawing/panel.hpp"

namespace antilock::figures {

constexpr double to_numbers = 24, right_margin = 5;

double colour_bar_room(const Range& range, double before, double least) {
  const double numbers = widest_number(Page(1), Axis::linear(range.low, range.high));
  return std::max(least, before + bar_width + to_numbers + numbers + right_margin);
}

void draw_colour_bar(Page& page, const Box& box, const Range& range, const std::string& name,
                     const Beyond& beyond) {
  constexpr int steps = 256;
  for (int i = 0; i < steps; ++i)
    page.fill(Box{box.x, box.y + box.height * i / steps, box.width, box.height / steps + 1.0},
              viridis((i + 0.5) / steps));
  page.rectangle(box, {2.5});
  const double head = beyond.above ? 0.9 * box.width : 0;
  if (beyond.above || beyond.below) {
    const auto tip = [&](double base, double side, const std::optional<Colour>& colour) {
      if (!colour) return;
      const std::vector<Point> corners{
          {box.x, base}, {box.right(), base}, {box.centre().x, base + side * 0.9 * box.width}};
      page.fill(corners, *colour);
      page.line({corners[0], corners[2], corners[1]}, {2.5});
    };
    tip(box.top(), 1, beyond.above);
    tip(box.y, -1, beyond.below);
  }
  const Axis axis = Axis::linear(range.low, range.high);
  for (const Tick& tick : axis.ticks()) {
    const double y = box.y + box.height * (tick.value - range.low) / (range.high - range.low);
    page.line({{box.right(), y}, {box.right() + 12, y}}, {2.5});
    page.text({box.right() + to_numbers, y}, tick.label,
              {number_size, {0, Anchor::Height::middle}});
  }
  page.text({box.centre().x, box.top() + head + 30}, name, {name_size, {0.5}});
}

Beyond beyond(const Range& range, const Range& data) {
  const double slack = 0.01 * (range.high - range.low);
  Beyond marks;
  if (data.low < range.low - slack) marks.below = viridis(0);
  if (data.high > range.high + slack) marks.above = viridis(1);
  return marks;
}

void check(const Range& range) {
  if (!(range.high > range.low) || !std::isfinite(range.high - range.low))
    throw Error(fmt::format("range {} {}: accepted: two finite numbers, the smaller first",
                            range.low, range.high));
}

}  // namespace antilock::figures
