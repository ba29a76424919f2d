// Every scene that cannot be asked: exit status 2, one line on standard error that names file and
// key, nothing written.
#include "antilock/runner/scene_mesh.hpp"

#include <sys/stat.h>
#include <sys/wait.h>

#include "antilock/runner/solve_scene.hpp"
#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::bad_scenes_test {

struct BadScene {
  std::string name;  ///< of the test
  std::string key;   ///< that the message must name
  std::string scene;
};

// Google Test asks for a function of this name
void PrintTo(const BadScene& bad, std::ostream* out) {
  *out << bad.name;
}  // NOLINT(readability-identifier-naming)

const std::string load = "[load]\nf = \"1\"\n", mesh = "[mesh]\nkind = \"structured\"\ncells = 8\n";

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}
std::string with_load(const std::string& f) { return "[load]\nf = " + f + "\n" + mesh; }
std::string with_layer(const std::string& lines) {
  return load + "[layer]\n" + lines + "\n" + mesh;
}
std::string with_contact(const std::string& lines) {
  return load + "[contact]\n" + lines + "\n" + mesh;
}
std::string with_mesh(const std::string& lines) { return load + "[mesh]\n" + lines + "\n"; }
std::string with_method(const std::string& lines) {
  return load + mesh + "[method]\n" + lines + "\n";
}

