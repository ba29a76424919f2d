#pragma once
#include <Eigen/Core>
#include <filesystem>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/space.hpp"
#include "antilock/space/vector_space.hpp"

namespace antilock {

/// The fields that a VTU file may hold beside u; an empty vector is left out.
struct VtuFields {
  Eigen::VectorXd p = {};         ///< T, the layer stress, one value per triangle (0 on the body)
  Eigen::VectorXd pressure = {};  ///< C, the contact pressure, a density, one value per contact unknown of the space
};
/// VTU (XML, its arrays as bytes in base64) for ParaView and the figures: point data `u` and `pressure` (0 off Gamma_C), cell
/// data `region` (1 and 2: the field data `body` and `layer` name them) and `p`. A vertex per triangle
/// corner, so that Crouzeix-Raviart fields keep their jumps; P1 and P2 fields share their vertices, and P2 is shown
/// there alone. Throws Error, `path` first, and leaves no partial file; so do the two below.
void write_vtu(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u,
               const VtuFields& more = {});
/// VTU of a field that is affine on each triangle and jumps between them: T x 3 values at the corners, point data `u`.
void write_vtu(const std::filesystem::path& path, const TriangleMesh& mesh, const Eigen::MatrixX3d& corners);
/// VTU of a body deformed by u (not magnified): the points where it moved them, three per triangle, point data
/// `displacement`, cell data `pressure` (one value per triangle).
void write_deformed_vtu(const std::filesystem::path& path, const VectorSpace& space, const Eigen::VectorXd& u,
                        const Eigen::VectorXd& pressure);

}  // namespace antilock
