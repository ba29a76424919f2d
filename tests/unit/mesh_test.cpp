#include <cstdlib>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/mesh/graded.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/msh_file.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "support/bodies.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace antilock::test::mesh_test {

int count(const TriangleMesh& mesh, EdgeTag tag) {
  return static_cast<int>(std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), tag));
}

// ==== make_triangle_mesh lets nothing through that a finite element relies on and that is not so.

/// What make_triangle_mesh is given; the default is two triangles on the unit square, contact below.
struct Input {
  Points vertices{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  Triples triangles{{0, 1, 2}, {0, 2, 3}};
  std::vector<Region> region{Region::body, Region::body};
  std::vector<TaggedEdge> tagged{
      {0, 1, EdgeTag::contact}, {1, 2, EdgeTag::clamped}, {2, 3, EdgeTag::clamped}, {3, 0, EdgeTag::clamped}};

  TriangleMesh make() const { return make_triangle_mesh(vertices, triangles, region, tagged, "input"); }
  void refused(const std::string& words) const {
    expect_refused([&] { make(); }, words);
    expect_refused([&] { make(); }, "input: ");  // every message says where
  }
  void add_vertex(double x, double y) {
    vertices.conservativeResize(vertices.rows() + 1, 2);
    vertices.bottomRows(1) << x, y;
  }
  void add_triangle(int a, int b, int c, Region where = Region::body) {
    triangles.conservativeResize(triangles.rows() + 1, 3);
    triangles.bottomRows(1) << a, b, c;
    region.push_back(where);
  }
};

TEST(TriangleMesh, TurnsASurfaceThatIsClockwiseAsAWhole) {
  Input input;
  input.triangles << 0, 2, 1, 0, 3, 2;
  const TriangleMesh mesh = input.make();
  for (int t = 0; t < 2; ++t) EXPECT_EQ(mesh.area(t), 0.5);
  // and one surface of two
  input = {};
  input.add_vertex(0, -1);
  input.add_vertex(1, -1);
  input.add_triangle(4, 1, 5, Region::layer);
  input.add_triangle(4, 0, 1, Region::layer);
  input.tagged = {{4, 5, EdgeTag::contact}, {1, 2, EdgeTag::clamped}, {2, 3, EdgeTag::clamped},
                  {3, 0, EdgeTag::clamped}, {0, 4, EdgeTag::clamped}, {1, 5, EdgeTag::clamped}};
  const TriangleMesh both = input.make();
  for (int t = 0; t < 4; ++t) EXPECT_EQ(both.area(t), 0.5);
  EXPECT_EQ(count(both, EdgeTag::sigma), 1);  // found without being tagged
}

TEST(TriangleMesh, RefusesWhatIsNoMesh) {
  using I = Input;
  const auto refused = [](const std::string& words, const std::function<void(I&)>& spoil) {
    Input input;
    spoil(input);
    input.refused(words);
  };
  for (const int bad : {-1, 4, 1000}) {
    refused("accepted 0 to 3", [=](I& i) { i.triangles(1, 1) = bad; });
    refused("tagged edge", [=](I& i) { i.tagged[2].to = bad; });
  }
  refused("not finite", [](I& i) { i.vertices(2, 1) = nan; });
  refused("not finite", [](I& i) { i.vertices(2, 1) = infinity; });
  refused("no triangles", [](I& i) { i.triangles.resize(0, 3), i.region.clear(); });
  refused("one region a triangle", [](I& i) { i.region.pop_back(); });
  refused("degenerate", [](I& i) { i.vertices.row(2) << 0.5, 0; });  // on the line of 0 and 1
  refused("degenerate", [](I& i) { i.vertices.row(2) << 0.5, 1e-16; });
  refused("degenerate", [](I& i) { i.triangles.row(1) << 0, 3, 3; });
  refused("inverted", [](I& i) { i.triangles.row(1) << 0, 3, 2; });
  refused("two vertices share the place", [](I& i) {  // a crack along the diagonal
    i.add_vertex(1, 1), i.add_vertex(0, 0);
    i.triangles.row(1) << 5, 4, 3;
    i.tagged[2] = {4, 3, EdgeTag::clamped}, i.tagged[3] = {3, 5, EdgeTag::clamped};
  });
  refused("belongs to no triangle", [](I& i) { i.add_vertex(0.3, 0.4); });
  refused("hangs on the edge", [](I& i) {  // the lower triangle split at the middle of the diagonal, the upper one not
    i.add_vertex(0.5, 0.5), i.add_triangle(1, 2, 4);
    i.triangles.row(0) << 0, 1, 4;
  });
  refused("overlapping", [](I& i) {  // both on the right of the diagonal 0-2, each counterclockwise
    i.vertices.row(3) << 0.9, 0.5;
    i.triangles.row(1) << 0, 3, 2;
  });
  refused("three triangles share the edge", [](I& i) { i.add_vertex(0.9, 0.2), i.add_triangle(0, 4, 2); });
  refused("in no group", [](I& i) { i.tagged.erase(i.tagged.begin() + 2); });
  refused("no triangle is in the group body", [](I& i) { i.region.assign(2, Region::layer); });
}

TEST(TriangleMesh, RefusesATaggedEdgeThatIsNoEdgeOrInTheWrongPlace) {
  Input input;
  input.tagged.push_back({1, 3, EdgeTag::clamped});  // the other diagonal
  input.refused("dangling or misplaced");
  input.tagged.back() = {0, 2, EdgeTag::clamped};  // an inner edge
  input.refused("dangling or misplaced");
  input.tagged.back() = {0, 2, EdgeTag::sigma};  // body on both sides
  input.refused("dangling or misplaced");
  input.tagged.back() = {0, 1, EdgeTag::sigma};  // the boundary
  input.refused("dangling or misplaced");
}

TEST(TriangleMesh, RefusesAnEdgeInTwoGroups) {
  Input input;
  input.tagged.push_back({1, 0, EdgeTag::clamped});  // contact already; the direction does not matter
  input.refused("two groups");
  input.tagged.back() = {1, 0, EdgeTag::contact};  // the same again is no contradiction
  EXPECT_NO_THROW(input.make());
}

TEST(TriangleMesh, RefusesAPieceThatNothingHolds) {
  Input input;
  input.add_vertex(2, 0);
  input.add_vertex(3, 0);
  input.add_vertex(2, 1);
  input.add_triangle(4, 5, 6);
  for (const auto& [a, b] : {std::pair{4, 5}, std::pair{5, 6}, std::pair{6, 4}})
    input.tagged.push_back({a, b, EdgeTag::contact});
  input.refused("no clamped edge holds its piece");
  input.tagged.back().tag = EdgeTag::clamped;
  EXPECT_NO_THROW(input.make());
  input = {};
  for (TaggedEdge& edge : input.tagged) edge.tag = EdgeTag::contact;
  input.refused("clamped, which is needed");
}

// ==== Invariants of the meshes of Figures 3 and 6, and of their variants.

// gmsh works for each of these tests, whatever tests/run keeps (mesh/unstructured.cpp)
[[maybe_unused]] const int nothing_kept = unsetenv("ANTILOCK_MESHES");

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

/// The unit square and the layer of `depth` below it, with their tagged sides, which are fewer terms than the areas.
void expect_two_squares(const TriangleMesh& mesh, double depth, double within, const std::string& name) {
  EXPECT_NEAR(area(mesh, Region::body), 1, within) << name;
  EXPECT_NEAR(area(mesh, Region::layer), depth, within) << name;
  EXPECT_NEAR(length(mesh, EdgeTag::contact), 1, within / 10) << name;
  EXPECT_NEAR(length(mesh, EdgeTag::sigma), depth > 0 ? 1 : 0, within / 10) << name;
  EXPECT_NEAR(length(mesh, EdgeTag::clamped), 3 + 2 * depth, within / 10) << name;
}

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
      ASSERT_EQ(mesh.region[t], mesh.vertices.col(1)(mesh.triangles.row(t)).sum() > 0 ? Region::body : Region::layer)
          << name;
    for (int e = 0; e < mesh.edge_count(); ++e) {
      const auto a = mesh.vertices.row(mesh.edges(e, 0)), b = mesh.vertices.row(mesh.edges(e, 1));
      const auto both_on = [&](int axis, double value) { return a(axis) == value && b(axis) == value; };
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
      ASSERT_TRUE(seen.insert({mesh.edges(e, 0), mesh.edges(e, 1)}).second) << name << ": an edge twice";
    }
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (int i = 0; i < 3; ++i) {
        const int e = mesh.triangle_edges(t, i);  // lies opposite vertex i
        const auto [low, high] = std::minmax(mesh.triangles(t, (i + 1) % 3), mesh.triangles(t, (i + 2) % 3));
        ASSERT_EQ(mesh.edges(e, 0), low) << name;
        ASSERT_EQ(mesh.edges(e, 1), high) << name;
        ASSERT_TRUE(mesh.edge_triangles(e, 0) == t || mesh.edge_triangles(e, 1) == t) << name;
      }
  }
}

