// (23) in space: the unit cube on the layer (0,1)^2 x (-1,0), clamped on its sides and its top, in
// contact on its bottom. And the boundary conditions on faces.
#include "antilock/analysis/kernel.hpp"
#include "antilock/analysis/layer_components.hpp"
#include "antilock/analysis/solve.hpp"
#include "antilock/io/write_csv.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/mesh/layered.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace antilock::test::models_test::tetrahedra_test {

/// The load of the figures, times a half wave in y, which is 0 on the clamped sides.
double load_in_space(double x, double y, double) {
  return paper_load(x, y) * std::sin(std::numbers::pi * y);
}

double largest_on_contact(const Mesh& mesh, const Element& element, double epsilon) {
  const Space space(mesh, element);
  const VariationalInequality problem =
      assemble(Scene({load_in_space}, StiffLayer{epsilon}, UnilateralContact{}), space);
  const Solution solution = active_set(problem);
  const Eigen::VectorXd on_contact = solution.u(space.contact_dofs());
  EXPECT_GE(on_contact.minCoeff(), 0);
  return on_contact.maxCoeff();
}

TEST(Tetrahedra, LockWhereTheLayerIsNotInColumns) {
  constexpr int cells = 8;
  constexpr double epsilon = 1e-6;
  const Domain domain{1, CellKind::tetrahedron};
  const Element &p = p1(CellKind::tetrahedron), &cr = crouzeix_raviart(CellKind::tetrahedron);
  const Mesh aligned = structured_mesh(cells, domain);
  const Mesh moved = jittered_mesh(cells, 0.2, domain);
  const Mesh layered = layered_mesh(cells, 1, CellKind::tetrahedron);
  const Mesh gmsh = unstructured_mesh(cells, domain);
  const double on_aligned = largest_on_contact(aligned, p, epsilon);
  const std::vector<std::pair<const char*, const Mesh*>> families{
      {"aligned", &aligned}, {"layered", &layered}, {"moved", &moved}, {"gmsh", &gmsh}};
  for (const auto& [name, mesh] : families) {
    const double of_p1 = largest_on_contact(*mesh, p, epsilon);
    const double of_cr = largest_on_contact(*mesh, cr, epsilon);
    fmt::print("| {} | P1 {:.7f} | CR {:.7f} |\n", name, of_p1, of_cr);
    if (mesh == &moved || mesh == &gmsh)
      EXPECT_LT(of_p1, 1e-4 * on_aligned) << name;
    else
      EXPECT_NEAR(of_p1, on_aligned, 0.15 * on_aligned) << name;
    EXPECT_NEAR(of_cr, on_aligned, 0.15 * on_aligned) << name;
  }
}

/// The unit cube alone. Its bottom is group 1, natural; the rest is group 0, where u is prescribed.
Mesh cube(const Mesh& tagged_by_position) {
  Mesh mesh = tagged_by_position;
  for (EdgeTag& tag : mesh.edge_tag) {
    if (tag == EdgeTag::clamped) tag = dirichlet_group(0);
    if (tag == EdgeTag::contact) tag = natural_group(1);
  }
  return mesh;
}

std::vector<Mesh> cubes() {
  const Domain body{0, CellKind::tetrahedron};
  return {cube(structured_mesh(3, body)), cube(jittered_mesh(3, 0.15, body)),
          cube(unstructured_mesh(3, body))};
}

std::vector<const Element*> elements_in_space() {
  constexpr CellKind kind = CellKind::tetrahedron;
  return {&p1(kind), &p2(kind), &crouzeix_raviart(kind)};
}

double no_load(double, double) { return 0; }

/// Affine functions are in every space. A solution that is one is found but for round-off.
void expect_solution(const Field& u, const BoundaryCondition& bottom) {
  using Kind = BoundaryCondition::Kind;
  const Scene scene({no_load}, NoLayer{}, std::nullopt, {{"sides", Kind::displacement, u}, bottom});
  for (const Mesh& mesh : cubes())
    for (const Element* element : elements_in_space()) {
      const Space space(mesh, *element);
      const Eigen::VectorXd found = active_set(assemble(scene, space)).u;
      const Eigen::VectorXd exact = dof_values(space, u);
      EXPECT_LT((found - exact).norm(), 1e-11 * exact.norm()) << element->name();
    }
}

