#pragma once
#include <functional>
#include <string>
#include <vector>

#include "drawing/page.hpp"

namespace antilock::figures {

/// Draws the sample of entry n within a box.
using Swatch = std::function<void(std::size_t n, const Box& box)>;

/// The height of a legend of these entries, set in as many centred lines as the page's width asks for.
double legend_height(const Page& page, const std::vector<std::string>& names);
void draw_legend(Page& page, const std::vector<std::string>& names, double bottom, const Swatch& swatch);

}  // namespace antilock::figures
