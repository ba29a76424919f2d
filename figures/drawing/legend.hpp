#pragma once
#include <functional>
#include <string>
#include <vector>

#include "drawing/page.hpp"

namespace antilock::figures {

/// Draws the sample of entry n within a box.
using Swatch = std::function<void(std::size_t n, const Box& box)>;

/// A legend of these names: in centred lines over the width of the page, or one below the other in
/// a box.
class Legend {
 public:
  Legend(const Page& page, const std::vector<std::string>& names);
  std::size_t lines() const { return lines_.size(); }
  double height() const;
  void draw(Page& page, double bottom, const Swatch& swatch) const;
  /// Draws one entry per line, centred in the box.
  void draw_in(Page& page, const Box& box, const Swatch& swatch) const;
  /// Returns the width of a box that contains every entry.
  double column_width() const;

 private:
  struct Line {
    std::vector<std::size_t> entries;
    double width;
  };
  void break_lines(std::size_t most);  // entries per line
  std::vector<std::string> names_;
  std::vector<double> widths_;  // of the names
  std::vector<Line> lines_;
};

}  // namespace antilock::figures