// The outward derivative on the bottom, z = 0, is -d_z u = -3.
TEST(Tetrahedra, PassThePatchTestOfTractions) {
  const auto pull = [](double, double) { return -3.0; };
  expect_solution([](double x, double y, double z) { return 1 + 2 * x - y + 3 * z; },
                  {"bottom", BoundaryCondition::Kind::traction, pull});
}

// A spring of stiffness 1 pulls with -u = -3 there.
TEST(Tetrahedra, PassThePatchTestOfSprings) {
  const auto stiffness = [](double, double) { return 1.0; };
  expect_solution([](double, double, double z) { return 3 + 3 * z; },
                  {"bottom", BoundaryCondition::Kind::spring, stiffness});
}

TEST(Tetrahedra, HaveBoundsOfAGapThatDependsOnXAndY) {
  const auto gap = [](double x, double y) { return 0.1 + x * x + 2 * y; };
  const Mesh mesh = structured_mesh(3, {1, CellKind::tetrahedron});
  for (const Element* element : elements_in_space()) {
    const Space space(mesh, *element);
    const VariationalInequality problem =
        assemble(Scene({no_load}, StiffLayer{0.1}, UnilateralContact{gap}), space);
    ASSERT_EQ(problem.bounds.unknowns, space.contact_dofs());
    for (std::size_t i = 0; i < space.contact_dofs().size(); ++i) {
      const Position x = space.dof_coordinates().row(space.contact_dofs()[i]);
      EXPECT_EQ(problem.bounds.lower(static_cast<Eigen::Index>(i)), -gap(x(0), x(1)));
    }
  }
}

// The obstacle rises above the body around the middle of the bottom: contact is there, with
// pressures that are at least 0, and the KKT conditions hold.
TEST(Tetrahedra, TouchAnObstacleBelowTheirFaces) {
  const auto gap = [](double x, double y) {
    return -0.05 + 2 * (std::pow(x - 0.5, 2) + std::pow(y - 0.5, 2));
  };
  for (const Element* element : elements_in_space()) {
    const Space space(structured_mesh(4, {1, CellKind::tetrahedron}), *element);
    const VariationalInequality problem = assemble(
        Scene({no_load}, StiffLayer{0.1}, UnilateralContact{.gap = gap, .zero_at = {}}), space);
    const Solution solution = active_set(problem);
    const Eigen::VectorXd opening = solution.u(problem.bounds.unknowns) - problem.bounds.lower;
    EXPECT_GE(opening.minCoeff(), -1e-12) << element->name();
    EXPECT_GE(solution.lambda.minCoeff(), 0) << element->name();
    EXPECT_GT(solution.lambda.maxCoeff(), 0) << element->name();
    const Eigen::VectorXd work = opening.cwiseProduct(solution.lambda);
    EXPECT_LT(work.cwiseAbs().maxCoeff(), 1e-12) << element->name();
  }
}

