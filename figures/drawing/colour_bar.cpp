#include "drawing/colour_bar.hpp"

#include <fmt/format.h>

#include "antilock/core/error.hpp"
#include "drawing/axis.hpp"
#include "drawing/panel.hpp"

namespace antilock::figures {

void draw_colour_bar(Page& page, const Box& box, const Range& range, const std::string& name,
                     const std::optional<Beyond>& beyond) {
  constexpr int steps = 256;
  for (int i = 0; i < steps; ++i)
    page.fill(Box{box.x, box.y + box.height * i / steps, box.width, box.height / steps + 1.0},
              viridis((i + 0.5) / steps));
  page.rectangle(box, {2.5});
  double head = 0;
  if (beyond) {
    head = 0.9 * box.width;
    const auto tip = [&](double base, double side, const Colour& colour) {
      const std::vector<Point> corners{{box.x, base}, {box.right(), base}, {box.centre().x, base + side * head}};
      page.fill(corners, colour);
      page.line({corners[0], corners[2], corners[1]}, {2.5});
    };
    tip(box.top(), 1, beyond->above);
    tip(box.y, -1, beyond->below);
  }
  const Axis axis = Axis::linear(range.low, range.high);
  for (const Tick& tick : axis.ticks()) {
    const double y = box.y + box.height * (tick.value - range.low) / (range.high - range.low);
    page.line({{box.right(), y}, {box.right() + 12, y}}, {2.5});
    page.text({box.right() + 24, y}, tick.label, {number_size, {0, Anchor::Height::middle}});
  }
  page.text({box.centre().x, box.top() + head + 30}, name, {name_size, {0.5}});
}

void check(const Range& range) {
  if (!(range.high > range.low) || !std::isfinite(range.high - range.low))
    throw Error(fmt::format("range {} {}: accepted: two finite numbers, the smaller first", range.low, range.high));
}

}  // namespace antilock::figures
