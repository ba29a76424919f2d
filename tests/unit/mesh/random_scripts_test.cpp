// Random scripts.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <random>

#include "antilock/core/error.hpp"
#include "antilock/mesh/detail/gmsh_session.hpp"
#include "antilock/mesh/geometry_script.hpp"
#include "support/temporary_folder.hpp"
#include "unit/mesh/geometry_script_helpers.hpp"

namespace antilock::test::mesh_test::random_scripts_test {

/// What a process left behind.
struct Traces {
  int files = 0;
  bool started = false;  ///< another process
  bool crashed = false;
};

/// Runs `work` in a process of its own, whose folder is empty.
template <class Work>
Traces traces_of(const Work& work) {
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(60);
    if (::chdir(folder.path().c_str()) != 0) ::_exit(1);
    ::setenv("HOME", folder.path().c_str(), 1);
    work();
    rusage children{};
    ::getrusage(RUSAGE_CHILDREN,
                &children);  // of those that were waited for; waitpid sees the others
    ::_exit(children.ru_minflt > 0 || ::waitpid(-1, nullptr, WNOHANG) != -1 ? 2 : 0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return {folder.file_count(), WIFEXITED(status) && WEXITSTATUS(status) != 0, WIFSIGNALED(status)};
}

void draw(const std::string& script) {
  try {
    GmshSession gmsh;
    gmsh.read_curves({"random.geo", script});
  } catch (const Error&) {  // most of them make no sense
  }
}

TEST(GeometryScript, WithoutTheRewritingLeavesTraces) {
  boxes_of({"empty.geo", "\n"});  // gmsh is loaded before the fork
  const Traces of_a_call = traces_of([] { draw("SystemCall \"touch marker\";\n"); });
  EXPECT_EQ(of_a_call.files, 1);
  EXPECT_TRUE(of_a_call.started);
  const Traces in_the_background =
      traces_of([] { draw("NonBlockingSystemCall \"sleep 0.1\";\n"); });
  EXPECT_TRUE(in_the_background.started);
  const Traces of_nothing = traces_of([] { draw("Point(1) = {0, 0, 0};\n"); });
  EXPECT_EQ(of_nothing.files, 0);
  EXPECT_FALSE(of_nothing.started || of_nothing.crashed);
}

// A word that keeps its spelling and that gmsh takes for a variable would have an index that
// nothing guards: 8e8 bytes before its list lies no memory, so that the child crashes.
TEST(GeometryScript, KeepsNoCommandThatGmshTakesForAVariable) {
  boxes_of({"empty.geo", "\n"});  // gmsh is loaded before the forks
  const std::string far = "(-100000000)";
  const auto crashes = [](const std::vector<std::string>& scripts) {
    return traces_of([&] { std::for_each(scripts.begin(), scripts.end(), draw); }).crashed;
  };
  EXPECT_TRUE(crashes({"W() = {1}; W" + far + " = 1;\n"}));
  for (const std::string& word : geometry_script_commands()) {
    const std::string list = word + "() = {1};\n" + word;
    std::vector<std::string> scripts;
    for (const std::string& script :
         {list + far + " = 1;", list + far + "++;",
          word + "[] = {1}; " + word + "[-100000000] = 1;",
          word + " += {1}; x = " + word + far + ";", word + " = 1; x = {" + word + far + "};",
          "For i In {1:2}\n" + list + far + " = i;\nEndFor",
          "For " + word + " In {1:2}\n" + word + far + " = 1;\nEndFor",
          "DefineConstant[ " + word + "() = {1} ]; " + word + far + " = 1;"})
      if (refusal(script).empty()) scripts.push_back(geometry_script(script));
    EXPECT_FALSE(crashes(scripts)) << word;
  }
}

class RandomScripts {
 public:
  explicit RandomScripts(unsigned seed) : random_(seed) {}

  /// Statements, some of them changed: a token taken away, doubled, replaced or put in.
  std::string changed_statements() {
    std::string script = "a = 1; b() = {1, 2, 3}; p = newp;\n";
    for (int k = below(6) + 1; k > 0; --k) {
      std::vector<std::string> tokens = split(one_of(statements_));
      for (int changes = below(3); changes > 0 && !tokens.empty(); --changes) {
        const auto at = tokens.begin() + below(static_cast<int>(tokens.size()));
        switch (below(4)) {
          case 0:
            tokens.erase(at);
            break;
          case 1:
            tokens.insert(at, *at);
            break;
          case 2:
            *at = any_token();
            break;
          default:
            tokens.insert(at, any_token());
        }
      }
      for (const std::string& token : tokens) script += token + (below(8) == 0 ? "\n" : " ");
      script += '\n';
    }
    return script;
  }

  /// Words that are accepted, in any order, brackets in pairs.
  std::string accepted_words() {
    std::string script = "a = 1; b() = {1, 2, 3}; Merge = 1; SystemCall() = {1};\n", open;
    for (int k = below(40) + 2; k > 0; --k) {
      if (!open.empty() && below(3) == 0) {
        script += open.back();
        open.pop_back();
      } else if (below(4) == 0) {
        const int kind = below(3);
        script += "([{"[kind];
        open += ")]}"[kind];
      } else {
        script += one_of(below(2) == 0 ? words_ : plain_);
      }
      script += below(12) == 0 ? " ;\n" : " ";
    }
    for (; !open.empty(); open.pop_back()) script += open.back();
    return script + " ;\n";
  }

 private:
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  const std::string& one_of(const std::vector<std::string>& all) {
    return all[below(static_cast<int>(all.size()))];
  }
  std::string any_token() {
    const int kind = below(3);
    return one_of(kind == 0 ? dangerous_ : kind == 1 ? words_ : plain_);
  }
  static std::vector<std::string> split(const std::string& statement) {
    std::istringstream in(statement);
    return {std::istream_iterator<std::string>(in), {}};
  }

  std::mt19937 random_;
  const std::vector<std::string> statements_ = {
      "Point ( 1 ) = { 0 , 0 , 0 } ;",
      "Point ( p ) = { a , b(1) , 0 , 0.1 } ;",
      "Line ( 1 ) = { 1 , p } ;",
      "Circle ( 3 ) = { 1 , 2 , p } ;",
      "Curve Loop ( 1 ) = { 1 , 2 , 3 } ;",
      "Plane Surface ( 1 ) = { 1 } ;",
      "Loop ( ) = { 1 , 2 } ; Loop ( -100000000 ) = 1 ;",
      "Boundary ( ) = { 1 } ; Boundary [ -100000000 ] = 1 ;",
      "c ( ) = Boundary { Surface { 1 } ; } ;",
      "b ( -100000000 ) = 1 ;",
      "a = b [ -100000000 ] ++ ;",
      "SetFactory ( \"OpenCASCADE\" ) ;",
      "Rectangle ( 1 ) = { 0 , 0 , 0 , 1 , a } ;",
      "Disk ( 2 ) = { 0 , 0 , 0 , 0.3 } ;",
      "BooleanUnion { Surface { 1 } ; Delete ; } { Surface { 2 } ; }",
      "c ( ) = Curve In BoundingBox { 0 , 0 , 0 , b() } ;",
      "Translate { a , 0 , 0 } { Duplicata { Surface { 1 } ; } }",
      "Delete { Curve { b() } ; }",
      "Coherence ;",
      "For i In { 1 : 3 }\nPoint ( i ) = { i , 0 , 0 } ;\nEndFor",
      "b ( 2 ) = a ? Sqrt ( 2 ) : Fabs ( -3 ) ;",
      "DefineConstant [ d = { 1 , Name \"marker\" } , e = 2 ] ;",
      "Geometry . Tolerance = 1e-8 ;",
      "Mesh . Algorithm = 6 ;",
      "Physical Curve ( \"marker\" ) = { 1 } ;",
      "Printf ( \"marker\" , a ) ;",
      "Field [ 1 ] = MathEval ;",
      "SystemCall \"touch marker\" ;",
      "Printf ( \"a\" ) > \"marker\" ;",
      "Save \"marker.msh\" ;",
      "Merge \"marker\" ;",
      "Macro M\nSystemCall \"touch marker\" ;\nReturn",
      "If ( a )\nPrint \"marker.png\" ;\nEndIf",
      "CreateDir \"marker\" ;"};
  const std::vector<std::string> dangerous_ = {"SystemCall",
                                               "\"touch marker\"",
                                               "System",
                                               "NonBlockingSystemCall",
                                               "Printf",
                                               ">",
                                               ">>",
                                               "\"marker\"",
                                               "Print",
                                               "Save",
                                               "Include",
                                               "Merge",
                                               "CreateDir",
                                               "OnelabRun",
                                               "ShapeFromFile",
                                               "Plugin",
                                               "StringToName",
                                               "Macro",
                                               "Call",
                                               "Return",
                                               "If",
                                               "EndIf",
                                               "Else",
                                               "General",
                                               ".",
                                               "Field",
                                               "View",
                                               "//",
                                               "/*",
                                               "*/",
                                               "\"",
                                               "'",
                                               "EndFor",
                                               "For"};
  const std::vector<std::string> plain_ = {
      "1",  "2",  "0.5", "1e3", "a",  "b",  "Merge", "SystemCall", ",",  ";", ":", "=",
      "+=", "-=", "*=",  "/=",  "++", "--", "+",     "-",          "*",  "/", "^", "?",
      "!",  "<",  ">",   "<=",  ">=", "==", "!=",    "&&",         "||", "~", "#", "..."};
  const std::vector<std::string> words_ = {"Point",
                                           "Line",
                                           "Curve",
                                           "Circle",
                                           "Ellipse",
                                           "Spline",
                                           "BSpline",
                                           "Bezier",
                                           "Wire",
                                           "Loop",
                                           "Plane",
                                           "Ruled",
                                           "Surface",
                                           "Rectangle",
                                           "Disk",
                                           "Volume",
                                           "Box",
                                           "Sphere",
                                           "Cylinder",
                                           "Cone",
                                           "Torus",
                                           "Wedge",
                                           "Translate",
                                           "Rotate",
                                           "Symmetry",
                                           "Dilate",
                                           "Affine",
                                           "Duplicata",
                                           "Extrude",
                                           "Layers",
                                           "Recombine",
                                           "Delete",
                                           "Recursive",
                                           "Coherence",
                                           "BooleanUnion",
                                           "BooleanIntersection",
                                           "BooleanDifference",
                                           "BooleanFragments",
                                           "In",
                                           "BoundingBox",
                                           "Boundary",
                                           "CombinedBoundary",
                                           "PointsOf",
                                           "newp",
                                           "newl",
                                           "newll",
                                           "news",
                                           "newsl",
                                           "newv",
                                           "newf",
                                           "newreg",
                                           "Pi",
                                           "Exp",
                                           "Log",
                                           "Sqrt",
                                           "Sin",
                                           "Cos",
                                           "Fabs",
                                           "Abs",
                                           "Fmod",
                                           "Min",
                                           "Max",

                                           "List",
                                           "LinSpace",
                                           "Unique",
                                           "SetFactory(\"OpenCASCADE\");",
                                           "Geometry.Tolerance"};
};

// Whatever is accepted, gmsh makes a drawing of it or complains. 16 scripts share a process; gmsh
// may crash on nonsense, which ends the 16 without a trace.
TEST(GeometryScript, OfRandomTokensLeavesNoFileAndStartsNoProcess) {
  boxes_of({"empty.geo", "\n"});  // gmsh is loaded before the forks
  int accepted = 0, crashes = 0;
  constexpr int batches = 48, in_a_batch = 16;
  for (int batch = 0; batch < batches; ++batch) {
    RandomScripts random(static_cast<unsigned>(batch));
    std::vector<std::string> scripts, originals;
    for (int tries = 0; scripts.size() < in_a_batch && tries < 2000; ++tries) {
      originals.push_back(batch % 2 == 0 ? random.changed_statements() : random.accepted_words());
      if (refusal(originals.back()).empty())
        scripts.push_back(geometry_script(originals.back()));
      else
        originals.pop_back();
    }
    accepted += static_cast<int>(scripts.size());
    const Traces traces = traces_of([&] { std::for_each(scripts.begin(), scripts.end(), draw); });
    crashes += traces.crashed ? 1 : 0;
    if (traces.files == 0 && !traces.started) continue;
    for (const std::string& original : originals)
      ADD_FAILURE() << "one of these left a trace:\n" << original;
  }
  EXPECT_EQ(accepted, batches * in_a_batch);
  EXPECT_LT(crashes, batches / 4) << "too few scripts were read to their end";
}

}  // namespace antilock::test::mesh_test::random_scripts_test
