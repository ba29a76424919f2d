// Files of gmsh, as they are written and broken.
#include <cstdlib>

#include "antilock/mesh/read_msh.hpp"
#include "support/measures.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"
#include "unit/mesh/helpers.hpp"

namespace antilock::test::mesh_test::read_msh_test {

// gmsh works for each of these tests, whatever tests/run keeps (mesh/unstructured.cpp)
[[maybe_unused]] const int nothing_kept = unsetenv("ANTILOCK_MESHES");

const std::string data = ANTILOCK_TEST_DATA;

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
    EXPECT_NEAR(test::area(mesh, Region::body), 1,
                1e-12);  // the sum of about 14 triangles of a unit square
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
  std::string text =
      with(square_22, "$Nodes\n", "$Comments\nanything $at all\n$EndComments\n\n$Nodes\n\n");
  std::string windows;
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(windows).triangles, read(square_22).triangles);
}

TEST(MshFile, SigmaMayBeLeftOutSinceItIsWhereBodyMeetsLayer) {
  const TriangleMesh whole = read_msh(data + "/two_squares_22.msh");
  std::string text =
      with(test::contents(data + "/two_squares_22.msh"), "5\n1 3 \"sigma\"\n", "4\n");
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
      {"no names", with(a, a.substr(a.find("$Phys"), a.find("$Nodes") - a.find("$Phys")), ""),
       "$PhysicalNames"},
      {"no nodes", with(a, a.substr(a.find("$Nodes"), a.find("$Elem") - a.find("$Nodes")), ""),
       "$Nodes"},
      {"no elements", a.substr(0, a.find("$Elements")), "$Elements"},
      {"no entities", with(b, b.substr(b.find("$Ent"), b.find("$Nodes") - b.find("$Ent")), ""),
       "$Entities"},
      {"nodes twice", a + a.substr(a.find("$Nodes"), a.find("$Elem") - a.find("$Nodes")), "second"},
      {"text between sections", with(a, "$Nodes", "stray\n$Nodes"), "outside"},
      {"section not closed", with(a, "$Nodes", "$Periodic\n0\n$Nodes"), "truncated"},
      {"cut within nodes", a.substr(0, a.find("3 1 1 0")), "truncated"},
      {"cut within a number", a.substr(0, a.find("6 2 2 1 1") + 9), "fields"},
      {"cut before the end", a.substr(0, a.find("$EndElements")), "truncated"},
      {"fewer nodes than declared", with(a, "$Nodes\n4", "$Nodes\n5"), "further"},
      {"more nodes than declared", with(a, "$Nodes\n4", "$Nodes\n3"), "are over"},
      {"a huge number of nodes", with(a, "$Nodes\n4", "$Nodes\n9000000000000000000"), "further"},
      {"a number beyond 64 bits", with(a, "$Nodes\n4", "$Nodes\n99999999999999999999"),
       "no integer"},
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
      {"a tetrahedron", with(a, "6 2 2 1 1 1 3 4", "6 4 2 1 1 1 2 3 4"),
       "unknown surface group \"body\""},
      {"a triangle of two nodes", with(a, "1 1 1 3 4", "1 1 1 3"), "fields"},
      {"a wrong count of tags", with(a, "6 2 2 1 1", "6 2 3 1 1"), "fields"},
      {"a huge count of tags", with(a, "6 2 2 1 1", "6 2 9223372036854775807 1 1"), "fields"},
      {"no group", with(a, "6 2 2 1 1", "6 2 2 0 1"), "no physical group"},
      {"no tags", with(a, "6 2 2 1 1", "6 2 0"), "no physical group"},
      {"a group without a name", with(a, "6 2 2 1 1", "6 2 2 8 1"), "group 8"},
      {"a curve's group on a triangle", with(a, "6 2 2 1 1", "6 2 2 4 1"), "group 4"},
      {"an unknown name", with(a, "\"body\"", "\"Body\""), "Body"},
      {"a name in the wrong dimension", with(a, "2 1 \"body\"", "1 1 \"body\""),
       "unknown curve group"},
      {"a name twice", with(a, "\"contact\"", "\"clamped\""), "twice"},
      {"a number with two names", with(a, "1 5 \"contact\"", "1 4 \"contact\""), "two names"},
      {"a name without quotes", with(a, "\"contact\"", "contact"), "must read"},
      {"a name cut off", with(a, "\"contact\"", "\"contact"), "must read"},
      {"a group that lost its name", with(with(a, "3\n1 4", "2\n1 4"), "1 5 \"contact\"\n", ""),
       "group 5"},
      {"an empty group", with(with(a, "3\n1 4", "4\n1 4"), "2 1", "2 2 \"layer\"\n2 1"),
       "is empty"},
      {"nothing in contact", with(a, "1 1 2 5 5", "1 1 2 4 4"), "\"contact\""},
      {"nothing clamped",
       with(with(with(a, "2 1 2 4", "2 1 2 5"), "3 1 2 4", "3 1 2 5"), "4 1 2 4", "4 1 2 5"),
       "\"clamped\""},
      {"a dimension of 4", with(a, "2 1 \"body\"", "4 1 \"body\""), "dimension 4"},
      {"an unknown entity", with(b, "2 1 2 2\n", "2 5 2 2\n"), "surface 5"},
      {"an entity without group", with(b, "1 0 0 0 1 1 0 1 1 2 8 9", "1 0 0 0 1 1 0 0 2 8 9"),
       "no physical group"},
      {"an entity in two groups", with(b, "8 0 0 0 1 0 0 1 5 0", "8 0 0 0 1 0 0 2 5 4 0"),
       "2 physical groups"},
      {"an entity twice", with(b, "9 0 0 0 1 1 0 1 4 0", "8 0 0 0 1 1 0 1 4 0"), "twice"},
      {"an entity cut off", with(b, "9 0 0 0 1 1 0 1 4 0", "9 0 0 0 1 1 0 1"), "line ends"},
      {"a huge count of entities", with(b, "1 2 1 0\n", "1 2 1 9000000000000000000\n"), "further"},
      {"a group out of range", with(b, "1 0 0 1 5 0", "1 0 0 1 -9223372036854775808 0"),
       "out of range"},
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
  for (const std::string& word :
       {long_word, std::string("\x1b[2J\x07\x01\xff"), std::string(1, '\0')}) {
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

}  // namespace antilock::test::mesh_test::read_msh_test