const std::vector<BadScene> bad_scenes = {
    // the file
    {"Empty", "load", ""},
    {"OnlyAComment", "load", "# nothing\n"},
    {"SyntaxNoValue", "syntax", "[load]\nf =\n"},
    {"SyntaxUnclosedQuote", "syntax", "[load]\nf = \"1\n" + mesh},
    {"SyntaxKeyTwice", "syntax", "[load]\nf = \"1\"\nf = \"2\"\n" + mesh},
    {"SyntaxSectionTwice", "syntax", load + mesh + "[mesh]\n"},
    {"SyntaxBinary", "syntax",
     std::string("\x7f"
                 "ELF\0\1\2",
                 7)},
    {"SyntaxInvalidUtf8", "syntax", "title = \"\xff\xfe\"\n" + load + mesh},
    {"SyntaxJson", "syntax", "{\"load\": {\"f\": \"1\"}}"},
    {"SyntaxTildeInAHeader", "syntax",
     "[~load]\nf = \"1\"\n"},  // found by the fuzzer: an assertion of toml++ built for debugging
    {"SyntaxKeyOfManyParts", "syntax", "a" + repeated(".a", 200000) + " = 1\n" + load + mesh},
    {"SyntaxKeyOfManyQuotedParts", "syntax",
     "\"a\"" + repeated(" . 'a'", 65) + " = 1\n" + load + mesh},
    {"SyntaxHeaderOfManyParts", "syntax", load + mesh + "[a" + repeated(".a", 200000) + "]\n"},
    {"SyntaxDeepArray", "syntax",
     "a = " + repeated("[", 65) + repeated("]", 65) + "\n" + load + mesh},
    {"SyntaxDeepTable", "syntax",
     "a = " + repeated("{a=", 65) + "1" + repeated("}", 65) + "\n" + load + mesh},
    {"LargerThanAMegabyte", "file", "#" + std::string(1100000, 'x')},
    // sections
    {"NoLoad", "load", mesh},
    {"NoMesh", "mesh", load},
    {"UnknownSection", "solver", load + mesh + "[solver]\nname = \"x\"\n"},
    {"UnknownTopKey", "epsilon", "epsilon = 1\n" + load + mesh},
    {"SectionInCapitals", "Load", "[Load]\nf = \"1\"\n" + mesh},
    {"SectionIsAValue", "load", "load = \"1\"\n" + mesh},
    {"SectionIsAList", "load", "[[load]]\nf = \"1\"\n" + mesh},
    {"TitleIsANumber", "title", "title = 3\n" + load + mesh},
    {"UnknownLoadKey", "load.g", "[load]\nf = \"1\"\ng = \"2\"\n" + mesh},
    {"UnknownKeyWithLineEnd", "load.a?b", "[load]\nf = \"1\"\n\"a\\nb\" = 1\n" + mesh},
    // the load
    {"LoadMissing", "load.f", "[load]\n" + mesh},
    {"LoadIsANumber", "load.f", with_load("1")},
    {"LoadIsAList", "load.f", with_load("[\"1\"]")},
    {"LoadEmpty", "load.f", with_load("\"\"")},
    {"LoadBlank", "load.f", with_load("\"  \"")},
    {"LoadDoesNotParse", "load.f", with_load("\"10*sin(2*pi*x\"")},
    {"LoadTwoOperators", "load.f", with_load("\"1 * / x\"")},
    {"LoadImplicitProduct", "load.f", with_load("\"2x\"")},
    {"LoadUnknownVariable", "load.f", with_load("\"x + z\"")},
    {"LoadUnknownFunction", "load.f", with_load("\"foo(x)\"")},
    {"LoadForeignConstant", "load.f", with_load("\"_pi * x\"")},
    {"LoadAssignment", "load.f", with_load("\"x = 3\"")},
    {"LoadTwoValues", "load.f", with_load("\"x, y\"")},
    {"LoadText", "load.f", with_load("'\"abc\"'")},
    {"LoadHalfACondition", "load.f", with_load("\"x < 0.5 ? 1\"")},
    {"LoadOfTwoLines", "load.f", with_load("\"\"\"x +\n* y\"\"\"")},
    {"LoadInfiniteInside", "load.f", with_load("\"1/(x - 0.3)\"")},
    {"LoadInfiniteOnTheEdge", "load.f", with_load("\"1/x\"")},
    {"LoadInfiniteInACorner", "load.f", with_load("\"1/((1-x)^2 + (1-y)^2)\"")},
    {"LoadInfiniteOnALine", "load.f", with_load("\"1/(x - y)\"")},
    {"LoadNotReal", "load.f", with_load("\"sqrt(x - 0.5)\"")},
    {"LoadLogarithmOfZero", "load.f", with_load("\"log(y)\"")},
    {"LoadNoNumberUnderMax", "load.f", with_load("\"max(0, log(x - 0.5))\"")},
    {"LoadOverflows", "load.f", with_load("\"exp(1000*x)\"")},
    {"LoadHuge", "load.f", with_load("\"1e200\"")},
    {"LoadDividesByZero", "load.f", with_load("\"1/0\"")},
    // the layer
    {"LayerEmpty", "layer.epsilon", with_layer("")},
    {"EpsilonNegative", "layer.epsilon", with_layer("epsilon = -1e-6")},
    {"EpsilonAboveOne", "layer.epsilon", with_layer("epsilon = 1.5")},
    {"EpsilonText", "layer.epsilon", with_layer("epsilon = \"1e-6\"")},
    {"EpsilonBoolean", "layer.epsilon", with_layer("epsilon = true")},
    {"EpsilonNan", "layer.epsilon", with_layer("epsilon = nan")},
    {"EpsilonInfinite", "layer.epsilon", with_layer("epsilon = inf")},
    {"ModelUnknown", "layer.model", with_layer("epsilon = 1\nmodel = \"rigid\"")},
    {"ModelInCapitals", "layer.model", with_layer("epsilon = 1\nmodel = \"Scaled\"")},
    {"ModelANumber", "layer.model", with_layer("epsilon = 1\nmodel = 1")},
    {"VentcelNotTheLimit", "layer.epsilon", with_layer("epsilon = 1e-6\nmodel = \"ventcel\"")},
    {"ThinRigid", "layer.epsilon", with_layer("epsilon = 0\nmodel = \"thin\"")},
    {"ThinTooThin", "layer.epsilon", with_layer("epsilon = 1e-4\nmodel = \"thin\"")},
    {"LayerUnknownKey", "layer.depth", with_layer("epsilon = 1\ndepth = 1")},
    // contact
    {"GapANumber", "contact.gap", with_contact("gap = 0")},
    {"GapDependsOnY", "contact.gap", with_contact("gap = \"y\"")},
    {"GapEmpty", "contact.gap", with_contact("gap = \"\"")},
    {"GapNotFinite", "contact.gap", with_contact("gap = \"1/(x - 0.5)\"")},
    {"GapNotRealAtTheEnd", "contact.gap", with_contact("gap = \"log(x)\"")},
    {"GapAgainstTheClamp", "contact.gap", with_contact("gap = \"-0.1\"")},
    {"CeilingAgainstTheClamp", "contact.ceiling", with_contact("ceiling = \"-0.1\"")},
    {"GapUnknownKey", "contact.friction", with_contact("friction = 0.3")},
    // the mesh
    {"MeshEmpty", "mesh.kind", with_mesh("")},
    {"KindUnknown", "mesh.kind", with_mesh("kind = \"hexagonal\"\ncells = 8")},
    {"CellsMissing", "mesh.cells", with_mesh("kind = \"structured\"")},
    {"CellsZero", "mesh.cells", with_mesh("kind = \"structured\"\ncells = 0")},
    {"CellsNegative", "mesh.cells", with_mesh("kind = \"structured\"\ncells = -4")},
    {"CellsReal", "mesh.cells", with_mesh("kind = \"structured\"\ncells = 8.0")},
    {"CellsText", "mesh.cells", with_mesh("kind = \"structured\"\ncells = \"8\"")},
    {"CellsTooManyStructured", "mesh.cells", with_mesh("kind = \"structured\"\ncells = 2049")},
    {"CellsTooManyUnstructured", "mesh.cells", with_mesh("kind = \"unstructured\"\ncells = 513")},
    {"RefinementsZero", "mesh.refinements",
     with_mesh("kind = \"structured\"\ncells = 8\nrefinements = 0")},
    {"RefinementsReal", "mesh.refinements",
     with_mesh("kind = \"structured\"\ncells = 8\nrefinements = 1.5")},
    {"RefinementsTooMany", "mesh.refinements",
     with_mesh("kind = \"structured\"\ncells = 512\nrefinements = 3")},
    {"CellsOverflow", "mesh.cells", with_mesh("kind = \"structured\"\ncells = 4294967304")},
    {"CellsTooFewToMoveAnything", "mesh", with_mesh("kind = \"structured\"\ncells = 1")},
    {"FileWithStructured", "mesh.file",
     with_mesh("kind = \"structured\"\ncells = 8\nfile = \"my.msh\"")},
    {"CellsWithFile", "mesh.cells", with_mesh("kind = \"file\"\ncells = 8\nfile = \"my.msh\"")},
    {"FileMissing", "mesh.file", with_mesh("kind = \"file\"")},
    {"FileEmptyName", "mesh.file", with_mesh("kind = \"file\"\nfile = \"\"")},
    {"FileNotThere", "mesh.file", with_mesh("kind = \"file\"\nfile = \"not_there.msh\"")},
    {"FileIsAFolder", "mesh.file", with_mesh("kind = \"file\"\nfile = \".\"")},
    {"FileIsNoMesh", "mesh.file", with_mesh("kind = \"file\"\nfile = \"scene.toml\"")},
    {"MeshUnknownKey", "mesh.size", with_mesh("kind = \"structured\"\ncells = 8\nsize = 0.1")},
    // the method
    {"ElementUnknown", "method.element", with_method("element = \"P7\"")},
    {"LayerTwoWays", "layer.epsilon", with_layer("epsilon = 0.1\nthickness = 0.1")},
    {"LayerThicknessAlone", "layer.stiffness", with_layer("thickness = 0.1")},
    {"LayerThicknessZero", "layer.thickness", with_layer("thickness = 0\nstiffness = 1")},
    {"LayerStiffnessNegative", "layer.stiffness", with_layer("thickness = 0.1\nstiffness = -1")},
    {"LayerLoadOnVentcel", "layer.load",
     with_layer("epsilon = 0\nmodel = \"ventcel\"\nload = \"1\"")},
    {"CeilingIsANumber", "contact.ceiling", with_contact("ceiling = 1")},
    {"EdgesWithoutAFile", "edge", load + mesh + "[[edge]]\ngroup = \"top\"\nfree = true\n"},
    {"EdgeIsASection", "edge", load + mesh + "[edge]\ngroup = \"top\"\n"},
    {"BodyGroupsWithoutAFile", "body", load + mesh + "[body]\nstiffness = { left = 1 }\n"},
    {"AccuracyOfAVaryingStiffness", "method.accuracy",
     with_method("accuracy = 0.1") + "[body]\nstiffness = \"1 + x\"\n"},
    {"AccuracyOfACeiling", "method.accuracy",
     with_method("accuracy = 0.1") + "[contact]\nceiling = \"2\"\n"},
    {"PetscOfACeiling", "method.solver",
     with_method("solver = \"petsc\"") + "[contact]\nceiling = \"2\"\n"},
    {"ModelKindUnknown", "model.kind", load + mesh + "[model]\nkind = \"plane stress\"\n"},
    {"ModelOfALayerWithoutContact", "model.kind",
     with_layer("epsilon = 0.1") + "[model]\nkind = \"plane strain\"\n"},
    {"ModelOfFrictionWithoutContact", "model.kind",
     load + mesh + "[model]\nkind = \"plane strain\"\nfriction = \"1\"\n"},
    {"ModelKeyOfTheOther", "model.young",
     with_contact("") + "[model]\nkind = \"plane strain\"\nyoung = 1\n"},
    {"ModelEpsilonTooLarge", "model.epsilon",
     with_contact("") + "[model]\nkind = \"plane strain\"\nepsilon = 2\n"},
    {"ModelIncompressible", "model.poisson",
     with_contact("") +
         "[layer]\nepsilon = 0.1\n[model]\nkind = \"plane strain\"\npoisson = 0.5\n"},
    {"ElementInSmallLetters", "method.element", with_method("element = \"cr\"")},
    {"SolverUnknown", "method.solver", with_method("solver = \"newton\"")},
    {"AccuracyZero", "method.accuracy", with_method("accuracy = 0")},
    {"AccuracyOne", "method.accuracy", with_method("accuracy = 1")},
    {"AccuracyNegative", "method.accuracy", with_method("accuracy = -0.1")},
    {"AccuracyNan", "method.accuracy", with_method("accuracy = nan")},
    {"AccuracyText", "method.accuracy", with_method("accuracy = \"1e-2\"")},
    {"AccuracyOfVentcel", "method.accuracy",
     with_layer("epsilon = 0\nmodel = \"ventcel\"") + "[method]\naccuracy = 0.1\n"},
    {"AccuracyByUzawa", "method.solver", with_method("accuracy = 0.1\nsolver = \"uzawa\"")},
    {"OfUnknown", "method.of", with_method("accuracy = 0.1\nof = \"strain\"")},
    {"OfWithoutAccuracy", "method.of", with_method("of = \"stress\"")},
    {"OfTheStressOfP1", "method.of",
     with_method("accuracy = 0.1\nelement = \"P1\"\nof = \"stress\"")},
    {"MostUnknownsWithoutAccuracy", "method.most_unknowns", with_method("most_unknowns = 1000")},
    {"MostUnknownsZero", "method.most_unknowns", with_method("accuracy = 0.1\nmost_unknowns = 0")},
    {"MostUnknownsBelowTheFirstMesh", "method.accuracy",
     with_method("accuracy = 0.1\nmost_unknowns = 50")},
    {"MostUnknownsTooMany", "method.most_unknowns",
     with_method("accuracy = 0.1\nmost_unknowns = 2e9")},
    {"ToleranceZero", "method.tolerance", with_method("tolerance = 0")},
    {"ToleranceNegative", "method.tolerance", with_method("tolerance = -1e-10")},
    {"ToleranceOne", "method.tolerance", with_method("tolerance = 1")},
    {"ToleranceBeyondUse", "method.tolerance", with_method("tolerance = 0.01")},
    {"P2WithVentcel", "method.element",
     with_layer("epsilon = 0\nmodel = \"ventcel\"") + "[method]\nelement = \"P2\"\n"},
    {"HybridBdm1WithVentcel", "method.element",
     with_layer("epsilon = 0\nmodel = \"ventcel\"") + "[method]\nelement = \"M2\"\n"},
    {"HybridBdm1WithPetsc", "method.element",
     with_method("element = \"BDM1-hybrid\"\nsolver = \"petsc\"")},
    {"HybridBdm1InPlaneStrain", "model.kind",
     with_contact("") + "[model]\nkind = \"plane strain\"\n[method]\nelement = \"M2\"\n"},
    {"LayeredWithoutLayer", "mesh.kind", with_mesh("kind = \"layered\"\ncells = 8")},
    {"LayeredThin", "mesh.kind",
     load + "[layer]\nepsilon = 0.1\nmodel = \"thin\"\n[mesh]\nkind = \"layered\"\ncells = 8\n"},
    {"CellsTooManyLayered", "mesh.cells",
     load + "[layer]\nepsilon = 0.1\n[mesh]\nkind = \"layered\"\ncells = 513\n"},
    {"ToleranceNan", "method.tolerance", with_method("tolerance = nan")},
    {"ToleranceText", "method.tolerance", with_method("tolerance = \"1e-10\"")},
    {"MethodUnknownKey", "method.order", with_method("order = 2")},
};

