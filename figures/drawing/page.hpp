#pragma once
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "drawing/colours.hpp"
#include "drawing/geometry.hpp"
#include "drawing/shapes.hpp"
#include "drawing/typesetter.hpp"

class vtkContext2D;

namespace antilock::figures {

struct Stroke {
  double width = 3;  ///< pixels
  Colour colour = palette::ink;
  std::vector<double> dashes = {};  ///< drawn, skipped, drawn, ... in pixels; empty: solid
};

/// One picture: three-dimensional scenes below, drawing above, text on top. White, units of pixels, rendered larger and
/// averaged down, which smooths every edge.
class Page {
 public:
  static constexpr int oversampling = 3;  ///< pixels rendered a pixel written, each way

  Page(int width, int height) : width_(width), height_(height) {}
  int width() const { return width_; }
  int height() const { return height_; }

  void line(const std::vector<Point>& points, const Stroke& stroke = {});
  void rectangle(const Box& box, const Stroke& stroke = {});
  /// A filled convex polygon.
  void fill(const std::vector<Point>& corners, const Colour& colour, double opacity = 1);
  void fill(const Box& box, const Colour& colour, double opacity = 1);
  /// The outline of a marker of about the given diameter; markers of different sizes at one place all show.
  void marker(Point at, Marker shape, double size, const Colour& colour);
  /// An arrow from one point to another, with a filled head.
  void arrow(Point from, Point to, const Stroke& stroke = {});
  void text(Point at, const std::string& markup, const TextStyle& style = {});
  double text_width(const std::string& markup, double size) const { return typesetter_.width(markup, size); }
  /// Shows a renderer in part of the page.
  void scene(vtkSmartPointer<vtkRenderer> renderer, const Box& where);

  /// Renders and writes a PNG file, whole or not at all. Throws Error where it cannot be written.
  void save(const std::filesystem::path& path) const;

 private:
  struct Text {
    Point at;
    std::string markup;
    TextStyle style;
  };
  int width_, height_;
  std::vector<vtkSmartPointer<vtkRenderer>> scenes_;
  std::vector<std::function<void(vtkContext2D&)>> strokes_;  // in the order in which they are painted
  std::vector<Text> texts_;
  Typesetter typesetter_;
};

}  // namespace antilock::figures