TEST(Mesh, HIsTheRequestedOne) {
  for (const int cells : {1, 5, 16}) {
    EXPECT_NEAR(structured_mesh(cells).diameter(), std::sqrt(2.0) / cells, 1e-15);
    // gmsh keeps edges near the size asked for: never twice it, and about 2 to 2.6 cells^2 triangles a square
    const TriangleMesh mesh = unstructured_mesh(cells);
    EXPECT_LT(mesh.diameter(), 2.0 / cells);
    EXPECT_GE(mesh.diameter(), (1 - 1e-14) / cells);  // gmsh puts that edge on the boundary
  }
}

TEST(Mesh, AThinLayerIsTwoCellsDeepAtLeast) {
  for (const TriangleMesh& mesh : {structured_mesh(8, {0.01}), unstructured_mesh(8, {0.01})}) {
    EXPECT_EQ(mesh.vertices.col(1).minCoeff(), -0.01);
    bool inside = false;
    for (int v = 0; v < mesh.vertex_count(); ++v) inside |= mesh.vertices(v, 1) < 0 && mesh.vertices(v, 1) > -0.01;
    EXPECT_TRUE(inside) << "no vertex inside the layer";
  }
}

/// The smallest and the largest angle, in degrees.
std::pair<double, double> angles(const TriangleMesh& mesh) {
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

// The limit: gmsh itself makes the mesh of 128 cells; beyond, a coarser one is refined. Frontal-Delaunay: 41 degrees measured
// at 1/64.
TEST(Mesh, UnstructuredIsWellShapedAndOfTheHAskedForBeyondGmshsLimitToo) {
  for (const auto& [cells, depth] : {std::pair{32, 1.0}, {129, 0.0}, {200, 0.0}, {161, 1.0}, {512, 0.0}, {150, 0.01}}) {
    const std::string name = fmt::format("{} cells, depth {}", cells, depth);
    const TriangleMesh mesh = unstructured_mesh(cells, {depth});
    EXPECT_GT(angles(mesh).first, depth == 0.01 ? 20 : 30) << name;
    expect_two_squares(mesh, depth, 1e-11, name);
    EXPECT_EQ(depth_of(mesh), depth) << name;
    // h: on the top side, whose edges gmsh makes equal, as asked or the least that whole numbers allow
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

void expect_same(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_TRUE(a.vertices == b.vertices && a.triangles == b.triangles && a.edges == b.edges);
  EXPECT_TRUE(a.region == b.region && a.edge_tag == b.edge_tag);
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
    if (other.path() != first) fs::copy_file(first, other.path(), fs::copy_options::overwrite_existing);
  expect_same(unstructured_mesh(5, {0.1}), twelve);
  // what is cut, longer or empty is made anew
  for (const auto size : std::initializer_list<std::uintmax_t>{whole - 1, whole + 1, whole / 2, 24, 0}) {
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
      const Eigen::RowVector2d along = (mesh.vertices.row(mesh.edges(e, 1)) - mesh.vertices.row(mesh.edges(e, 0))) / h;
      const bool cut = std::abs(along(0) - slope * along(1)) < 1e-13 && std::abs(std::abs(along(0)) - 1) < 1e-13;
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
      EXPECT_NEAR(fine.area(t), mesh.area(t / 4) / 4, 1e-15) << name;  // round-off of coordinates of size 1
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
  const TriangleMesh straight = structured_mesh(16), moved = jittered_mesh(16, 0.2), less = jittered_mesh(16, 0.1);
  EXPECT_EQ(jittered_mesh(16, 0).vertices, straight.vertices);
  EXPECT_LT((moved.vertices - straight.vertices - 2 * (less.vertices - straight.vertices)).norm(), 1e-13);
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
      return std::abs(mesh.vertices(mesh.triangles(t, i), 0) - mesh.vertices(mesh.triangles(t, j), 0)) < 1e-9;
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
  EXPECT_GT(share["unstructured"], 2 * share["delaunay"]);  // Frontal-Delaunay begins at the boundary
  expect_refused([] { mesh_family("hexagons"); }, "accepted: structured, layered, columns");
  expect_refused([] { rows_mesh(0, 4); }, "accepted 1 to 2048");
}

TEST(Mesh, LatticesAreOfCongruentTriangles) {
  const double h = 1.0 / 8, height = 1.0 / 9;
  for (const TriangleMesh& mesh : {rows_mesh(8, 9), columns_mesh(8, 9)}) {
    int whole = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.region[t] == Region::body || mesh.area(t) < 0.4 * h * height) continue;  // half of one
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
  for (const int cells : {0, -3, 2049}) expect_refused([&] { structured_mesh(cells); }, "accepted 1 to 2048");
  for (const int cells : {0, -3, 513}) expect_refused([&] { unstructured_mesh(cells); }, "accepted 1 to 512");
  for (const double depth : {-0.1, 1.1, nan}) {
    expect_refused([&] { structured_mesh(4, {depth}); }, "accepted 0 to 1");
    expect_refused([&] { unstructured_mesh(4, {depth}); }, "accepted 0 to 1");
  }
}

// ==== The disc of the plate.

TEST(DiscMesh, IsADiscOfGoodTriangles) {
  for (const int n : {1, 2, 7, 20}) {
    const TriangleMesh mesh = disc_mesh(n);
    EXPECT_EQ(mesh.triangle_count(), 6 * n * n);
    EXPECT_EQ(mesh.vertex_count(), 3 * n * n + 3 * n + 1);
    // the polygon of 6 n corners
    EXPECT_NEAR(area(mesh, Region::body), 3 * n * std::sin(std::numbers::pi / (3 * n)), 1e-12);
    EXPECT_LT(angles(mesh).second, 95) << n;
    for (int e = 0; e < mesh.edge_count(); ++e)
      EXPECT_EQ(mesh.edge_tag[e] == EdgeTag::clamped, mesh.edge_triangles(e, 1) < 0);
  }
  EXPECT_THROW(disc_mesh(0), Error);
}

// ==== Graded lines and tensor meshes, and what they are for: degrees on them.

/// The x of all vertices, ascending.
std::vector<double> lines_in_x(const TriangleMesh& mesh) {
  const std::set<double> x(mesh.vertices.col(0).begin(), mesh.vertices.col(0).end());
  return {x.begin(), x.end()};
}

TEST(GradedMesh, KeepsTheEndsAndThePointBetweenCellsOfTheWidth) {
  for (const double at : {0.3, 0.7})
    for (const int layers : {0, 1, 7}) {
      const std::vector<double> x = lines_in_x(graded_mesh(at, 0.25, layers, 0.25, 1));
      EXPECT_EQ(x.front(), 0);
      EXPECT_EQ(x.back(), 1);
      EXPECT_EQ(std::count(x.begin(), x.end(), at), 1);
      for (std::size_t i = 1; i < x.size(); ++i) EXPECT_LE(x[i] - x[i - 1], 0.25 * (1 + 1e-14));
      EXPECT_EQ(x.size(), 1 + 5 + 2 * static_cast<std::size_t>(layers));
    }
}

TEST(GradedMesh, EachLayerLeavesItsShareNextToThePoint) {
  const std::vector<double> x = lines_in_x(graded_mesh(0.5, 0.5, 4, 0.2, 1));  // one cell on each side, cut 4 times
  ASSERT_EQ(x.size(), 11u);
  for (int k = 0; k <= 4; ++k) {
    EXPECT_NEAR(x[10 - k] - 0.5, 0.5 * std::pow(0.2, k), 1e-15);
    EXPECT_NEAR(0.5 - x[k], 0.5 * std::pow(0.2, k), 1e-15);
  }
}

TEST(TensorMesh, OfEqualLinesIsTheStructuredMesh) {
  for (const Diagonal diagonal : {Diagonal::right, Diagonal::left, Diagonal::crossed})
    expect_same(tensor_mesh({0, 0.25, 0.5, 0.75, 1}, {-1, -0.75, -0.5, -0.25, 0, 0.25, 0.5, 0.75, 1}, diagonal),
                structured_mesh(4, {}, diagonal));
}

TEST(GradedMesh, FillsTheTwoSquaresWithTaggedSides) {
  for (const double epsilon : {1.0, 0.1, 1e-20, 0.0}) {
    const TriangleMesh mesh = graded_mesh(0.7, 1.0 / 3, 6, 0.25, epsilon);
    for (int t = 0; t < mesh.triangle_count(); ++t) ASSERT_GT(mesh.area(t), 0);
    expect_two_squares(mesh, 1, 1e-12, std::to_string(epsilon));
  }
}

// Layers wider than epsilon have rows above Sigma, the others above Gamma_C: at epsilon = 1 all of them there, at 0 none.
TEST(GradedMesh, PutsARowWhereALayerIsFelt) {
  const auto lowest = [](const TriangleMesh& mesh, double above) {  // the height of the first row above a line
    double least = 1;
    for (int v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.vertices(v, 1) > above) least = std::min(least, mesh.vertices(v, 1) - above);
    return least;
  };
  for (const auto& [epsilon, in_body] : {std::pair{1.0, 0}, {0.1, 2}, {1e-2, 4}, {1e-6, 6}, {0.0, 6}}) {
    const TriangleMesh mesh = graded_mesh(0.5, 0.5, 6, 0.25, epsilon);
    EXPECT_NEAR(lowest(mesh, 0), 0.5 * std::pow(0.25, in_body), 1e-15) << epsilon;
    EXPECT_NEAR(lowest(mesh, -1), 0.5 * std::pow(0.25, 6 - in_body), 1e-15) << epsilon;
  }
}

// Columns, however narrow: G_h on the layer is every function of x, n p - 1 of them, for every degree.
TEST(GradedMesh, LeavesNoDegreeLocked) {
  const TriangleMesh mesh = graded_mesh(0.5, 0.5, 2, 0.25, 0.1);  // 6 columns
  for (int degree = 1; degree <= 6; ++degree) {
    const Space space(mesh, lagrange(degree));
    const VariationalInequality problem = test::stiff_problem(space, 0);
    EXPECT_EQ(layer_kernel_dimension(problem), 6 * degree - 1) << degree;
  }
}

TEST(GradedMesh, RefusesWhatHasNoMesh) {
  EXPECT_THROW(tensor_mesh({0}, {0, 1}), Error);
  EXPECT_THROW(tensor_mesh({0, 1, 1}, {0, 1}), Error);
  EXPECT_THROW(tensor_mesh({0, 1}, {-1, 1}), Error);  // no line y = 0
  EXPECT_THROW(tensor_mesh({0, 1}, {-1, 0}), Error);  // no body
  EXPECT_THROW(tensor_mesh({0, 1}, {0, NAN}), Error);
  EXPECT_THROW(graded_mesh(0, 0.1, 1, 0.5, 1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, 1, 0.5, -1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, 1, 0.5, 2), Error);
  EXPECT_THROW(graded_mesh(0.5, 0, 1, 0.5, 1), Error);
  EXPECT_THROW(graded_mesh(0.5, NAN, 1, 0.5, 1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, -1, 0.5, 1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, 61, 0.5, 1), Error);
  EXPECT_THROW(graded_mesh(0.5, 0.1, 1, 1, 1), Error);
}

// ==== The layer in columns under any body: its shape, its tags, and what it does to P1.

struct Case {
  std::string name;
  TriangleMesh body;
  double body_area, outline, sigma;  ///< outline: the clamped length of the body
  int feet;                          ///< intervals of Sigma
};
std::vector<Case> bodies() {
  return {{"square", unstructured_mesh(8, {0}), 1, 3, 1, 1},
          {"L", test::l_shape(8), 0.75, 3, 1, 1},
          {"two feet", test::bridge(8), 0.75, 4.5, 0.5, 2}};
}

TEST(ExtrudedLayer, FillsTheLayerUnderSigmaAndNothingElse) {
  for (const Case& c : bodies())
    for (const double epsilon : {1.0, 0.3, 0.0}) {
      const TriangleMesh mesh = extruded(c.body, epsilon);
      EXPECT_EQ(mesh.vertices.topRows(c.body.vertex_count()), c.body.vertices) << "first, and in its order";
      EXPECT_EQ(mesh.triangles.topRows(c.body.triangle_count()), c.body.triangles);
      EXPECT_NEAR(area(mesh, Region::body), c.body_area, 1e-12) << c.name;
      EXPECT_NEAR(area(mesh, Region::layer), c.sigma, 1e-12) << c.name;
      EXPECT_NEAR(length(mesh, EdgeTag::sigma), c.sigma, 1e-12) << c.name;
      EXPECT_NEAR(length(mesh, EdgeTag::contact), c.sigma, 1e-12) << c.name;
      EXPECT_NEAR(length(mesh, EdgeTag::clamped), c.outline + 2 * c.feet, 1e-12) << c.name;  // sides of depth 1
      for (int e = 0; e < mesh.edge_count(); ++e) {
        if (mesh.edge_tag[e] != EdgeTag::contact) continue;
        for (const int v : {mesh.edges(e, 0), mesh.edges(e, 1)}) EXPECT_EQ(mesh.vertices(v, 1), -1) << c.name;
      }
    }
}

TEST(ExtrudedLayer, HasCellsThatAreSquareInTheTrueLayer) {
  const TriangleMesh body = structured_mesh(8, {0});
  for (const auto& [epsilon, rows] : {std::pair{1.0, 8}, {0.5, 4}, {0.51, 5}, {0.125, 1}, {1e-6, 1}, {0.0, 1}}) {
    const TriangleMesh mesh = extruded(body, epsilon);
    EXPECT_EQ(mesh.triangle_count(), body.triangle_count() + 2 * 8 * rows) << epsilon;
    EXPECT_EQ(mesh.vertex_count(), body.vertex_count() + 9 * rows) << epsilon;
  }
  EXPECT_EQ(extruded(structured_mesh(100, {0}), 0.07).vertex_count(), 101 * 108)
      << "0.07 * 100 > 7 in double precision";
}

TEST(ExtrudedLayer, OfAStructuredBodyIsFigureThree) {
  const TriangleMesh mesh = extruded(structured_mesh(5, {0}), 1), figure = structured_mesh(5);
  EXPECT_EQ(mesh.vertex_count(), figure.vertex_count());
  EXPECT_EQ(mesh.edge_count(), figure.edge_count());
  // the same P1 problem in another order: the same energy to round-off
  const auto least = [](const TriangleMesh& m) {
    const Space space(m, p1());
    const auto problem = test::stiff_problem(space, 1e-2);
    return energy(problem, active_set(problem));
  };
  EXPECT_NEAR(least(mesh), least(figure), 1e-10);
}

// B v = 0 on every triangle of a column makes v equal at all its vertices: one function per column that is free.
TEST(ExtrudedLayer, LeavesP1OneFunctionInTheKernelPerInteriorColumn) {
  for (const Case& c : bodies())
    for (const double epsilon : {1.0, 0.0}) {
      const TriangleMesh mesh = extruded(c.body, epsilon);
      const Space space(mesh, p1());
      const int interior = count(mesh, EdgeTag::sigma) - c.feet;
      EXPECT_EQ(layer_kernel_dimension(test::stiff_problem(space, 0)), interior) << c.name << epsilon;
    }
}

/// Half of the ring between r = 1 and `held`, 2 or 1/2, its bottom Sigma = Gamma_C at r = 1; free on y = 0, held at the
/// other radius.
TriangleMesh half_ring(int cells, double held) {
  TriangleMesh mesh = structured_mesh(cells, {0});
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::clamped)
      mesh.edge_tag[e] = mesh.vertices(mesh.edges.row(e), 1).minCoeff() == 1 ? held_group(1) : natural_group(0);
  for (auto row : mesh.vertices.rowwise()) {
    const double r = 1 + (held - 1) * row(1), angle = std::numbers::pi * (held > 1 ? 1 - row(0) : 1 + row(0));
    row << r * std::cos(angle), r * std::sin(angle);
  }
  return mesh;
}

// u = x at the held radius gives u = (a r + b / r) cos in the ring and (c r + d / r) cos in a layer of thickness t and
// modulus s / t, natural at its far side r = rho: c = d / rho^2, a + b = c + d, a - b = (s / t) (c - d). Of order h^2, as the
// polygon is: with J left out the error stays at 2 % and more.
TEST(ExtrudedLayer, AlongNormalsIsTheLayerOfARing) {
  const double t = 0.3, s = 0.5;
  const auto zero = [](double, double) { return 0.0; };
  const std::vector<EdgeCondition> edges{
      {"sides"}, {"held", EdgeCondition::Kind::displacement, [](double x, double) { return x; }}};
  for (const double held : {2.0, 0.5})
    for (const Element* element : {&p1(), &crouzeix_raviart(), &p2()}) {
      const double rho = held > 1 ? 1 - t : 1 + t, w = 1 / (rho * rho);
      double a = (1 + w) + s / t * (w - 1), b = (1 + w) - s / t * (w - 1), scale = held / (a * held + b / held);
      a *= scale, b *= scale;
      std::vector<double> errors;
      for (const int cells : {8, 16, 32}) {
        const TriangleMesh mesh = extruded(half_ring(cells, held), t, true);
        const Space space(mesh, *element);
        const Solution u = active_set(assemble(Scene(Body{zero}, StiffLayer{t, s}, {}, edges), space));
        double error = 0;
        for (int k = 0; k < mesh.triangle_count(); ++k)
          for (const int i : space.unknowns().row(k)) {
            const Eigen::RowVector2d x = space.points().row(i);
            const double r = x.norm();
            if (mesh.region[k] == Region::body) error = std::max(error, std::abs(u.u(i) - (a + b / (r * r)) * x(0)));
          }
        for (const int i : space.contact()) {
          const Eigen::RowVector2d foot = space.points().row(i) + Eigen::RowVector2d(0, 1);
          error = std::max(error, std::abs(u.u(i) - scale * (2 * w * rho + 2 / rho) * foot(0) / foot.norm()));
        }
        errors.push_back(error);
      }
      EXPECT_LT(errors[2], 4e-3) << element->name() << held;
      EXPECT_GT(errors[1], 3.3 * errors[2]) << element->name() << held;
    }
}

TEST(ExtrudedLayer, AlongNormalsIsRefusedWhereThereIsNoSuchLayer) {
  TriangleMesh ring = half_ring(8, 2), turned = ring;
  expect_refused([&] { extruded(ring, 1, true); }, "meets itself");
  TriangleMesh slot = test::cut_out(8, [](double x, double y) { return y < 0.25 || y > 0.5 || x < 0.25; });
  for (int e = 0; e < slot.edge_count(); ++e)
    if (slot.edge_triangles(e, 1) < 0 && (slot.vertices(slot.edges.row(e), 1).array() == 0.5).all())
      slot.edge_tag[e] = EdgeTag::contact;
  expect_refused([&] { extruded(slot, 0.1, true); }, "every x once");
  turned.vertices = -ring.vertices;
  expect_refused([&] { extruded(turned, 0.1, true); }, "the body is not above its contact edge");
  expect_refused([&] { extruded(ring, 0.1); }, "on the line y = 0");
  for (EdgeTag& tag : ring.edge_tag)
    if (tag == natural_group(0)) tag = held_group(0);
  expect_refused([&] { extruded(ring, 0.1, true); }, "a displacement is given at");
  const TriangleMesh grown = extruded(half_ring(8, 2), 0.1, true);
  const Space space(grown, p1());
  const Scene scene(Body{paper_load}, StiffLayer{0.1}, UnilateralContact{[](double) { return 1.0; }},
                    {{"in"}, {"out", EdgeCondition::Kind::displacement, [](double, double) { return 0; }}});
  expect_refused([&] { SceneSweep(scene, space).set_epsilon(0.2); }, "along normals");
  expect_refused([&] { solve_to(scene, grown, {0.1}); }, "along the normals");
  TriangleMesh forgotten = grown;
  forgotten.bend.clear();
  expect_refused([&] { assemble(scene, Space(forgotten, p1())); }, "Sigma on the line y = 0");
}

TEST(ExtrudedLayer, RefusesWhatItCannotStandUnder) {
  const TriangleMesh body = structured_mesh(4, {0});
  for (const double epsilon : {-1e-9, 1.5, nan})
    expect_refused([&] { extruded(body, epsilon); }, "accepted 0 <= epsilon <= 1");
  TriangleMesh lifted = body, clamped = body, low = unstructured_mesh(4, {0});
  lifted.vertices.col(1).array() += 0.5;
  expect_refused([&] { extruded(lifted, 1); }, "on the line y = 0");
  std::fill(clamped.edge_tag.begin(), clamped.edge_tag.end(), EdgeTag::clamped);
  expect_refused([&] { extruded(clamped, 1); }, "no edge in the group");
  low.vertices(low.vertex_count() - 1, 1) = -0.1;
  expect_refused([&] { extruded(low, 1); }, "above y = 0");
  expect_refused([] { extruded(structured_mesh(4), 1); }, "has a layer");
  expect_refused([] { layered_mesh(0); }, "cells = 0");
}

// ==== Files of gmsh, as they are written and broken.

const std::string data = ANTILOCK_TEST_DATA;

/// The text with its first `what` replaced; fails the test where there is none.
std::string with(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, text.npos) << what;
  return at == text.npos ? text : text.replace(at, what.size(), by);
}

TriangleMesh read(const std::string& text) {
  std::istringstream in(text);
  return read_msh(in, "test.msh");
}

/// The message that a broken file is refused with; empty where it is taken.
std::string refused(const std::string& text) {
  return test::refusal([&] { read(text); });
}

// A unit square of two triangles, by hand.
const std::string groups = R"( 0 8
$EndMeshFormat
$PhysicalNames
3
1 4 "clamped"
1 5 "contact"
2 1 "body"
$EndPhysicalNames
)";
const std::string square_22 = "$MeshFormat\n2.2" + groups + R"($Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
6
1 1 2 5 5 1 2
2 1 2 4 4 2 3
3 1 2 4 4 3 4
4 1 2 4 4 4 1
5 2 2 1 1 1 2 3
6 2 2 1 1 1 3 4
$EndElements
)";
const std::string square_41 = "$MeshFormat\n4.1" + groups + R"($Entities
1 2 1 0
7 0 0 0 0
8 0 0 0 1 0 0 1 5 0
9 0 0 0 1 1 0 1 4 0
1 0 0 0 1 1 0 1 1 2 8 9
$EndEntities
$Nodes
2 4 1 4
1 8 0 2
1
2
0 0 0
1 0 0
1 9 1 2
3
4
1 1 0 0.5
0 1 0 0.7
$EndNodes
$Elements
4 7 1 7
0 7 15 1
7 1
1 8 1 1
1 1 2
1 9 1 3
2 2 3
3 3 4
4 4 1
2 1 2 2
5 1 2 3
6 1 3 4
$EndElements
)";