void expect_refused(const SceneRun& run, const std::string& key) {
  expect_no_answer(run, "accepted");
  EXPECT_TRUE(run.outcome.err.starts_with(run.scene_path + ": " + key + ": ")) << run.outcome.err;
}

class BadScenes : public testing::TestWithParam<BadScene> {};

TEST_P(BadScenes, AreRefusedInOneLineAndNothingIsWritten) {
  const SceneRun run(GetParam().scene);
  expect_refused(run, GetParam().key);
  EXPECT_EQ(run.input.file_count(), 1) << "something was written beside the scene";
}

INSTANTIATE_TEST_SUITE_P(All, BadScenes, testing::ValuesIn(bad_scenes),
                         [](const auto& info) { return info.param.name; });

// Brackets and dots of strings and comments do not count.
TEST(BadScenes, ADepthIsRefusedWithItsLine) {
  const std::string dots = repeated(".", 100), open = repeated("[", 100);
  const std::string quoted = "title = \"\"\"\\\"\"\" " + open + dots + "\n\"\"\"\"\" # '" + dots +
                             open + "\n" + "[load]\nf = '10' # \"\n" + mesh;  // seven lines
  EXPECT_EQ(read_scene(quoted, "s.toml").mesh.cells, 8);
  const std::string deepest =
      "a" + repeated(".a", 63) + " = " + repeated("[", 64) + repeated("]", 64) + "\n";
  test::expect_refused([&] { read_scene(deepest + load + mesh, "s.toml"); },
                       "s.toml: a: unknown key");
  test::expect_refused(
      [&] { read_scene(quoted + "b" + repeated(".b", 64) + " = 1\n", "s.toml"); },
      "s.toml: syntax: line 8: a key has too many parts; accepted: up to 64 parts between dots");
  test::expect_refused(
      [&] { read_scene(quoted + "b = '''\n'''''\n" + open, "s.toml"); },
      "s.toml: syntax: line 10: is nested too deeply; accepted: up to 64 brackets in each other");
}

