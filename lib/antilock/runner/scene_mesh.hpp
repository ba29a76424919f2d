#pragma once
#include "antilock/certificate/certificate.hpp"
#include "antilock/runner/scene_file.hpp"

namespace antilock {

/// Returns the mesh of a scene file: made by a generator, or read and compared with the scene, and
/// then refined. The body of a mesh file lies above its lower side. This side is the part of its
/// boundary on the line y = 0, or, where the contact edges leave this line, the curve of the
/// contact edges. With a layer this side is Sigma. The layer is the strip below it. If the side is
/// a curve, the layer follows the normals of the curve. The bottom of the layer is in contact. If
/// the file has no layer, a scaled layer is made below the body. Without a layer in the scene all
/// of the side is in contact. A geometry that the scene names is read and compared with the
/// boundary; other geometry files are ignored.
///
/// Throws Error, `FILE: KEY: ...`. KEY is mesh.cells, mesh.file, mesh.geometry or mesh.refinements.
/// It is load.f, contact.gap or contact.ceiling if check_on_mesh throws.
TriangleMesh make_mesh(const SceneFile& file);

/// Returns the mesh width for reports: 1/cells of the refined mesh, or the longest edge if the mesh
/// comes from a file or was refined to an accuracy.
double mesh_width(const SceneFile& file, const TriangleMesh& mesh);

}  // namespace antilock
