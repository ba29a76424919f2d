#pragma once
#include <string>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/runner/scene_file.hpp"
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

/// Empty, or a line about displacements that jump: two groups of edges that meet with different values, or a formula.
/// No function of finite energy has them: with h the energy grows like |log h|.
std::string displacement_warning(const SceneFile& file, const TriangleMesh& mesh);

/// Empty, or a line about a boundary of a mesh from a file that looks like a curve: at six vertices or more it turns by
/// an angle up to that of a regular octagon. What is proved is proved of the polygon.
std::string polygon_warning(const SceneFile& file, const TriangleMesh& mesh);

/// Empty, or a line about a .geo or .brep file that has the name of the mesh file and that the scene does not name: the
/// mesh is refined without it.
std::string geometry_warning(const SceneFile& file);

/// Empty, or a line about an obstacle that is missed between the contact unknowns: the largest depth to which u_h sinks
/// into it, looked for at a hundred thousand places of Gamma_C, if above a twentieth of max |u_h|.
std::string gap_warning(const SceneFile& file, const Space& space, const Solution& solution);

/// Empty, or a line about a layer without a load in which u_h of Crouzeix-Raviart leaves the range of the values around it
/// by more than a twentieth of max |u_h|: no exact solution does, by the maximum principle.
std::string range_warning(const SceneFile& file, const Space& space, const Solution& solution);

}  // namespace antilock
