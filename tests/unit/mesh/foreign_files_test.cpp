// Files as other programs write them: what is meant is read, and what cannot be read is named. The
// comment of each test has the public report that the case was made from, by repository and number;
// nothing was copied.
#include "antilock/core/number.hpp"
#include "antilock/core/plain_text.hpp"
#include "antilock/mesh/read_msh.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"
#include "unit/mesh/helpers.hpp"

namespace antilock::test::mesh_test::foreign_files_test {

void refused(const std::string& text, const std::string& words) {
  expect_refused([&] { read(text); }, words);
}

// Two surfaces of two triangles each, side by side in the group body: (0, 1) x (0, 1) and (1, 2) x
// (0, 1).
const std::string start = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 4 "clamped"
1 5 "contact"
2 1 "body"
$EndPhysicalNames
)";
const std::string nodes_22 = R"($Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 2 1 0
5 1 1 0
6 0 1 0
$EndNodes
)";
const std::string lines_22 = R"($Elements
10
1 1 2 5 1 1 2
2 1 2 5 2 2 3
3 1 2 4 3 3 4
4 1 2 4 4 4 5
5 1 2 4 5 5 6
6 1 2 4 6 6 1
)";
const std::string left = "7 2 2 1 1 1 2 5\n8 2 2 1 1 1 5 6\n";
const std::string right = "9 2 2 1 2 2 3 4\n10 2 2 1 2 2 4 5\n",
                  right_clockwise = "9 2 2 1 2 2 4 3\n10 2 2 1 2 2 5 4\n";
const std::string end = "$EndElements\n";
const std::string two_surfaces = start + nodes_22 + lines_22 + left + right + end;

const std::string two_surfaces_41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
1 4 "clamped"
1 5 "contact"
2 1 "body"
$EndPhysicalNames
$Entities
1 2 2 0
1 0 0 5 1 9
1 0 0 0 2 0 0 1 5 0
2 0 0 0 2 1 0 1 4 0
1 0 0 0 1 1 0 1 1 0
2 1 0 0 2 1 0 1 1 0
$EndEntities
$Nodes
2 7 1 7
0 1 0 1
7
0 0 5
2 1 0 6
1
2
3
4
5
6
0 0 0
1 0 0
2 0 0
2 1 0
1 1 0
0 1 0
$EndNodes
$Elements
5 11 1 11
0 1 15 1
11 7
1 1 1 2
1 1 2
2 2 3
1 2 1 4
3 3 4
4 4 5
5 5 6
6 6 1
2 1 2 2
7 1 2 5
8 1 5 6
2 2 2 2
9 2 3 4
10 2 4 5
$EndElements
)";

void expect_the_same_mesh(const TriangleMesh& mesh) {
  const TriangleMesh wanted = read(two_surfaces);
  EXPECT_EQ(mesh.vertices, wanted.vertices);
  EXPECT_EQ(mesh.edges, wanted.edges);
  EXPECT_EQ(mesh.edge_tag, wanted.edge_tag);
  for (int t = 0; t < mesh.triangle_count(); ++t) EXPECT_EQ(mesh.area(t), 0.5) << t;
}

// deal.II #13579 and #13346, FerriteGmsh #15 and #57: gmsh meshes a surface clockwise whose curve
// loop is drawn so. Each surface is turned by itself; a triangle that is inverted within one is an
// error, still.
TEST(ForeignMesh, EachSurfaceMayBeClockwise) {
  expect_the_same_mesh(read(start + nodes_22 + lines_22 + left + right_clockwise + end));
  const std::string turned =
      with(with(two_surfaces_41, "9 2 3 4", "9 2 4 3"), "10 2 4 5", "10 2 5 4");
  expect_the_same_mesh(read(turned));
  refused(with(two_surfaces, "9 2 2 1 2 2 3 4", "9 2 2 1 2 2 4 3"), "inverted triangle");
  refused(with(two_surfaces_41, "9 2 3 4", "9 2 4 3"), "inverted triangle");
}

