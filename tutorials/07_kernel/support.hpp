#pragma once
#include <cctype>
#include <filesystem>
#include <numbers>
#include <string>

#include "antilock/analysis/kernel.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/models/anti_plane.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// Two functions of G_h, the kernel of the paper's stiff form on this space: the orthogonal
/// projections onto it of one unknown in the middle of the layer (scaled to 1), and of
/// sin(pi x). Files NAME_local.vtu and NAME_sine.vtu, NAME in small letters with _ in place
/// of blanks.
inline void draw_kernel(const std::filesystem::path& out, const Space& space,
                        std::string name) {
  for (char& c : name)
    c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const Eigen::MatrixXd basis = kernel_basis(assemble(paper_scene(0), space));
  const auto projection = [&](const Eigen::VectorXd& v) {
    return Eigen::VectorXd(basis * (basis.transpose() * v));
  };
  Eigen::Index middle = 0;
  (space.dof_coordinates().rowwise() - Eigen::RowVector2d(0.5, -0.5))
      .rowwise()
      .squaredNorm()
      .minCoeff(&middle);
  Eigen::VectorXd local = projection(Eigen::VectorXd::Unit(space.size(), middle));
  double highest = 1e-8;  // over the corners of the triangles, where CR jumps
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    for (int i = 0; i < 3; ++i)
      highest = std::max(highest, space.element()
                                      .basis(Eigen::Vector3d::Unit(i))
                                      .dot(local(space.cell_dofs().row(t))));
  local /= highest;
  const auto x = space.dof_coordinates().col(0).array(),
             y = space.dof_coordinates().col(1).array();
  write_vtu(out / (name + "_local.vtu"), space, local);
  write_vtu(out / (name + "_sine.vtu"), space,
            projection((std::numbers::pi * x).sin() * (1 - y.max(0.0))));
}

}  // namespace antilock::tutorial
