#include "drawing/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace antilock::figures {
namespace {

bool near(const Box& a, const Box& b) {
  return a.x < b.right() + least_distance && b.x < a.right() + least_distance &&
         a.y < b.top() + least_distance && b.y < a.top() + least_distance;
}

}  // namespace

double smallest_type(const std::vector<LaidText>& texts, double page_width) {
  double smallest = HUGE_VAL;
  for (const LaidText& text : texts) smallest = std::min(smallest, text.extent.smallest);
  return smallest * shown_width / page_width;
}

std::optional<std::string> layout_fault(const std::vector<LaidText>& texts, double page_width,
                                        double page_height) {
  for (const LaidText& text : texts) {
    const Box& ink = text.extent.ink;
    if (const double shown = text.extent.smallest * shown_width / page_width;
        shown < least_type - 1e-9)
      return fmt::format(
          "type of {:.1f} pixels in \"{}\" where the picture is {} wide; accepted: {} or more",
          shown, text.markup, shown_width, least_type);
    if (text.most && text.extent.width > *text.most)
      return fmt::format("\"{}\" is {:.0f} pixels wide; its place holds {:.0f}", text.markup,
                         text.extent.width, *text.most);
    if (!(ink.x >= least_distance && ink.y >= least_distance &&
          ink.right() <= page_width - least_distance && ink.top() <= page_height - least_distance))
      return fmt::format(
          "\"{}\" leaves the page: from ({:.0f}, {:.0f}) to ({:.0f}, {:.0f}) on {} x {} pixels",
          text.markup, ink.x, ink.y, ink.right(), ink.top(), page_width, page_height);
  }
  for (std::size_t i = 0; i < texts.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (near(texts[i].extent.ink, texts[k].extent.ink))
        return fmt::format("\"{}\" and \"{}\" overlap near ({:.0f}, {:.0f})", texts[k].markup,
                           texts[i].markup, texts[i].extent.ink.x, texts[i].extent.ink.y);
  return std::nullopt;
}

}  // namespace antilock::figures
