#include "pictures/chart_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace antilock::figures {
namespace {

constexpr double size = number_size, bar = 14;

/// Pixels of a decade along each axis of a panel with logarithmic scales, one over the other.
double steepness(const Panel& panel) {
  return (panel.box.height / std::log(panel.y.high() / panel.y.low())) /
         (panel.box.width / std::log(panel.x.high() / panel.x.low()));
}

}  // namespace

double strip_height(std::size_t curves) {
  return curves == 0 ? 0 : strip_bar * static_cast<double>(curves) + 20;
}

void draw_strip(Page& page, const Panel& panel, const std::vector<Failures>& failures,
                std::size_t curves) {
  if (failures.empty()) return;
  const Box& box = panel.box;
  const double height = strip_height(curves), bottom = box.top() - height;
  page.line({{box.x, bottom}, {box.right(), bottom}}, {2.5, palette::grey});
  double y = bottom + 0.5 * (height + strip_bar * static_cast<double>(failures.size() - 1));
  for (const Failures& failed : failures) {
    for (const auto& [from, to] : failed.ranges) {
      const double a = panel(from, panel.y.high()).x, b = panel(to, panel.y.high()).x;
      page.line({{std::max(a - 13, box.x + 2), y}, {std::min(b + 13, box.right() - 2), y}},
                {bar, failed.colour});
    }
    y -= strip_bar;
  }
}

void draw_failure(Page& page, const Box& box) {
  page.line({{box.x, box.centre().y}, {box.right(), box.centre().y}}, {bar, palette::grey});
}

void draw_slopes(Page& page, const Panel& panel, const std::vector<double>& slopes,
                 const std::vector<Point>& taken) {
  if (slopes.empty()) return;
  const double steep = steepness(panel),
               most =
                   std::abs(*std::max_element(slopes.begin(), slopes.end(), [](double a, double b) {
                     return std::abs(a) < std::abs(b);
                   }));
  const double base = std::min(120.0, 0.3 * panel.box.height / (most * steep)),
               triangle = base + 100;
  const Box need{0, 0, triangle * static_cast<double>(slopes.size()),
                 most * steep * base + size + 40};
  const double left = panel.box.x + 30, right = panel.box.right() - need.width - 10,
               low = panel.box.y + 20, high = panel.box.top() - need.height - 20;
  Box best{};
  long fewest = -1;
  for (const Point corner : {Point{right, low}, {left, high}, {left, low}, {right, high}}) {
    const Box box{corner.x, corner.y, need.width, need.height};
    const long inside = std::count_if(taken.begin(), taken.end(), [&](const Point& p) {
      return p.x > box.x - 20 && p.x < box.right() + 20 && p.y > box.y - 20 && p.y < box.top() + 20;
    });
    if (fewest < 0 || inside < fewest) best = box, fewest = inside;
  }
  Point left_end{best.x, best.y + size + 10};
  for (const double slope : slopes) {  // a falling one hangs below its base
    const Point origin = left_end + Point{0, std::max(0.0, -slope * steep * base)};
    const Point end = origin + Point{base, 0}, top = end + Point{0, slope * steep * base};
    page.line({origin, end, top, origin, end}, {3, palette::ink});
    const Anchor::Height side = slope < 0 ? Anchor::Height::baseline : Anchor::Height::top;
    page.text(end + Point{-0.5 * base, slope < 0 ? 12.0 : -12.0}, "1", {size, {0.5, side}});
    page.text(0.5 * (end + top) + Point{14, 0}, fmt::format("{:g}", slope),
              {size, {0, Anchor::Height::middle}});
    left_end = left_end + Point{triangle, 0};
  }
}

}  // namespace antilock::figures
