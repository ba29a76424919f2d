#pragma once
#include <string>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/runner/scene_file.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Evaluates the load at the vertices and edge midpoints of a body from a file, and the bounds gap
/// and ceiling along Gamma_C, the contact boundary, or along the slave side of two bodies. Throws
/// Error, `FILE: KEY: ...`, where one of them has no finite value, where the ceiling is below the
/// obstacle, and where displacements prescribed at a vertex of Gamma_C, or at one place of both
/// bodies, violate one of the bounds.
void check_on_mesh(const SceneFile& file, const TriangleMesh& mesh);

/// Returns a warning if the quadrature misses a part of the load f, else an empty text. The
/// integrals of f, x f, y f and, in space, z f over the body are compared with those of at least
/// 250,000 points spread over all cells. The warning names an integral that differs by more than a
/// twentieth of the integral of its absolute value. There is a warning, too, if f is far from q,
/// the quadratic that fits it best at the quadrature points of a cell: if the integral of |f - q|
/// is more than a quarter of that of |f|. A spike that lies between all of the points is not
/// detected.
std::string load_warning(const SceneFile& file, const Space& space,
                         const VariationalInequality& problem);

/// Returns a warning if prescribed displacements jump, else an empty text. They may jump where two
/// groups of edges with different values meet, or within a formula. No function of finite energy
/// has such a jump: the energy of u_h grows like |log h| as h tends to 0.
std::string displacement_warning(const SceneFile& file, const TriangleMesh& mesh);

/// Returns a warning if the boundary of a mesh from a file looks like a curve, else an empty text.
/// The boundary looks like a curve if its direction changes at six vertices or more by an angle of
/// at most 45 degrees, that of a regular octagon. The warning is needed because the certificate
/// bounds the error of the problem on the polygon, and not on the curve.
std::string polygon_warning(const SceneFile& file, const TriangleMesh& mesh);

/// Returns a warning if a refined mesh file has a .geo or .brep file of the same name that the
/// scene does not name, else an empty text. The mesh is refined without this file.
std::string geometry_warning(const SceneFile& file);

/// Returns a warning if u_h violates a bound of the contact between its contact unknowns by more
/// than a twentieth of max |u_h|, else an empty text. It names the largest violation at about a
/// hundred thousand points of Gamma_C.
std::string gap_warning(const SceneFile& file, const Space& space, const Solution& solution);

/// Returns a warning if the values of the Crouzeix-Raviart u_h in the layer leave the range of its
/// values on the boundary of the layer by more than a twentieth of max |u_h|, else an empty text.
/// If the layer has no load, the exact solution in the layer lies between its smallest and its
/// largest value on the boundary of the layer, by the maximum principle. Layers with a considerable
/// load are not checked.
std::string range_warning(const SceneFile& file, const Space& space, const Solution& solution);

}  // namespace antilock
