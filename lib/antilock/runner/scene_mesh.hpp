#pragma once
#include "antilock/certificate/certificate.hpp"
#include "antilock/runner/scene_file.hpp"

namespace antilock {

/// The mesh of a scene file: made, or read and compared with the scene, then refined. From a file the body may be
/// anything on or above y = 0 with a bottom edge on that line, or above a curve of contact edges, along whose normals
/// the layer then grows: with a layer all of it is Sigma, and the layer fills the strip below, contact at its bottom;
/// without one all of it is contact. A geometry that the scene names is read and compared with the boundary; no other
/// is looked at. Throws Error, `FILE: KEY: ...`, KEY mesh.cells, mesh.file, mesh.geometry, mesh.refinements, or load.f and
/// contact.gap where these have no value on the body of a file.
TriangleMesh make_mesh(const SceneFile& file);

/// The mesh width to report: 1/cells of the refined mesh, or the longest edge of one from a file or refined to an
/// accuracy.
double mesh_width(const SceneFile& file, const TriangleMesh& mesh);

}  // namespace antilock
