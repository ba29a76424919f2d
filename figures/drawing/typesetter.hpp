#pragma once
#include <memory>
#include <optional>
#include <string>

#include "drawing/geometry.hpp"

class vtkImageData;

namespace antilock::figures {

class Fonts;

/// The place of the anchor in a text: `across` from its left end (0) to its right end (1), and its
/// height.
struct Anchor {
  enum class Height { baseline, middle, top };
  double across = 0;
  Height height = Height::baseline;
};

struct TextStyle {
  double size = 48;  ///< of an em, in pixels
  Anchor anchor = {};
  double angle = 0;  ///< degrees, counterclockwise
  Colour colour = {0.13, 0.13, 0.13};
  /// The width that the text must not exceed, in pixels (for a title that of its panel).
  std::optional<double> most = {};
};

/// The extent of a text on the page, in pixels.
struct Extent {
  Box ink;              ///< around its glyphs
  double smallest = 0;  ///< em of the smallest glyph: that of the text or of its scripts
  double width = 0;     ///< along the text
};

/// Sets text in STIX and draws it into a finished image (FreeType). Markup is UTF-8 with
/// mathematics between dollars, as in `the layer $Ω_ε^−$, $u ≥ 0$`. In mathematics Latin and small
/// Greek letters are italic, and `_` and `^` set one character or a {group} below and above the
/// line (with both, one above the other).
class Typesetter {
 public:
  Typesetter();  ///< throws Error where the fonts cannot be read
  ~Typesetter();
  Typesetter(Typesetter&&) noexcept;
  Typesetter& operator=(Typesetter&&) noexcept;

  /// Returns the pixels from the first to the last glyph, at angle 0. Throws Error for broken UTF-8
  /// or unbalanced markup.
  double width(const std::string& markup, double size) const;
  /// Returns the extent of the text; `at` is the place of its anchor. Throws Error likewise.
  Extent extent(Point at, const std::string& markup, const TextStyle& style) const;
  /// Draws the text into an image of 3 components (unsigned char).
  void draw(vtkImageData& image, Point at, const std::string& markup, const TextStyle& style) const;

 private:
  std::unique_ptr<Fonts> fonts_;
};

}  // namespace antilock::figures
