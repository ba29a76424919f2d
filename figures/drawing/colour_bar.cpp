#include "drawing/colour_bar.hpp"

#include <fmt/format.h>

#include "antilock/scene/error.hpp"
#include "drawing/axis.hpp"

namespace antilock::figures {

void draw_colour_bar(Page& page, const Box& box, const Range& range, const std::string& name, double size) {
  constexpr int steps = 256;
  for (int i = 0; i < steps; ++i)
    page.fill(Box{box.x, box.y + box.height * i / steps, box.width, box.height / steps + 1.0},
              viridis((i + 0.5) / steps));
  page.rectangle(box, {2.5});
  const Axis axis = Axis::linear(range.low, range.high);
  for (const Tick& tick : axis.ticks()) {
    const double y = box.y + box.height * (tick.value - range.low) / (range.high - range.low);
    page.line({{box.right(), y}, {box.right() + 12, y}}, {2.5});
    page.text({box.right() + 24, y}, tick.label, {size, {0, Anchor::Height::middle}});
  }
  page.text({box.centre().x, box.top() + 30}, name, {1.25 * size, {0.5}});
}

void check(const Range& range) {
  if (!(range.high > range.low) || !std::isfinite(range.high - range.low))
    throw Error(fmt::format("range {} {}: accepted: two finite numbers, the smaller first", range.low, range.high));
}

}  // namespace antilock::figures
