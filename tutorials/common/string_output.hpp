#pragma once
#include <Eigen/Core>

#include <filesystem>
#include <vector>

namespace antilock::tutorial {

/// The exact string of 00_string_on_an_obstacle, load 10 sin(2 pi x): where it comes to lie on a floor at height -depth
/// (0 <= depth <= 0.2), and its shape on a floor at height 0.
double string_touches_from(double depth);
double string_shape(double x);

/// Of a discrete string, at its inner nodes x_i = i / (n + 1): the first x with a force (1 without one), and the largest
/// error on a floor at height 0.
double contact_starts(const Eigen::VectorXd& lambda);
double string_error(const Eigen::VectorXd& u);

/// What that chapter draws, at the inner nodes x_i = i / (n + 1): shapes.csv (the string, with and without the floor, and
/// the pressure of the floor), active_sets.csv (the first three guesses and the last), projection.csv (a string of two
/// nodes: its energy over the plane of their heights).
/// @param guesses  the shapes that the active set went through; the first is the string without a floor
/// @param lambda   force at each node
void write_string(const std::filesystem::path& out, const std::vector<Eigen::VectorXd>& guesses,
                  const Eigen::VectorXd& lambda);

}  // namespace antilock::tutorial
