// Two bodies of one mesh file.
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "antilock/mesh/read_msh.hpp"
#include "antilock/mesh/two_bodies.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "antilock/models/two_bodies.hpp"
#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::two_bodies_test {

const std::string mesh_file = EXAMPLE_SCENES "/two_bodies.msh";
const std::string sides = "slave = \"top of the block\"\nmaster = \"below the layer\"\n";

/// The scene two_bodies.toml with other lines in [contact] and [method], and another epsilon.
std::string scene(const std::string& contact, const std::string& method,
                  const std::string& epsilon = "1e-6") {
  return fmt::format(
      "[load]\nf = \"y > 0 ? -10 : 0\"\n[layer]\nepsilon = {}\n[contact]\n{}[mesh]\n"
      "kind = \"file\"\nfile = \"{}\"\n[method]\n{}",
      epsilon, contact, mesh_file, method);
}

TEST(TwoBodyScenes, AreWhatTheLibrarySolves) {
  ExtraGroups groups;
  groups.curves = {{"top of the block", natural_group(0)}, {"below the layer", natural_group(1)}};
  groups.needs_contact = false;
  const TriangleMesh mesh = read_msh(mesh_file, groups);
  const Scene direct({[](double, double y) { return y > 0 ? -10 : 0; }}, StiffLayer{1e-6}, {},
                     {{"top of the block"}, {"below the layer"}});
  for (const bool nodes : {false, true}) {
    TwoBodyContact contact{natural_group(0), natural_group(1),
                           [](double x, double) { return 0.1 * x; }};
    if (nodes) contact.method = InterfaceMethod::node_to_segment;
    const Space space(mesh, crouzeix_raviart());
    const VariationalInequality problem = assemble(direct, contact, space);
    const Solution solution = active_set(problem);
    const Eigen::MatrixX3d table =
        interface_table(interface_constraints(space, contact.slave, contact.master, contact.method),
                        problem.bounds, solution.u, solution.lambda);
    const SceneRun run(
        scene(sides + "gap = \"0.1*x\"\n" + (nodes ? "method = \"node to segment\"\n" : ""),
              "element = \"CR\"\n"));
    const auto summary = run.summary();
    EXPECT_EQ(summary["u_min"].get<double>(), solution.u.minCoeff());
    EXPECT_NEAR(summary["contact_force"]["normal"].get<double>(), solution.lambda.sum(), 1e-12);
    EXPECT_EQ(summary["contact"]["points"].get<Eigen::Index>(), table.rows());
    EXPECT_GT(summary["contact"]["active"].get<int>(), 0);
    EXPECT_LT(summary["contact"]["active"].get<Eigen::Index>(), table.rows());
    EXPECT_EQ(summary["effects"], nlohmann::json({"layer", "contact"}));
    const Csv contact_file = read_csv(run.results / "contact.csv");
    EXPECT_EQ(contact_file.header, "x,gap,pressure");
    EXPECT_LT((contact_file.rows - table).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_TRUE(std::filesystem::exists(run.results / "solution.vtu"));
  }
}

TEST(TwoBodyScenes, TheMomentIsThatOfTheForcesOnTheUpperBody) {
  ExtraGroups groups;
  groups.curves = {{"top of the block", natural_group(0)}, {"below the layer", natural_group(1)}};
  groups.needs_contact = false;
  const Space space(read_msh(mesh_file, groups), p1());
  const Scene direct({[](double, double y) { return y > 0 ? -10 : 0; }}, StiffLayer{1}, {},
                     {{"top of the block"}, {"below the layer"}});
  const TwoBodyContact contact{natural_group(0), natural_group(1),
                               [](double x, double) { return 0.1 * x; }};
  const VariationalInequality problem = assemble(direct, contact, space);
  const Eigen::VectorXd force =
      bound_forces(problem.bounds, active_set(problem).lambda, space.size());
  const TriangleMesh& mesh = space.mesh();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(space.size());  // and 0 in the lower body
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3i corners = mesh.triangles.row(t);
    const double sum_of_y =
        mesh.vertices(corners(0), 1) + mesh.vertices(corners(1), 1) + mesh.vertices(corners(2), 1);
    if (sum_of_y > -3)
      for (const int unknown : space.cell_dofs().row(t))
        x(unknown) = space.dof_coordinates()(unknown, 0);
  }
  const SceneRun run(scene(sides + "gap = \"0.1*x\"\n", "element = \"P1\"\n", "1"));
  const auto contact_force = run.summary()["contact_force"];
  EXPECT_GT(contact_force["normal"].get<double>(), 0);
  EXPECT_NEAR(contact_force["moment"].get<double>(), force.dot(x), 1e-12);
}

TEST(TwoBodyScenes, WarnOfALayerThatLocks) {
  const auto locks = [](const std::string& element, const std::string& epsilon) {
    const SceneRun run(scene(sides, "element = \"" + element + "\"\n", epsilon));
    const std::string warning = run.summary()["warning"];
    return warning.find("locks") != warning.npos;
  };
  EXPECT_TRUE(locks("P1", "1e-6"));
  EXPECT_TRUE(locks("P1", "0"));
  EXPECT_FALSE(locks("P1", "1"));
  EXPECT_FALSE(locks("CR", "1e-6"));
}

