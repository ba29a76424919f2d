// Q1 with its switches, and the rotated element: which forms are equal, how many functions have no
// strain in the layer, and which of them pass the patch test.
#include "antilock/analysis/kernel.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/form/edge_forms.hpp"
#include "antilock/form/elasticity_forms.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/strain_projection.hpp"
#include "antilock/models/project_strain.hpp"
#include "antilock/space/cell_map.hpp"
#include "support/scenes.hpp"

namespace antilock::test::form_test::switches_test {

constexpr CellKind kind = CellKind::quadrilateral;
/// A few round-offs of sums of some ten products of size 1.
constexpr double round_off = 1e-13;

Mesh moved(Mesh mesh, const std::function<Eigen::RowVector2d(double, double)>& map) {
  for (int v = 0; v < mesh.vertex_count(); ++v)
    mesh.vertices.row(v) = map(mesh.vertices(v, 0), mesh.vertices(v, 1));
  return mesh;
}
/// The structured mesh, sheared: each cell is a parallelogram without a vertical edge.
Mesh parallelograms(int cells) {
  return moved(structured_mesh(cells, {1, kind}),
               [](double x, double y) { return Eigen::RowVector2d(x + 0.3 * y, y + 0.2 * x); });
}
std::vector<NamedMesh> meshes(int cells) {
  return {{"structured", structured_mesh(cells, {1, kind})},
          {"jittered", jittered_mesh(cells, 0.2, {1, kind})},
          {"recombined", unstructured_mesh(cells, {1, kind})}};
}

const Element& selective() { return q1(Integration::selective); }
const Element& reduced() { return q1(Integration::reduced); }

SparseMatrix stiffness(const FactoredForm& form) {
  return form.b.transpose() * form.m.asDiagonal() * form.b;
}
double difference(const SparseMatrix& a, const SparseMatrix& b) {
  return (a - b).norm() / b.norm();
}

// On any quadrilateral |J| d/dy u and |J| are affine in s and t, so that the mean of d/dy u over a
// cell is its value at the centre.
TEST(Switches, SelectiveIntegrationIsTheMeanOfTheStrain) {
  for (const auto& [name, mesh] : meshes(5)) {
    const Space full(mesh, q1()), one(full, selective());
    const FactoredForm strain = layer_strain(full), centre = layer_strain(one);
    const FactoredForm mean = project_strain(strain, cell_projection(strain));
    EXPECT_LT((mean.b - centre.b).norm() / centre.b.norm(), round_off) << name;
    EXPECT_LT((mean.m - centre.m).norm() / centre.m.norm(), round_off) << name;
    EXPECT_EQ(mean.cell, centre.cell) << name;
    EXPECT_EQ(strain.m.size(), 4 * mean.m.size()) << name;
  }
}

// For the rotated element |J| d/dy u has squares of s and t. Its mean is its value at the centre on
// parallelograms, and not on other cells.
TEST(Switches, TheMeanIsNotTheCentreForTheRotatedElement) {
  const auto to_centre = [](const Mesh& mesh) {
    const Space space(mesh, rotated_q1_plus());
    const FactoredForm strain = layer_strain(space);
    const FactoredForm mean = project_strain(strain, cell_projection(strain));
    double largest = 0;
    for (Eigen::Index row = 0; row < mean.m.size(); ++row) {
      const int t = mean.cell[row];
      const CellMap<kind> map(mesh, t);
      const Eigen::VectorXd centre = rotated_q1_plus().derivative(Eigen::Vector2d(0.5, 0.5)) *
                                     map.at(Eigen::Vector2d(0.5, 0.5)).gradient.col(1);
      for (Eigen::Index i = 0; i < centre.size(); ++i)
        largest =
            std::max(largest, std::abs(mean.b.coeff(row, space.cell_dofs()(t, i)) - centre(i)));
    }
    return largest;
  };
  EXPECT_LT(to_centre(parallelograms(4)), 100 * round_off);
  EXPECT_GT(to_centre(jittered_mesh(4, 0.2, {1, kind})), 0.1);
}

// On a cell u is an affine function plus a multiple of S T, and the mean of grad S T is its value
// at the centre, which is 0.
TEST(Switches, ReducedFormAndHourglassFormAreTheFullForm) {
  const Stiffness body{1, 1}, layer{2, 5};
  std::vector<NamedMesh> all = meshes(4);
  all.push_back({"parallelograms", parallelograms(4)});
  for (const auto& [name, mesh] : all) {
    const Space space(mesh, reduced());
    const SparseMatrix full = gradient_form(Space(space, q1()), body, layer);
    const SparseMatrix sum = SparseMatrix(gradient_form(space, body, layer)) +
                             stiffness(hourglass_form(space, body, layer));
    EXPECT_LT(difference(sum, full), round_off) << name;
    EXPECT_GT(difference(gradient_form(space, body, layer), full), 0.01) << name;
  }
}

// One point sees neither constants nor the function that is 1 and -1 at the two ends of each edge.
// The stabilised form sees the second one.
TEST(Switches, OnePointHasOneModeWithoutEnergy) {
  for (const auto& [name, mesh] : meshes(3)) {
    const Space space(mesh, reduced());
    const Eigen::MatrixXd one_point = gradient_form(space, {1, 1}, {1, 1});
    const Eigen::MatrixXd sum =
        one_point + Eigen::MatrixXd(stiffness(hourglass_form(space, {1, 1}, {1, 1})));
    const auto rank = [](const Eigen::MatrixXd& form) {
      const Eigen::VectorXd values = symmetric_eigenvalues(form);
      return (values.array() > 1e-10 * values.maxCoeff()).count();
    };
    EXPECT_EQ(rank(one_point), space.size() - 2) << name;
    EXPECT_EQ(rank(sum), space.size() - 1) << name;
  }
}

VariationalInequality projected(const Space& space) {
  return project_strain(stiff_problem(space, 0), cell_projection(layer_strain(space)));
}

// The same for the divergence of a displacement. With one condition per cell there are more
// unknowns than conditions, with three per cell there are fewer.
TEST(Switches, SelectiveIntegrationIsTheMeanOfTheDivergence) {
  for (const auto& [name, mesh] : meshes(4)) {
    const Space full(mesh, q1()), one(full, selective());
    const FactoredForm div = divergence({full, full}), centre = divergence({one, one});
    const FactoredForm mean = project_strain(div, cell_projection(div));
    EXPECT_LT((mean.b - centre.b).norm() / centre.b.norm(), round_off) << name;
    EXPECT_LT((mean.m - centre.m).norm() / centre.m.norm(), round_off) << name;
    const Space points(full, reduced());
    EXPECT_LT(difference(strain_form({one, one}), strain_form({full, full})), round_off) << name;
    EXPECT_GT(difference(strain_form({points, points}), strain_form({full, full})), 0.01) << name;
  }
}

// int (grad u)' D grad v for the affine u = (x - 2 y, 3 x + y): 2 mu eps:eps + lambda div^2 with
// eps_xx = eps_yy = 1, 2 eps_xy = 1, div u = 2, times the area 2.
TEST(Switches, StrainFormsGiveAffineDisplacementsTheirEnergy) {
  const Eigen::Matrix4d material = Lame{3, 0.5}.matrix();
  for (const auto& [name, mesh] : meshes(3))
    for (const Element* element : {&q1(), &selective(), &reduced()}) {
      const Space space(mesh, *element);
      Eigen::VectorXd u(2 * space.size());
      u << dof_values(space, [](double x, double y) { return x - 2 * y; }),
          dof_values(space, [](double x, double y) { return 3 * x + y; });
      const double density = 2 * 0.5 * (1 + 1 + 2 * 0.25) + 3 * 4;
      EXPECT_NEAR(u.dot(strain_form({space, space}, material, material) * u), 2 * density,
                  1000 * round_off)
          << name << element->name();
      EXPECT_LT(((divergence({space, space}).b * u).array() - 2).abs().maxCoeff(), 1000 * round_off)
          << name << element->name();
    }
}

// E_Sigma + E_C - E_D = 0 on these meshes. The rotated element has N functions without mean strain,
// N the cells of the layer, and one more for each cell with its fifth function.
TEST(Switches, KernelsAreAsDerived) {
  for (const int n : {3, 5})
    for (const auto& [name, mesh] : meshes(n)) {
      const auto cells =
          static_cast<int>(std::count(mesh.region.begin(), mesh.region.end(), Region::layer));
      const int aligned = name == "structured" ? n - 1 : 0;
      for (const Element* element : {&q1(), &selective(), &reduced()})
        EXPECT_EQ(layer_kernel_dimension(stiff_problem(Space(mesh, *element), 0)), aligned)
            << name << element->name();
      EXPECT_EQ(layer_kernel_dimension(projected(Space(mesh, rotated_q1()))), cells) << name;
      EXPECT_EQ(layer_kernel_dimension(projected(Space(mesh, rotated_q1_plus()))), 2 * cells)
          << name;
    }
}

// The solution of a1 + a0 with the values of w = x - 2 y on the whole boundary.
double patch_test(const Space& space, VariationalInequality problem) {
  const Eigen::VectorXd exact = dof_values(space, [](double x, double y) { return x - 2 * y; });
  std::set<int> given(space.dirichlet_dofs().begin(), space.dirichlet_dofs().end());
  given.insert(space.contact_dofs().begin(), space.contact_dofs().end());
  problem.dirichlet_dofs.assign(given.begin(), given.end());
  problem.dirichlet_values = exact(problem.dirichlet_dofs);
  problem.bounds = {};
  problem.load.setZero();
  problem.compliance = 1;
  return (active_set(problem).u - exact).cwiseAbs().maxCoeff();
}

TEST(Switches, PassThePatchTest) {
  for (const auto& [name, mesh] : meshes(4)) {
    for (const Element* element : {&q1(), &selective(), &reduced(), &rotated_q1_plus()}) {
      const Space space(mesh, *element);
      // the condition of a system is some h^-2 = 16, and that of the reduced one h^-4
      EXPECT_LT(patch_test(space, stiff_problem(space, 1)), 1e3 * round_off)
          << name << element->name();
      if (element != &q1() && element != &rotated_q1_plus()) continue;
      EXPECT_LT(patch_test(space, projected(space)), 1e3 * round_off) << name << element->name();
    }
    VariationalInequality stabilised = stiff_problem(Space(mesh, reduced()), 1);
    stabilised.a1 += stiffness(hourglass_form(Space(mesh, reduced()), {1, 1}, {1, 0}));
    EXPECT_LT(patch_test(Space(mesh, reduced()), stabilised), 1e3 * round_off) << name;
  }
}

// Without the fifth function the rotated element has no affine functions but on parallelograms.
TEST(Switches, TheRotatedElementOfFourFunctionsFailsThePatchTestOnOtherCells) {
  const Space right(structured_mesh(4, {1, kind}), rotated_q1());
  EXPECT_LT(patch_test(right, stiff_problem(right, 1)), 1e3 * round_off);
  const Space wrong(jittered_mesh(4, 0.2, {1, kind}), rotated_q1());
  EXPECT_GT(patch_test(wrong, stiff_problem(wrong, 1)), 1e-3);
}

TEST(Switches, AreRefusedOnTriangles) {
  expect_refused(
      [] {
        hourglass_form(Space(structured_mesh(2), p1()), {1, 1}, {1, 0});
      },
      "accepted: Q1 on quadrilaterals");
  expect_refused(
      [] {
        hourglass_form(Space(structured_mesh(2, {1, kind}), rotated_q1()), {1, 1}, {1, 0});
      },
      "accepted: Q1 on quadrilaterals");
  expect_refused([] { Space(structured_mesh(2), selective()); }, "accepted: both of one kind");
  expect_refused([] { element("Q1-reduced"); }, "accepted \"P1\" to \"P6\"");
  FactoredForm scattered = layer_strain(Space(structured_mesh(2, {1, kind}), q1()));
  std::swap(scattered.cell[0], scattered.cell[5]);
  expect_refused([&] { cell_projection(scattered); }, "accepted: the rows of a form cell by cell");
}

}  // namespace antilock::test::form_test::switches_test
