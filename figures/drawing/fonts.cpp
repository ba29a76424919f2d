#include "drawing/fonts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "antilock/core/error.hpp"

namespace antilock::figures {
namespace {

using Characters = std::u32string;

Characters decode(const std::string& utf8) {
  Characters characters;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    const int more = first < 0x80    ? 0
                     : first >= 0xF0 ? 3
                     : first >= 0xE0 ? 2
                     : first >= 0xC2 ? 1
                                     : -1;
    if (more < 0 || i + more >= utf8.size())
      throw Error(fmt::format("text \"{}\": not UTF-8", utf8));
    char32_t character = more == 0 ? first : first & (0x3F >> more);
    for (int k = 1; k <= more; ++k)
      character = (character << 6) | (static_cast<unsigned char>(utf8[i + k]) & 0x3F);
    characters.push_back(character);
    i += more + 1;
  }
  return characters;
}

/// Letters that mathematics sets in italic: Latin, and small Greek.
bool slanted(char32_t c) {
  return (c >= U'a' && c <= U'z') || (c >= U'A' && c <= U'Z') || (c >= U'α' && c <= U'ω') ||
         c == U'ϵ' || c == U'∂';
}

bool has_second_script(const Characters& text, std::size_t from) {
  std::size_t after = from + 2;
  if (from + 1 < text.size() && text[from + 1] == U'{')
    after = std::min(text.find(U'}', from), text.size()) + 1;
  return after < text.size() && text[after] == (text[from] == U'_' ? U'^' : U'_');
}

/// Script sizes and shifts, in ems of the text around them.
constexpr double script_size = 0.75, raise = 0.36, lower = 0.17, stacked_lower = 0.26;

}  // namespace

Fonts::Fonts() {
  if (FT_Init_FreeType(&library_) != 0) throw Error("FreeType cannot be started");
  upright_ = open("STIXGeneral-Regular.otf");
  italic_ = open("STIXGeneral-Italic.otf");
}
Fonts::~Fonts() { FT_Done_FreeType(library_); }  // closes the faces as well

FT_Face Fonts::open(const std::string& name) const {
  FT_Face face = nullptr;
  const std::string path = fmt::format("{}/{}", STIX_FONTS, name);
  if (FT_New_Face(library_, path.c_str(), 0, &face) != 0)
    throw Error(fmt::format("{}: cannot be read as a font; install Debian's fonts-stix", path));
  return face;
}

/// Appends one character at (line.width, y).
void Fonts::put(Line& line, char32_t character, bool in_math, double size, double y) const {
  FT_Face face = in_math && slanted(character) ? italic_ : upright_;
  unsigned index = FT_Get_Char_Index(face, character);
  if (index == 0) index = FT_Get_Char_Index(face = upright_, character);
  if (index == 0)
    throw Error(fmt::format("text: STIX has no glyph U+{:04X}", static_cast<unsigned>(character)));
  if (FT_Load_Glyph(face, index, FT_LOAD_NO_SCALE | FT_LOAD_IGNORE_TRANSFORM) != 0)
    throw Error("text: a glyph cannot be loaded");
  const FT_Glyph_Metrics& metrics = face->glyph->metrics;
  const double unit = size / face->units_per_EM;
  line.glyphs.push_back({face,
                         index,
                         size,
                         line.width,
                         y,
                         {line.width + unit * metrics.horiBearingX,
                          y + unit * (metrics.horiBearingY - metrics.height), unit * metrics.width,
                          unit * metrics.height}});
  line.width += unit * static_cast<double>(face->glyph->advance.x);
}

/// Sets characters [from, to) and stops at `end` (0: none); returns the place after the last one
/// read.
std::size_t Fonts::set(Line& line, const Characters& text, std::size_t from, char32_t end,
                       bool in_math, double size, double y) const {
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
std::size_t Fonts::set_scripts(Line& line, const Characters& text, std::size_t from, double size,
                               double y) const {
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

Line Fonts::layout(const std::string& markup, double size) const {
  Line line;
  set(line, decode(markup), 0, 0, false, size, 0);
  return line;
}

}  // namespace antilock::figures
