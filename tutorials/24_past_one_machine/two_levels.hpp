#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// The two choices of the experiment of chapter 24: the subdomains of the smoother and the
/// coarse space of a two-level preconditioner for a layer without columns.
struct TwoLevels {
  /// Whether the layer is solved on overlapping strips from Sigma to Gamma_C. Otherwise it
  /// is solved on small patches, the edges of each vertex of the layer.
  bool strips = true;
  /// Whether the coarse functions of Sigma's vertices continue into the layer as hat
  /// functions of x. Otherwise the coarse space consists of P1 in the body.
  bool hats = true;
};

/// The number of iterations of conjugate gradients to 1e-8 in the energy norm, for
/// Crouzeix-Raviart on `mesh` and A_delta = A1 + delta^-1 B' M B without contact; `most`
/// where these are not enough. It is the serial variant of
/// distributed/detail/strip_multigrid.hpp, but that the coarse problem is solved exactly.
/// `cells` is 1/h.
int iterations_of(const TwoLevels& choice, const TriangleMesh& mesh, int cells,
                  double delta, int most = 200);

/// One row per mesh width, choice and delta, on gmsh's Delaunay mesh: subdomains ("strips"
/// or "patches"), hats ("yes" or "no"), cells, delta and iterations.
Table iterations_table(const std::vector<TwoLevels>& choices, const std::vector<int>& cells,
                       const std::vector<double>& deltas);

}  // namespace antilock::tutorial