TEST(TwoBodyScenes, WithAMistakeAreRefusedInOneLine) {
  const auto refused = [](const std::string& text, const std::string& says) {
    expect_no_answer(SceneRun(text), says);
  };
  refused(scene("slave = \"top of the block\"\n", ""), "contact.master: is missing");
  refused(scene("master = \"below the layer\"\n", ""), "contact.slave: is missing");
  refused(scene("slave = \"below the layer\"\nmaster = \"below the layer\"\n", ""),
          "contact.master: \"below the layer\" has its condition already");
  refused(scene("slave = \"clamped\"\nmaster = \"below the layer\"\n", ""),
          "contact.slave: \"clamped\" has its condition already");
  refused(scene("slave = \"top of the block\"\nmaster = \"bottom\"\n", ""),
          "unknown curve group \"below the layer\"");
  refused(scene(sides + "method = \"penalty\"\n", ""), "contact.method: \"penalty\" is unknown");
  refused(scene(sides + "ceiling = \"1\"\n", ""), "contact.ceiling: does not go with two bodies");
  refused(scene(sides, "element = \"P2\"\n"), "method.element: \"P2\" does not go with two bodies");
  refused(scene(sides, "accuracy = 0.1\n"), "method.accuracy: an accuracy does not go with");
  refused(scene(sides, "solver = \"petsc\"\n"), "method.solver: does not go with edges in named");
  refused(scene(sides + "gap = \"1/(x - x)\"\n", ""), "contact.gap: ");
  refused(scene(sides, "[model]\nkind = \"plane strain\"\n"),
          "\"plane strain\" does not go with two bodies");
  refused("[load]\nf = \"1\"\n[contact]\n" + sides + "[mesh]\nkind = \"structured\"\ncells = 4\n",
          "contact: names groups of a mesh file");
}

/// Expects the error `says`, or a contact force where it is empty, for two blocks that are clamped
/// at their outer sides, with either one as the slave.
void refuse_or_solve_gap(const std::string& gap, const std::string& says) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "blocks.msh";
  write_msh(path, two_body_mesh(structured_mesh(3, {0}), structured_mesh(4, {0})),
            {{"above"}, {"below"}});
  for (const std::string slave : {"above", "below"}) {
    const std::string master = slave == "above" ? "below" : "above";
    const SceneRun run(
        fmt::format("[load]\nf = \"1\"\n[contact]\nslave = \"{}\"\nmaster = \"{}\"\n"
                    "gap = \"{}\"\n[mesh]\nkind = \"file\"\nfile = \"{}\"\n",
                    slave, master, gap, path.string()));
    if (says.empty())
      EXPECT_GT(run.summary()["contact_force"]["normal"].get<double>(), 0.1);
    else
      expect_no_answer(run, says);
  }
}

TEST(TwoBodyScenes, AGapThatNoClampedCornerHasIsRefused) {
  refuse_or_solve_gap("-1", "contact.gap: gap(0) = -1, but u above - u below = 0 is prescribed");
  refuse_or_solve_gap("x - 0.5", "contact.gap: gap(0) = -0.5, but u above - u below = 0");
  refuse_or_solve_gap("1/x", "contact.gap: \"1/x\" is not finite at x = 0");
  refuse_or_solve_gap("-x*(1 - x)", "");  // the bodies overlap between their corners
}

TEST(TwoBodyScenes, SidesThatAreNoInterfaceAreRefused) {
  const TriangleMesh square = structured_mesh(3, {0});
  const TemporaryFolder folder;
  const auto refused = [&](const TriangleMesh& mesh, const std::string& says) {
    const std::filesystem::path path = folder.path() / "spoilt.msh";
    write_msh(path, mesh, {{"a"}, {"b"}});
    expect_no_answer(
        SceneRun(fmt::format("[load]\nf = \"1\"\n[contact]\nslave = \"a\"\nmaster = \"b\"\n[mesh]\n"
                             "kind = \"file\"\nfile = \"{}\"\n",
                             path.string())),
        says);
  };
  TriangleMesh mesh = two_body_mesh(square, structured_mesh(4, {0}));
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.vertices(v, 1) == 0 && mesh.vertices(v, 0) == 0.25) mesh.vertices(v, 1) = -0.01;
  refused(mesh, "off the line");
  mesh = two_body_mesh(square, structured_mesh(4, {0}));
  const auto is_inside = [&](int v) {
    return mesh.vertices(v, 0) >= 0.25 && mesh.vertices(v, 0) <= 0.75;
  };
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == lower_side && is_inside(mesh.edges(e, 0)) &&
        is_inside(mesh.edges(e, 1)))
      mesh.edge_tag[e] = EdgeTag::clamped;
  refused(mesh, "the master edges cover");
  mesh = two_body_mesh(square, structured_mesh(4, {0}));
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.vertices(mesh.edges(e, 0), 1) == -1 && mesh.vertices(mesh.edges(e, 1), 1) == -1)
      mesh.edge_tag[e] = EdgeTag::contact;  // an obstacle below the lower body
  refused(mesh, "has edges in the group contact");
}

}  // namespace antilock::test::two_bodies_test
