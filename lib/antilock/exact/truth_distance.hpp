#pragma once
#include "antilock/exact/truth.hpp"

namespace antilock {

/// ||u_a - u_b||_{1,Omega}, the norm of Theorem 1, of two truths, body and layer together: by Parseval's theorem on
/// rows y = const, and Gauss' rule over the rows. The truths may differ in epsilon, load and points.
double h1_distance(const Truth& a, const Truth& b);

}  // namespace antilock
