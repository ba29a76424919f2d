#pragma once
#include <ft2build.h>

#include <string>
#include <vector>

#include "drawing/geometry.hpp"
#include FT_FREETYPE_H

namespace antilock::figures {

/// One letter of a line.
struct Glyph {
  FT_Face face;
  unsigned index;
  double size;  ///< pixels per em
  double x, y;  ///< from the origin of the line, in pixels
  Box ink;      ///< the box around its ink, likewise
};

struct Line {
  std::vector<Glyph> glyphs;
  double width = 0;
};

/// The two faces of STIX. They turn markup (typesetter.hpp) into a line of glyphs.
class Fonts {
 public:
  Fonts();  ///< throws Error where they cannot be read
  ~Fonts();
  Fonts(const Fonts&) = delete;
  Fonts& operator=(const Fonts&) = delete;

  /// Returns the line of a markup. Throws Error for broken UTF-8, unbalanced markup or a character
  /// that STIX does not have.
  Line layout(const std::string& markup, double size) const;

 private:
  FT_Face open(const std::string& name) const;
  void put(Line& line, char32_t character, bool in_math, double size, double y) const;
  std::size_t set(Line& line, const std::u32string& text, std::size_t from, char32_t end,
                  bool in_math, double size, double y) const;
  std::size_t set_scripts(Line& line, const std::u32string& text, std::size_t from, double size,
                          double y) const;

  FT_Library library_ = nullptr;
  FT_Face upright_ = nullptr, italic_ = nullptr;
};

}  // namespace antilock::figures