TEST(MshFile, BothVersionsOfGmshsOwnFilesGiveTheDomainOfFigure2) {
  for (const char* file : {"/two_squares_22.msh", "/two_squares_41.msh"}) {
    const TriangleMesh mesh = read_msh(data + file);
    EXPECT_EQ(mesh.vertex_count(), 21) << file;
    EXPECT_NEAR(test::area(mesh, Region::body), 1, 1e-12);  // the sum of about 14 triangles of a unit square
    EXPECT_NEAR(test::area(mesh, Region::layer), 1, 1e-12);
    EXPECT_EQ(count(mesh, EdgeTag::sigma), 2);  // h = 1/2: two edges a side
    EXPECT_EQ(count(mesh, EdgeTag::contact), 2);
    EXPECT_EQ(count(mesh, EdgeTag::clamped), 10);
  }
  expect_same(read_msh(data + "/two_squares_22.msh"), read_msh(data + "/two_squares_41.msh"));
}

TEST(MshFile, HandWrittenSquaresAreTakenInBothVersions) {
  for (const std::string& text : {square_22, square_41}) {
    const TriangleMesh mesh = read(text);
    EXPECT_EQ(mesh.triangle_count(), 2);
    EXPECT_EQ(mesh.edge_count(), 5);
    EXPECT_EQ(count(mesh, EdgeTag::clamped), 3);
    EXPECT_EQ(count(mesh, EdgeTag::contact), 1);
    EXPECT_DOUBLE_EQ(test::area(mesh, Region::body), 1);
  }
}

