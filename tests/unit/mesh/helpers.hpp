#pragma once
#include <sstream>
#include <string>

#include "antilock/mesh/read_msh.hpp"
#include "support/measures.hpp"

namespace antilock::test::mesh_test {

/// The text with its first `what` replaced; fails the test where there is none.
inline std::string with(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, text.npos) << what;
  return at == text.npos ? text : text.replace(at, what.size(), by);
}

/// The mesh of a text in the format MSH.
inline TriangleMesh read(const std::string& text) {
  std::istringstream in(text);
  return read_msh(in, "test.msh");
}

inline int count(const TriangleMesh& mesh, EdgeTag tag) {
  return static_cast<int>(std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), tag));
}

/// The unit square and the layer of `depth` below it, with their tagged sides, which are fewer
/// terms than the areas.
inline void expect_two_squares(const TriangleMesh& mesh, double depth, double within,
                               const std::string& name) {
  EXPECT_NEAR(area(mesh, Region::body), 1, within) << name;
  EXPECT_NEAR(area(mesh, Region::layer), depth, within) << name;
  EXPECT_NEAR(length(mesh, EdgeTag::contact), 1, within / 10) << name;
  EXPECT_NEAR(length(mesh, EdgeTag::sigma), depth > 0 ? 1 : 0, within / 10) << name;
  EXPECT_NEAR(length(mesh, EdgeTag::clamped), 3 + 2 * depth, within / 10) << name;
}

/// The smallest and the largest angle, in degrees.
inline std::pair<double, double> angles(const TriangleMesh& mesh) {
  double smallest = 180, largest = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const Eigen::RowVector2d corner = mesh.vertices.row(mesh.triangles(t, i));
      const Eigen::RowVector2d a = mesh.vertices.row(mesh.triangles(t, (i + 1) % 3)) - corner;
      const Eigen::RowVector2d b = mesh.vertices.row(mesh.triangles(t, (i + 2) % 3)) - corner;
      const double angle = std::acos(a.dot(b) / a.norm() / b.norm()) * 180 / std::numbers::pi;
      smallest = std::min(smallest, angle);
      largest = std::max(largest, angle);
    }
  return {smallest, largest};
}

inline void expect_same(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_TRUE(a.vertices == b.vertices && a.triangles == b.triangles && a.edges == b.edges);
  EXPECT_TRUE(a.region == b.region && a.edge_tag == b.edge_tag);
}

}  // namespace antilock::test::mesh_test
