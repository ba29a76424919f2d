#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock::test {

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

}  // namespace antilock::test
