// Files as other programs write them, given to run_scene and antilock: what is meant is read, and a
// refusal names the file, the line and what was found. The comment of each test has the public
// report that the case was made from, by repository and number; nothing was copied.
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "antilock/mesh/write_msh.hpp"
#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::foreign_files_test {

/// A folder with files of a user's, and what the programs say of them.
class ForeignFiles : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::string file(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
    return in_shell(path(name));
  }
  Outcome solve(const std::string& scene, const std::string& out = "out") {
    return run_scene(file("scene.toml", scene) + " --out " + in_shell(path(out)), log);
  }
  nlohmann::json summary(const std::string& scene, const std::string& out = "out") {
    const Outcome outcome = solve(scene, out);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.status == 0 ? nlohmann::json::parse(contents(folder / out / "summary.json"))
                               : nlohmann::json();
  }
  void refused(const Outcome& outcome, const std::vector<std::string>& words) {
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << ": " << outcome.err;
  }
  TemporaryFolder folder, log;
};

/// The unit square, `k` times as large and moved by x0.
TriangleMesh block(int cells, double k, double x0 = 0) {
  TriangleMesh mesh = structured_mesh(cells, {0});
  mesh.vertices *= k;
  mesh.vertices.col(0).array() += x0;
  return mesh;
}

std::string block_scene(double k, double x0, const std::string& more = "") {
  return fmt::format(
      "[load]\nf = \"-20*(y/{0})/{0}\"\n[contact]\ngap = \"0.01*(x - {1})\"\n{2}[mesh]\nkind = "
      "\"file\"\nfile = "
      "\"block.msh\"\n",
      k, x0, more);
}

// feelpp #1198, moose #5249, smoothMesh #31: tolerances that do not know the size of the
// mesh. u(x) = k U(x / k) solves the problem of the k times larger block, whatever the unit of
// length is.
TEST_F(ForeignFiles, LengthsMayHaveAnyUnit) {
  write_msh(path("block.msh"), block(8, 1));
  const double one = summary(block_scene(1, 0))["u_min"];
  EXPECT_LT(one, -0.001);
  for (const double k : {1e-9, 1e-7, 1e-5, 1e-3, 1e3, 1e9}) {
    write_msh(path("block.msh"), block(8, k));
    const auto found = summary(block_scene(k, 0));
    EXPECT_NEAR(found["u_min"].get<double>() / k, one, 1e-9 * std::abs(one))
        << k;  // both are solved to 1e-10
    EXPECT_EQ(found["warning"], "") << k;
  }
}

TEST_F(ForeignFiles, ABlockMayLieAnywhere) {
  write_msh(path("block.msh"), block(8, 1));
  const std::string at = "[at]\npoints = [[{}, 0.5], [{}, 0]]\n";
  const auto one = summary(block_scene(1, 0) + fmt::format(fmt::runtime(at), 0.3, 1.0));
  for (const double x0 : {450000.125, 1e6, -0.5}) {
    write_msh(path("block.msh"), block(8, 1, x0));
    const auto found =
        summary(block_scene(1, x0) + fmt::format(fmt::runtime(at), x0 + 0.3, x0 + 1));
    // a coordinate near 1e6 has 10 digits behind the point, and an edge, 1/8 long, nine
    EXPECT_NEAR(found["u_min"].get<double>(), one["u_min"].get<double>(), 1e-8);
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(found["at"][i]["u"].get<double>(), one["at"][i]["u"].get<double>(), 1e-8) << x0;
  }
}

// The same, with a layer that grows below the block: s = stiffness thickness stands before a_x and
// s / thickness^2 before a_y, so that a thickness k times as large makes u(x) = k U(x / k) in the
// layer, too.
TEST_F(ForeignFiles, ALayerBelowABlockOfAnyUnit) {
  const auto scene = [](double k, const std::string& element) {
    return block_scene(
        k, 0,
        fmt::format("[layer]\nthickness = {}\nstiffness = 3\n[method]\nelement = \"{}\"\n", 0.1 * k,
                    element));
  };
  for (const std::string element : {"P1", "CR"}) {
    write_msh(path("block.msh"), block(8, 1));
    const double one = summary(scene(1, element))["u_min"];
    for (const double k : {1e-7, 1e-4}) {
      write_msh(path("block.msh"), block(8, k));
      EXPECT_NEAR(summary(scene(k, element))["u_min"].get<double>() / k, one, 1e-8 * std::abs(one))
          << k << element;
    }
  }
}

