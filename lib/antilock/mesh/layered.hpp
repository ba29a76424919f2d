#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Returns the triangles of the body over a layer (-1 < y < 0) in columns: one column under every
/// edge of Sigma, cut into ceil(epsilon / h) rows, where h is the mean width of the columns. With
/// this number of rows the cells are about square in the true layer of thickness epsilon. Each cell
/// is cut by a diagonal (/).
///
/// `body` is a mesh of any body on or above Sigma, a part of the line y = 0. Sigma consists of its
/// edges with the tag contact. The vertices and triangles of the body come first, in their order,
/// and keep their tags. The sides of the layer have the Dirichlet tag that the body has at the ends
/// of Sigma, or are free. The bottom has the tag contact (Figure 2 of [SR04], which is cited in
/// problem/variational_inequality.hpp). A P1 function that is constant in y on each column has no
/// layer stress, so that P1 does not lock on this mesh. Throws Error unless 0 <= epsilon <= 1, for
/// a body below y = 0, for one without Sigma and for one with a layer.
///
/// Below a body of tetrahedra, with Sigma on the plane z = 0, the columns are prisms below the
/// faces of Sigma. Each row of a prism is cut into three tetrahedra, and h is the side of a square
/// of two faces of mean area.
///
/// With `along_normals` Sigma, the lower side of the body, may be curved, as the graph of a
/// function of x. The layer of thickness t = epsilon is then gamma(s) + t d n(s), 0 < d < 1, with s
/// the length along Sigma and n the normal out of the body. Let c be the curvature of Sigma and J =
/// 1 + t c d. Then the area element is t J ds dd, the derivative along Sigma is d_s / J, and the
/// derivative across is d_d / t. So the energy of a layer of modulus 1 / t, (22), becomes that of
/// (23) with two weights:
///
///     int u_s^2 / J + t^-2 J u_d^2 ds dd.
///
/// In the mesh the layer lies straight below Sigma: with gamma(s) = (x, y), the point (s, d) has
/// the coordinates (x, y - d). So x means the same on Sigma and on the bottom. Below an edge of
/// slope m:
///
///     d_s = (d_x + m d_y) / (1 + m^2)^(1/2),  d_d = -d_y,  ds dd = (1 + m^2)^(1/2) dx dy.
///
/// The edges of the bottom are as long as those of Sigma. The curvature of a polygon at a vertex is
/// the angle between its two edges divided by their mean length, and on an edge the mean of its
/// ends (`curved_columns`). Throws Error for a vertical edge, for an edge without the body above
/// it, for an x that Sigma has twice, where a displacement is given at an end of Sigma, and where t
/// reaches the radius of a hollow, because the normals meet there.
TriangleMesh extruded(const TriangleMesh& body, double epsilon, bool along_normals = false);

/// Returns the vertices for a picture, V x 2. A layer along normals is drawn along them, with a
/// thickness of a tenth of the width of the mesh, or of half of the smallest radius of a hollow if
/// that is less.
Points drawn_along_normals(const TriangleMesh& mesh);

/// Returns the layered mesh of the unit square: the body of gmsh (unstructured_mesh) with an
/// extruded layer. A mesh that is made for one epsilon is fit for every smaller one, too. The layer
/// has about `cells` rows for epsilon = 1, and one row where epsilon is at most the mean width of a
/// column. Throws Error unless 1 <= cells <= 512. Tetrahedra fill the unit cube, and the prisms
/// below each face of Sigma are cut into three; then 1 <= cells <= 64.
TriangleMesh layered_mesh(int cells, double epsilon = 1, CellKind kind = CellKind::triangle);

}  // namespace antilock