// The file and the key stand first and once, whatever the file is called: here as the message of
// the refinement begins.
TEST(BadScenes, TheNameOfTheSceneDoesNotChangeTheMessage) {
  const SceneFile file = read_scene(with_method("accuracy = 0.1\nmost_unknowns = 50"), "accuracy");
  test::expect_refused(
      [&] { solve_scene(file, {}); },
      "accuracy: method.accuracy: accuracy: most_unknowns = 50 cannot hold the first mesh");
  // read without complaint, and infinite at the midpoint 1/14 of a contact edge of this mesh
  const SceneFile gap =
      read_scene(load + "[contact]\ngap = \"0.0714 < x < 0.0715 ? 1/0 : 0\"\n" +
                     "[mesh]\nkind = \"structured\"\ncells = 7\n[method]\nelement = \"CR\"\n",
                 "gap.toml");
  const std::string message = test::refusal([&] { solve_scene(gap, {}); });
  EXPECT_TRUE(message.starts_with("gap.toml: contact.gap: ")) << message;
  EXPECT_EQ(message.rfind("gap.toml"), 0) << message;
}

// The mesh of a body, each with another part that is wrong.
std::string msh(const std::string& nodes, const std::string& elements) {
  const auto counted = [](const std::string& lines) {
    return std::to_string(std::count(lines.begin(), lines.end(), '\n')) + "\n" + lines;
  };
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 4 \"clamped\"\n1 5 "
         "\"contact\"\n2 1 \"body\"\n"
         "$EndPhysicalNames\n$Nodes\n" +
         counted(nodes) + "$EndNodes\n$Elements\n" + counted(elements) + "$EndElements\n";
}
// A unit square of four triangles around its centre, so that P1 has an unknown to solve for.
const std::string square_nodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0.5 0.5 0\n";
const std::string contact_edge = "1 1 2 5 5 1 2\n";
const std::string clamped_edges = "2 1 2 4 4 2 3\n3 1 2 4 4 3 4\n4 1 2 4 4 4 1\n";
const std::string square_triangles =
    "5 2 2 1 1 1 2 5\n6 2 2 1 1 2 3 5\n7 2 2 1 1 3 4 5\n8 2 2 1 1 4 1 5\n";
