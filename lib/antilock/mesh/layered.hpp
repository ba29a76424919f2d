#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The body's triangles over a layer (-1 < y < 0) in columns: one column under every edge of Sigma, cut into as many
/// rows as make its cells about square in the true layer, of thickness epsilon: ceil(epsilon / h) rows, h the mean
/// width of the columns. Each cell is cut by a diagonal (/). `body` is a mesh of any body on or above Sigma, a part of
/// the line y = 0: Sigma are its edges with the tag contact. The body's vertices and triangles come first, in their
/// order, and keep their tags. Below, the sides are held as the body is at the ends of Sigma, or free, and the bottom
/// is contact (Figure 2). A function of P1 on it that is constant on each column costs no layer stress, so that P1
/// does not lock on it. Throws Error unless 0 <= epsilon <= 1, for a body below y = 0, for one without Sigma and for
/// one with a layer.
///
/// `along_normals`: Sigma may be curved, anywhere below the body, each x once. The layer of thickness t = epsilon is
/// then gamma(s) + t d n(s), 0 < d < 1, with s the length along Sigma and n the normal out of the body. With c the
/// curvature of Sigma and J = 1 + t c d its area element is t J ds dd, and its derivatives are d_s / J along and d_d /
/// t across. So the energy of a layer of modulus 1 / t, (22), becomes that of (23) with two weights:
///
///     int u_s^2 / J + t^-2 J u_d^2 ds dd.
///
/// The mesh draws it straight down, the point (s, d) at (x, y - d) where gamma(s) = (x, y), so that
/// x means the same on Sigma and on Gamma_C. Below an edge of slope m: d_s = (d_x + m d_y) / (1 +
/// m^2)^(1/2), d_d = -d_y, ds dd = (1 + m^2)^(1/2) dx dy. Gamma_C has the lengths of Sigma. The
/// curvature of a polygon at a vertex is the angle by which it turns there, divided by the mean
/// length of the two edges. On an edge it is the mean of the curvatures at its ends
/// (`curved_columns`). Throws Error for a vertical edge, for one without the body above it, for an
/// x that Sigma has twice, where a displacement is given at an end of Sigma, and where t reaches
/// the radius of a hollow: there the normals meet.
TriangleMesh extruded(const TriangleMesh& body, double epsilon, bool along_normals = false);

/// The mesh's vertices, with a layer along the normals where those are, drawn as thick as a tenth of the width of all,
/// or half of the smallest radius.
Points drawn_along_normals(const TriangleMesh& mesh);

/// The layered mesh of the unit square: gmsh's body (unstructured_mesh), its layer extruded. Made for one epsilon it
/// serves every smaller one; the layer has about `cells` rows for epsilon = 1 and a single one where epsilon is at most
/// the mean width of a column.
/// Throws Error unless 1 <= cells <= 512.
TriangleMesh layered_mesh(int cells, double epsilon = 1);

}  // namespace antilock
