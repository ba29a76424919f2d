// Bodies other than the unit square, from mesh files: each answer is known from one of the unit square, or from the
// library called directly.
#include <nlohmann/json.hpp>

#include "antilock/io/writers.hpp"
#include "antilock/mesh/layered.hpp"
#include "scenes/runner.hpp"
#include "support/bodies.hpp"
#include "support/scenes.hpp"

namespace antilock::test::bodies_test {
namespace {

/// A scene on the mesh, written beside it.
struct OnMesh {
  OnMesh(const TriangleMesh& mesh, const std::string& effects, const std::string& f, const std::string& element = "CR")
      : path((folder / "body.msh").string()) {
    write_msh(path, mesh);
    run.emplace("[load]\nf = \"" + f + "\"\n" + effects + "[mesh]\nkind = \"file\"\nfile = \"" + path +
                "\"\n[method]\nelement = \"" + element + "\"\n");
  }
  double energy() const { return run->summary()["energy"]; }

  TemporaryFolder folder;
  std::string path;
  std::optional<SceneRun> run;
};

TriangleMesh moved(TriangleMesh mesh, double factor, double along) {
  mesh.vertices *= factor;
  mesh.vertices.col(0).array() += along;
  return mesh;
}

TEST(Bodies, OfAnotherSizeScaleTheirAnswer) {
  // v(x) = s^2 u(x / s) solves the problem of the s times larger body: its energy is s^4 that of u
  const OnMesh one(structured_mesh(8, {0}), "[contact]\n", "10*sin(2*pi*x)");
  const OnMesh three(moved(structured_mesh(8, {0}), 3, 0), "[contact]\n", "10*sin(2*pi*x/3)");
  ASSERT_EQ(three.run->outcome.status, 0) << three.run->outcome.err;
  EXPECT_NEAR(three.energy(), 81 * one.energy(), 1e-8 * 81 * std::abs(one.energy()));
  EXPECT_EQ(three.run->summary()["warning"], "");
}

TEST(Bodies, ElsewhereHaveTheSameAnswer) {
  const std::string effects[] = {"[layer]\nepsilon = 1e-3\n[contact]\ngap = \"0.001\"\n",
                                 "[layer]\nepsilon = 0\nmodel = \"ventcel\"\n[contact]\n"};
  for (const bool ventcel : {false, true}) {
    const TriangleMesh mesh = structured_mesh(8, {ventcel ? 0.0 : 1.0});
    const OnMesh here(mesh, effects[ventcel], "10*sin(2*pi*x)");
    const OnMesh there(moved(mesh, 1, -7), effects[ventcel], "10*sin(2*pi*(x + 7))");
    ASSERT_EQ(there.run->outcome.status, 0) << there.run->outcome.err;
    EXPECT_NEAR(there.energy(), here.energy(), 1e-8 * std::abs(here.energy())) << ventcel;
  }
}

TEST(Bodies, OfAnyShapeAreWhatTheLibrarySolves) {
  const Scene scene(Body{paper_load}, StiffLayer{1e-3}, UnilateralContact{});
  const std::string effects = "[layer]\nepsilon = 1e-3\n[contact]\n";
  for (const TriangleMesh& body : {l_shape(8), bridge(8)}) {
    const TriangleMesh mesh = extruded(body, 1e-3);
    const OnMesh file(mesh, effects, "10*sin(2*pi*x)");
    ASSERT_EQ(file.run->outcome.status, 0) << file.run->outcome.err;
    const Space space(mesh, crouzeix_raviart());
    const Solution direct = active_set(assemble(scene, space));
    EXPECT_NEAR(file.run->summary()["u_max"].get<double>(), direct.u.maxCoeff(), 1e-9);
    EXPECT_NEAR(file.run->summary()["u_min"].get<double>(), direct.u.minCoeff(), 1e-9);
  }
}

TEST(Bodies, OnTwoFeetHaveNoVentcelLayer) {
  const OnMesh file(bridge(8), "[layer]\nepsilon = 0\nmodel = \"ventcel\"\n", "1");
  EXPECT_EQ(file.run->outcome.status, 2);
  EXPECT_NE(file.run->outcome.err.find("one piece"), std::string::npos) << file.run->outcome.err;
}

TEST(Bodies, ALayerThatDoesNotFillTheStripBelowIsRefused) {
  TriangleMesh mesh = structured_mesh(8, {0.5});
  const OnMesh file(mesh, "[layer]\nepsilon = 1e-3\n", "1");
  EXPECT_EQ(file.run->outcome.status, 2);
  EXPECT_NE(file.run->outcome.err.find("accepted for this scene: the strip"), std::string::npos)
      << file.run->outcome.err;
}

}  // namespace
}  // namespace antilock::test::bodies_test
