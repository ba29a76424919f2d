#pragma once
#include <functional>
#include <string>
#include <vector>

#include "antilock/mesh/generate.hpp"

namespace antilock {

/// A family of meshes: a name, and one mesh per number of cells per unit side (h = 1/cells). A
/// family of one's own is one line:
/// `MeshFamily{"jittered", [](int cells) { return jittered_mesh(cells, 0.1); }}`.
struct MeshFamily {
  std::string name;
  std::function<TriangleMesh(int cells)> mesh;
};
/// The meshes of Figure 3 and of Figure 6.
MeshFamily structured(const Domain& domain = {}, Diagonal diagonal = Diagonal::right);
MeshFamily unstructured(const Domain& domain = {});

/// The families of the two unit squares, by name: structured, layered and columns, whose layers have a vertical edge in
/// every triangle; unstructured (gmsh's Frontal-Delaunay), delaunay, meshadapt (gmsh, too), jittered (by 0.2 h),
/// staggered (rows as high as their triangles are wide), rows (of nearly equilateral triangles, as those of columns
/// are).
const std::vector<MeshFamily>& mesh_families();
/// One of them. Throws Error for another name.
const MeshFamily& mesh_family(const std::string& name);

}  // namespace antilock
