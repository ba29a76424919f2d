#pragma once
#include "drawing/geometry.hpp"

namespace antilock::figures {

/// Colours that readers with any colour vision can distinguish: those of Okabe and Ito that are
/// visible as a thin line on white, and darker ones of Tol in place of the others. styles.cpp lists
/// their meanings in charts.
namespace palette {
constexpr Colour black{0, 0, 0}, white{1, 1, 1}, ink{0.13, 0.13, 0.13}, grey{0.5, 0.5, 0.5},
    pale{0.87, 0.87, 0.87};
constexpr Colour blue{0, 0.447, 0.698}, vermillion{0.835, 0.369, 0}, green{0, 0.55, 0.4},
    purple{0.69, 0.3, 0.55};
constexpr Colour sky{0.23, 0.56, 0.8}, indigo{0.2, 0.133, 0.533}, olive{0.5, 0.44, 0.05},
    red{0.8, 0.13, 0.07};
constexpr Colour body{0.87, 0.92, 0.97}, layer{0.99, 0.91, 0.78};  ///< fills of Omega+ and Omega-
}  // namespace palette

/// Returns the colour of viridis (van der Walt and Smith, 2015) at t in [0, 1], interpolated
/// between 16 samples. A t outside is clamped.
Colour viridis(double t);

}  // namespace antilock::figures
