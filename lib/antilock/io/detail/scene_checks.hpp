#pragma once
#include "antilock/io/scene_file.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Asks for the load at vertices and edges of a mesh from a file, and for the gap along Gamma_C: what has no value
/// there throws, and so does a gap that presses in where Gamma_C meets clamped edges. Throws Error, `FILE: KEY: ...`.
void check_on_mesh(const SceneFile& file, const TriangleMesh& mesh);

/// Empty, or a line about a load that the quadrature does not see as it is: its integrals of f, x f and y f over the
/// body are compared with those of a quarter of a million points (or more) spread over all triangles; off by more than
/// a twentieth of the integral of |f|, they are named. A spike narrower than that remains unseen.
std::string load_warning(const SceneFile& file, const Space& space, const VariationalInequality& problem);

/// Empty, or a line about a boundary of a mesh from a file that looks like a curve: at six vertices or more it turns by
/// an angle up to that of a regular octagon. What is proved is proved of the polygon.
std::string polygon_warning(const SceneFile& file, const TriangleMesh& mesh);

/// Empty, or a line about an obstacle that is missed between the contact unknowns: the largest depth to which u_h sinks
/// into it, looked for at a hundred thousand places of Gamma_C, if above a twentieth of max |u_h|.
std::string gap_warning(const SceneFile& file, const Space& space, const Solution& solution);

}  // namespace antilock
