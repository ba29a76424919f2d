#pragma once
#include <vector>

#include "antilock/mesh/generate.hpp"

namespace antilock {

/// Returns the mesh of all lines x = const and y = const, each cell cut by a diagonal. The layer is
/// below y = 0 (Sigma), the body above. The lowest line is Gamma_C, the contact boundary. The other
/// sides are clamped. The layer is in columns, so that P1 does not lock on it, whatever the
/// distances of the lines. Throws Error unless both lists ascend and have two lines or more, y = 0
/// is a line below the last one, and there are at most 2^25 crossings.
TriangleMesh tensor_mesh(const std::vector<double>& x, const std::vector<double>& y,
                         Diagonal diagonal = Diagonal::right);

/// Returns the tensor mesh of the two unit squares for a contact that ends at x = `end` on Gamma_C.
/// Its cells are no wider than `width`. `layers` refinement layers cut the cells towards the line x
/// = end. Each of them cuts the cell next to the line, and the part at the line has the fraction
/// `ratio` of its width.
///
/// A feature of width d in x reaches to the depth d in the body, and to d / epsilon in the layer.
/// So refinement layer k = 0, 1, ... also cuts in y: where ratio^k > epsilon it cuts the rows of
/// the body next to Sigma, and otherwise the rows of the layer next to Gamma_C.
///
/// Throws Error unless 0 < end < 1, 0 <= epsilon <= 1, width >= 1e-6, 0 <= layers <= 60 and 0 <
/// ratio < 1, and where tensor_mesh does. It also throws where the cells at x = `end` would be
/// smaller than the round-off of `end`.
TriangleMesh graded_mesh(double end, double width, int layers, double ratio, double epsilon);

}  // namespace antilock
