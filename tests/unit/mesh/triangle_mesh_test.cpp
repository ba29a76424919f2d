// make_mesh lets nothing through that a finite element relies on and that is not so.
#include <set>

#include "antilock/mesh/labelled_edges.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"
#include "unit/mesh/helpers.hpp"

namespace antilock::test::mesh_test::triangle_mesh_test {

/// The arguments of make_mesh. By default they are two triangles on the unit square with contact
/// below.
struct Input {
  Points vertices{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  Triples triangles{{0, 1, 2}, {0, 2, 3}};
  std::vector<Region> region{Region::body, Region::body};
  std::vector<TaggedEdge> tagged{{0, 1, EdgeTag::contact},
                                 {1, 2, EdgeTag::clamped},
                                 {2, 3, EdgeTag::clamped},
                                 {3, 0, EdgeTag::clamped}};

  TriangleMesh make() const { return make_mesh(vertices, triangles, region, tagged, "input"); }
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

TEST(TriangleMesh, FindsAnEdgeByItsNumber) {
  const TriangleMesh mesh = Input{}.make();
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) EXPECT_EQ(local_edge(mesh, t, mesh.triangle_edges(t, i)), i);
  // two triangles with one edge in common: of the five edges each has three
  int refused = 0;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (!test::refusal([&] { local_edge(mesh, 0, e); }).empty()) ++refused;
  EXPECT_EQ(refused, 2);
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
    refused("tagged edge", [=](I& i) { i.tagged[2].vertices[1] = bad; });
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
  refused("two vertices share the place", [](I& i) {  // both faces in one named group
    i.add_vertex(1, 1), i.add_vertex(0, 0);
    i.triangles.row(1) << 5, 4, 3;
    i.tagged.push_back({0, 2, natural_group(0)}), i.tagged.push_back({5, 4, natural_group(0)});
  });
  refused("belongs to no triangle", [](I& i) { i.add_vertex(0.3, 0.4); });
  refused("hangs on the edge",
          [](I& i) {  // the lower triangle split at the middle of the diagonal, the upper one not
            i.add_vertex(0.5, 0.5), i.add_triangle(1, 2, 4);
            i.triangles.row(0) << 0, 1, 4;
          });
  refused("overlapping", [](I& i) {  // both on the right of the diagonal 0-2, each counterclockwise
    i.vertices.row(3) << 0.9, 0.5;
    i.triangles.row(1) << 0, 3, 2;
  });
  refused("three triangles share the edge",
          [](I& i) { i.add_vertex(0.9, 0.2), i.add_triangle(0, 4, 2); });
  refused("in no group", [](I& i) { i.tagged.erase(i.tagged.begin() + 2); });
  refused("no triangle is in the group body", [](I& i) { i.region.assign(2, Region::layer); });
}

// A thin triangle has a right angle. Its height is 1e-16 of its length.
TEST(TriangleMesh, TakesAThinTriangleAndNoFlatOne) {
  Input input;
  input.vertices.col(1) *= 1e-16;
  EXPECT_NO_THROW(input.make());
  input.vertices.row(2) << 2, 1e-16;  // the triangle 0, 1, 2 has the angles 0, 180 and 0 degrees
  input.refused("degenerate");
}

TEST(TriangleMesh, AcceptsACrackWhoseFacesAreInTwoNamedGroups) {
  Input input;
  input.add_vertex(1, 1), input.add_vertex(0, 0);
  input.triangles.row(1) << 5, 4, 3;
  input.tagged = {{0, 1, EdgeTag::contact}, {1, 2, EdgeTag::clamped}, {4, 3, EdgeTag::clamped},
                  {3, 5, EdgeTag::clamped}, {0, 2, natural_group(0)}, {5, 4, natural_group(1)}};
  EXPECT_EQ(input.make().edge_count(), 6);
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
  input.tagged.push_back(
      {1, 0, EdgeTag::clamped});  // contact already; the direction does not matter
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

// However many groups a scene has, the number of a group says nothing of its kind.
TEST(EdgeTag, ANamedGroupKeepsItsKindAndItsNumber) {
  for (int k = 0; k < 3000; ++k) {
    EXPECT_FALSE(is_dirichlet(natural_group(k))) << k;
    EXPECT_TRUE(is_dirichlet(dirichlet_group(k))) << k;
    EXPECT_EQ(natural_group(k).group, k);
    EXPECT_EQ(dirichlet_group(k).group, k);
  }
  EXPECT_TRUE(is_dirichlet(EdgeTag::clamped));
  EXPECT_FALSE(is_dirichlet(EdgeTag::free));
}

// Group k of a scene has Dirichlet data or none; in a file no two groups have one number.
TEST(EdgeTag, TheGroupsOfAFileHaveNumbersOfTheirOwn) {
  std::set<int> numbers{0};  // that of no group
  for (const EdgeTag tag : {EdgeTag::sigma, EdgeTag::clamped, EdgeTag::contact, EdgeTag::free})
    EXPECT_TRUE(numbers.insert(physical_number(tag)).second) << physical_number(tag);
  for (int k = 0; k < 3000; ++k) {
    const int number = physical_number(k % 4 == 0 ? dirichlet_group(k) : natural_group(k));
    EXPECT_TRUE(numbers.insert(number).second) << "group " << k << " has the number " << number;
  }
}

}  // namespace antilock::test::mesh_test::triangle_mesh_test
