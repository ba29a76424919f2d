#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/detail/vector_space.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// MSH 2.2 ASCII with the physical groups of Figure 2 and, with their names, those of `edges`; free edges of no other
/// group are in "free".
void write_msh(const std::filesystem::path& path, const TriangleMesh& mesh,
               const std::vector<EdgeCondition>& edges = {});
/// FreeFEM's native .msh: nv nt nbe; x y label; i j k region; i j label. The same numbering, labels as in
/// EdgeTag/Region.
void write_freefem_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);
/// A table: one header line, then rows, comma separated. Here and below a number is the shortest text that reads back
/// as the same double (up to 17 digits). Every writer throws Error, `path` first, and leaves no partial file.
void write_csv(const std::filesystem::path& path, const std::vector<std::string>& header, const Eigen::MatrixXd& rows);
/// `x,y,u`, or `x,y,u_x,u_y` for the 2 N values of a displacement: one row per unknown of the space.
void write_solution_csv(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u);
/// What a VTU file may hold beside u; an empty vector is left out.
struct VtuFields {
  Eigen::VectorXd p = {};         ///< T, the layer stress, one value per triangle (0 on the body)
  Eigen::VectorXd pressure = {};  ///< C, the contact pressure, a density, one value per contact unknown of the space
};
/// VTU (XML, its arrays as bytes in base64) for ParaView and the figures: point data `u` and `pressure` (0 off Gamma_C), cell
/// data `region` (1 and 2: the field data `body` and `layer` name them) and `p`. A vertex per triangle
/// corner, so that Crouzeix-Raviart fields keep their jumps; P1 and P2 fields share their vertices, and P2 is shown
/// there alone.
void write_vtu(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u,
               const VtuFields& more = {});
/// VTU of a field that is affine on each triangle and jumps between them: T x 3 values at the corners, point data `u`.
void write_vtu(const std::filesystem::path& path, const TriangleMesh& mesh, const Eigen::MatrixX3d& corners);
/// VTU of a body deformed by u (not magnified): the points where it moved them, three per triangle, point data
/// `displacement`, cell data `pressure` (one value per triangle).
void write_deformed_vtu(const std::filesystem::path& path, const VectorSpace& space, const Eigen::VectorXd& u,
                        const Eigen::VectorXd& pressure);

}  // namespace antilock