// The same reports: the first tag alone, as some converters write it, or 0 for the entity. The
// group is the surface then.
TEST(ForeignMesh, AGroupIsTheSurfaceWhereNoneIsNamed) {
  std::string one_tag = two_surfaces;
  for (const char* element : {"7 2 ", "8 2 ", "9 2 ", "10 2 "})
    for (const char* tags : {"2 1 1 ", "2 1 2 "})
      if (const std::string old = std::string(element) + tags;
          one_tag.find("\n" + old) != one_tag.npos)
        one_tag = with(one_tag, "\n" + old, "\n" + std::string(element) + "1 1 ");
  EXPECT_EQ(one_tag.find("2 2 1 2 2 3 4"), one_tag.npos);
  expect_the_same_mesh(read(one_tag));
  refused(with(one_tag, "9 2 1 1 2 3 4", "9 2 1 1 2 4 3"), "inverted triangle");
}

// A relative of FerriteGmsh #57: Physical Surface("body") = {1, -2} turns a surface by the sign of
// its group.
TEST(ForeignMesh, ANegativeGroupIsTheGroup) {
  expect_the_same_mesh(
      read(start + nodes_22 + lines_22 + left + "9 2 2 -1 2 2 4 3\n10 2 2 -1 2 2 5 4\n" + end));
  expect_the_same_mesh(read(with(two_surfaces_41, "2 1 0 0 2 1 0 1 1 0", "2 1 0 0 2 1 0 1 -1 0")));
}

// ElmerFEM #671, meshio #993, Kratos #432: a node that no element needs, as the
// centre of a circle, which may be a physical point and off the plane.
TEST(ForeignMesh, ANodeOfNoTriangleIsLeftOut) {
  expect_the_same_mesh(read(two_surfaces_41));  // node 7 at (0, 0, 5)
  const std::string more =
      with(with(two_surfaces, "$Nodes\n6\n", "$Nodes\n8\n10 1 0.5 0\n"), "6 0 1 0\n",
           "6 0 1 0\n900 1 0 -3\n");  // in the place of another one, but for z
  expect_the_same_mesh(read(more));
  const std::string as_point =
      with(with(more, "$Elements\n10\n", "$Elements\n11\n"), end, "11 15 2 7 1 900\n" + end);
  expect_the_same_mesh(read(as_point));
  // a line that needs it is wrong, and so is a triangle out of the plane
  refused(with(with(more, "$Elements\n10\n", "$Elements\n11\n"), end, "11 1 2 4 9 10 5\n" + end),
          "dangling");
  refused(with(two_surfaces, "4 2 1 0\n", "4 2 1 -3\n"), "line 15: node 4 has z = -3");
}

// meshio #1411: Mesh.SaveParametric puts the parameters of each node behind it.
TEST(ForeignMesh, ParametricNodesAreNodes) {
  const std::string parametric = R"($ParametricNodes
6
1 0 0 0 0 1
2 1 0 0 1 1 0.5
3 2 0 0 0 2
4 2 1 0 0 3
5 1 1 0 2 1 0.25 0.75
6 0 1 0 0 4
$EndParametricNodes
)";
  expect_the_same_mesh(read(with(two_surfaces, nodes_22, parametric)));
  refused(with(two_surfaces, nodes_22, nodes_22 + parametric), "a second");
  refused(with(two_surfaces, nodes_22, with(parametric, "1 0 0 0 0 1", "1 0 0 0")),
          "$ParametricNodes; accepted: 6 to 8");
  refused(with(two_surfaces, nodes_22, with(parametric, "$EndParametricNodes", "$EndNodes")),
          "$EndParametricNodes");
}

// A relative of meshio #1411: a file that holds results beside the mesh has a section for each of
// their steps.
TEST(ForeignMesh, SectionsThatAMeshDoesNotNeedArePassedOver) {
  const std::string step = "$NodeData\n1\n\"u\"\n1\n0.5\n3\n0\n1\n1\n1 2.5\n$EndNodeData\n";
  const std::string more =
      "$Periodic\n1\n1 2 1\n1\n1 "
      "2\n$EndPeriodic\n$InterpolationScheme\n\"x\"\n0\n$EndInterpolationScheme\n";
  expect_the_same_mesh(read("$Comments\nmade by hand\n$EndComments\n" +
                            with(two_surfaces, "$Nodes\n", more + "$Nodes\n") + step + step));
  expect_the_same_mesh(read(two_surfaces_41 + step + step));
  refused(with(two_surfaces_41, "$Entities",
               "$PartitionedEntities\n2\n$EndPartitionedEntities\n$Entities"),
          "partition");
}

