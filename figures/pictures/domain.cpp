// The labelled domains of Figures 1 and 2, from a table `kind,name,label,x,y`: one row per corner,
// in the order of painting. Kinds: page (the two corners of the window), fill, line, arrow,
// dimension (an arrow both ways), obstacle (a hatched edge), label (markup of typesetter.hpp at its
// place). The first word of the name chooses the colour; tied0 to tied5 are six pale ones.
#include <fmt/format.h>

#include <map>

#include "antilock/core/error.hpp"
#include "pictures/pictures.hpp"
#include "pictures/table.hpp"

namespace antilock::figures {
namespace {

struct Part {
  std::string kind, name, label;
  std::vector<Point> corners;  // pixels
};

/// Half way to white: a fill on which lines show.
Colour tint(const Colour& colour) {
  Colour lighter;
  for (int i = 0; i < 3; ++i) lighter[i] = 0.45 * colour[i] + 0.55;
  return lighter;
}

Colour colour_of(const std::string& name) {
  static const std::map<std::string, Colour> colours{
      {"body", palette::body},          {"layer", palette::layer},
      {"sigma", palette::green},        {"clamped", palette::ink},
      {"layer_clamped", palette::blue}, {"contact", palette::vermillion},
      {"obstacle", palette::grey},      {"axis", palette::grey},
      {"tied0", tint(palette::blue)},   {"tied1", tint(palette::vermillion)},
      {"tied2", tint(palette::green)},  {"tied3", tint(palette::purple)},
      {"tied4", tint(palette::olive)},  {"tied5", tint(palette::indigo)},
  };
  const auto found = colours.find(name.substr(0, name.find(' ')));
  return found == colours.end() ? palette::ink : found->second;
}

/// The corners of one part: rows of the same kind and name that follow each other.
std::vector<Part> read_parts(const CsvTable& table) {
  std::vector<Part> parts;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto &kind = table.text(row, "kind"), &name = table.text(row, "name"),
               &label = table.text(row, "label");
    if (kind == "label" || parts.empty() || parts.back().kind != kind || parts.back().name != name)
      parts.push_back({kind, name, label, {}});
    parts.back().corners.push_back({table.number(row, "x"), table.number(row, "y")});
  }
  return parts;
}

/// The edge of a rigid obstacle: a line with strokes that slant away below it.
void draw_obstacle(Page& page, Point from, Point to) {
  constexpr double spacing = 30, depth = 36;
  for (double x = from.x + spacing; x <= to.x; x += spacing)
    page.line({{x, from.y}, {x - depth, from.y - depth}}, {2.5, palette::grey});
  page.line({from, to}, {5, palette::ink});
}

void draw(Page& page, const Part& part) {
  const Colour colour = colour_of(part.name);
  const Stroke stroke{part.name.starts_with("axis") ? 3.0 : part.name.empty() ? 5.0 : 9.0, colour};
  const auto& corners = part.corners;
  if (part.kind == "fill") {
    page.fill(corners, colour);
  } else if (part.kind == "line") {
    page.line(corners, stroke);
  } else if (part.kind == "arrow") {
    page.arrow(corners.front(), corners.back(), stroke);
  } else if (part.kind == "dimension") {
    page.arrow(corners.front(), corners.back(), stroke);
    page.arrow(corners.back(), corners.front(), stroke);
  } else if (part.kind == "obstacle") {
    draw_obstacle(page, corners.front(), corners.back());
  } else if (part.kind == "label") {
    const bool small = part.name.starts_with("axis");
    page.text(
        corners.front(), part.label,
        {small ? 52.0 : 66.0, {0.5, Anchor::Height::middle}, 0, small ? palette::ink : colour});
  }
}

}  // namespace

Page domain_picture(const std::filesystem::path& outline, const std::string& title) {
  std::vector<Part> parts = read_parts(CsvTable(outline));
  const Part window = parts.front();
  if (window.kind != "page" || window.corners.size() != 2 ||
      !(window.corners[1].x > window.corners[0].x) || !(window.corners[1].y > window.corners[0].y))
    throw Error(fmt::format(
        "{}: must open with two rows of kind page, the lower left and upper right corner",
        outline.string()));

  const double head = title.empty() ? 0 : 120;
  const Point span = window.corners[1] - window.corners[0];
  const double scale = Page::width / span.x;
  const double height = scale * span.y + head;
  if (!(height > 200 && height < 8000))
    throw Error(fmt::format("{}: the page is too flat or too tall", outline.string()));

  Page page(height);
  for (Part& part : parts) {
    for (Point& corner : part.corners) corner = scale * (corner - window.corners[0]);
    draw(page, part);
  }
  if (!title.empty()) page.text({0.5 * Page::width, height - 90}, title, {56, {0.5}});
  return page;
}

}  // namespace antilock::figures