const std::string whole_square = contact_edge + clamped_edges + square_triangles;
const std::string square = msh(square_nodes, whole_square);
const std::string twice_the_square =
    msh("1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n5 1 1 0\n", whole_square);

struct BadMesh {
  std::string name, mesh, effects, key = "mesh.file", f = "1";
};
void PrintTo(const BadMesh& bad, std::ostream* out) {
  *out << bad.name;
}  // NOLINT(readability-identifier-naming)
const std::string thin_layer = "[layer]\nepsilon = 0.1\nmodel = \"thin\"\n";

const std::vector<BadMesh> bad_meshes = {
    {"NoLayerGroup", square, thin_layer},
    {"NoContactGroup", msh(square_nodes, clamped_edges + square_triangles), ""},
    {"NoClampedGroup", msh(square_nodes, contact_edge + square_triangles), ""},
    {"NoBodyGroup", msh(square_nodes, contact_edge + clamped_edges), ""},
    {"Inverted",
     msh(square_nodes, contact_edge + clamped_edges +
                           "5 2 2 1 1 2 1 5\n6 2 2 1 1 2 3 5\n7 2 2 1 1 3 4 5\n8 2 2 1 1 4 1 5\n"),
     ""},
    {"Degenerate", msh("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0.5 0 0\n", whole_square), ""},
    {"DanglingEdge", msh(square_nodes + "6 0.2 0.7 0\n", whole_square + "9 1 2 4 4 1 6\n"), ""},
    {"DanglingTriangle",
     msh(square_nodes + "6 3 3 0\n7 4 3 0\n8 3 4 0\n",
         whole_square + "9 2 2 1 1 6 7 8\n10 1 2 5 5 6 7\n11 1 2 5 5 7 8\n12 1 2 5 5 8 6\n"),
     ""},
    {"MissingTriangle",
     msh(square_nodes,
         contact_edge + clamped_edges + "5 2 2 1 1 1 2 5\n6 2 2 1 1 2 3 5\n7 2 2 1 1 3 4 5\n"),
     ""},
    {"Truncated", square.substr(0, square.size() / 2), ""},
    {"BodyBelowTheLine", msh("1 0 -1 0\n2 1 -1 0\n3 1 1 0\n4 0 1 0\n5 0.5 0.5 0\n", whole_square),
     ""},
    {"BodyAboveTheLine", msh("1 0 1 0\n2 1 1 0\n3 1 2 0\n4 0 2 0\n5 0.5 1.5 0\n", whole_square),
     ""},
    {"GapAgainstTheClampOfThisBody", twice_the_square,
     "[contact]\ngap = \"x < 1.5 ? 0.1 : -0.1\"\n", "contact.gap"},
    {"LoadWithoutAValueOnThisBody", twice_the_square, "", "load.f", "1/(x - 2)"},
    {"ContactOnPartOfTheSide",
     msh("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0.5 0.5 0\n6 0.5 0 0\n",
         "1 1 2 5 5 1 6\n9 1 2 4 4 6 2\n" + clamped_edges +
             "5 2 2 1 1 1 6 5\n10 2 2 1 1 6 2 5\n6 2 2 1 1 2 3 5\n7 2 2 1 1 3 4 5\n8 2 2 1 1 4 1 "
             "5\n"),
     ""},
    {"ContactOnTheWrongSide",
     msh(square_nodes,
         "1 1 2 5 5 3 4\n2 1 2 4 4 2 3\n3 1 2 4 4 1 2\n4 1 2 4 4 4 1\n" + square_triangles),
     ""},
};

