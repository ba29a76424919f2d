#pragma once
#include <Eigen/Core>

#include <filesystem>

#include "antilock/space/space.hpp"

namespace antilock::tutorial {

/// One basis function on a coarse unstructured mesh, as VTU: that of the edge whose midpoint is nearest to the middle of
/// the layer.
void draw_basis_function(const std::filesystem::path& path);

/// The largest step of a function of Crouzeix-Raviart between two triangles, at the ends of their common edge (at its
/// midpoint they meet).
double largest_jump(const Space& space, const Eigen::VectorXd& u);

}  // namespace antilock::tutorial
