#pragma once
#include <vector>

#include "antilock/analysis/detail/interface_line.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// Returns the function that lifts v above the obstacle (section 5 of
/// tutorials/guides/locking_loss.md): n values on Sigma, not below 0. It is affine on each edge,
/// and 0 where v is high enough at all of the sampled points. v has n values on Sigma, and is the
/// same at all depths. `basis` has the values of v's basis at points that divide an edge evenly,
/// its two ends included.
///
/// An end that is `held` (per place) does not move: the other one is lifted by so much more. Where
/// nothing that can move would lift v, a value is infinite, unless v is at most `tolerance` below
/// the obstacle there.
Eigen::VectorXd lift_above(const InterfaceLine& sigma, const EdgeBasis& basis,
                           const Eigen::VectorXd& v, const Profile& obstacle,
                           const std::vector<char>& held, double tolerance);

/// Returns the function that moves v between the obstacles of the contact condition, likewise: up
/// above the lower one, then down below the upper one. A value is infinite where there is no room.
Eigen::VectorXd lift_into_k(const InterfaceLine& sigma, const EdgeBasis& basis,
                            const Eigen::VectorXd& v, const UnilateralContact& contact,
                            const std::vector<char>& held, double tolerance);

}  // namespace antilock