class BadMeshes : public testing::TestWithParam<BadMesh> {};

TEST_P(BadMeshes, AreRefusedInOneLineAndNothingIsWritten) {
  const TemporaryFolder folder;
  std::ofstream(folder / "my.msh") << GetParam().mesh;
  const SceneRun run("[load]\nf = \"" + GetParam().f + "\"\n" + GetParam().effects +
                     "[mesh]\nkind = \"file\"\nfile = \"" + (folder / "my.msh").string() + "\"\n");
  expect_refused(run, GetParam().key);
}

INSTANTIATE_TEST_SUITE_P(All, BadMeshes, testing::ValuesIn(bad_meshes),
                         [](const auto& info) { return info.param.name; });

TEST(BadMeshes, TheMeshThatTheyAreMadeFromIsGood) {
  const TemporaryFolder folder;
  std::ofstream(folder / "my.msh") << square;
  const SceneRun run(load + "[mesh]\nkind = \"file\"\nfile = \"" + (folder / "my.msh").string() +
                     "\"\n");
  EXPECT_EQ(run.outcome.status, 0) << run.outcome.err;
}

// What is accepted is said of a mesh that is none, whatever the file is called.
TEST(BadMeshes, TheNameOfTheFileDoesNotChangeTheMessage) {
  const TemporaryFolder folder;
  std::ofstream(folder / "accepted.msh")
      << msh("1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0.5 0 0\n", whole_square);
  const SceneRun run(load + "[mesh]\nkind = \"file\"\nfile = \"" +
                     (folder / "accepted.msh").string() + "\"\n");
  expect_refused(run, "mesh.file");
  EXPECT_TRUE(run.outcome.err.ends_with(
      "; accepted: MSH 2.2 or 4.1 with the groups body, layer (if the scene has one), "
      "clamped and contact, its triangles proper and connected\n"))
      << run.outcome.err;
}

