#pragma once
#include <string>
#include <vector>

#include "drawing/geometry.hpp"

namespace antilock::figures {

/// The colours of Okabe and Ito, which readers with any colour vision can tell apart.
namespace palette {
constexpr Colour black{0, 0, 0}, white{1, 1, 1}, ink{0.13, 0.13, 0.13}, grey{0.55, 0.55, 0.55}, pale{0.85, 0.85, 0.85};
constexpr Colour blue{0, 0.447, 0.698}, vermillion{0.835, 0.369, 0}, green{0, 0.62, 0.451}, purple{0.8, 0.475, 0.655};
constexpr Colour orange{0.902, 0.624, 0}, sky{0.337, 0.706, 0.914};
constexpr Colour body{0.87, 0.92, 0.97}, layer{0.99, 0.91, 0.78};  ///< fills of Omega+ and Omega-
}  // namespace palette

/// The n-th colour of a series of curves (six, then again from the first).
Colour series_colour(std::size_t n);

/// Viridis (van der Walt and Smith, 2015) at t in [0, 1], interpolated between 16 samples; t outside is clamped.
Colour viridis(double t);

}  // namespace antilock::figures
