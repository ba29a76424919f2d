#pragma once
#include <gmshc.h>
#include <gtest/gtest.h>
#include <array>

#include "antilock/core/error.hpp"
#include "antilock/mesh/detail/gmsh_session.hpp"
#include "antilock/mesh/geometry.hpp"
#include "antilock/mesh/geometry_script.hpp"

namespace antilock::test::mesh_test {

/// The message of a refusal; empty for a script that is accepted.
inline std::string refusal(const std::string& script) {
  try {
    geometry_script(script);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

/// The bounding boxes of the curves that gmsh has now.
inline std::vector<std::array<double, 6>> boxes(const GmshSession& gmsh,
                                                const std::vector<int>& curves) {
  std::vector<std::array<double, 6>> all;
  for (const int curve : curves) {
    auto& [a, b, c, d, e, f] = all.emplace_back();
    gmsh.call<decltype(gmshModelGetBoundingBox)>("gmshModelGetBoundingBox", 1, curve, &a, &b, &c,
                                                 &d, &e, &f);
  }
  return all;
}
inline std::vector<std::array<double, 6>> boxes_of(const Geometry& geometry) {
  GmshSession gmsh;
  return boxes(gmsh, gmsh.read_curves(geometry));
}

}  // namespace antilock::test::mesh_test
