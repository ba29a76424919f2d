#pragma once
#include "antilock/io/scene_file.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Evaluates f once on lattices of the closed unit square that hold the corners, the edges, and every x and y of one or
/// two decimals or of a denominator up to 6: there the poles of formulas written by hand are found. f throws.
void sample_load(const Field& f);
/// The same for a gap on [from, to].
void sample_gap(const Profile& gap, double from, double to);

/// The same for the scene on a mesh from a file: the load at its vertices and edges, the gap along Gamma_C, which must
/// keep away from where Gamma_C meets clamped edges. Throws Error, `FILE: KEY: ...`.
void check_on_mesh(const SceneFile& file, const TriangleMesh& mesh);

/// Empty, or a line about a load that the quadrature does not see as it is: its integrals of f, x f and y f over the
/// body are compared with those of a quarter of a million points (or more) spread over all triangles; off by more than a
/// twentieth of the integral of |f|, they are named. A spike narrower than that remains unseen.
std::string load_warning(const SceneFile& file, const Space& space, const VariationalInequality& problem);

/// Empty, or a line about a boundary of a mesh from a file that looks like a curve: at six vertices or more it turns by an
/// angle up to that of a regular octagon. What is proved is proved of the polygon.
std::string polygon_warning(const SceneFile& file, const TriangleMesh& mesh);

/// Empty, or a line about an obstacle that is missed between the contact unknowns: the largest depth to which u_h sinks
/// into it, looked for at a hundred thousand places of Gamma_C, if above a twentieth of max |u_h|.
std::string gap_warning(const SceneFile& file, const Space& space, const Solution& solution);

}  // namespace antilock
