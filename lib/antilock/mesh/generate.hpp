#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The diagonals of the cells. right: / (Figure 3 of [SR04], which is cited in
/// problem/variational_inequality.hpp); left: \; crossed: both, with a vertex at the centre of each
/// cell.
enum class Diagonal { right, left, crossed };

/// The domain of Figure 2 of [SR04]: the unit square, and where layer_depth > 0 below it a layer
/// (0,1) x (-layer_depth, 0). Sigma is the line y = 0 between them. For tetrahedra it is the same
/// in space: the unit cube, and below it the layer (0,1)^2 x (-layer_depth, 0). Sigma is z = 0.
struct Domain {
  /// 0: the body alone; 1: after the change of variable (Figure 2); epsilon: before it (Figure 1).
  double layer_depth = 1;
  CellKind kind = CellKind::triangle;  ///< the cells of the mesh
};

/// The largest numbers of cells per unit side, of structured and of unstructured meshes.
inline constexpr int most_structured = 2048, most_unstructured = 512;
/// The same for tetrahedra.
inline constexpr int most_structured_in_space = 128, most_unstructured_in_space = 64;

/// Throws Error unless 1 <= cells <= most and 0 <= layer_depth <= 1.
void check_mesh_request(int cells, int most, const Domain& domain);

/// Returns the structured mesh of Figure 3: `cells` squares per unit side, each cut by a diagonal.
/// A layer has max(2, round(layer_depth * cells)) rows, so that its cells are nearly square.
/// Quadrilaterals are the squares themselves. Tetrahedra are six per cube, around its diagonal (H.
/// W. Kuhn, IBM J. Res. Dev. 4, 1960). Throws Error unless 1 <= cells <= 2048, or 128 in space.
TriangleMesh structured_mesh(int cells, const Domain& domain = {},
                             Diagonal diagonal = Diagonal::right);

/// Returns the structured mesh with moved vertices: each vertex inside of the body or of the layer
/// moves by up to amount * h in each coordinate. The directions are random, but the same in every
/// call and for every amount. Throws Error unless 0 <= amount <= 0.2, because with a larger one a
/// triangle may turn over, and where a cell does so.
TriangleMesh jittered_mesh(int cells, double amount, const Domain& domain = {});

/// The layers of the next two meshes are regular lattices. The layer of rows_mesh has `rows` rows
/// of isosceles triangles. Their bases are horizontal, of length 1/cells, and alternately below and
/// above, so that no inner edge is vertical. The layer of columns_mesh is the same turned by 90
/// degrees, in `columns` columns. The triangles of a layer are congruent, except for the halves at
/// the ends of each row or column. The body consists of rectangles, each cut by a diagonal. On
/// Sigma its vertices are those of the layer. Both throw Error unless 1 <= cells <= 2048 and 1 <=
/// rows, columns <= 4096.
TriangleMesh rows_mesh(int cells, int rows);
TriangleMesh columns_mesh(int cells, int columns);

enum class Mesher { mesh_adapt = 1, delaunay = 5, frontal = 6 };  ///< gmsh's own numbers

/// Returns the unstructured mesh of Figure 6, by gmsh (one thread, fixed seed): the same mesh in
/// every call. Frontal-Delaunay begins at the boundary, so that most triangles of the layer have a
/// vertical edge. Delaunay and MeshAdapt avoid this. In a thin layer the cells shrink to half of
/// its depth. Beyond 128 cells gmsh makes a coarser mesh with cells / 2^k, k at most 3. For a body
/// alone k is the smallest number with cells / 2^k <= 80. With a thin layer k may be smaller,
/// because the cells of the coarse mesh must not be deeper than the layer. Every triangle is then
/// cut into four by its midpoints, k times. So the angles are those of the coarse mesh, and inside
/// of its triangles the mesh is regular. Throws Error unless 1 <= cells <= 512. Tetrahedra are made
/// by gmsh's Delaunay algorithm, whatever the mesher of their surfaces, for 1 <= cells <= 64.
/// Quadrilaterals are gmsh's recombined triangles, for 1 <= cells <= 128.
TriangleMesh unstructured_mesh(int cells, const Domain& domain = {},
                               Mesher mesher = Mesher::frontal);

/// Returns a mesh of the disc of radius 1 with a clamped rim: 6 rings^2 triangles with edges of
/// about 1/rings and no angle far above 90 degrees. Its boundary is the polygon through 6 rings
/// points of the circle. Throws Error unless 1 <= rings <= 512.
TriangleMesh disc_mesh(int rings);

}  // namespace antilock