TEST(MshFile, SparseNodeTagsAndAnyOrderOfSectionsAreTaken) {
  std::string text = with(square_22, "3 1 1 0\n", "900000000000 1 1 0\n");
  text = with(text, "4 4 2 3\n", "4 4 2 900000000000\n");
  text = with(text, "4 4 3 4\n", "4 4 900000000000 4\n");
  text = with(text, "1 2 3\n", "1 2 900000000000\n");
  text = with(text, "1 1 3 4\n", "1 1 900000000000 4\n");
  const std::size_t nodes = text.find("$Nodes"), elements = text.find("$Elements");
  const std::string late = text.substr(nodes, elements - nodes);
  EXPECT_EQ(read(text.erase(nodes, elements - nodes) + late).vertices, read(square_22).vertices);
}

TEST(MshFile, CommentsBlankLinesAndWindowsLineEndsAreTaken) {
  std::string text = with(square_22, "$Nodes\n", "$Comments\nanything $at all\n$EndComments\n\n$Nodes\n\n");
  std::string windows;
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(windows).triangles, read(square_22).triangles);
}

TEST(MshFile, SigmaMayBeLeftOutSinceItIsWhereBodyMeetsLayer) {
  const TriangleMesh whole = read_msh(data + "/two_squares_22.msh");
  std::string text = with(test::contents(data + "/two_squares_22.msh"), "5\n1 3 \"sigma\"\n", "4\n");
  const std::size_t elements = text.find("$Elements\n") + 10;
  std::istringstream records(text.substr(elements));
  std::string kept, line;
  int dropped = 0, declared = 0;
  records >> declared >> std::ws;
  while (std::getline(records, line)) {
    if (line.find(" 1 2 3 ") != line.npos)
      ++dropped;
    else
      kept += line + '\n';
  }
  ASSERT_EQ(dropped, 2);
  text = text.substr(0, elements) + std::to_string(declared - dropped) + '\n' + kept;
  EXPECT_EQ(read(text).edge_tag, whole.edge_tag);
}

