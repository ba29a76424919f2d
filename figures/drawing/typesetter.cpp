#include "drawing/typesetter.hpp"

#include <fmt/format.h>
#include <ft2build.h>
#include <vtkImageData.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "antilock/core/error.hpp"
#include FT_FREETYPE_H

namespace antilock::figures {
namespace {

using Characters = std::u32string;

Characters decode(const std::string& utf8) {
  Characters characters;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    const int more = first < 0x80 ? 0 : first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC2 ? 1 : -1;
    if (more < 0 || i + more >= utf8.size()) throw Error(fmt::format("text \"{}\": not UTF-8", utf8));
    char32_t character = more == 0 ? first : first & (0x3F >> more);
    for (int k = 1; k <= more; ++k) character = (character << 6) | (static_cast<unsigned char>(utf8[i + k]) & 0x3F);
    characters.push_back(character);
    i += more + 1;
  }
  return characters;
}

/// Letters that mathematics sets in italic: Latin, and small Greek.
bool slanted(char32_t c) {
  return (c >= U'a' && c <= U'z') || (c >= U'A' && c <= U'Z') || (c >= U'α' && c <= U'ω') || c == U'ϵ' || c == U'∂';
}

struct Glyph {
  FT_Face face;
  unsigned index;
  double size;  // pixels an em
  double x, y;  // from the text's origin
  Box ink;      // likewise, in pixels
};

struct Line {
  std::vector<Glyph> glyphs;
  double width = 0;
};

/// Script sizes and shifts, in ems of the text around them.
constexpr double script_size = 0.75, raise = 0.36, lower = 0.17, stacked_lower = 0.26;

}  // namespace

struct Typesetter::Fonts {
  FT_Library library = nullptr;
  FT_Face upright = nullptr, italic = nullptr;

  Fonts() {
    if (FT_Init_FreeType(&library) != 0) throw Error("FreeType cannot be started");
    upright = open("STIXGeneral-Regular.otf");
    italic = open("STIXGeneral-Italic.otf");
  }
  ~Fonts() { FT_Done_FreeType(library); }  // closes the faces as well
  Fonts(const Fonts&) = delete;
  Fonts& operator=(const Fonts&) = delete;

  FT_Face open(const std::string& name) {
    FT_Face face = nullptr;
    const std::string path = std::string(STIX_FONTS) + "/" + name;
    if (FT_New_Face(library, path.c_str(), 0, &face) != 0)
      throw Error(fmt::format("{}: cannot be read as a font; install Debian's fonts-stix", path));
    return face;
  }

  /// Appends one character at (line.width, y).
  void put(Line& line, char32_t character, bool in_math, double size, double y) const {
    FT_Face face = in_math && slanted(character) ? italic : upright;
    unsigned index = FT_Get_Char_Index(face, character);
    if (index == 0) index = FT_Get_Char_Index(face = upright, character);
    if (index == 0) throw Error(fmt::format("text: STIX has no glyph U+{:04X}", static_cast<unsigned>(character)));
    if (FT_Load_Glyph(face, index, FT_LOAD_NO_SCALE | FT_LOAD_IGNORE_TRANSFORM) != 0)
      throw Error("text: a glyph cannot be loaded");
    const FT_Glyph_Metrics& metrics = face->glyph->metrics;
    const double unit = size / face->units_per_EM;
    line.glyphs.push_back(
        {face,
         index,
         size,
         line.width,
         y,
         {line.width + unit * metrics.horiBearingX, y + unit * (metrics.horiBearingY - metrics.height),
          unit * metrics.width, unit * metrics.height}});
    line.width += unit * static_cast<double>(face->glyph->advance.x);
  }