// What is wrong with a mesh is as wrong in another unit: at 1e-9 all of it was within the
// tolerance.
TEST_F(ForeignFiles, AFaultIsSeenInAnyUnit) {
  for (const double k : {1e-9, 1.0, 1e9}) {
    TriangleMesh mesh = block(8, k);
    for (int e = 0; e < mesh.edge_count(); ++e)
      if (mesh.edge_tag[e] == EdgeTag::contact &&
          mesh.vertices(mesh.edges.row(e), 0).minCoeff() > 0.4 * k)
        mesh.edge_tag[e] = EdgeTag::clamped;
    write_msh(path("block.msh"), mesh);
    refused(solve(block_scene(k, 0)), {"mesh.file", "of the body's bottom edge"});
    mesh = block(8, k);
    mesh.vertices.col(1).array() += 0.01 * k;
    write_msh(path("block.msh"), mesh);
    refused(solve(block_scene(k, 0, "[layer]\nthickness = 1e-9\nstiffness = 3\n")), {"mesh.file"});
    write_msh(path("block.msh"), block(8, k));
    std::string hidden = block_scene(k, 0);
    hidden.replace(hidden.find("0.01*(x"), 7, fmt::format("0.01*(x - {}", 0.1 * k));
    refused(solve(hidden), {"contact.gap"});  // below the clamp by a thousandth of the length
  }
}

// meshio #281, elmerfem #923, meshlab #1582, medcoupling #14: names of
// groups, files and folders in any script.
TEST_F(ForeignFiles, NamesThatAreNotAsciiAreShown) {
  std::filesystem::create_directories(folder / "Ordner ä 网");
  std::string mesh;
  {
    write_msh(path("block.msh"), block(4, 1));
    mesh = contents(folder / "block.msh");
    mesh.replace(mesh.find("\"clamped\""), 9, "\"上面 🙂\"");
  }
  file("Ordner ä 网/梁 ü.msh", mesh);
  const auto scene = [](const std::string& group, const std::string& mesh_file) {
    return "title = \"Prüfung Ω\"\n[load]\nf = \"-1\"\n[contact]\ngap = \"0.1\"\n[[edge]]\ngroup = "
           "\"" +
           group + "\"\ndisplacement = \"0\"\n[mesh]\nkind = \"file\"\nfile = \"" + mesh_file +
           "\"\n";
  };
  const Outcome outcome = solve(scene("上面 🙂", "Ordner ä 网/梁 ü.msh"), "Ergebnis Ω");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Prüfung Ω"), std::string::npos) << outcome.out;
  refused(solve(scene("上边", "Ordner ä 网/梁 ü.msh")), {"梁 ü.msh", "上边", "上面 🙂"});
  refused(solve(scene("上面 🙂", "梁.msh")), {"梁.msh"});
  refused(solve("\"Körper\" = 1\n"), {"Körper: unknown key"});
  refused(solve("[load]\nf = \"1 + Δ\"\n[mesh]\nkind = \"structured\"\ncells = 4\n"),
          {"\"1 + Δ\"", "\"Δ\" is not expected"});
  refused(run_scene("'存在しない.toml' --out " + in_shell(path("out")), log),
          {"存在しない.toml: file: cannot be opened"});
  refused(run_antilock("truth 'Fläche.toml' < /dev/null", log), {"Fläche.toml"});
}

// numpy #18861, dbt-core #1177, kukur #279: Excel's "CSV UTF-8" begins with a byte order mark. Its
// relatives: quotes around a name (R), blanks, tabs, a plus sign, Windows' ends of lines.
TEST_F(ForeignFiles, TablesAsSpreadsheetsWriteThem) {
  const std::string scene = file("s.toml",
                                 "\xef\xbb\xbf[load]\nf = \"10*sin(2*pi*x)\"\n[layer]\nepsilon = "
                                 "1e-3\n[contact]\n[mesh]\nkind = \"structured\"\ncells = 4\n");
  const auto ask = [&](const std::string& points) {
    return run_antilock("truth " + scene + " < " + file("p.csv", points), log);
  };
  const std::string told = ask("x,y\n0.25,-1\n").out;
  ASSERT_EQ(std::count(told.begin(), told.end(), '\n'), 2);
  for (const std::string points :
       {"\xef\xbb\xbfx,y\r\n0.25,-1\r\n", "\"x\",\"y\"\n0.25,-1\n", "x, y\n\t.25 ,\t-1.\n",
        "x,y\n+2.5E-01,-1e0", "\xef\xbb\xbf\"x\",\"y\"\r\n\r\n\"0.25\",\"-1\"\r\n"}) {
    const Outcome outcome = ask(points);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, told) << points;
  }
  // which number a comma ends cannot be told, nor which columns a table without names has
  const std::string accepted = "accepted: the header x,y, then";
  refused(ask("x;y\n0,25;-1\n"),
          {"standard input: line 1: the header is \"x;y\" with semicolons", accepted});
  refused(ask("x\ty\n0.25\t-1\n"), {"with tabs", accepted});
  refused(ask("# x,y\n0.25,-1\n"), {"the header is \"# x,y\" behind a \"#\"", accepted});
  refused(ask("0.25,-1\n"), {"the header is \"0.25,-1\", which is no header but a row", accepted});
  refused(ask("y,x\n-1,0.25\n"), {"the header is \"y,x\"; ", accepted});
  refused(ask("x,y\n\n0.25,+-1\n"), {"line 3: \"+-1\" is no finite number"});
  refused(ask("x,y\n\"0,25\",-1\n"), {"line 2: \"0,25\" is no finite number"});
  refused(ask("x,y\ninf,-1\n"), {"line 2: \"inf\" is no finite number"});
  refused(ask(std::string("\xff\xfe") + std::string("x\0,\0y\0\n\0", 8)),
          {"standard input: is text in UTF-16"});
}

