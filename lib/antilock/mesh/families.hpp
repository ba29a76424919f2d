#pragma once
#include <functional>
#include <string>
#include <vector>

#include "antilock/mesh/generate.hpp"

namespace antilock {

/// A family of meshes: a name, and one mesh per number of cells per unit side (h = 1/cells). A new
/// family is one line:
/// `MeshFamily{"jittered", [](int cells) { return jittered_mesh(cells, 0.1); }}`.
struct MeshFamily {
  std::string name;
  std::function<TriangleMesh(int cells)> mesh;
};
/// The meshes of Figure 3 and of Figure 6 of [SR04] (cited in problem/variational_inequality.hpp).
MeshFamily structured(const Domain& domain = {}, Diagonal diagonal = Diagonal::right);
MeshFamily unstructured(const Domain& domain = {});

/// The families of the two unit squares, body and layer, by name:
///
///     structured, layered, columns    every triangle of the layer has a vertical edge
///     unstructured                    by gmsh, Frontal-Delaunay
///     delaunay, meshadapt             by gmsh
///     jittered                        structured, its inner vertices moved by up to 0.2 h
///     staggered                       rows of triangles as high as wide
///     rows                            rows of nearly equilateral triangles
///
/// The triangles of the family columns are nearly equilateral, like those of the family rows.
const std::vector<MeshFamily>& mesh_families();
/// Returns the family of this name. Throws Error for another name.
const MeshFamily& mesh_family(const std::string& name);

}  // namespace antilock