TEST(BadMeshes, AThinLayerAndNoLayerRefuseTheLayerOfAScaledOne) {
  for (const std::string& layer : {thin_layer, std::string()}) {
    const SceneRun run(load + layer +
                       "[mesh]\nkind = \"file\"\nfile = \"" EXAMPLE_SCENES "/own_mesh.msh\"\n");
    expect_refused(run, "mesh.file");
  }
}

// The command line itself.
void expect_one_line(const Outcome& outcome, const std::string& start) {
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with(start)) << outcome.err;
}

TEST(BadCommandLine, IsRefusedInOneLine) {
  const TemporaryFolder log;
  for (const std::string arguments : {"", "--cells 3", "a.toml b.toml", "a.toml --out"})
    expect_one_line(run_scene(arguments, log), "run_scene: ");
}

TEST(BadCommandLine, ASceneThatIsNotThere) {
  const TemporaryFolder log;
  expect_one_line(run_scene("not_there.toml --out " + in_shell(log / "r"), log),
                  "not_there.toml: file: ");
  expect_one_line(run_scene(in_shell(log.path().string()) + " --out " + in_shell(log / "r"), log),
                  log.path().string() + ": file: ");
  EXPECT_FALSE(std::filesystem::exists(log / "r"));
}

// A result of the same name would take the place of what the user wrote.
TEST(BadCommandLine, ResultsThatWouldReplaceTheirInputs) {
  const TemporaryFolder folder;
  std::ofstream(folder / "mesh.msh") << square;
  std::ofstream(folder / "scene.toml") << load + "[mesh]\nkind = \"file\"\nfile = \"mesh.msh\"\n";
  std::ofstream(folder / "summary.json") << load + "[mesh]\nkind = \"structured\"\ncells = 4\n";
  for (const std::string name : {"scene.toml", "summary.json"}) {
    const std::string path = (folder / name).string(), before = contents(path);
    expect_one_line(
        run_scene(in_shell(path) + " --out " + in_shell(folder.path().string()), folder),
        path + ": --out: ");
    EXPECT_EQ(contents(path), before);
    EXPECT_EQ(contents(folder / "mesh.msh"), square);
    EXPECT_FALSE(std::filesystem::exists(folder / "solution.csv"));
  }
}