// A relative of meshio #993: with gmsh's option Mesh.SaveAll, the usual answer to a mesh without
// some elements, lines within the body come in no group. A side in no group is refused, still, and
// so is a triangle.
TEST(ForeignMesh, LinesInNoGroupArePassedOver) {
  const std::string more =
      with(with(two_surfaces, "$Elements\n10\n", "$Elements\n11\n"), end, "11 1 2 0 7 2 5\n" + end);
  expect_the_same_mesh(read(more));
  refused(with(two_surfaces, "4 1 2 4 4 4 5", "4 1 2 0 4 4 5"),
          "the boundary edge from (2, 1) to (1, 1) is in no group");
  refused(with(two_surfaces, "9 2 2 1 2", "9 2 2 0 2"), "element 9 is in no physical group");
}

// dolfinx #3332 and MTEX2Gmsh #7: in MSH 2.2 a surface in two groups comes twice. "Three triangles
// share the edge", it was said.
TEST(ForeignMesh, ATriangleTwiceIsNamedWithBothGroups) {
  const std::string more = with(with(two_surfaces, "$Elements\n10\n", "$Elements\n11\n"),
                                "2 1 \"body\"\n", "2 1 \"body\"\n2 3 \"layer\"\n");
  const std::string three_names = with(more, "$PhysicalNames\n3\n", "$PhysicalNames\n4\n");
  refused(with(three_names, end, "11 2 2 3 1 6 5 1\n" + end),
          "element 11, in the group \"layer\", is the same triangle as element 8, in the group "
          "\"body\"; accepted: each "
          "triangle once, in one group");
}

// PyFR #381 and pygmsh #410: a curve and a surface may have one name, as they may have one number.
TEST(ForeignMesh, ACurveAndASurfaceMayHaveOneName) {
  const auto named = [](const std::string& curve, const std::string& surface) {
    return with(with(two_surfaces, "1 4 \"clamped\"", "1 4 \"" + curve + "\""), "2 1 \"body\"",
                "2 1 \"" + surface + "\"");
  };
  const auto read_with = [&](const std::string& text, const ExtraGroups& groups) {
    std::istringstream in(text);
    std::vector<int> part;
    const TriangleMesh mesh = read_msh(in, "test.msh", groups, &part);
    EXPECT_EQ(part, std::vector<int>(4, 0));
    return mesh;
  };
  const ExtraGroups steel{{{"steel", dirichlet_group(0)}}, {"steel"}},
      curve{{{"steel", dirichlet_group(0)}}, {}};
  const TriangleMesh mesh = read_with(named("steel", "steel"), steel);
  EXPECT_EQ(mesh.vertices, read(two_surfaces).vertices);
  EXPECT_EQ(std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), dirichlet_group(0)), 4);
  expect_refused([&] { read_with(named("clamped", "steel"), steel); },
                 "has no curve in the group \"steel\"");
  expect_refused([&] { read_with(named("steel", "body"), steel); },
                 "has no surface in the group \"steel\"");
  expect_refused([&] { read_with(named("steel", "steel"), curve); },
                 "unknown surface group \"steel\"");
  refused(with(two_surfaces, "1 5 \"contact\"", "1 5 \"clamped\""),
          "the curve group \"clamped\" is named twice");
}

// scnlib #77: what a printf with "%+e" and Fortran's SP write is a number. BALL #166 and
// ifcplusplus #225: a comma for the point and Fortran's D are none.
TEST(ForeignMesh, APlusSignIsPartOfANumber) {
  const std::string signs = with(with(two_surfaces, "4 2 1 0\n", "+4 +2.0e+00 +1.E0 -0\n"),
                                 "$Nodes\n6\n", "$Nodes\n+6\n");
  expect_the_same_mesh(read(signs));
  for (const char* bad : {"1,0", "0.1D+01", "+-1", "++1", "+", "0x1p0", "1e", "1.0f", "+nan"})
    refused(with(two_surfaces, "4 2 1 0\n", "4 2 " + std::string(bad) + " 0\n"),
            "line 15: \"" + std::string(bad) + "\" is no coordinate");
}

