#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The groups of the contact edges of two_body_mesh. A scene names them in this order
/// (Scene::edges()).
inline constexpr EdgeTag upper_side = natural_group(0);
inline constexpr EdgeTag lower_side = natural_group(1);

/// Returns one mesh of two bodies that are not connected. `upper` is a mesh whose contact edges lie
/// on a line y = c, such as every generated mesh of mesh/generate.hpp. `lower` is another one. It
/// is reflected in y and moved, so that its contact edges lie on the same line below `upper`. The
/// contact edges become upper_side and lower_side, and other tags stay. The vertices of the two
/// sides need not match. Throws Error where a mesh has no contact edge or has some off one line
/// y = const, and where one has named groups or a curved layer.
TriangleMesh two_body_mesh(const TriangleMesh& upper, const TriangleMesh& lower);

}  // namespace antilock
