#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// right: / (Figure 3); left: \; crossed: both, with a vertex at each cell's centre.
enum class Diagonal { right, left, crossed };

/// The domain of Figure 2: the unit square, with a layer (0,1) x (-layer_depth, 0) below it where layer_depth > 0.
struct Domain {
  double layer_depth =
      1;  ///< 0: the body alone; 1: after the change of variable (Figure 2); epsilon: before (Figure 1)
};

/// Throws Error unless 1 <= cells <= most and 0 <= layer_depth <= 1.
void check_mesh_request(int cells, int most, const Domain& domain);

/// The structured mesh of Figure 3: `cells` squares per unit side, each cut by a diagonal. A layer has as many rows as
/// keep its cells no flatter than needed: max(2, round(depth * cells)). Throws Error unless 1 <= cells <= 2048.
TriangleMesh structured_mesh(int cells, const Domain& domain = {}, Diagonal diagonal = Diagonal::right);

/// The structured mesh with every vertex off Sigma and off the boundary moved by up to amount * h in x and in y, at
/// random: the same directions at every call, whatever the amount. Throws Error unless 0 <= amount <= 0.2 (beyond, a
/// triangle may turn over).
TriangleMesh jittered_mesh(int cells, double amount);

/// The lattices: a layer of `rows` rows of isosceles triangles with the base 1/cells, which lies across and alternates
/// above and below, so no edge inside is vertical; or the same turned by 90 degrees, `columns` columns with upright
/// bases. Congruent but for the halves at the ends of each row or column. The body has rectangles of the lattice's
/// width, cut by a diagonal. Throws Error unless cells, rows and columns are in range: 1 <= cells <= 2048, up to 4096
/// of the others.
TriangleMesh rows_mesh(int cells, int rows);
TriangleMesh columns_mesh(int cells, int columns);

enum class Mesher { mesh_adapt = 1, delaunay = 5, frontal = 6 };  ///< gmsh's own numbers

/// The unstructured mesh of Figure 6, by gmsh (one thread, fixed seed): the same mesh at every call. Frontal-Delaunay
/// begins at the boundary: most triangles of the layer then have a vertical edge, which Delaunay and MeshAdapt avoid.
/// In a thin layer the cells shrink to half its depth. Beyond 128 cells gmsh makes the mesh of cells / 2, / 4 or / 8 (the
/// first that is at most 80, or the last that leaves a layer one cell deep) and every triangle is then cut into four by its midpoints, as often: the angles are those
/// of the coarse mesh, and inside its triangles the mesh is regular. Throws Error unless 1 <= cells <= 512.
TriangleMesh unstructured_mesh(int cells, const Domain& domain = {}, Mesher mesher = Mesher::frontal);

/// The disc of radius 1, its rim clamped: 6 rings^2 triangles with edges of about 1/rings, no angle far above 90
/// degrees. Its boundary is the polygon through 6 rings points of the circle. Throws Error unless 1 <= rings <= 512.
TriangleMesh disc_mesh(int rings);

}  // namespace antilock