// The bottom has the area 1. CR: each face is one unknown. P1: vertices on the rim are prescribed,
// so that of 4 x 4 squares the inner 3 x 3 vertices have an area of 1/16 each.
TEST(Tetrahedra, HaveContactPressuresOnFaces) {
  const Mesh mesh = structured_mesh(4, {1, CellKind::tetrahedron});
  constexpr CellKind kind = CellKind::tetrahedron;
  EXPECT_NEAR(contact_lengths(Space(mesh, crouzeix_raviart(kind))).sum(), 1, 1e-13);
  const Space space(mesh, p1(kind));
  EXPECT_NEAR(contact_lengths(space).sum(), 9.0 / 16, 1e-13);
  const auto gap = [](double x, double y) { return x + 2 * y; };
  const VariationalInequality problem =
      assemble(Scene({no_load}, StiffLayer{0.1}, UnilateralContact{gap}), space);
  const Solution solution = active_set(problem);
  const Eigen::MatrixXd table = contact_table({space, problem, solution});
  ASSERT_EQ(table.rows(), 9);
  ASSERT_EQ(table.cols(), 4);  // x, y, opening, pressure; u = 0 does not touch
  EXPECT_LT((table.col(2) - table.col(0) - 2 * table.col(1)).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(table.col(3).cwiseAbs().maxCoeff(), 0);
  expect_refused([&] { contact_lengths(Space(mesh, p2(kind))); }, "accepted: P1 and CR");
}

TEST(Tetrahedra, AreWrittenAsTablesWithZ) {
  const TemporaryFolder folder;
  const Space space(structured_mesh(1, {0, CellKind::tetrahedron}), p1(CellKind::tetrahedron));
  write_solution_csv(folder / "u.csv", space, Eigen::VectorXd::Zero(space.size()));
  const std::string text = contents(folder / "u.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')), "x,y,z,u");
}

// The kernel of B has the functions that are constant across the layer: on n^3 cubes over columns,
// one for each of the (n - 1)^2 inner vertices of Sigma, and one for each of the (n - 1)^3 inner
// vertices of the body, which B does not see. No column is left where the vertices are moved.
TEST(Tetrahedra, HaveAKernelOfColumns) {
  constexpr int n = 3;
  constexpr int in_body = (n - 1) * (n - 1) * (n - 1);
  const auto dimension = [](const Mesh& mesh) {
    const Space space(mesh, p1(CellKind::tetrahedron));
    return kernel_dimension(assemble(Scene({no_load}, StiffLayer{0.1}), space));
  };
  const Domain domain{1, CellKind::tetrahedron};
  EXPECT_EQ(dimension(structured_mesh(n, domain)), in_body + (n - 1) * (n - 1));
  EXPECT_LT(dimension(jittered_mesh(n, 0.15, domain)), in_body + (n - 1) * (n - 1));
}

std::vector<Mesh> meshes_in_columns() {
  return {structured_mesh(3, {1, CellKind::tetrahedron}),
          layered_mesh(3, 1, CellKind::tetrahedron)};
}
std::vector<Mesh> tied_meshes() {
  const Domain domain{1, CellKind::tetrahedron};
  return {jittered_mesh(3, 0.2, domain), unstructured_mesh(3, domain)};
}

TEST(Tetrahedra, AreInOneGroupBelowEachFaceOfSigmaOrTied) {
  for (const Mesh& mesh : meshes_in_columns()) {
    const LayerComponents components = layer_components(mesh);
    EXPECT_TRUE(components.is_aligned);
    EXPECT_EQ(components.count,
              std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), EdgeTag::sigma));
  }
  for (const Mesh& mesh : tied_meshes()) EXPECT_FALSE(layer_components(mesh).is_aligned);
}

TEST(Tetrahedra, HaveAReportOnLockingThatWarnsOfTiedCells) {
  const auto report = [](const Mesh& mesh, const Element& element) {
    const Scene scene({load_in_space}, StiffLayer{1e-3}, UnilateralContact{});
    return solve(scene, Space(mesh, element)).locking.value();
  };
  const Element &p = p1(CellKind::tetrahedron), &cr = crouzeix_raviart(CellKind::tetrahedron);
  for (const Mesh& mesh : meshes_in_columns()) {
    const LockingReport found = report(mesh, p);
    EXPECT_NE(found.diagnosis.find("does not lock here"), std::string::npos) << found.diagnosis;
    EXPECT_EQ(found.warning, "");
  }
  for (const Mesh& mesh : tied_meshes()) {
    const LockingReport found = report(mesh, p);
    EXPECT_NE(found.diagnosis.find("faces that are not vertical"), std::string::npos);
    EXPECT_NE(found.warning.find("P1 locks in this layer"), std::string::npos) << found.warning;
    EXPECT_GT(found.lost.value_or(0), 0.9);
    EXPECT_EQ(report(mesh, cr).warning, "");
  }
}

}  // namespace antilock::test::models_test::tetrahedra_test
