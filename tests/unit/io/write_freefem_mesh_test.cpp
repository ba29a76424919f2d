// Meshes.
#include <Eigen/Core>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/mesh/read_msh.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"
#include "unit/io/helpers.hpp"

namespace antilock::test::io_test::write_freefem_mesh_test {

using Rows =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

TEST(WriteMsh, AMeshComesBackAsItWas) {
  const TemporaryFolder folder;
  const std::array meshes = {structured_mesh(5), structured_mesh(4, Domain{0}),
                             structured_mesh(3, {}, Diagonal::left),
                             structured_mesh(4, Domain{0.125}), unstructured_mesh(6)};
  for (const TriangleMesh& mesh : meshes) {
    write_msh(folder / "mesh.msh", mesh);
    const TriangleMesh back = read_msh((folder / "mesh.msh").string());
    EXPECT_EQ(back.vertices, mesh.vertices);  // bit by bit
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_EQ(back.region, mesh.region);
    EXPECT_EQ(back.edges, mesh.edges);
    EXPECT_EQ(back.edge_tag, mesh.edge_tag);
  }
}

TEST(WriteMsh, NamesTheGroupsThatAreThereAndNoOthers) {
  const TemporaryFolder folder;
  write_msh(folder / "two.msh", structured_mesh(2));
  EXPECT_NE(
      contents(folder / "two.msh")
          .find(
              "5\n1 3 \"sigma\"\n1 4 \"clamped\"\n1 5 \"contact\"\n2 1 \"body\"\n2 2 \"layer\"\n"),
      std::string::npos);
  write_msh(folder / "one.msh", structured_mesh(2, Domain{0}));
  EXPECT_NE(
      contents(folder / "one.msh").find("3\n1 4 \"clamped\"\n1 5 \"contact\"\n2 1 \"body\"\n$End"),
      std::string::npos);
}

TEST(WriteFreefemMesh, HoldsTheCountsTheLabelsAndTheSameNumbering) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = structured_mesh(4);
  write_freefem_mesh(folder / "mesh.freefem.msh", mesh);
  const std::vector<double> n = numbers(folder / "mesh.freefem.msh");
  const int labelled = 4 + 4 + 4 + 16;  // sigma, contact, the top, the four sides
  ASSERT_EQ(n.size(), 3U + 3U * mesh.vertex_count() + 4U * mesh.triangle_count() + 3U * labelled);
  EXPECT_EQ(n[0], mesh.vertex_count());
  EXPECT_EQ(n[1], mesh.triangle_count());
  EXPECT_EQ(n[2], labelled);
  const Rows vertices(n.data() + 3, mesh.vertex_count(), 3);
  const Rows triangles(vertices.data() + vertices.size(), mesh.triangle_count(), 4);
  const Eigen::MatrixXi edges = Rows(triangles.data() + triangles.size(), labelled, 3).cast<int>();
  EXPECT_EQ(vertices.leftCols(2), mesh.vertices);
  EXPECT_EQ(triangles.leftCols(3).cast<int>(), (mesh.triangles.array() + 1).matrix());
  for (int t = 0; t < mesh.triangle_count(); ++t)
    EXPECT_EQ(triangles(t, 3), static_cast<int>(mesh.region[t]));
  for (const auto& [label, count] : {std::pair{3, 4}, {4, 20}, {5, 4}})
    EXPECT_EQ((edges.col(2).array() == label).count(), count) << label;
  for (const auto& edge : edges.rowwise()) {
    if (edge(2) != 5) continue;
    EXPECT_LT(mesh.vertices(edge(0) - 1, 0), mesh.vertices(edge(1) - 1, 0)) << "the domain is left";
  }
}

// A cube over two flat boxes of the layer, each cut into six tetrahedra. Faces: two on Sigma, two
// on Gamma_C, two on the top, and 24 on the sides.
TEST(WriteFreefemMesh, WritesTetrahedraInMeditsFormat) {
  const TemporaryFolder folder;
  const Mesh mesh = structured_mesh(1, {1, CellKind::tetrahedron});
  write_freefem_mesh(folder / "cube.mesh", mesh);
  std::istringstream in(contents(folder / "cube.mesh"));
  std::string word;
  int number = 0;
  const auto expect_section = [&](const std::string& name, int count) {
    ASSERT_TRUE(in >> word >> number);
    EXPECT_EQ(word, name);
    EXPECT_EQ(number, count) << name;
  };
  expect_section("MeshVersionFormatted", 2);
  expect_section("Dimension", 3);
  expect_section("Vertices", mesh.vertex_count());
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    Eigen::Vector3d x;
    ASSERT_TRUE(in >> x(0) >> x(1) >> x(2) >> number);
    EXPECT_EQ(x.transpose(), mesh.vertices.row(v)) << v;
  }
  expect_section("Tetrahedra", 18);
  for (int t = 0; t < 18; ++t) {
    Eigen::RowVector4i corners;
    ASSERT_TRUE(in >> corners(0) >> corners(1) >> corners(2) >> corners(3) >> number);
    EXPECT_EQ((corners.array() - 1).matrix(), mesh.triangles.row(t)) << t;
    EXPECT_EQ(number, static_cast<int>(mesh.region[t])) << t;
  }
  expect_section("Triangles", 30);
  std::map<int, int> faces;
  for (int e = 0; e < 30; ++e) {
    Eigen::Vector3i corners;
    ASSERT_TRUE(in >> corners(0) >> corners(1) >> corners(2) >> number);
    ++faces[number];
  }
  EXPECT_EQ(faces, (std::map<int, int>{{3, 2}, {4, 26}, {5, 2}}));
  ASSERT_TRUE(in >> word);
  EXPECT_EQ(word, "End");
}

}  // namespace antilock::test::io_test::write_freefem_mesh_test
