#pragma once
#include <optional>
#include <string>
#include <vector>

#include "drawing/typesetter.hpp"

namespace antilock::figures {

constexpr double shown_width = 480;   ///< pixels across at which a picture must still be readable
constexpr double least_type = 9;      ///< pixels of the smallest em at that width
constexpr double least_distance = 4;  ///< pixels of the page between two texts, and to its edge

/// One text of a page with what it covers.
struct LaidText {
  std::string markup;
  Extent extent;
  std::optional<double> most = {};  ///< the width that it must not exceed
};

/// The smallest em of the texts in a picture of `page_width` that is shown `shown_width` wide;
/// infinite without texts.
double smallest_type(const std::vector<LaidText>& texts, double page_width);

/// The first fault of a layout, one line: a text below `least_type`, off the page, wider than it
/// may be, or nearer to another one than `least_distance`.
std::optional<std::string> layout_fault(const std::vector<LaidText>& texts, double page_width, double page_height);

}  // namespace antilock::figures
