#pragma once
#include <optional>
#include <string>
#include <vector>

#include "drawing/typesetter.hpp"

namespace antilock::figures {

/// The width in pixels at which a picture must still be readable.
constexpr double shown_width = 480;
/// The least size of the smallest em at that width, in pixels.
constexpr double least_type = 9;
/// The least distance between two texts, and from a text to the edge of the page, in pixels of the
/// page.
constexpr double least_distance = 4;

/// One text of a page with its extent.
struct LaidText {
  std::string markup;
  Extent extent;
  std::optional<double> most = {};  ///< the width that it must not exceed, in pixels
};

/// Returns the smallest em of the texts, in pixels, in a picture of `page_width` that is shown
/// `shown_width` wide; infinity without texts.
double smallest_type(const std::vector<LaidText>& texts, double page_width);

/// Returns the first fault of a layout in one line: a text smaller than `least_type`, off the page,
/// wider than allowed, or nearer to another one than `least_distance`. Returns nothing if there is
/// none.
std::optional<std::string> layout_fault(const std::vector<LaidText>& texts, double page_width,
                                        double page_height);

}  // namespace antilock::figures