// What never ends, or never begins.
TEST(BadCommandLine, DevicesAreNoFiles) {
  const TemporaryFolder folder;
  expect_one_line(run_scene("/dev/zero --out " + in_shell(folder / "r"), folder),
                  "/dev/zero: file: ");
  std::ofstream(folder / "scene.toml") << load + "[mesh]\nkind = \"file\"\nfile = \"/dev/zero\"\n";
  const std::string path = (folder / "scene.toml").string();
  expect_one_line(run_scene(in_shell(path) + " --out " + in_shell(folder / "r"), folder),
                  path + ": mesh.file: ");
  ASSERT_EQ(::mkfifo((folder / "pipe.toml").c_str(), 0600), 0);
  const std::string pipe = (folder / "pipe.toml").string();
  expect_one_line(run_scene(in_shell(pipe) + " --out " + in_shell(folder / "r"), folder),
                  pipe + ": file: ");
  EXPECT_FALSE(std::filesystem::exists(folder / "r"));
}

// `...toml` without its extension is `..`: the results would go beside the folder results.
TEST(BadCommandLine, ANameOfASceneThatNamesNoFolder) {
  const TemporaryFolder folder, log;
  std::filesystem::create_directory(folder / "at");
  const std::string in_it = "cd " + in_shell(folder / "at") + " && " + in_shell(RUN_SCENE) + " ";
  for (const std::string name : {"...toml", "..toml"}) {
    std::ofstream(folder / "at" / name) << load + mesh;
    EXPECT_EQ(WEXITSTATUS(std::system((in_it + name + " 2>" + in_shell(log / "err")).c_str())), 2)
        << name;
    EXPECT_TRUE(contents(log / "err").starts_with(name + ": --out: ")) << contents(log / "err");
    EXPECT_EQ(std::system((in_it + name + " --out ../out >/dev/null").c_str()), 0);
    std::filesystem::remove_all(folder / "out");
  }
  EXPECT_EQ(folder.file_count(), 2) << "the two scenes";
}

TEST(BadCommandLine, ResultsThatCannotBeWritten) {
  const TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << load << mesh;
  std::ofstream(folder / "a_file") << "precious";
  for (const std::string out : {"a_file", "a_file/results"})
    expect_one_line(
        run_scene(in_shell(folder / "scene.toml") + " --out " + in_shell(folder / out), folder),
        (folder / out).string());
  EXPECT_EQ(contents(folder / "a_file"), "precious");
  expect_one_line(run_scene(in_shell(folder / "scene.toml") + " --out ''", folder), "");
}

}  // namespace antilock::test::bad_scenes_test
