#pragma once
#include "antilock/mesh/mesh.hpp"

namespace antilock {

/// The name of a mesh in functions that accept triangles only.
using TriangleMesh = Mesh;

}  // namespace antilock
