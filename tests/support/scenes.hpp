#pragma once
// What every test begins with: gtest, the standard library's usual pages, a mesh, a problem and its
// solver, and the scenes that tests share. In the tests' precompiled header.
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
#include <stdexcept>
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

/// A space, and what to call it in a message.
struct NamedSpace : Space {
  NamedSpace(const std::string& mesh_name, TriangleMesh mesh, const Element& element)
      : Space(std::move(mesh), element), name(mesh_name + " " + element.name()) {}
  std::string name;
};

/// Each element on each of the two_square_meshes.
inline std::vector<NamedSpace> two_square_spaces(int cells,
                                                 const std::vector<const Element*>& elements) {
  std::vector<NamedSpace> spaces;
  for (const auto& [name, mesh] : two_square_meshes(cells))
    for (const Element* element : elements) spaces.emplace_back(name, mesh, *element);
  return spaces;
}

/// (23) under the load of the figures, with contact.
inline Scene stiff_scene(double epsilon, UnilateralContact contact = {}) {
  return Scene({paper_load}, StiffLayer{epsilon}, std::move(contact));
}
inline VariationalInequality stiff_problem(const Space& space, double epsilon,
                                           UnilateralContact contact = {}) {
  return assemble(stiff_scene(epsilon, std::move(contact)), space);
}

/// What `act` throws, of the kind that is asked for.
template <class Failure, class Act>
Failure thrown(Act&& act) {
  try {
    act();
  } catch (const Failure& failure) {
    return failure;
  }
  throw std::logic_error("nothing was thrown");
}

/// The message of the Error (or a kind of it) that `act` throws; empty where it throws none.
template <class Act>
std::string refusal(Act&& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// `act` must throw Error in one line that contains `words`.
template <class Act>
void expect_refused(Act&& act, const std::string& words) {
  const std::string message = refusal(act);
  EXPECT_NE(message, "") << "nothing was refused; expected: " << words;
  EXPECT_NE(message.find(words), message.npos) << message;
  EXPECT_EQ(message.find('\n'), message.npos) << message;
}

/// Largest difference, relative to the largest entry of `truth`.
inline double relative_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& exact) {
  return (a - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

/// at_lower where `active`, else between: a start for bounds from below.
inline BoundStatuses held_at_lower(const std::vector<bool>& active) {
  BoundStatuses status;
  for (const bool held : active)
    status.push_back(held ? BoundStatus::at_lower : BoundStatus::inactive);
  return status;
}

}  // namespace antilock::test
