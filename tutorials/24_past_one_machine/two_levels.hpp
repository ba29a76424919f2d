#pragma once
#include <filesystem>
#include <string>
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

/// Strips and hat functions, or which of the two: "patches", "patches and hats", "strips" or
/// "strips and hats".
std::string name_of(const TwoLevels& choice);

/// A mesh whose layer has no columns: the structured mesh of 1/h = 16 with moved vertices,
/// refined to 1/h = cells, which is 16 times a power of two. It is the same on every machine.
TriangleMesh mesh_without_columns(int cells);

/// One row per mesh width, choice and delta, on mesh_without_columns: pair (name_of), cells,
/// delta and iterations.
Table iterations_table(const std::vector<TwoLevels>& choices, const std::vector<int>& cells,
                       const std::vector<double>& deltas);

/// Writes such a table for the picture: pair, h, delta, and iterations, which are NaN where
/// `most` were not enough.
void write_four_pairs(const std::filesystem::path& path, const Table& runs, int most = 200);

/// Writes a drawing of the subdomains on gmsh's mesh of 1/h = 48: one strip of three with
/// what it shares with its neighbours, and one patch. figures/pictures/domain.cpp reads it.
void write_strip(const std::filesystem::path& path);

/// Writes no_hat.vtu and hat.vtu, the coarse function of a vertex of Sigma on gmsh's mesh
/// of 1/h = 16, without and with its hat function in the layer.
void write_coarse_function(const std::filesystem::path& folder);

}  // namespace antilock::tutorial
