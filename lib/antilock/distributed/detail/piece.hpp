#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock::distributed {

/// A vertex of the coarse mesh that several ranks hold. The lowest of these ranks owns it.
struct SharedCorner {
  int vertex;  ///< of this piece
  int owner;   ///< rank
  int index;   ///< among the corners that the owner owns
  int row;     ///< among those of them that are not clamped; -1 where it is
};

/// An edge of the coarse mesh that two ranks hold, with all that refinement made of it, in the same order on both.
struct Seam {
  int owner;                         ///< rank, the lower of the two
  int index;                         ///< among the seams that the owner owns
  std::vector<int> vertices, edges;  ///< 2^level + 1 and 2^level of this piece, from one end to the other
};

/// What one rank holds of a mesh: its own triangles, as a mesh whose cut edges are interior, and what it shares.
/// Nothing here communicates: every rank knows the coarse mesh, and refinement does the same on both sides of a seam.
struct MeshPart {
  TriangleMesh mesh;
  int level = 0;  ///< refinements since the coarse mesh
  std::vector<SharedCorner> corners;
  std::vector<Seam> seams;
  std::vector<int> corner_count;      ///< corners that each rank owns
  std::vector<int> corner_rows;       ///< those of them that are not clamped
  std::vector<int> clamped, contact;  ///< vertices of the coarse mesh that lie on clamped and on contact edges
};

/// The piece of `rank`; owner_of holds the rank of every triangle of the coarse mesh.
MeshPart piece_of(const TriangleMesh& coarse, const std::vector<int>& owner_of, int rank, int ranks);

/// Every triangle cut into four by its edge midpoints, triangle t into 4 t ... 4 t + 3 (as mesh/refine.hpp does, but
/// without a search or a check: the numbers of the new edges follow from those of the old).
MeshPart refined(const MeshPart& piece);

}  // namespace antilock::distributed
