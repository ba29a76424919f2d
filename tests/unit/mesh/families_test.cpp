// Invariants of the meshes of Figures 3 and 6, and of their variants.
#include <cstdlib>

#include "antilock/mesh/families.hpp"
#include "antilock/mesh/refine.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"
#include "unit/mesh/helpers.hpp"

namespace antilock::test::mesh_test::families_test {

std::vector<NamedMesh> all_meshes() {
  std::vector<NamedMesh> meshes;
  for (const int cells : {1, 2, 7, 16})
    for (const double depth : {0.0, 0.03, 0.5, 1.0}) {
      const std::string name = fmt::format("{} cells, depth {}, ", cells, depth);
      meshes.push_back({name + "right", structured_mesh(cells, {depth})});
      meshes.push_back({name + "left", structured_mesh(cells, {depth}, Diagonal::left)});
      meshes.push_back({name + "unstructured", unstructured_mesh(cells, {depth})});
    }
  return meshes;
}

double depth_of(const TriangleMesh& mesh) { return -mesh.vertices.col(1).minCoeff(); }

TEST(Mesh, TrianglesAreCounterclockwiseAndFillTheDomain) {
  for (const auto& [name, mesh] : all_meshes()) {
    EXPECT_EQ(mesh.vertex_count() - mesh.edge_count() + mesh.triangle_count(), 1) << name;  // Euler
    const auto boundary = (mesh.edge_triangles.col(1).array() < 0).count();
    EXPECT_EQ(3 * mesh.triangle_count(), 2 * mesh.edge_count() - boundary) << name;
    for (int t = 0; t < mesh.triangle_count(); ++t) ASSERT_GT(mesh.area(t), 0) << name;
    // a sum of some thousand areas, each with one round-off
    expect_two_squares(mesh, std::max(0.0, depth_of(mesh)), 1e-12, name);
  }
}

TEST(Mesh, RegionsAndTagsSitWhereFigureTwoPutsThem) {
  for (const auto& [name, mesh] : all_meshes()) {
    const double depth = std::max(0.0, depth_of(mesh));
    for (int t = 0; t < mesh.triangle_count(); ++t)
      ASSERT_EQ(mesh.region[t], mesh.vertices.col(1)(mesh.triangles.row(t)).sum() > 0
                                    ? Region::body
                                    : Region::layer)
          << name;
    for (int e = 0; e < mesh.edge_count(); ++e) {
      const auto a = mesh.vertices.row(mesh.edges(e, 0)), b = mesh.vertices.row(mesh.edges(e, 1));
      const auto both_on = [&](int axis, double value) {
        return a(axis) == value && b(axis) == value;
      };
      EdgeTag expected = EdgeTag::interior;
      if (both_on(0, 0) || both_on(0, 1) || both_on(1, 1)) expected = EdgeTag::clamped;
      if (depth > 0 && both_on(1, 0)) expected = EdgeTag::sigma;
      if (both_on(1, -depth)) expected = EdgeTag::contact;
      ASSERT_EQ(mesh.edge_tag[e], expected) << name << ": edge from " << a << " to " << b;
    }
  }
}

TEST(Mesh, EdgesMatchTheirTriangles) {
  for (const auto& [name, mesh] : all_meshes()) {
    std::set<std::pair<int, int>> seen;
    for (int e = 0; e < mesh.edge_count(); ++e) {
      ASSERT_LT(mesh.edges(e, 0), mesh.edges(e, 1)) << name;
      ASSERT_TRUE(seen.insert({mesh.edges(e, 0), mesh.edges(e, 1)}).second)
          << name << ": an edge twice";
    }
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (int i = 0; i < 3; ++i) {
        const int e = mesh.triangle_edges(t, i);  // lies opposite vertex i
        const auto [low, high] =
            std::minmax(mesh.triangles(t, (i + 1) % 3), mesh.triangles(t, (i + 2) % 3));
        ASSERT_EQ(mesh.edges(e, 0), low) << name;
        ASSERT_EQ(mesh.edges(e, 1), high) << name;
        ASSERT_TRUE(mesh.edge_triangles(e, 0) == t || mesh.edge_triangles(e, 1) == t) << name;
      }
  }
}

TEST(Mesh, HIsTheRequestedOne) {
  for (const int cells : {1, 5, 16}) {
    EXPECT_NEAR(structured_mesh(cells).diameter(), std::sqrt(2.0) / cells, 1e-15);
    // gmsh keeps edges near the size asked for: never twice it, and about 2 to 2.6 cells^2
    // triangles a square
    const TriangleMesh mesh = unstructured_mesh(cells);
    EXPECT_LT(mesh.diameter(), 2.0 / cells);
    EXPECT_GE(mesh.diameter(), (1 - 1e-14) / cells);  // gmsh puts that edge on the boundary
  }
}

TEST(Mesh, AThinLayerIsTwoCellsDeepAtLeast) {
  for (const TriangleMesh& mesh : {structured_mesh(8, {0.01}), unstructured_mesh(8, {0.01})}) {
    EXPECT_EQ(mesh.vertices.col(1).minCoeff(), -0.01);
    bool inside = false;
    for (int v = 0; v < mesh.vertex_count(); ++v)
      inside |= mesh.vertices(v, 1) < 0 && mesh.vertices(v, 1) > -0.01;
    EXPECT_TRUE(inside) << "no vertex inside the layer";
  }
}

// The limit: gmsh itself makes the mesh of 128 cells; beyond, a coarser one is refined.
// Frontal-Delaunay: 41 degrees measured at 1/64.
TEST(Mesh, UnstructuredIsWellShapedAndOfTheHAskedForBeyondGmshsLimitToo) {
  for (const auto& [cells, depth] :
       {std::pair{32, 1.0}, {129, 0.0}, {200, 0.0}, {161, 1.0}, {512, 0.0}, {150, 0.01}}) {
    const std::string name = fmt::format("{} cells, depth {}", cells, depth);
    const TriangleMesh mesh = unstructured_mesh(cells, {depth});
    EXPECT_GT(angles(mesh).first, depth == 0.01 ? 20 : 30) << name;
    expect_two_squares(mesh, depth, 1e-11, name);
    EXPECT_EQ(depth_of(mesh), depth) << name;
    // h: on the top side, whose edges gmsh makes equal, as asked or the least that whole numbers
    // allow
    double top = 0;
    for (int e = 0; e < mesh.edge_count(); ++e)
      if (mesh.vertices(mesh.edges(e, 0), 1) == 1 && mesh.vertices(mesh.edges(e, 1), 1) == 1)
        top = std::max(top, mesh.edge_length(e));
    EXPECT_LT(top, 1.01 / cells) << name;
    EXPECT_GT(top, 0.95 / cells) << name;
    EXPECT_LT(mesh.diameter(), 2.0 / cells) << name;
    if (depth == 0.01) continue;
    const double squares = depth > 0 ? 2 : 1;
    EXPECT_GT(mesh.triangle_count(), squares * 2 * cells * cells) << name;
    EXPECT_LT(mesh.triangle_count(), squares * 2.6 * cells * cells) << name;
  }
}

TEST(Mesh, AKeptMeshIsTheMeshThatGmshMakes) {
  namespace fs = std::filesystem;
  const TriangleMesh twelve = unstructured_mesh(12), refined = unstructured_mesh(136),
                     thin = unstructured_mesh(5, {0.1});
  const test::TemporaryFolder folder;
  setenv("ANTILOCK_MESHES", folder.path().c_str(), 1);
  for (int call = 0; call < 2; ++call) {
    expect_same(unstructured_mesh(12), twelve);
    expect_same(unstructured_mesh(136), refined);
    expect_same(unstructured_mesh(5, {0.1}), thin);
    EXPECT_EQ(folder.file_count(), 3) << call;
  }
  // the second call reads: it takes what stands there
  const fs::path first = folder / "unstructured6_0x1p+0_0x1.5555555555555p-4_0x1.5555555555555p-4";
  ASSERT_TRUE(fs::exists(first));
  const auto whole = fs::file_size(first);
  for (const fs::directory_entry& other : fs::directory_iterator(folder.path()))
    if (other.path() != first)
      fs::copy_file(first, other.path(), fs::copy_options::overwrite_existing);
  expect_same(unstructured_mesh(5, {0.1}), twelve);
  // what is cut, longer or empty is made anew
  for (const auto size :
       std::initializer_list<std::uintmax_t>{whole - 1, whole + 1, whole / 2, 24, 0}) {
    fs::resize_file(first, size);
    expect_same(unstructured_mesh(12), twelve);
    EXPECT_EQ(fs::file_size(first), whole) << size;
  }
  unsetenv("ANTILOCK_MESHES");
}

// Figure 3: squares of side h, cut along / or along \.
TEST(Mesh, StructuredIsSquaresCutAlongOneDiagonal) {
  const double h = 1.0 / 6;
  for (const auto& [diagonal, slope] : {std::pair{Diagonal::right, 1}, {Diagonal::left, -1}}) {
    const TriangleMesh mesh = structured_mesh(6, {}, diagonal);
    EXPECT_EQ(mesh.vertex_count(), 7 * 13);
    for (int e = 0; e < mesh.edge_count(); ++e) {
      const Eigen::RowVector2d along =
          (mesh.vertices.row(mesh.edges(e, 1)) - mesh.vertices.row(mesh.edges(e, 0))) / h;
      const bool cut =
          std::abs(along(0) - slope * along(1)) < 1e-13 && std::abs(std::abs(along(0)) - 1) < 1e-13;
      EXPECT_TRUE(cut || std::abs(along.cwiseAbs().sum() - 1) < 1e-13) << along;
    }
  }
}

TEST(Mesh, RefinedKeepsAreasTagsAndFathers) {
  for (const auto& [name, mesh] : test::two_square_meshes(3)) {
    const TriangleMesh fine = refined(mesh);
    ASSERT_EQ(fine.triangle_count(), 4 * mesh.triangle_count()) << name;
    for (int t = 0; t < fine.triangle_count(); ++t) {
      EXPECT_EQ(fine.region[t], mesh.region[t / 4]) << name;
      EXPECT_NEAR(fine.area(t), mesh.area(t / 4) / 4, 1e-15)
          << name;  // round-off of coordinates of size 1
    }
    for (const EdgeTag tag : {EdgeTag::sigma, EdgeTag::clamped, EdgeTag::contact})
      EXPECT_NEAR(length(fine, tag), length(mesh, tag), 1e-14) << name;
  }
  // the structured family is nested: the refined one is the next
  const TriangleMesh fine = refined(structured_mesh(4)), next = structured_mesh(8);
  EXPECT_EQ(fine.vertex_count(), next.vertex_count());
  EXPECT_EQ(fine.edge_count(), next.edge_count());
  EXPECT_NEAR(fine.diameter(), next.diameter(), 1e-15);
}

TEST(Mesh, JitterMovesTheInsideAloneAndTurnsNoTriangleOver) {
  const TriangleMesh straight = structured_mesh(16), moved = jittered_mesh(16, 0.2),
                     less = jittered_mesh(16, 0.1);
  EXPECT_EQ(jittered_mesh(16, 0).vertices, straight.vertices);
  EXPECT_LT((moved.vertices - straight.vertices - 2 * (less.vertices - straight.vertices)).norm(),
            1e-13);
  EXPECT_LE((moved.vertices - straight.vertices).cwiseAbs().maxCoeff(), 0.2 / 16);
  for (int t = 0; t < moved.triangle_count(); ++t) EXPECT_GT(moved.twice_area(t), 0);
  for (const EdgeTag tag : {EdgeTag::sigma, EdgeTag::clamped, EdgeTag::contact})
    EXPECT_EQ(length(moved, tag), length(straight, tag));
  expect_refused([] { jittered_mesh(4, 0.3); }, "jitter 0.3");
}

/// The layer's triangles: how many, and how many of them have a vertical edge.
std::array<int, 2> with_vertical_edge(const TriangleMesh& mesh) {
  std::array<int, 2> count{};
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] == Region::body) continue;
    const auto upright = [&](int i, int j) {  // gmsh places points to about 1e-12
      return std::abs(mesh.vertices(mesh.triangles(t, i), 0) -
                      mesh.vertices(mesh.triangles(t, j), 0)) < 1e-9;
    };
    ++count[0], count[1] += upright(0, 1) || upright(1, 2) || upright(2, 0);
  }
  return count;
}