// numpy #18861: a byte order mark before the first character. Its relatives: the end of lines and
// blanks of Windows, numbers behind tabs, and a file in UTF-16, as Windows' PowerShell writes what
// is redirected.
TEST(ForeignMesh, EncodingsAreReadOrNamed) {
  expect_the_same_mesh(read("\xef\xbb\xbf" + two_surfaces));
  std::string windows;
  for (const char c : two_surfaces)
    windows += c == '\n' ? " \r\n" : c == ' ' ? "\t" : std::string(1, c);
  expect_the_same_mesh(read(windows));
  std::string wide;
  for (const char c : two_surfaces) wide += {c, '\0'};
  refused("\xff\xfe" + wide, "is text in UTF-16 or UTF-32; accepted: UTF-8");
  refused(wide, "UTF-16");
  refused(std::string(1, '\0') + wide, "UTF-16");
  refused("\xef\xbb\xbf", "is empty");
}

// feelpp #1198, moose #5249: a mesh of any size and at any place; what is flat is so beside its
// size.
TEST(ForeignMesh, IsFlatBesideItsOwnSize) {
  const auto scaled = [](double k, const std::string& z) {
    std::string text = two_surfaces;
    const auto node = [&](int tag, double x, double y) {
      text = with(text, fmt::format("\n{} {:g} {:g} 0\n", tag, x, y),
                  fmt::format("\n{} {} {} {}\n", tag, k * x, k * y, z));
    };
    node(1, 0, 0), node(2, 1, 0), node(3, 2, 0), node(4, 2, 1), node(5, 1, 1), node(6, 0, 1);
    return text;
  };
  for (const double k : {1e-9, 1e-5, 1e9}) {
    const TriangleMesh mesh = read(scaled(k, "0"));
    EXPECT_DOUBLE_EQ(body_size(mesh), 2 * k);
    EXPECT_NEAR(test::area(mesh, Region::body), 2 * k * k, 1e-15 * k * k);
    EXPECT_NO_THROW(read(scaled(k, fmt::format("{}", 1e-13 * k))));  // round-off of a generator
    refused(scaled(k, fmt::format("{}", 1e-6 * k)), "z = ");
  }
}

// meshio #281, elmerfem #923, meshlab #1582: a name can be read in a message.
TEST(ForeignNames, AreShownAsTheyAre) {
  for (const std::string name :
       {"rechte Fläche (oben)", "上面", "Ω", "🙂", "naïve \"quoted\" name"})
    EXPECT_EQ(printable(name), name);
  EXPECT_EQ(printable("上面", 1), "上...");
  EXPECT_EQ(printable("上面", 2), "上面");
  EXPECT_EQ(first_character("上面"), "上");
  EXPECT_EQ(first_character("x"), "x");
  EXPECT_EQ(first_character(""), "");
  EXPECT_EQ(first_character("\xe4\xb8"), "\xe4");
}

TEST(ForeignNames, ChangeNeitherTheLineNorTheTerminal) {
  EXPECT_EQ(printable("a\nb\tc\x1b[2J\x7f"), "a?b?c?[2J?");
  EXPECT_EQ(printable("\xff\xfe\xe4\xb8"), "????");  // bytes that are no UTF-8
  EXPECT_EQ(printable("Fl\xe4"
                      "che"),
            "Fl?che");                                    // Latin-1
  EXPECT_EQ(printable("\xc0\x8a\xe0\x80\x8a"), "?????");  // a line feed in more bytes than it needs
  EXPECT_EQ(printable("\xed\xa0\x80\xf4\x90\x80\x80"),
            "???????");  // half of a pair of UTF-16, beyond Unicode
  EXPECT_EQ(printable("\xc2\x9b|\xe2\x80\xa8|\xe2\x80\xae"),
            "?|?|?");  // CSI, line separator, right to left
  EXPECT_EQ(printable("\xef\xbb\xbfx"), "?x");
  refused(with(two_surfaces, "\"body\"", "\"corps élastique\""),
          "unknown surface group \"corps élastique\"");
}

TEST(ReadNumber, TakesAllOfATextOrLeavesTheValue) {
  double value = 7;
  for (const auto& [text, number] :
       {std::pair("1", 1.0), {"+1.5", 1.5}, {"-2.5E-01", -0.25}, {".5", 0.5}, {"1.", 1.0}}) {
    EXPECT_TRUE(read_number(text, value)) << text;
    EXPECT_EQ(value, number);
  }
  for (const char* text : {"", "+", "-", "1 ", " 1", "1x", "1,5", "1e999", "--1"}) {
    EXPECT_FALSE(read_number(text, value)) << text;
    EXPECT_EQ(value, 1) << text;
  }
}

}  // namespace antilock::test::mesh_test::foreign_files_test
