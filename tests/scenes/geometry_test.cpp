// The geometry that a scene names, and the files that lie beside its mesh: which are read, and that
// none is run.
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "scenes/runner.hpp"
#include "support/temporary_folder.hpp"

namespace antilock::test::geometry_test {

/// A folder with body.msh, the unit square, and files beside it.
class Beside {
 public:
  Beside() { write_msh(folder / "body.msh", structured_mesh(2, {0})); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
  }
  /// A scene beside body.msh, its section [mesh] continued by `more`.
  SceneRun run(const std::string& more, const std::string& name = "body.msh") const {
    const auto path = [&](const std::string& file) { return (folder / file).string(); };
    std::string mesh = more;
    if (const auto at = mesh.find("geometry = \""); at != mesh.npos)
      mesh.insert(at + 12, folder.path().string() + "/");
    return SceneRun("[load]\nf = \"10\"\n[mesh]\nkind = \"file\"\nfile = \"" + path(name) + "\"\n" +
                    mesh);
  }
  bool marked() const { return std::filesystem::exists(folder / "marker"); }
  /// A command of gmsh that leaves a file.
  std::string command() const {
    return "SystemCall \"touch " + (folder / "marker").string() + "\";\n";
  }

  TemporaryFolder folder;
};

const std::string square =
    "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};\n"
    "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n";
const std::string refined = "refinements = 1\n", accurate = "[method]\naccuracy = 0.2\n";

TEST(Geometry, ThatTheSceneDoesNotNameIsNotReadAndWarnedOf) {
  const Beside beside;
  for (const std::string file : {"body.geo", "body.brep"}) {
    std::filesystem::remove(beside.folder / "body.geo");
    beside.write(file, beside.command() + square);
    for (const std::string& asked : {refined, accurate}) {
      const std::string warning = beside.run(asked).summary()["warning"];
      EXPECT_NE(
          warning.find("mesh.geometry: " + file + " lies beside the mesh file and was not read"),
          std::string::npos)
          << warning;
      EXPECT_NE(warning.find("geometry = \""), std::string::npos) << warning;
    }
    EXPECT_EQ(beside.run("").summary()["warning"], "") << "nothing is refined";
    EXPECT_FALSE(beside.marked());
  }
}

TEST(Geometry, OfASceneIsNamedRelativeToIt) {
  const TemporaryFolder folder, results;
  std::filesystem::create_directory(folder / "meshes");
  write_msh(folder / "meshes/body.msh", structured_mesh(2, {0}));
  std::ofstream(folder / "meshes/body.geo") << square;
  const std::string scene =
      "[load]\nf = \"10\"\n[mesh]\nkind = \"file\"\nfile = \"meshes/body.msh\"\nrefinements = 1\n";
  const std::string run =
      in_shell((folder / "scene.toml").string()) + " --out " + in_shell(results.path().string());
  const auto summary = [&] { return nlohmann::json::parse(contents(results / "summary.json")); };

  std::ofstream(folder / "scene.toml") << scene;
  EXPECT_EQ(run_scene(run, results).status, 0);
  const std::string warning = summary()["warning"], key = "geometry = \"meshes/body.geo\"";
  EXPECT_NE(warning.find(key), std::string::npos) << warning;
  // the key of the warning, put in
  std::ofstream(folder / "scene.toml") << scene << key << "\n";
  EXPECT_EQ(run_scene(run, results).status, 0);
  EXPECT_EQ(summary()["warning"], "");
  EXPECT_EQ(summary()["scene"]["mesh"]["geometry"], "meshes/body.geo");
}

TEST(Geometry, WithACommandIsRefusedByNameAndLineAndNothingIsRun) {
  const Beside beside;
  for (const std::string& asked : {std::string(), refined, accurate}) {
    beside.write("body.geo", square + beside.command());
    expect_no_answer(beside.run("geometry = \"body.geo\"\n" + asked),
                     "body.geo: line 3: SystemCall: ");
    beside.write("body.geo", square + "For i In {1:2}\n" + beside.command() + "EndFor\n");
    expect_no_answer(beside.run("geometry = \"body.geo\"\n" + asked),
                     "body.geo: line 4: SystemCall: ");
    beside.write("body.geo",
                 "Macro Draw\n" + beside.command() + "Return\n" + square + "Call Draw;\n");
    expect_no_answer(beside.run("geometry = \"body.geo\"\n" + asked), "body.geo: line 1: Macro: ");
    EXPECT_FALSE(beside.marked());
  }
}

TEST(Geometry, IsReadWithoutWhatLiesBesideIt) {
  const Beside beside;
  beside.write("body.geo", square);
  for (const std::string name : {"body.geo.opt", "body.msh.opt", "body.opt", ".gmshrc", "gmshrc"})
    beside.write(name, beside.command());
  EXPECT_EQ(beside.run("geometry = \"body.geo\"\n" + refined).summary()["warning"], "");
  std::filesystem::create_symlink(beside.folder / "body.geo", beside.folder / "link.geo");
  beside.write("link.geo.opt", beside.command());
  EXPECT_EQ(beside.run("geometry = \"link.geo\"\n" + refined).summary()["warning"], "");
  EXPECT_FALSE(beside.marked());
}

TEST(Geometry, IsNoScriptUnderAnotherName) {
  const Beside beside;
  beside.write("body.brep", beside.command() + square);
  expect_no_answer(beside.run("geometry = \"body.brep\"\n" + refined),
                   "body.brep: OpenCASCADE finds no shape in it");
  for (const std::string name :
       {"body.step", "body.geo.gz", "body.py", "body.geo_unrolled", "body.GEO", "body"}) {
    beside.write(name, beside.command() + square);
    expect_no_answer(beside.run("geometry = \"" + name + "\"\n" + refined), "mesh.geometry: ");
  }
  beside.write("script.msh", beside.command() + square);
  expect_no_answer(beside.run(refined, "script.msh"), "mesh.file: ");
  EXPECT_FALSE(beside.marked());
}

TEST(Geometry, ThatIsNotThereOrNoFileIsRefused) {
  const Beside beside;
  std::filesystem::create_directory(beside.folder / "folder.geo");
  ASSERT_EQ(::mkfifo((beside.folder / "pipe.geo").c_str(), 0600), 0);
  std::filesystem::create_symlink("nowhere", beside.folder / "link.geo");
  for (const std::string name : {"absent.geo", "absent.brep", "link.geo"})
    expect_no_answer(beside.run("geometry = \"" + name + "\"\n"), name + ": cannot be opened");
  for (const std::string name : {"folder.geo", "pipe.geo"})
    expect_no_answer(beside.run("geometry = \"" + name + "\"\n"),
                     name + ": is a folder, a device or a pipe");
}

TEST(Geometry, GoesWithAMeshFileAndOneProcess) {
  const std::string load = "[load]\nf = \"10\"\n[mesh]\n";
  expect_no_answer(SceneRun(load + "kind = \"structured\"\ncells = 4\ngeometry = \"body.geo\"\n"),
                   "mesh.geometry: goes with a mesh file only");
  for (const std::string value : {"1", "\"\"", "\"a\\u0000.geo\""})
    expect_no_answer(
        SceneRun(load + "kind = \"file\"\nfile = \"body.msh\"\ngeometry = " + value + "\n"),
        "mesh.geometry: is ");
  const Beside beside;
  beside.write("body.geo", square);
  expect_no_answer(beside.run("geometry = \"body.geo\"\n[method]\nsolver = \"petsc\"\n"),
                   "mesh.geometry: does not go with solver = \"petsc\"");
}

TEST(Geometry, OfAnotherBodyIsRefused) {
  const Beside beside;
  beside.write("body.geo", square + "Delete { Curve{3}; }\n");
  for (const std::string& asked : {std::string(), refined, accurate})
    expect_no_answer(beside.run("geometry = \"body.geo\"\n" + asked),
                     "body.geo: no curve of it holds the edge");
  beside.write("body.geo", square + "\nLine(5) = {3 4};\n");
  expect_no_answer(beside.run("geometry = \"body.geo\"\n"), "body.geo', line 4: syntax error");
}

}  // namespace antilock::test::geometry_test
