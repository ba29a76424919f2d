#include "drawing/panel.hpp"

#include <algorithm>
#include <cmath>

namespace antilock::figures {

double widest_number(const Page& page, const Axis& axis) {
  double widest = 0;
  for (const Tick& tick : axis.ticks())
    widest = std::max(widest, page.text_width(tick.label, number_size));
  return widest;
}

double left_margin(const Page& page, const Axis& y) {
  return widest_number(page, y) + name_size + 70;
}

void draw_grid(Page& page, const Panel& panel) {
  const Box& box = panel.box;
  for (const Tick& tick : panel.x.ticks()) {
    if (tick.label.empty()) continue;
    const double x = box.x + box.width * panel.x.place(tick.value);
    page.line({{x, box.y}, {x, box.top()}}, {2.5, palette::pale});
  }
  for (const Tick& tick : panel.y.ticks()) {
    if (tick.label.empty()) continue;
    const double y = box.y + box.height * panel.y.place(tick.value);
    page.line({{box.x, y}, {box.right(), y}}, {2.5, palette::pale});
  }
}

void draw_frame(Page& page, const Panel& panel, const PanelNames& names) {
  const Box& box = panel.box;
  for (const Tick& tick : panel.x.ticks()) {
    const double x = box.x + box.width * panel.x.place(tick.value),
                 size = tick.label.empty() ? 8 : 15;
    page.line({{x, box.y}, {x, box.y + size}}, {2.5});
    if (!names.x.empty() && !tick.label.empty())
      page.text({x, box.y - 18}, tick.label, {number_size, {0.5, Anchor::Height::top}});
  }
  for (const Tick& tick : panel.y.ticks()) {
    const double y = box.y + box.height * panel.y.place(tick.value),
                 size = tick.label.empty() ? 8 : 15;
    page.line({{box.x, y}, {box.x + size, y}}, {2.5});
    if (names.y.empty() || tick.label.empty()) continue;
    page.text({box.x - 16, y}, tick.label, {number_size, {1, Anchor::Height::middle}});
  }
  page.rectangle(box, {3});
  if (!names.x.empty())
    page.text({box.centre().x, box.y - 84}, names.x, {name_size, {0.5, Anchor::Height::top}});
  if (!names.y.empty())
    page.text({box.x - 16 - widest_number(page, panel.y) - 34, box.centre().y}, names.y,
              {name_size, {0.5}, 90});
  page.text({box.centre().x, box.top() + 26}, names.title,
            {name_size, {0.5}, 0, palette::ink, box.width});
}

std::size_t panel_columns(std::size_t count) { return count == 1 ? 1 : count <= 4 ? 2 : 3; }
std::size_t panel_rows(std::size_t count) {
  return (count + panel_columns(count) - 1) / panel_columns(count);
}

std::vector<Box> arrange_panels(std::size_t count, const Box& area, double gap_x, double gap_y) {
  const std::size_t columns = panel_columns(count), rows = panel_rows(count);
  const double width = (area.width - (columns - 1) * gap_x) / columns,
               height = (area.height - (rows - 1) * gap_y) / rows;
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i / columns, column = i % columns;
    boxes.push_back({area.x + column * (width + gap_x),
                     area.top() - row * (height + gap_y) - height, width, height});
  }
  return boxes;
}

}  // namespace antilock::figures
