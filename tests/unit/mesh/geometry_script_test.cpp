// What gmsh is given of a .geo file (mesh/geometry_script.hpp): all that draws, and nothing that
// reads, writes or runs.
#include <dlfcn.h>
#include <gmshc.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <array>
#include <fstream>

#include "antilock/core/error.hpp"
#include "antilock/mesh/detail/gmsh_session.hpp"
#include "antilock/mesh/geometry.hpp"
#include "antilock/mesh/geometry_script.hpp"
#include "support/temporary_folder.hpp"
#include "unit/mesh/geometry_script_helpers.hpp"

namespace antilock::test::mesh_test::geometry_script_test {

/// `script` is refused in line `line`, and the message names `name` there.
void expect_refused(const std::string& script, int line, const std::string& name) {
  const std::string why = refusal(script), begin = "line " + std::to_string(line) + ": " + name;
  EXPECT_EQ(why.substr(0, begin.size()), begin) << script << "\n" << why;
  EXPECT_NE(why.find("accepted: "), std::string::npos) << why;
  EXPECT_EQ(why.find('\n'), std::string::npos) << why;
}

/// gmsh as a program that uses it itself has it, until the end of its scope.
class GmshInitialized {
 public:
  GmshInitialized() {
    int failed = 0;
#if GMSH_API_VERSION_MINOR < 9
    function<decltype(gmshInitialize)>("gmshInitialize")(0, nullptr, 0, &failed);
#else
    function<decltype(gmshInitialize)>("gmshInitialize")(0, nullptr, 0, 0, &failed);
#endif
    function<decltype(gmshOptionSetNumber)>("gmshOptionSetNumber")("General.Terminal", 0, &failed);
    function<decltype(gmshModelAdd)>("gmshModelAdd")("mine", &failed);
  }
  ~GmshInitialized() {
    int failed = 0;
    function<decltype(gmshFinalize)>("gmshFinalize")(&failed);
  }
  GmshInitialized(const GmshInitialized&) = delete;
  GmshInitialized& operator=(const GmshInitialized&) = delete;

  double number(const char* option) const {
    double value = 0;
    int failed = 0;
    function<decltype(gmshOptionGetNumber)>("gmshOptionGetNumber")(option, &value, &failed);
    return value;
  }

