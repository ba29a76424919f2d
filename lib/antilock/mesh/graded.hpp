#pragma once
#include <vector>

#include "antilock/mesh/generate.hpp"

namespace antilock {

/// The mesh of all lines x = const and y = const, each cell cut by a diagonal: a layer below y = 0, the body above; the
/// lowest line is Gamma_C, the other sides are clamped. The layer is in columns, so that P1 does not lock on it,
/// however far the lines are from equal distances. Throws Error unless both lists ascend, with two lines at least, and
/// y = 0 is a line below the last one, and for more than 2^25 crossings.
TriangleMesh tensor_mesh(const std::vector<double>& x, const std::vector<double>& y,
                         Diagonal diagonal = Diagonal::right);

/// The tensor mesh of the two unit squares for a contact that ends at x = `end` on Gamma_C: cells no wider than
/// `width`, and `layers` toward x = end. What happens at a distance d in x is felt up to d in the body, but up to d /
/// epsilon in the layer: as many layers toward Sigma as are wider than epsilon (ratio^k > epsilon) in the rows of the
/// body, the others toward Gamma_C in those of the layer. Each of the `layers` cuts the cell next to the line, and
/// leaves it the share `ratio`. Throws Error unless 0 < end < 1, 0 <= epsilon <= 1, width is a millionth or more, 0 <=
/// layers <= 60 and 0 < ratio < 1, and as tensor_mesh does: where the cuts fall below the digits of `end`, too.
TriangleMesh graded_mesh(double end, double width, int layers, double ratio, double epsilon);

}  // namespace antilock