TEST(Mesh, FamiliesAreWhatTheirNamesSay) {
  std::map<std::string, double> share;
  for (const int n : {1, 2, 7, 16})
    for (const MeshFamily& family : mesh_families()) {
      const TriangleMesh mesh = family.mesh(n);
      EXPECT_EQ(mesh.vertex_count() - mesh.edge_count() + mesh.triangle_count(), 1) << family.name;
      expect_two_squares(mesh, 1, 1e-12, family.name);
      EXPECT_LE(mesh.diameter(), 2.0 / n) << family.name;
      const auto [all, vertical] = with_vertical_edge(mesh);
      share[family.name] = static_cast<double>(vertical) / all;
    }
  for (const char* name : {"structured", "layered", "columns"}) EXPECT_EQ(share[name], 1) << name;
  // per row 2 n + 1 triangles, the two at its ends lean on the sides of the layer
  for (const char* name : {"rows", "staggered"}) EXPECT_DOUBLE_EQ(share[name], 2.0 / 33) << name;
  EXPECT_GT(share["unstructured"],
            2 * share["delaunay"]);  // Frontal-Delaunay begins at the boundary
  expect_refused([] { mesh_family("hexagons"); }, "accepted: structured, layered, columns");
  expect_refused([] { rows_mesh(0, 4); }, "accepted 1 to 2048");
}