struct Broken {
  std::string name, text, says;  // what the message must hold
};

std::vector<Broken> broken_files() {
  const std::string &a = square_22, &b = square_41;
  return {
      {"empty", "", "empty"},
      {"only blank lines", "\n\n \n", "no MSH file"},
      {"another kind of file", "solid cube\nfacet\n", "$MeshFormat"},
      {"version 2.1", with(a, "2.2 0 8", "2.1 0 8"), "2.1"},
      {"version 4.0", with(b, "4.1 0 8", "4 0 8"), "4.1"},
      {"binary", with(a, "2.2 0 8", "2.2 1 8"), "binary"},
      {"format line cut", with(a, "2.2 0 8", "2.2"), "line 2"},
      {"no names", with(a, a.substr(a.find("$Phys"), a.find("$Nodes") - a.find("$Phys")), ""), "$PhysicalNames"},
      {"no nodes", with(a, a.substr(a.find("$Nodes"), a.find("$Elem") - a.find("$Nodes")), ""), "$Nodes"},
      {"no elements", a.substr(0, a.find("$Elements")), "$Elements"},
      {"no entities", with(b, b.substr(b.find("$Ent"), b.find("$Nodes") - b.find("$Ent")), ""), "$Entities"},
      {"nodes twice", a + a.substr(a.find("$Nodes"), a.find("$Elem") - a.find("$Nodes")), "second"},
      {"text between sections", with(a, "$Nodes", "stray\n$Nodes"), "outside"},
      {"section not closed", with(a, "$Nodes", "$Periodic\n0\n$Nodes"), "truncated"},
      {"cut within nodes", a.substr(0, a.find("3 1 1 0")), "truncated"},
      {"cut within a number", a.substr(0, a.find("6 2 2 1 1") + 9), "fields"},
      {"cut before the end", a.substr(0, a.find("$EndElements")), "truncated"},
      {"fewer nodes than declared", with(a, "$Nodes\n4", "$Nodes\n5"), "further"},
      {"more nodes than declared", with(a, "$Nodes\n4", "$Nodes\n3"), "are over"},
      {"a huge number of nodes", with(a, "$Nodes\n4", "$Nodes\n9000000000000000000"), "further"},
      {"a number beyond 64 bits", with(a, "$Nodes\n4", "$Nodes\n99999999999999999999"), "no integer"},
      {"a negative count", with(a, "$Nodes\n4", "$Nodes\n-4"), "no count"},
      {"a count with a fraction", with(a, "$Nodes\n4", "$Nodes\n4.0"), "no integer"},
      {"fewer elements than declared", with(a, "$Elements\n6", "$Elements\n7"), "further"},
      {"more elements than declared", with(a, "$Elements\n6", "$Elements\n5"), "are over"},
      {"a huge number of elements", with(a, "$Elements\n6", "$Elements\n4000000000"), "further"},
      {"a node without y", with(a, "3 1 1 0", "3 1 1"), "3 fields"},
      {"NaN", with(a, "3 1 1 0", "3 1 nan 0"), "nan"},
      {"infinity", with(a, "3 1 1 0", "3 1 -inf 0"), "inf"},
      {"too large for a double", with(a, "3 1 1 0", "3 1 1e999 0"), "1e999"},
      {"a word for a coordinate", with(a, "3 1 1 0", "3 1 one 0"), "one"},
      {"a decimal comma", with(a, "3 1 1 0", "3 1 1,0 0"), "1,0"},
      {"out of the plane", with(a, "3 1 1 0", "3 1 1 0.25"), "z = "},
      {"node tag zero", with(a, "3 1 1 0", "0 1 1 0"), "node tag 0"},
      {"node tag twice", with(a, "3 1 1 0", "2 1 1 0"), "twice"},
      {"unknown node", with(a, "1 1 1 3 4", "1 1 1 3 40"), "node 40"},
      {"element number twice", with(a, "6 2 2 1 1", "5 2 2 1 1"), "twice"},
      {"a quadrangle", with(a, "6 2 2 1 1 1 3 4", "6 3 2 1 1 1 2 3 4"), "type 3"},
      {"a quadratic triangle", with(a, "6 2 2 1 1 1 3 4", "6 9 2 1 1 1 3 4 1 2 3"), "type 9"},
      {"a tetrahedron", with(a, "6 2 2 1 1 1 3 4", "6 4 2 1 1 1 2 3 4"), "type 4"},
      {"a triangle of two nodes", with(a, "1 1 1 3 4", "1 1 1 3"), "fields"},
      {"a wrong count of tags", with(a, "6 2 2 1 1", "6 2 3 1 1"), "fields"},
      {"a huge count of tags", with(a, "6 2 2 1 1", "6 2 9223372036854775807 1 1"), "fields"},
      {"no group", with(a, "6 2 2 1 1", "6 2 2 0 1"), "no physical group"},
      {"no tags", with(a, "6 2 2 1 1", "6 2 0"), "no physical group"},
      {"a group without a name", with(a, "6 2 2 1 1", "6 2 2 8 1"), "group 8"},
      {"a curve's group on a triangle", with(a, "6 2 2 1 1", "6 2 2 4 1"), "group 4"},
      {"an unknown name", with(a, "\"body\"", "\"Body\""), "Body"},
      {"a name in the wrong dimension", with(a, "2 1 \"body\"", "1 1 \"body\""), "unknown curve group"},
      {"a name twice", with(a, "\"contact\"", "\"clamped\""), "twice"},
      {"a number with two names", with(a, "1 5 \"contact\"", "1 4 \"contact\""), "two names"},
      {"a name without quotes", with(a, "\"contact\"", "contact"), "must read"},
      {"a name cut off", with(a, "\"contact\"", "\"contact"), "must read"},
      {"a group that lost its name", with(with(a, "3\n1 4", "2\n1 4"), "1 5 \"contact\"\n", ""), "group 5"},
      {"an empty group", with(with(a, "3\n1 4", "4\n1 4"), "2 1", "2 2 \"layer\"\n2 1"), "is empty"},
      {"nothing in contact", with(a, "1 1 2 5 5", "1 1 2 4 4"), "\"contact\""},
      {"nothing clamped", with(with(with(a, "2 1 2 4", "2 1 2 5"), "3 1 2 4", "3 1 2 5"), "4 1 2 4", "4 1 2 5"),
       "\"clamped\""},
      {"a dimension of 4", with(a, "2 1 \"body\"", "4 1 \"body\""), "dimension 4"},
      {"an unknown entity", with(b, "2 1 2 2\n", "2 5 2 2\n"), "surface 5"},
      {"an entity without group", with(b, "1 0 0 0 1 1 0 1 1 2 8 9", "1 0 0 0 1 1 0 0 2 8 9"), "no physical group"},
      {"an entity in two groups", with(b, "8 0 0 0 1 0 0 1 5 0", "8 0 0 0 1 0 0 2 5 4 0"), "2 physical groups"},
      {"an entity twice", with(b, "9 0 0 0 1 1 0 1 4 0", "8 0 0 0 1 1 0 1 4 0"), "twice"},
      {"an entity cut off", with(b, "9 0 0 0 1 1 0 1 4 0", "9 0 0 0 1 1 0 1"), "line ends"},
      {"a huge count of entities", with(b, "1 2 1 0\n", "1 2 1 9000000000000000000\n"), "further"},
      {"a group out of range", with(b, "1 0 0 1 5 0", "1 0 0 1 -9223372036854775808 0"), "out of range"},
      {"a total that lies (nodes)", with(b, "2 4 1 4", "2 5 1 4"), "declares 5"},
      {"a total that lies (elements)", with(b, "4 7 1 7", "4 6 1 7"), "declares 6"},
      {"a block that lies", with(b, "2 1 2 2\n", "2 1 2 3\n"), "further"},
      {"a huge block", with(b, "1 8 0 2\n", "1 8 0 9000000000000000000\n"), "accepted: 1"},
      {"a missing block", with(b, "2 4 1 4", "3 4 1 4"), "further"},
      {"a type that does not fit its block", with(b, "2 1 2 2\n", "1 8 2 2\n"), "dimension"},
      {"parameters missing", with(b, "1 1 0 0.5", "1 1 0"), "3 fields"},
      {"a partitioned mesh", with(b, "$Entities", "$PartitionedEntities\n$Entities"), "partition"},
      {"the same triangle twice", with(a, "6 2 2 1 1 1 3 4", "6 2 2 1 1 1 2 3"), "test.msh"},
  };
}