// The same reports: what PowerShell redirects and what an editor saves as "Unicode" is UTF-16.
TEST_F(ForeignFiles, ScenesInUtf16AreNamed) {
  std::string wide = "\xff\xfe";
  for (const char c : std::string("[load]\nf = \"1\"\n")) wide += {c, '\0'};
  for (const std::string& scene : {wide, wide.substr(2)})
    refused(solve(scene), {"scene.toml: syntax: is text in UTF-16 or UTF-32; accepted: UTF-8"});
}

// tigl #254, preCICE #779, pyvista #6355: << of C++ and of FreeFEM write six digits.
TEST_F(ForeignFiles, TablesOfSixDigitsAreJudgedOrTheirDigitsNamed) {
  const TriangleMesh mesh = unstructured_mesh(16);
  write_msh(path("mesh.msh"), mesh);
  const std::string scene = file("scene.toml",
                                 "[load]\nf = \"10*sin(2*pi*x)\"\n[layer]\nepsilon = "
                                 "1e-1\n[contact]\n[mesh]\nkind = \"structured\"\ncells = 4\n");
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    const Eigen::VectorXd u = active_set(stiff_problem(space, 0.1)).u;
    const auto judge = [&](int digits) {
      std::string table = "x,y,u\n";
      for (int i = 0; i < space.size(); ++i)
        table += fmt::format("{0:.{3}g},{1:.{3}g},{2:.{3}g}\n", space.dof_coordinates()(i, 0),
                             space.dof_coordinates()(i, 1), u(i), digits);
      return run_antilock("judge " + scene + " " + in_shell(path("mesh.msh")) + " " +
                              file("u.csv", table) + " --accuracy 0.3 --json " +
                              in_shell(path("judged.json")),
                          log);
    };
    const auto error = [&](int digits) {
      const Outcome outcome = judge(digits);
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      const bool named =
          outcome.out.find(fmt::format("coordinates of {} digits", digits)) != std::string::npos;
      EXPECT_TRUE(digits == 6 ? named : digits == 7 || !named) << digits << ": " << outcome.out;
      return nlohmann::json::parse(contents(folder / "judged.json"))["errors"]["energy"]
          .get<double>();
    };
    const double exact = error(17);
    for (const int digits :
         {9, 7,
          6})  // what is cut off from u shows in its slope, h = 1/16 and epsilon = 1/10 as long
      EXPECT_NEAR(error(digits), exact, 160 * std::pow(10, -digits)) << element->name();
    for (const int digits : {4, 3})
      refused(judge(digits),
              {"u.csv: the coordinates have", "digits, which place row", "digits or more"});
    refused(judge(1), {"that fit neither"});
  }
}

std::string coordinate_matrix(int rows, int columns,
                              const std::vector<std::array<double, 3>>& entries) {
  std::string text = fmt::format("%%MatrixMarket matrix coordinate real general\n{} {} {}\n", rows,
                                 columns, entries.size());
  for (const auto& [i, j, value] : entries) text += fmt::format("{} {} {}\n", i + 1, j + 1, value);
  return text;
}