  /// Sets characters [from, to) and stops at `end` (0: none); returns the place after the last one read.
  std::size_t set(Line& line, const Characters& text, std::size_t from, char32_t end, bool in_math, double size,
                  double y) const {
    for (std::size_t i = from; i < text.size();) {
      const char32_t c = text[i];
      if (end != 0 && c == end) return i + 1;
      if (c == U'$') {
        in_math = !in_math;
        ++i;
      } else if (in_math && (c == U'_' || c == U'^')) {
        i = set_scripts(line, text, i, size, y);
      } else {
        put(line, c, in_math, size, y);
        ++i;
      }
    }
    if (end != 0) throw Error("text: a { in mathematics is never closed");
    return text.size();
  }

  /// One script, or a pair of them one above the other, from the `_` or `^` at `from`.
  std::size_t set_scripts(Line& line, const Characters& text, std::size_t from, double size, double y) const {
    const double start = line.width;
    double end = start;
    std::size_t i = from;
    const auto one = [&](bool pair) {
      const bool up = text[i] == U'^';
      if (i + 1 >= text.size()) throw Error("text: nothing follows a _ or ^ in mathematics");
      const double shifted = y + size * (up ? raise : pair ? -stacked_lower : -lower);
      line.width = start;
      if (text[i + 1] == U'{') {
        i = set(line, text, i + 2, U'}', true, script_size * size, shifted);
      } else {
        put(line, text[i + 1], true, script_size * size, shifted);
        i += 2;
      }
      end = std::max(end, line.width);
    };
    const bool pair = has_second_script(text, from);
    one(pair);
    if (pair) one(true);
    line.width = end;
    return i;
  }

  static bool has_second_script(const Characters& text, std::size_t from) {
    std::size_t after = from + 2;
    if (from + 1 < text.size() && text[from + 1] == U'{') after = std::min(text.find(U'}', from), text.size()) + 1;
    return after < text.size() && text[after] == (text[from] == U'_' ? U'^' : U'_');
  }

  Line layout(const std::string& markup, double size) const {
    Line line;
    set(line, decode(markup), 0, 0, false, size, 0);
    return line;
  }
};

Typesetter::Typesetter() : fonts_(std::make_unique<Fonts>()) {}
Typesetter::~Typesetter() = default;
Typesetter::Typesetter(Typesetter&&) noexcept = default;
Typesetter& Typesetter::operator=(Typesetter&&) noexcept = default;

double Typesetter::width(const std::string& markup, double size) const { return fonts_->layout(markup, size).width; }

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
        pixel[i] = static_cast<unsigned char>(std::lround((1 - cover) * pixel[i] + cover * 255 * colour[i]));
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

void Typesetter::draw(vtkImageData& image, Point at, const std::string& markup, const TextStyle& style) const {
  const Line line = fonts_->layout(markup, style.size);
  const Placement place(at, line.width, style);
  const double c = std::cos(place.angle()), s = std::sin(place.angle());
  const auto fixed = [](double v) { return static_cast<FT_Fixed>(std::lround(v * 65536)); };
  FT_Matrix rotation{fixed(c), fixed(-s), fixed(s), fixed(c)};

  for (const Glyph& glyph : line.glyphs) {
    const Point origin = place(glyph.x, glyph.y);
    const Point whole{std::floor(origin.x), std::floor(origin.y)};
    FT_Vector rest{std::lround(64 * (origin.x - whole.x)), std::lround(64 * (origin.y - whole.y))};
    FT_Set_Char_Size(glyph.face, std::lround(64 * glyph.size), 0, 72, 72);  // at 72 dpi a point is a pixel
    FT_Set_Transform(glyph.face, &rotation, &rest);
    if (FT_Load_Glyph(glyph.face, glyph.index, FT_LOAD_NO_HINTING | FT_LOAD_RENDER) != 0)
      throw Error("text: a glyph cannot be drawn");
    const auto* slot = glyph.face->glyph;
    blend(image, slot->bitmap, static_cast<int>(whole.x) + slot->bitmap_left,
          static_cast<int>(whole.y) + slot->bitmap_top, style.colour);
  }
}

}  // namespace antilock::figures