TEST(Mesh, LatticesAreOfCongruentTriangles) {
  const double h = 1.0 / 8, height = 1.0 / 9;
  for (const TriangleMesh& mesh : {rows_mesh(8, 9), columns_mesh(8, 9)}) {
    int whole = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.region[t] == Region::body || mesh.area(t) < 0.4 * h * height)
        continue;  // half of one
      std::array<double, 3> length{};
      for (int i = 0; i < 3; ++i) length[i] = mesh.edge_length(mesh.triangle_edges(t, i));
      std::sort(length.begin(), length.end());
      EXPECT_NEAR(length[0], h, 1e-15);
      EXPECT_NEAR(length[2], std::hypot(h / 2, height), 1e-15);
      ++whole;
    }
    EXPECT_EQ(whole, 9 * 15);
  }
}

TEST(Mesh, RefusesRequestsOutOfRange) {
  for (const int cells : {0, -3, 2049})
    expect_refused([&] { structured_mesh(cells); }, "accepted 1 to 2048");
  for (const int cells : {0, -3, 513})
    expect_refused([&] { unstructured_mesh(cells); }, "accepted 1 to 512");
  for (const double depth : {-0.1, 1.1, nan}) {
    expect_refused([&] { structured_mesh(4, {depth}); }, "accepted 0 to 1");
    expect_refused([&] { unstructured_mesh(4, {depth}); }, "accepted 0 to 1");
  }
}

}  // namespace antilock::test::mesh_test::families_test
