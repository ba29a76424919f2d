#pragma once
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drawing/bands.hpp"
#include "drawing/colours.hpp"
#include "drawing/geometry.hpp"
#include "drawing/layout.hpp"
#include "drawing/shapes.hpp"
#include "drawing/typesetter.hpp"

namespace antilock::figures {

struct Stroke {
  double width = 3;  ///< pixels
  Colour colour = palette::ink;
  std::vector<double> dashes = {};  ///< drawn, skipped, drawn, ... in pixels; empty: solid
};

/// One picture on white: three-dimensional scenes below, drawings above, text on top. Units are
/// pixels.
class Page {
 public:
  /// The width of every picture, so that a size of type means the same in all of them.
  static constexpr int width = 1920;

  explicit Page(double height) : height_(static_cast<int>(height)) {}
  int height() const { return height_; }

  void line(const std::vector<Point>& points, const Stroke& stroke = {});
  void rectangle(const Box& box, const Stroke& stroke = {});
  /// Draws a filled convex polygon.
  void fill(const std::vector<Point>& corners, const Colour& colour, double opacity = 1);
  void fill(const Box& box, const Colour& colour, double opacity = 1);
  /// Draws a filled marker of about the given diameter with a white rim. So a small one is visible
  /// on a larger one at the same place.
  void marker(Point at, Marker shape, double size, const Colour& colour);
  /// Draws an arrow from one point to another, with a filled head.
  void arrow(Point from, Point to, const Stroke& stroke = {});
  void text(Point at, const std::string& markup, const TextStyle& style = {});
  double text_width(const std::string& markup, double size) const {
    return typesetter_.width(markup, size);
  }
  /// Shows a renderer in part of the page.
  void scene(vtkSmartPointer<vtkRenderer> renderer, const Box& where);

  /// Returns the first fault of the texts in one line: too small, too near to each other, wider
  /// than allowed or off the page (layout.hpp).
  std::optional<std::string> layout_fault() const;
  /// Returns the smallest em on the page, scripts included, in pixels of a picture that is shown
  /// `shown_width` wide (layout.hpp).
  double smallest_type() const;

  /// Renders and writes a PNG file, whole or not at all. Throws Error where it cannot be written.
  /// `compression` is 0 to 9: 9 takes twice as long as 8 and saves less than half a per cent, 1
  /// takes a quarter of the time. `half` writes half of the width and height.
  void save(const std::filesystem::path& path, int compression = 8, bool half = false) const;

 private:
  struct Text {
    Point at;
    std::string markup;
    TextStyle style;
  };
  std::vector<LaidText> laid_texts() const;
  int height_;
  std::vector<Drawing3d> scenes_;
  std::vector<Painting> pieces_;  // in the order in which they are painted
  std::vector<Text> texts_;
  Typesetter typesetter_;
};

}  // namespace antilock::figures
