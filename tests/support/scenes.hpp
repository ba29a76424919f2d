#pragma once
// What every test begins with: gtest, the standard library's usual pages, a mesh, a problem and its solver, and the scenes
// that tests share. In the tests' precompiled header.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/kkt.hpp"

namespace antilock::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity(),
                        nan = std::numeric_limits<double>::quiet_NaN();

/// A mesh and what to call it in a message.
struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

/// Figures 3 (both diagonals) and 6.
inline std::vector<NamedMesh> two_square_meshes(int cells) {
  return {{"right", structured_mesh(cells)},
          {"left", structured_mesh(cells, {}, Diagonal::left)},
          {"unstructured", unstructured_mesh(cells)}};
}

/// (23) under the load of the figures, with contact.
inline Scene stiff_scene(double epsilon, UnilateralContact contact = {}) {
  return Scene({paper_load}, StiffLayer{epsilon}, std::move(contact));
}
inline VariationalInequality stiff_problem(const Space& space, double epsilon, UnilateralContact contact = {}) {
  return assemble(stiff_scene(epsilon, std::move(contact)), space);
}

/// `act` must throw Error itself (or a kind of it) in one line that contains `words`.
template <class Act>
void expect_refused(Act&& act, const std::string& words) {
  try {
    act();
    ADD_FAILURE() << "nothing was refused; expected: " << words;
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(words), message.npos) << message;
    EXPECT_EQ(message.find('\n'), message.npos) << message;
  }
}

/// Largest difference, relative to the largest entry of `truth`.
inline double relative_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& truth) {
  return (a - truth).cwiseAbs().maxCoeff() / truth.cwiseAbs().maxCoeff();
}

/// at_lower where `active`, else between: a start for bounds from below.
inline Pieces held_at_lower(const std::vector<bool>& active) {
  Pieces pieces;
  for (const bool held : active) pieces.push_back(held ? Piece::at_lower : Piece::between);
  return pieces;
}

}  // namespace antilock::test
