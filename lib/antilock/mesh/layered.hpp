#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The body's triangles over a layer (-1 < y < 0) in columns: one column under every edge of Sigma, cut into as many
/// rows as make its cells about square in the true layer, of thickness epsilon: ceil(epsilon / h) rows, h the mean
/// width of the columns. Each cell is cut by a diagonal (/). `body` is a mesh of any body on or above Sigma, a part of
/// the line y = 0: Sigma are its edges with the tag contact, or, where it has a layer, those with the tag sigma; that
/// layer is left out. The body's vertices and triangles come first, in their order, and keep their tags. Below, the
/// sides are clamped and the bottom is contact, as in Figure 2. A function of P1 on it that is constant on each column
/// costs no layer stress, so that P1 does not lock on it. Throws Error unless 0 <= epsilon <= 1, for a body below y = 0
/// and for one without Sigma.
TriangleMesh extruded(const TriangleMesh& body, double epsilon);

/// The layered mesh of the unit square: gmsh's body (unstructured_mesh), its layer extruded. Made for one epsilon it
/// serves every smaller one; the layer has `cells` rows for epsilon = 1 and a single one for epsilon <= 1 / cells.
/// Throws Error unless 1 <= cells <= 512.
TriangleMesh layered_mesh(int cells, double epsilon = 1);

}  // namespace antilock
