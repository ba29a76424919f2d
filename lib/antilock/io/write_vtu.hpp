#pragma once
#include <Eigen/Core>
#include <filesystem>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/space.hpp"
#include "antilock/space/vector_space.hpp"

namespace antilock {

/// The fields that a VTU file may hold beside u. An empty vector is left out.
struct VtuFields {
  /// One value per triangle: the layer stress (0 on the body).
  Eigen::VectorXd p = {};
  /// One value per contact unknown of the space: the contact pressure, a density.
  Eigen::VectorXd pressure = {};
};
/// Writes VTU (XML, with its arrays as bytes in base64) for ParaView and the figures. The point
/// data are `u` and `pressure` (0 off Gamma_C, the contact boundary). The cell data are `p` and
/// `region` (1 and 2: the field data `body` and `layer` name them). A Crouzeix-Raviart field has
/// three points per triangle, so that it keeps its jumps. A P1 or P2 field has one point per
/// vertex, so P2 is shown only by its values at vertices. This function and the two below throw
/// Error, whose message begins with `path`, and leave no partial file.
void write_vtu(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u,
               const VtuFields& more = {});
/// Writes a field that is affine on each triangle and jumps between them: T x 3 values at the
/// corners of the T triangles, as point data `u`.
void write_vtu(const std::filesystem::path& path, const TriangleMesh& mesh,
               const Eigen::MatrixX3d& corners);
/// Writes the body deformed by u, not magnified. There are three points per triangle, at their
/// deformed positions. The point data are `displacement`, the cell data `pressure` (one value per
/// triangle).
void write_deformed_vtu(const std::filesystem::path& path, const VectorSpace& space,
                        const Eigen::VectorXd& u, const Eigen::VectorXd& pressure);

}  // namespace antilock
