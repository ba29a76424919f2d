#include "drawing/typesetter.hpp"

#include <vtkImageData.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "antilock/core/error.hpp"
#include "drawing/fonts.hpp"

namespace antilock::figures {

Typesetter::Typesetter() : fonts_(std::make_unique<Fonts>()) {}
Typesetter::~Typesetter() = default;
Typesetter::Typesetter(Typesetter&&) noexcept = default;
Typesetter& Typesetter::operator=(Typesetter&&) noexcept = default;

double Typesetter::width(const std::string& markup, double size) const {
  return fonts_->layout(markup, size).width;
}

namespace {

/// From places in a set line to places on the page.
class Placement {
 public:
  Placement(Point at, double line_width, const TextStyle& style)
      : at_(at),
        across_(style.anchor.across * line_width),
        drop_(drop(style)),
        angle_(style.angle * std::numbers::pi / 180) {}
  Point operator()(double x, double y) const {
    const double across = x - across_, up = y - drop_, c = std::cos(angle_), s = std::sin(angle_);
    return {at_.x + c * across - s * up, at_.y + s * across + c * up};
  }
  double angle() const { return angle_; }

 private:
  static double drop(const TextStyle& style) {
    constexpr double capital = 0.662;  // height of STIX capitals, in ems
    return style.size * (style.anchor.height == Anchor::Height::top      ? capital
                         : style.anchor.height == Anchor::Height::middle ? 0.5 * capital
                                                                         : 0);
  }
  Point at_;
  double across_, drop_, angle_;
};

/// Mixes one glyph's coverage into the image; (left, top) is the bitmap's upper left pixel.
void blend(vtkImageData& image, const FT_Bitmap& bitmap, int left, int top, const Colour& colour) {
  int size[3];
  image.GetDimensions(size);
  for (unsigned row = 0; row < bitmap.rows; ++row) {
    const int y = top - 1 - static_cast<int>(row);
    for (unsigned column = 0; column < bitmap.width; ++column) {
      const int x = left + static_cast<int>(column);
      if (x < 0 || y < 0 || x >= size[0] || y >= size[1]) continue;
      const double cover = bitmap.buffer[row * bitmap.pitch + column] / 255.0;
      auto* pixel = static_cast<unsigned char*>(image.GetScalarPointer(x, y, 0));
      for (int i = 0; i < 3; ++i)
        pixel[i] = static_cast<unsigned char>(
            std::lround((1 - cover) * pixel[i] + cover * 255 * colour[i]));
    }
  }
}

}  // namespace

Extent Typesetter::extent(Point at, const std::string& markup, const TextStyle& style) const {
  const Line line = fonts_->layout(markup, style.size);
  const Placement place(at, line.width, style);
  Extent extent{{at.x, at.y, 0, 0}, style.size, line.width};
  Point low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const Glyph& glyph : line.glyphs) {
    if (!(glyph.ink.width > 0)) continue;  // a space
    extent.smallest = std::min(extent.smallest, glyph.size);
    for (const double x : {glyph.ink.x, glyph.ink.right()})
      for (const double y : {glyph.ink.y, glyph.ink.top()}) {
        const Point corner = place(x, y);
        low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
        high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
      }
  }
  if (low.x <= high.x) extent.ink = {low.x, low.y, high.x - low.x, high.y - low.y};
  return extent;
}

void Typesetter::draw(vtkImageData& image, Point at, const std::string& markup,
                      const TextStyle& style) const {
  const Line line = fonts_->layout(markup, style.size);
  const Placement place(at, line.width, style);
  const double c = std::cos(place.angle()), s = std::sin(place.angle());
  const auto fixed = [](double v) { return static_cast<FT_Fixed>(std::lround(v * 65536)); };
  FT_Matrix rotation{fixed(c), fixed(-s), fixed(s), fixed(c)};

  for (const Glyph& glyph : line.glyphs) {
    const Point origin = place(glyph.x, glyph.y);
    const Point whole{std::floor(origin.x), std::floor(origin.y)};
    FT_Vector rest{std::lround(64 * (origin.x - whole.x)), std::lround(64 * (origin.y - whole.y))};
    FT_Set_Char_Size(glyph.face, std::lround(64 * glyph.size), 0, 72,
                     72);  // at 72 dpi a point is a pixel
    FT_Set_Transform(glyph.face, &rotation, &rest);
    if (FT_Load_Glyph(glyph.face, glyph.index, FT_LOAD_NO_HINTING | FT_LOAD_RENDER) != 0)
      throw Error("text: a glyph cannot be drawn");
    const auto* slot = glyph.face->glyph;
    blend(image, slot->bitmap, static_cast<int>(whole.x) + slot->bitmap_left,
          static_cast<int>(whole.y) + slot->bitmap_top, style.colour);
  }
}

}  // namespace antilock::figures
