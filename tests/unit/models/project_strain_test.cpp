// Projected forms.
#include "antilock/models/project_strain.hpp"
#include "antilock/analysis/best_approximation.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"

namespace antilock::test::models_test::project_strain_test {

double slope(const std::vector<double>& values) {
  return std::log2(values.front() / values.back());
}

TEST(Projected, WithSharesOfOneIsTheSameProblem) {
  const Space space(unstructured_mesh(8), p1());
  for (const double epsilon : {0.9, 0.1, 1e-6, 1e-20, 0.0})
    for (const double kept : {0.0, 0.5, 0.9}) {
      const VariationalInequality problem = stiff_problem(space, epsilon);
      const Eigen::VectorXd u = active_set(problem).u;
      StrainProjection identity(problem.m.size(), problem.m.size());
      identity.setIdentity();
      const Eigen::VectorXd same = active_set(project_strain(problem, identity, kept)).u;
      EXPECT_LT((same - u).lpNorm<Eigen::Infinity>(), 1e-9 * u.lpNorm<Eigen::Infinity>())
          << epsilon << " " << kept;
    }
}

TEST(Projected, IsAsCoerciveAsThePartThatIsKept) {
  // (H1): a1 + kept a0 + (1 - kept) a0_h >= kept (a1 + a0). Nothing kept, a zigzag across the layer
  // costs h^2.
  std::vector<double> nothing, half;
  for (const int n : {4, 8, 16}) {
    const TriangleMesh mesh = structured_mesh(n);
    const Space space(mesh, p1());
    const StrainProjection boxes = box_projection(mesh, layer_strain(space), 2.0 / n, 2.0 / n);
    const VariationalInequality problem = stiff_problem(space, 1);
    const SparseMatrix norm = h1_gram_matrix(space);
    nothing.push_back(coercivity(project_strain(problem, boxes), norm));
    half.push_back(coercivity(project_strain(problem, boxes, 0.5), norm));
    EXPECT_GE(half.back(), 0.5 * coercivity(problem, norm)) << n;
  }
  EXPECT_NEAR(slope(nothing), 4, 0.6);  // two halvings of h
  EXPECT_LT(slope(half), 0.2);
}

TEST(Projected, SurvivesEveryContactAtEveryEpsilon) {
  const TriangleMesh mesh = unstructured_mesh(16);
  const Space space(mesh, p1());
  const StrainProjection boxes = box_projection(mesh, layer_strain(space), 0.125, 0.125);
  for (const double epsilon : {1.0, 1e-2, 1e-6, 1e-20, 0.0}) {
    VariationalInequality problem = stiff_problem(space, epsilon);
    const Eigen::VectorXd load = problem.load;
    const auto solve = [&](double factor, bool one_sign) {
      problem.load = factor * (one_sign ? Eigen::VectorXd(load.cwiseAbs()) : load);
      return active_set(project_strain(problem, boxes, 0.5));
    };
    const auto touching = [](const Solution& s) {
      return std::count(s.active.begin(), s.active.end(), true);
    };
    const Solution lifted = solve(1, true), pressed = solve(-1, true), part = solve(1, false),
                   none = solve(0, false);
    EXPECT_EQ(touching(lifted), 0) << epsilon;
    EXPECT_EQ(touching(pressed), static_cast<long>(problem.bounds.unknowns.size())) << epsilon;
    EXPECT_GT(touching(part), 0) << epsilon;
    EXPECT_LT(touching(part), static_cast<long>(problem.bounds.unknowns.size())) << epsilon;
    EXPECT_EQ(none.u.norm(), 0) << epsilon;  // gap 0 and force 0 everywhere
    // a load 1e12 times as large: the same shape
    EXPECT_LT((solve(1e12, false).u / 1e12 - part.u).norm(), 1e-9 * part.u.norm()) << epsilon;
  }
}

TEST(Projected, ALockedUThatComesDownSlowlyIsFollowed) {
  // Patches leave nothing in K_0h but 0 on the layer, and their rows of B are nearly dependent. A
  // conforming kernel hides no slope; that of v is a force of size 1, so the norm is round-off.
  for (const int cells : {16, 32}) {
    const TriangleMesh mesh = unstructured_mesh(cells);
    const Space space(mesh, p1());
    const FactoredForm strain = layer_strain(space);
    const auto patches = project_strain(
        stiff_problem(space, 1), vertex_projection(mesh, strain, strain_quadrature(p1())), 0.5);
    const auto slope = load_vector(
        space,
        [](double x, double y) {
          return std::sin(std::numbers::pi * x) * std::cos(std::numbers::pi * y);
        },
        Region::layer);
    EXPECT_LT(dual_norm(patches, h1_gram_matrix(space), slope, true), 1e-6) << cells;
  }
}

TEST(Projected, RefusesWhatCannotBeKept) {
  EXPECT_EQ(projected_class_parameter(0.25, 0), 0.25);
  EXPECT_EQ(projected_class_parameter(1, 0.5), 1);
  EXPECT_EQ(projected_class_parameter(0, 0.5), 0);
  expect_refused([] { projected_class_parameter(0.5, 1); }, "exact_fraction = 1; accepted");
  expect_refused([] { projected_class_parameter(0.5, -0.1); }, "exact_fraction = -0.1; accepted");
  expect_refused([] { projected_class_parameter(2, 0.5); },
                 "compliance 2 with exact_fraction = 0.5");
  expect_refused([] { projected_class_parameter(NAN, 0.5); }, "compliance nan");
}

}  // namespace antilock::test::models_test::project_strain_test