 private:
  template <class Function>
  static Function* function(const char* name) {
    return reinterpret_cast<Function*>(
        dlsym(dlopen(ANTILOCK_GMSH_LIBRARY, RTLD_LAZY | RTLD_LOCAL), name));
  }
};

/// The words of a script, one blank between two.
std::string words(const std::string& script) {
  std::istringstream in(script);
  std::string all;
  for (std::string word; in >> word;) all += (all.empty() ? "" : " ") + word;
  return all;
}

/// An index as it is written.
std::string guarded(const std::string& index) {
  return "Min ( 1e6 , Max ( 0 , 1e6 + 1 - Round ( 1 / ( 1 / Max ( 0 , 1e6 + 2 - Round ( 1 / ( 1 / "
         "Max ( 0 , 1 + Floor ( " +
         index + " ) ) ) ) ) ) ) ) )";
}

TEST(GeometryScript, KeepsNumbersSignsAndCommandsAndRenamesVariables) {
  EXPECT_EQ(words(geometry_script("h = 1e-1; Point(1) = {0.5, -.5, 2., h};")),
            "v_1 = 1e-1 ; Point ( 1 ) = { 0.5 , - .5 , 2. , v_1 } ;");
  EXPECT_EQ(words(geometry_script("a() = {1:3}; a(0) += 2; a() -= 1; b~{1} = #a();b~{1}++;")),
            "v_1 ( ) = { 1 : 3 } ; v_1 ( " + guarded("0") +
                " ) += 2 ; v_1 ( ) -= 1 ; v_2 ~ { 1 } = # v_1 ( ) ; v_2 ~ { 1 } ++ ;");
  EXPECT_EQ(words(geometry_script("Merge = 1; x = Merge;")), "v_1 = 1 ; v_2 = v_1 ;");
}

// To gmsh x~{1} is another name of x_1.
TEST(GeometryScript, KeepsTheNumbersBehindANameOfAVariable) {
  EXPECT_EQ(words(geometry_script(
                "x_1 = 1; x~{2} = 2; y = x~{1}; x_1_20 = y; a_ = 1; _1 = 2; x1 = 3; x_ = x_1;")),
            "v_1_1 = 1 ; v_1 ~ { 2 } = 2 ; v_2 = v_1 ~ { 1 } ; v_1_1_20 = v_2 ; v_3 = 1 ; v_4 = 2 "
            "; v_5 = 3 ; "
            "v_6 = v_1_1 ;");
}

// gmsh looks for the end of a loop that it skips letter by letter: the word behind EndFor in a name
// was run.
TEST(GeometryScript, KeepsNoLettersOfTheNamesOfVariables) {
  const std::string script =
      geometry_script("a1EndFor1Exit = 1;\nFor i In {2:1}\na1EndFor1Exit ;\nEndFor\n");
  EXPECT_EQ(words(script), "v_1 = 1 ; For v_2 In { 2 : 1 } v_1 ; EndFor");
}

TEST(GeometryScript, TakesAByteOrderMark) {
  EXPECT_EQ(words(geometry_script("\xEF\xBB\xBFh = 1;")), "v_1 = 1 ;");
}

// gmsh writes the name into 1,024 letters of its stack.
TEST(GeometryScript, RefusesLongChainsOfNumbersBehindAName) {
  const auto chain = [](int links) {
    std::string script = "x = 1;\ny = x";
    for (int i = 0; i < links; ++i) script += "~{-2147483648}";
    return script + ";";
  };
  EXPECT_EQ(refusal(chain(8)), "");
  expect_refused(chain(9), 2, "~");
}

TEST(GeometryScript, KeepsTheLinesOfItsTokens) {
  const std::string script = geometry_script("// one\n/* two\nthree */\nPoint(1) =\n{0, 0, 0};\n");
  EXPECT_EQ(script, "\n\n\n Point ( 1 ) =\n { 0 , 0 , 0 } ;\n");
}

TEST(GeometryScript, BreaksLongLinesBetweenTokens) {
  std::string list = "1";
  for (int i = 2; i < 5000; ++i) list += ", " + std::to_string(i);
  const std::string script = geometry_script("Spline(1) = {" + list + "};");
  EXPECT_EQ(words(script).substr(0, 26), "Spline ( 1 ) = { 1 , 2 , 3");
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LT(line.size(), 2200U);  // gmsh cuts from 8192 on
}

TEST(GeometryScript, LeavesOutCommentsAndWhatConcernsTheMeshAlone) {
  for (const std::string nothing :
       {"// SystemCall \"touch marker\";", "/* Merge \"x\"; */", "Mesh.Algorithm = 6;", "Mesh 2;",
        "Physical Curve(\"SystemCall 'touch marker';\", 3) = {1, 2};",
        "Characteristic Length {:} = 0.1;",
        "Field[1] = MathEval; Field[1].F = \"x*y\"; Background Field = 1;",
        "Printf(\"%g SystemCall\", 1);",
        "Transfinite Curve {1} = 10 Using Progression 1.1; Recombine Surface {1};",
        "BoundaryLayer Field = 1;"})
    EXPECT_EQ(words(geometry_script(nothing)), "") << nothing;
}

TEST(GeometryScript, KeepsTheValuesOfConstantsAndLeavesOutTheirMenus) {
  EXPECT_EQ(
      words(geometry_script(
          "DefineConstant[ h = {0.1, Min 0, Name \"a/b\"}, n = 3, l() = {{1, 2}, Name \"c\"} ];")),
      "DefineConstant [ v_1 = { 0.1 } , v_2 = 3 , v_3 ( ) = { { 1 , 2 } } ] ;");
}

TEST(GeometryScript, KeepsLoopsAndTheKernel) {
  EXPECT_EQ(words(geometry_script(
                "SetFactory(\"OpenCASCADE\");\nFor i In {1:3}\n  Point(i) = {i, 0, 0};\nEndFor\n")),
            "SetFactory ( \"OpenCASCADE\" ) ; For v_1 In { 1 : 3 } Point ( v_1 ) = { v_1 , 0 , 0 } "
            "; EndFor");
  EXPECT_EQ(words(geometry_script("For (1:2)\n p = newp;\nEndFor")),
            "For ( 1 : 2 ) v_1 = newp ; EndFor");
}

TEST(GeometryScript, RefusesByNameAndLineWhatRunsReadsOrWrites) {
  for (const auto& [script, name] : std::initializer_list<std::pair<std::string, std::string>>{
           {"SystemCall \"touch marker\";", "SystemCall"},
           {"System \"touch marker\";", "System"},
           {"NonBlockingSystemCall \"touch marker\";", "NonBlockingSystemCall"},
           {"OnelabRun(\"a\", \"touch marker\");", "OnelabRun"},
           {"OnelabRun \"a\";", "OnelabRun"},
           {"Printf(\"a\") > \"marker\";", "Printf"},
           {"Printf(\"%g\", 1) >> \"marker\";", "Printf"},
           {"Print \"marker.png\";", "Print"},
           {"Save \"marker.msh\";", "Save"},
           {"Save View[0] \"marker\";", "Save"},
           {"Include \"marker\";", "Include"},
           {"Merge \"marker\";", "Merge"},
           {"MergeWithBoundingBox \"marker\";", "MergeWithBoundingBox"},
           {"s() = ShapeFromFile(\"marker.step\");", "ShapeFromFile"},
           {"l() = ListFromFile[\"marker\"];", "ListFromFile"},
           {"CreateDir \"marker\";", "CreateDir"},
           {"Plugin(Triangulate).Run;", "Plugin"},
           {"Plugin(MathEval).Expression0 = \"x\";", "Plugin"},
           {"View \"a\" { SP(0,0,0){1}; };", "View"},
           {"View[0].Visible = 0;", "View"},
           {"General.OptionsFileName = \"marker\";", "General.OptionsFileName"},
           {"General.ExecutableFileName = \"marker\";", "General.ExecutableFileName"},
           {"Solver.Executable0 = \"touch marker\";", "Solver.Executable0"},
           {"Print.Text = 1;", "Print.Text"},
           {"PostProcessing.SaveMesh = 1;", "PostProcessing.SaveMesh"},
           {"Geometry.OCCTargetUnit = \"M\";", "Geometry.OCCTargetUnit"},
           {"x = General.Terminal;", "General.Terminal"},
           {"Field[1] = ExternalProcess;", "Field = ExternalProcess"},
           {"Field[1] = Structured;", "Field = Structured"},
           {"Field[1] = PostView;", "Field = PostView"},
           {"SetString(\"a\", \"b\");", "SetString"},
           {"SetNumber(\"a\", 1);", "SetNumber"},
           {"UndefineConstant[\"a\"];", "UndefineConstant"},
           {"x = GetEnv(\"HOME\");", "GetEnv"},
           {"x = GetValue(\"a\", 1);", "GetValue"},
           {"DefineConstant[ x = DefineString(\"a\") ];", "DefineString"},
           {"StringToName[\"SystemCall\"] \"touch marker\";", "StringToName"},
           {"S2N[\"SystemCall\"] \"touch marker\";", "S2N"},
           {"System~{1} \"touch marker\";", "System"},
           {"If (1)", "If"},
           {"Macro M", "Macro"},
           {"Function M", "Function"},
           {"Call M;", "Call"},
           {"Return", "Return"},
           {"Exit;", "Exit"},
           {"Abort;", "Abort"},
           {"Sleep 1000;", "Sleep"},
           {"NewModel;", "NewModel"},
           {"Struct S[a 1];", "Struct"},
           {"SetFactory(Str(\"OpenCASCADE\"));", "SetFactory"},
           {"SetFactory(\"marker\");", "\"marker\""},
           {"Levelset Plane(1) = {0, 0, 1, 0};", "Levelset"},
           {"PolarSphere(1) = {1, 2};", "PolarSphere"},
           {"ThruSections(1) = {1:3};", "ThruSections"}}) {
    expect_refused("\n\n" + script, 3, name);
    expect_refused("a = 1;\nb() = {1, 2};\n" + script, 3, name);
    expect_refused("Mesh.Algorithm = 6;\n\n" + script, 3, name);
    expect_refused("Delete { Point{1}; }\n/* ; */\n" + script, 3, name);
    expect_refused("For i In {1:2}\r\n\r\n" + script + "\r\nEndFor", 3, name);
    expect_refused("// \\\n\"'\";\n" + script, 2, "\"'\"");  // a backslash continues no line
  }
}

TEST(GeometryScript, RefusesOddSpellings) {
  for (const std::string script :
       {"SystemCall'touch marker';", "SystemCall/**/\"touch marker\";",
        "SystemCall\t\f\"touch marker\";", "SystemCall \"touch\nmarker\";",
        "a = 1;SystemCall\"touch marker\";", "/*/*/SystemCall \"touch marker\";",
        "/* /* */ SystemCall \"touch marker\"; /* */", "SystemCall StrCat(\"touch\", \" marker\");",
        "SystemCall \"touch marker\"", "{ SystemCall \"touch marker\"; }",
        "Surface { SystemCall \"touch marker\"; };", "a() = { SystemCall };",
        "SystemCall = 1; SystemCall 2; System \"a\";"})
    EXPECT_NE(refusal(script), "") << script;
  // a name that the script assigns is a variable: the text behind it is refused
  expect_refused("SystemCall = 1;\nSystemCall \"touch marker\";", 2, "\"touch marker\"");
  expect_refused("Merge() = {1};\nMerge \"marker\";", 2, "\"marker\"");
  expect_refused("a = \"touch marker\";\nSystemCall a;", 1, "\"touch marker\"");
  // a text ends at the next quotation mark, whatever stands before it
  expect_refused("Printf(\"a\\\");\nSystemCall \"touch marker\"; //\");", 2, "SystemCall");
  expect_refused("Printf('a\"');\nSystemCall \"touch marker\";", 2, "SystemCall");
  expect_refused("Physical Point(\"/*\") = {1};\nSystemCall \"touch marker\"; // */", 2,
                 "SystemCall");
  expect_refused("// /*\nSystemCall \"touch marker\"; // */", 2, "SystemCall");
  // carriage returns end no comment, for gmsh as well
  EXPECT_EQ(words(geometry_script("// \rSystemCall \"touch marker\";")), "");
}

TEST(GeometryScript, RefusesWhatIsNoScript) {
  using namespace std::string_literals;
  expect_refused("a = 1;\nb = \0;"s, 2, "a byte 0");
  expect_refused("// \0\n"s, 1, "a byte 0");
  expect_refused("\xEF\xBB\xBF\xEF\xBB\xBFPoint(1) = {0,0,0};", 1, "?");
  expect_refused("\n$MeshFormat", 2, "$");
  expect_refused("Point(1) = {0, 0, 0};\n/* ", 2, "/*");
  expect_refused("Printf(\"", 1, "a text");
  expect_refused("Printf('\"\n", 1, "a text");
  expect_refused("Point(1) = {0, 0, 0", 1, "{");
  expect_refused("Point(1) = (0, 0, 0};", 1, "}");
  expect_refused("\n)", 2, ")");
  expect_refused("Mesh.Algorithm = 1", 1, "Mesh");
  expect_refused("For i In {1:2}", 1, "For");
  expect_refused("For i In {1:2}\nEndFor\nEndFor", 3, "EndFor");
  expect_refused("x = 1 % 0;", 1, "%");
  expect_refused("x = y;", 1, "y");
  expect_refused("a() = {1}; b = a({0});", 1, "a");
  expect_refused(std::string(101, 'x') + " = 1;", 1, "xxx");
  EXPECT_EQ(refusal(std::string(100, 'x') + " = 1;"), "");
  EXPECT_EQ(refusal("// \xC3\xA9\nPhysical Point(\"\xC3\xA9\") = {1};"),
            "");  // UTF-8 where it means nothing
}

// gmsh's scanner reads these words as names: as variables they would have no guarded index.
TEST(GeometryScript, RefusesCommandsThatAreNamesOutsideOfTheirForm) {
  for (const std::string word : {"Loop", "Duplicata", "Boundary", "CombinedBoundary", "PointsOf"})
    for (const std::string use : {"W() = {1};",
                                  "W[] = {1};",
                                  "W(0) = 1;",
                                  "W[0] = 1;",
                                  "W = 1;",
                                  "W += 1;",
                                  "W++;",
                                  "W--;",
                                  "W~{1} = 1;",
                                  "W~{1}(0) = 1;",
                                  "x = W(-1);",
                                  "x = W[0]++;",
                                  "x = W;",
                                  "x = #W();",
                                  "For W In {1:2}\nEndFor",
                                  "DefineConstant[ W = 1 ];",
                                  "DefineConstant[ W() = {1} ];",
                                  "DefineConstant[ W = {1, Name \"a\"} ];",
                                  "Delete W;",
                                  "Point W(1) = {1};"}) {
      std::string script = use;
      script.replace(script.find('W'), 1, word);
      expect_refused("\n" + script, 2, word);
    }
  expect_refused("x = Boundary(0) { Line{1}; };", 1, "Boundary");
  expect_refused("Line Loop{1};", 1, "Loop");
  EXPECT_EQ(words(geometry_script(
                "Line Loop(newcl) = {1}; Curve Loop(2) = {1}; Surface Loop(1) = {1}; b() = "
                "Boundary{ Surface{1}; }; Translate {1, 0, 0} { Duplicata{ Curve{1}; } }")),
            "Line Loop ( newll ) = { 1 } ; Curve Loop ( 2 ) = { 1 } ; Surface Loop ( 1 ) = { 1 } ; "
            "v_1 ( ) = Boundary { Surface { 1 } ; } ; Translate { 1 , 0 , 0 } { Duplicata { Curve "
            "{ 1 } ; } }");
}

// What is left out has no part in the drawing, so that nothing in it may have one.
TEST(GeometryScript, LeavesOutNoEffect) {
  for (const auto& [left_out, name] : std::initializer_list<std::pair<std::string, std::string>>{
           {"Physical Curve(n++) = {1};", "++"},
           {"Physical Curve(1) = {n--};", "--"},
           {"Field[n++] = Box;", "++"},
           {"Field[1].F = Translate{0, 1, 0}{ Curve{1}; };", "Translate"},
           {"Mesh.Algorithm = n++;", "++"},
           {"Printf(\"%g\", n++);", "++"},
           {"Printf(\"%g\", n = 2);", "="},
           {"Characteristic Length {n++} = 0.1;", "++"},
           {"Transfinite Curve {n++} = 3;", "++"},
           {"Periodic Curve {1} = Translate{0, 1, 0}{ Curve{1}; };", "Translate"},
           {"DefineConstant[ a = {1, Min n++, Name \"a\"} ];", "++"},
           {"DefineConstant[ a = {1, Name Str(\"a\")} ];", "Name"},
           {"DefineConstant[ a = {1, Choices{1=\"a\", n++=\"b\"}} ];", "++"},
           {"Physical Surface(1) = BooleanDifference{ Surface{1}; }{ Surface{2}; };",
            "BooleanDifference"},
           {"Physical Curve(1) = ThruSections{1, 2};", "ThruSections"}})
    expect_refused("n = 1;\n" + left_out, 2, name);
  for (const std::string word : {"Translate", "Rotate", "Symmetry", "Dilate", "Affine", "Extrude",
                                 "BooleanUnion", "BooleanIntersection", "BooleanFragments",
                                 "Duplicata", "Boundary", "CombinedBoundary", "PointsOf"})
    expect_refused("\nPhysical Curve(\"top\") = " + word + "{0, 1, 0}{ Curve{1}; };", 2, word);
  for (const std::string kept :
       {"Periodic Curve {1} = {2} Translate {0, 1, 0};",
        "n = 1; Physical Curve(n + 1) += {n, 3:4};",
        "Transfinite Surface {1} = {1, 2, 3, 4} AlternateLeft;",
        "Field[1].F = Sprintf(\"x*%g\", 1);",
        "DefineConstant[ a = {1, Min 0, Max 2, Step 1, Choices{1=\"a\", 2=\"b\"}, Name \"a\"} ];"})
    EXPECT_EQ(refusal(kept), "") << kept;
}

// gmsh counts groups and fields that are left out.
TEST(GeometryScript, RefusesNumbersThatCountWhatIsLeftOut) {
  for (const std::string number :
       {"newreg", "newl", "newc", "newll", "newcl", "news", "newsl", "newv"}) {
    const std::string use = "p = " + number + ";\n", physical = "Physical Curve(100) = {1};\n";
    EXPECT_EQ(refusal(use + physical), "");
    expect_refused(physical + use, 2, number);
    expect_refused("For i In {1:2}\n" + use + physical + "EndFor\n", 2, number);
  }
  expect_refused("Physical Curve(9) = {1};\nExtrude {0, 0, 1} { Curve{1}; }", 2, "Extrude");
  expect_refused("Physical Curve(9) = {1};\nx() = Translate {0, 0, 1} { Duplicata{ Curve{1}; } };",
                 2, "Duplicata");
  EXPECT_EQ(refusal("f = newf; Field[f] = Box; Field[f].VIn = 1; Background Field = f;"), "");
  expect_refused("f = newf;\nLine(1) = {1, f};", 2, "f");
  expect_refused("f = newf;\nf += 1;", 2, "f");
  expect_refused("x = 1 + newf;", 1, "newf");
  expect_refused("x() = {newf};", 1, "newf");
}

TEST(GeometryScript, RefusesWhatGmshReadsInItsOwnWay) {
  expect_refused("Point(1) = {0,0,0};\rLine(1) = {1,2};", 1, "a carriage return");
  expect_refused("a = 1;\r", 1, "a carriage return");
  EXPECT_EQ(refusal("a = 1;\r\n// \r b\r\n"), "");
  expect_refused("x = 0;\nFor i In {1:3} x += 1; EndFor", 2, "For");
  expect_refused("x = 0;\nFor i In {1:3} x += 1;\nEndFor", 2, "For");
  expect_refused("x = 0;\nFor (1:3) x += 1;\nEndFor", 2, "For");
  expect_refused("x = 0;\nFor i In {1:3}\nx += 1;\nEndFor x += 1;", 4, "EndFor");
  expect_refused("For i\n", 1, "For");
  EXPECT_EQ(refusal("For i In {1:3} // thrice\nx = i;\nEndFor // done"), "");
  // comments behind a loop's header or its end that are not over with the line
  const std::string body = "\nx = i;\nEndFor", tail = "\nx = 1;";
  for (const std::string& comment :
       {std::string("/*\nx = 1; // */"), std::string("/* a */ /* b\n */"),
        std::string("// a \r x = 1;"), std::string("/* \r */"),
        "// " + std::string(9000, ' ') + "x = 1;"}) {
    expect_refused("\nFor i In {1:3} " + comment + body, 2, "For");
    expect_refused("For (1:3) " + comment + "\nx = 1;\nEndFor", 1, "For");
    expect_refused("For i In {1:3}" + body + " " + comment + tail, 3, "EndFor");
    EXPECT_EQ(refusal("For i In {1:3}" + body + "\n" + comment + tail), "") << comment;
  }
  EXPECT_EQ(refusal("For i In {1:3} /* thrice */ // \r\n/*\n*/\r\nx = i;\r\nEndFor // done"), "");
  expect_refused("DefineConstant[ a = {1, Name \"x\"},\nb = {2, Name \"x\"} ];", 2, "\"x\"");
  expect_refused("DefineConstant[ a = {1, Name \"x\"} ];\nDefineConstant[ b = {2, Name 'x'} ];", 2,
                 "'x'");
  expect_refused("x = Rand(1);", 1, "Rand");
  expect_refused("x = 0." + std::string(99, '1') + ";", 1, "0.11111111");
  EXPECT_EQ(refusal("x = 0." + std::string(98, '1') + ";"), "");
}

// gmsh checks the upper bound of an index alone. Others are divisions by zero, wherever the
// brackets stand.
TEST(GeometryScript, KeepsEveryIndexFromZeroOn) {
  const std::string before = "l() = {1}; k~{1} = {1}; ", three = guarded("- 3");
  for (const auto& [index, kept] :
       {std::pair<std::string, std::string>{"l[-3] = 1;", "v_1 [ " + three + " ] = 1 ;"},
        {"l(-3) = 1;", "v_1 ( " + three + " ) = 1 ;"},
        {"x = l /* */ [-3];", "v_3 = v_1 [ " + three + " ] ;"},
        {"x = k~{1}[-3];", "v_3 = v_2 ~ { 1 } [ " + three + " ] ;"},
        {"k~{1}~{2}(-3)++;", "v_2 ~ { 1 } ~ { 2 } ( " + three + " ) ++ ;"},
        {"x = l[l[-3]];", "v_3 = v_1 [ " + guarded("v_1 [ " + three + " ]") + " ] ;"}}) {
    const std::string script = words(geometry_script(before + index));
    EXPECT_EQ(script.substr(script.size() - kept.size()), kept) << script;
  }
}
/// Of a file as gmsh itself reads it.
std::vector<std::array<double, 6>> boxes_by_gmsh(const std::filesystem::path& file) {
  GmshSession gmsh;
  gmsh.call<decltype(gmshMerge)>("gmshMerge", file.c_str());
  return boxes(gmsh, gmsh.read_curves({"nothing", geometry_script("")}));
}

const std::string plate_with_holes =
    "SetFactory(\"OpenCASCADE\");\nDefineConstant[ r = {0.1, Min 0.01, Name \"radius\"} "
    "];\nRectangle(1) = {0, 0, 0, "
    "4, 1};\n"
    "holes() = {};\nFor i In {0:2}\n  d = news;\n  Disk(d) = {1 + i, 0.5 + r*Sin(Pi*i/2), 0, r + "
    "i/20};\n"
    "  holes() += d;\nEndFor\nb() = BooleanDifference{ Surface{1}; Delete; }{ Surface{holes()}; "
    "Delete; };\n"
    "e() = Translate{0, 2, 0}{ Duplicata{ Surface{b(0)}; } };\nPhysical Surface(\"body\") = "
    "{b()};\nMesh.Algorithm = "
    "6;\n";
const std::string built_in =
    "h = .1;\nFor i In {0:20}\n  Point(10 + i) = {i/20, 0.1*Cos(2*Pi*i/20)^2, 0, h};\n  l(i) = 10 "
    "+ i;\nEndFor\n"
    "Spline(1) = {l()};\nPoint(1) = {1, 1, 0}; Point(2) = {0, 1, 0}; Point(3) = {0.5, 1, "
    "0};\nLine(2) = {30, 1};\n"
    "Circle(3) = {1, 3, 2};\nBSpline(4) = {2, 3, 10};\nCurve Loop(1) = {1, 2, 3, 4}; Plane "
    "Surface(1) = {1};\n"
    "o() = Extrude {0, 0, 1} { Curve{2}; Layers{3}; Recombine; };\nRotate{{0, 0, 1}, {0, 0, 0}, "
    "Pi/3} { Curve{3}; }\n";

TEST(GeometryScript, DrawsWhatTheFileDraws) {
  const TemporaryFolder folder;
  for (const std::string& script : {plate_with_holes, built_in}) {
    std::ofstream(folder / "body.geo") << script;
    const auto drawn = boxes_of(read_geometry(folder / "body.geo"));
    EXPECT_EQ(drawn, boxes_by_gmsh(folder / "body.geo"));
    EXPECT_GE(drawn.size(), 7U);
  }
}

TEST(GeometryScript, ReportsAnIndexOutsideOfItsList) {
  const std::string line = "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; l() = {0:1e6};\n";
  const auto end = [&](const std::string& index) {
    const std::string script =
        line + "x = l(" + index + ");\nPoint(3) = {2 + x, 0, 0}; Line(1) = {1, 3};";
    return boxes_of({"index.geo", geometry_script(script)}).at(0)[3] - 2;
  };
  for (const double index : {0., 1., 3., 49., 999999., 1e6})
    EXPECT_NEAR(end(std::to_string(index)), index, 1e-3)
        << index;  // gmsh's boxes are wider by 1e-7
  for (const std::string index :
       {"-1", "-1e-3", "-1e8", "1e6 + 1", "3e9", "-3e9", "Sqrt(-1)", "1e999"})
    EXPECT_THROW(end(index), Error) << index;
  for (const std::string bad : {"l(-1) = 1;", "l[-1e8]++;", "l(2e6) = 1;", "x = l(-1)++;"})
    EXPECT_THROW(boxes_of({"index.geo", geometry_script(line + bad)}), Error) << bad;
}

TEST(GeometryScript, IsReadOnceAndNothingLiesBesideIt) {
  const TemporaryFolder folder;
  const std::string marker = (folder / "marker").string(),
                    command = "SystemCall \"touch " + marker + "\";\n";
  std::ofstream(folder / "body.geo") << built_in;
  std::ofstream(folder / "body.geo.opt") << command;  // gmsh merges it with body.geo
  const Geometry geometry = read_geometry(folder / "body.geo");
  const auto drawn = boxes_of(geometry);
  std::ofstream(folder / "body.geo") << command;
  EXPECT_EQ(boxes_of(geometry), drawn);
  EXPECT_THROW(read_geometry(folder / "body.geo"), Error);
  EXPECT_FALSE(std::filesystem::exists(marker));
}

TEST(GeometryScript, WithASyntaxErrorLeavesNothingForTheNextOne) {
  const auto drawn = boxes_of({"body.geo", geometry_script(built_in)});
  for (const std::string bad :
       {"Point(1) = {1 1}; Point(2) = {0, 0, 0}; Point(3) = {1, 0, 0}; Line(77) = {2, 3};\n",
        "For i In {1:3}\n Point(i) = {1 1}; EndFor", "Point(1) = {,,,,,};;;", "Line(1) = {1};"})
    for (int twice = 0; twice < 2; ++twice) {
      EXPECT_THROW(boxes_of({"bad.geo", geometry_script(bad)}), Error) << bad;
      EXPECT_EQ(boxes_of({"body.geo", geometry_script(built_in)}), drawn) << bad;
    }
}

// gmsh's reader keeps the sphere's address, and the end of a session frees the sphere.
TEST(GeometryScript, LeavesNeitherASphereNorAKernelToTheNextOne) {
  const auto drawn = boxes_of({"body.geo", geometry_script(built_in)});
  const std::string sphere = "Sphere(100) = {1, 2};\n", on_it = "Point(50) = {0, 0, 0};\n";
  for (const std::string& left :
       {sphere, sphere + on_it, std::string("SetFactory(\"OpenCASCADE\");\n")}) {
    const Geometry good{"body.geo", geometry_script(built_in + left)};
    const Geometry bad{"bad.geo", geometry_script(built_in + left + "Line(1) = {1};")};
    for (int twice = 0; twice < 2; ++twice) EXPECT_EQ(boxes_of(good), drawn) << left;
    EXPECT_THROW(boxes_of(bad), Error) << left;
    EXPECT_EQ(boxes_of({"body.geo", geometry_script(built_in)}), drawn) << left;
  }
}

// gmsh keeps variables and options beyond the end of a model.
TEST(GeometryScript, LeavesNeitherVariablesNorOptionsToTheNextOne) {
  const std::string constant =
      built_in + "DefineConstant[ a = {0.25, Name \"a\"} ];\nPoint(90) = {3 + a, 0, 0};\n" +
      "l[] += {1};\nPoint(91) = {3, #l[], 0};\nLine(90) = {90, 91};\n";
  const Geometry geometry{"constant.geo", geometry_script(constant)};
  const Geometry other{
      "other.geo",
      geometry_script(built_in + "b = 7;\nc[] = {1, 2, 3};\nGeometry.Tolerance = 0.5;\n")};
  const auto drawn = boxes_of(geometry);
  const GmshInitialized caller;  // the sessions below are within that of their caller
  const double before = caller.number("Geometry.Tolerance");
  for (int twice = 0; twice < 2; ++twice) {
    boxes_of(other);
    EXPECT_EQ(caller.number("Geometry.Tolerance"), before);
    EXPECT_EQ(boxes_of(geometry), drawn);
  }
}

TEST(GeometryScript, OfABrepIsNotNeededSinceItIsDataWhateverItHolds) {
  const TemporaryFolder folder;
  const std::string file = (folder / "body.brep").string(), marker = (folder / "marker").string();
  const std::string command = "SystemCall \"touch " + marker + "\";\n";
  std::vector<std::array<double, 6>> drawn;
  {
    GmshSession gmsh;
    drawn = boxes(gmsh, gmsh.read_curves({"plate", geometry_script(plate_with_holes)}));
    gmsh.call<decltype(gmshWrite)>("gmshWrite", file.c_str());
  }
  const auto by_gmsh = boxes_by_gmsh(file);
  std::ofstream(file + ".opt") << command;
  EXPECT_EQ(boxes_of(read_geometry(file)), by_gmsh);
  EXPECT_EQ(by_gmsh.size(), drawn.size());
  EXPECT_FALSE(std::filesystem::exists(marker));

  std::filesystem::remove(file + ".opt");
  for (const std::string& text :
       {command, std::string(), std::string("DBRep_DrawableShape\nnothing")}) {
    std::ofstream(file) << text;
    EXPECT_THROW(boxes_of(read_geometry(file)), Error) << text;
    EXPECT_FALSE(std::filesystem::exists(marker));
  }
}

TEST(GeometryScript, IsOfAFileGeoOrBrep) {
  const TemporaryFolder folder;
  std::ofstream(folder / "body.step") << "";
  std::ofstream(folder / "body.geo.gz") << "";
  std::filesystem::create_directory(folder / "folder.geo");
  ASSERT_EQ(::mkfifo((folder / "pipe.geo").c_str(), 0600), 0);
  std::ofstream(folder / "empty.brep");
  std::filesystem::create_symlink("/proc/kmsg", folder / "kernel.brep");
  std::ofstream(folder / "large.geo") << std::string((4 << 20) + 1, ' ');
  for (const std::string name : {"body.step", "body.geo.gz", "folder.geo", "pipe.geo", "large.geo",
                                 "absent.geo", "empty.brep", "kernel.brep"})
    EXPECT_THROW(read_geometry(folder / name), Error) << name;
}

}  // namespace antilock::test::mesh_test::geometry_script_test