/// A string of eight unknowns, both ends held; the first three differences become stiff. Pushed
/// down, up at unknown 2.
class ForeignBounds : public ForeignFiles {
 protected:
  static constexpr int n = 8;
  ForeignBounds() {
    std::vector<std::array<double, 3>> a, b, load;
    for (int i = 0; i < n; ++i) {
      for (int j = std::max(0, i - 1); j <= std::min(n - 1, i + 1); ++j)
        a.push_back({double(i), double(j), i == j ? 2.0 : -1.0});
      load.push_back({double(i), 0, i == 2 ? 3.0 : -1.0});
    }
    for (int i = 0; i < 3; ++i)
      b.insert(b.end(), {{double(i), double(i), 1.0}, {double(i), i + 1.0, -1.0}});
    file("A.mtx", "\xef\xbb\xbf" + coordinate_matrix(n, n, a));
    file("B.mtx", coordinate_matrix(3, n, b));
    file("M.mtx", "%%MatrixMarket matrix array real general\n3 1\n1\n1\n1\n");
    file("L.mtx", coordinate_matrix(n, 1, load));
    file("fixed.csv", "unknown,value\n0,0\n7,0\n");
  }
  Outcome check(const std::string& bounds) {
    std::string words = "lockcheck";
    for (const char* name : {"A.mtx", "B.mtx", "M.mtx", "L.mtx"})
      words += " " + in_shell(path(name));
    return run_antilock(words + " --fixed " + in_shell(path("fixed.csv")) + " --bounds " +
                            file("bounds.csv", bounds) + " --out " + in_shell(path("out.csv")),
                        log);
  }
  /// u and lambda at each compliance.
  Eigen::MatrixXd answers(const std::string& bounds) {
    const Outcome outcome = check(bounds);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.status == 0 ? read_csv(folder / "out.csv").rows.rightCols(2).eval()
                               : Eigen::MatrixXd();
  }
};

// slsqp #37, OpenMDAO1 #427, moose #14136: no bound is written as an infinity, as
// the largest double, or as a number that is customary (1e20, 1e30).
TEST_F(ForeignBounds, NoBoundHasManyNames) {
  const Eigen::MatrixXd wanted = answers("unknown,lower,upper\n2,-1000,0.25\n3,-0.5,1000\n");
  EXPECT_NEAR(wanted(2, 0), 0.25,
              1e-12);  // both bounds hold at compliance 1, or the test tells nothing
  EXPECT_NEAR(wanted(3, 0), -0.5, 1e-12);
  for (const std::string none : {"1e20", "1e30", "3.4028234663852886e38", "1e39", "1e40", "1e300",
                                 "1.7976931348623157e308", "inf", "Infinity", "+INF"}) {
    const std::string minus = none.starts_with('+') ? none.substr(1) : none;
    const Eigen::MatrixXd found = answers("unknown,lower,upper\n2,-" + minus + ",0.25\n3,-0.5," +
                                          none + "\n5,-" + minus + "," + none + "\n");
    ASSERT_EQ(found.size(), wanted.size()) << none;
    EXPECT_LE((found - wanted).cwiseAbs().maxCoeff(), 1e-9)
        << none;  // both are solved to 1e-10 of u, and lambda is of its size
  }
  const Eigen::MatrixXd one_sided = answers("unknown,lower\n3,-0.5\n"),
                        infinite = answers("unknown,lower,upper\n3,-0.5,inf\n");
  EXPECT_EQ(one_sided, infinite);
}

// 4C #947, conmech #35, osqp #256: a held unknown among the bounds, an unknown twice, sides that
// cross. The file and the line are named, and bounds that hold the prescribed value are none.
TEST_F(ForeignBounds, RefusalsNameTheFileAndTheLine) {
  EXPECT_EQ(answers("unknown,lower\n0,-0.5\n3,-0.5\n7,0\n"), answers("unknown,lower\n3,-0.5\n"));
  refused(check("unknown,lower\n3,-0.5\n0,0.25\n"),
          {"bounds.csv: line 3: unknown 0 is bounded from 0.25 to inf, but fixed at 0; accepted: "
           "bounds that hold"});
  refused(check("unknown,lower\n3,-0.5\n\n3,-0.25\n"),
          {"bounds.csv: line 4: unknown 3 for the second time"});
  refused(check("unknown,lower,upper\n3,0.5,-0.5\n"),
          {"bounds.csv: line 2: unknown 3 is bounded from 0.5 to -0.5; accepted: lower <= upper"});
  refused(check("unknown,lower,upper\n3,inf,inf\n"),
          {"bounds.csv: line 2: unknown 3 is bounded from inf to inf"});
  refused(check("unknown,lower\n3,nan\n"), {"bounds.csv: line 2: \"nan\" is no number"});
  refused(check("unknown,lower\n8,0\n"),
          {"bounds.csv: line 2: unknown 8; accepted: whole numbers from 0 to 7"});
  refused(check("unknown,lower\ninf,0\n"),
          {"bounds.csv: line 2: unknown inf; accepted: whole numbers"});
  refused(check("unknown,upper\n3,0\n"),
          {"bounds.csv: line 1", "accepted: the header unknown,lower or unknown,lower,upper"});
  file("fixed.csv", "unknown,value\n0,0\n0,0\n7,0\n");
  refused(check("unknown,lower\n3,-0.5\n"), {"fixed.csv: line 3: unknown 0 for the second time"});
  file("fixed.csv", "unknown,value\n0,inf\n7,0\n");
  refused(check("unknown,lower\n3,-0.5\n"), {"fixed.csv: line 2: \"inf\" is no finite number"});
}

}  // namespace antilock::test::foreign_files_test