TEST(MshFile, EveryBrokenFileIsRefusedInOneLineThatNamesTheFileAndTheFault) {
  for (const Broken& file : broken_files()) {
    const std::string message = refused(file.text);
    EXPECT_NE(message, "") << file.name << " was taken";
    EXPECT_EQ(message.rfind("test.msh: ", 0), 0U) << file.name << ": " << message;
    EXPECT_EQ(message.find('\n'), message.npos) << file.name << ": " << message;
    EXPECT_LT(message.size(), 250U) << file.name << ": " << message;
    EXPECT_NE(message.find(file.says), message.npos) << file.name << ": " << message;
  }
}

TEST(MshFile, AFileCutAnywhereIsRefused) {
  for (const std::string& text : {square_22, square_41})
    for (std::size_t length = 0; length + 1 < text.size(); ++length)
      EXPECT_NE(refused(text.substr(0, length)), "") << "cut after " << length << " characters";
}

TEST(MshFile, HostileTextStaysOneShortPrintableLine) {
  const std::string long_word(100000, 'x');
  for (const std::string& word : {long_word, std::string("\x1b[2J\x07\x01\xff"), std::string(1, '\0')}) {
    const std::string message = refused(with(square_22, "3 1 1 0", "3 1 " + word + " 0"));
    EXPECT_LT(message.size(), 250U);
    EXPECT_GT(message.size(), 10U);
    for (const char c : message) EXPECT_TRUE(c >= ' ' && c <= '~');
  }
}

TEST(MshFile, PathsThatAreNoFileAreRefused) {
  for (const std::string& path : {data + "/no such file.msh", data}) {
    const std::string message = test::refusal([&] { read_msh(path); });
    EXPECT_TRUE(message.starts_with(path + ": ")) << message;
  }
}

}  // namespace antilock::test::mesh_test
