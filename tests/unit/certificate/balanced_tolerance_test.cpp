// The energy in a bracket, and what is accurate enough.
#include <string>

#include "antilock/certificate/balanced_tolerance.hpp"
#include "antilock/certificate/certificate.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/models/timoshenko_beam.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"
#include "support/bodies.hpp"
#include "support/scenes.hpp"
#include "unit/analysis/helpers.hpp"

namespace antilock::test::certificate_test::balanced_tolerance_test {

using namespace analysis_test;

// J(u_h) - J(u) >= |u_h - u|^2 / 2 in the energy norm of Remark 4: the width bounds the error
// without the truth.
TEST(EnergyBounds, HoldsTheExactEnergyAndBoundsTheErrorOfP1) {
  for (const double epsilon : {1.0, 1e-3, 0.0}) {
    const ExactSolution solved(paper_sine_load(), epsilon, true, 14);
    const ExactTable exact_solution(solved);
    for (const auto& [name, mesh] : two_square_meshes(8)) {
      const Space space(mesh, p1());
      const double error = measure_errors(space, active_set(stiff_problem(space, epsilon)), epsilon,
                                          reference(exact_solution))
                               .energy;
      const EnergyBounds found = energy_bounds(stiff_scene(epsilon), mesh);
      EXPECT_LE(found.lower, solved.energy()) << name << epsilon;
      EXPECT_GE(found.upper, solved.energy()) << name << epsilon;
      EXPECT_LT(found.width(), 0.2 * std::abs(solved.energy())) << name << epsilon;
      const double bound = std::sqrt(2 * found.width());
      EXPECT_LE(error, bound) << name << epsilon;
      EXPECT_GT(error, 0.5 * bound) << name << epsilon;  // tutorial 17: 0.71 to 0.99 of it
    }
  }
}

// Bumps between the points of the solver's rule; an edge held below 0 beside Gamma_C, where the
// obstacle rises from it.
TEST(EnergyBounds, IsOfTheLoadItselfAndOfGivenValues) {
  const auto bumps = [](double x,
                        double y) {  // at the centroids of the triangles of structured_mesh(8)
    const double s = 8 * x - std::floor(8 * x), t = 8 * y - std::floor(8 * y),
                 third = s > t ? 1.0 / 3 : 2.0 / 3;
    return 1 + 10 * std::exp(-(std::pow(s - 1 + third, 2) + std::pow(t - third, 2)) / 0.01);
  };
  const auto gap = [](double x) {
    return 0.4 * std::pow(1 - std::min(std::min(x, 1 - x) / 0.25, 1.0), 4);
  };
  const Scene rough({bumps}),
      lowered(
          {[](double, double) { return 0.0; }}, NoLayer{}, UnilateralContact{gap, {}},
          {{"rim", BoundaryCondition::Kind::displacement, [](double, double) { return -0.4; }}});
  const auto rim = [](double, double) { return dirichlet_group(0); };
  for (const auto& [scene, coarse, fine] :
       {std::tuple(rough, structured_mesh(8, {0}), structured_mesh(128, {0})),
        {lowered, retagged(structured_mesh(4, {0}), rim),
         retagged(structured_mesh(128, {0}), rim)}}) {
    const EnergyBounds found = energy_bounds(scene, coarse),
                       exact_solution = energy_bounds(scene, fine);
    EXPECT_LE(found.lower, exact_solution.upper);
    EXPECT_GE(found.upper, exact_solution.lower);
  }
}

TEST(EnergyBounds, IsNeededTheEnergyOfCrouzeixRaviartAloneIsNoBound) {
  // -lap u = 1 on the unit square, u = 0 around: int u = 0.0351442537 (torsion of a square bar),
  // J = -int u / 2
  constexpr double exact = -0.5 * 0.0351442537;
  const Scene scene({[](double, double) { return 1.0; }});
  const Space space(structured_mesh(1, {0}), crouzeix_raviart());
  VariationalInequality problem = assemble(scene, space);
  // the edge y = 0 is Sigma, free without contact: clamp it
  for (const int i : space.contact_dofs()) problem.dirichlet_dofs.push_back(i);
  std::sort(problem.dirichlet_dofs.begin(), problem.dirichlet_dofs.end());
  problem.dirichlet_values =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.dirichlet_dofs.size()));
  const Solution solution = active_set(problem);
  EXPECT_NEAR(energy(problem, solution), -1.0 / 144, 1e-15);  // one unknown, by hand
  EXPECT_GT(energy(problem, solution), exact);                // above
  EXPECT_LE(certify(scene, {space, problem, solution}).energy_lower, exact);
}

// Against the bracket of a mesh eight times as fine: a gap that the chord cuts, fixed values, a
// solve stopped early.
TEST(EnergyBounds, HoldsWithAGapWithFixedValuesAndAfterAnEarlyStop) {
  const Scene scene({paper_load}, StiffLayer{1e-2},
                    UnilateralContact{[](double x) { return 0.02 * x * (1 - x); }});
  const TriangleMesh mesh = unstructured_mesh(6), fine = unstructured_mesh(48);
  const EnergyBounds coarse = energy_bounds(scene, mesh), reference = energy_bounds(scene, fine);
  EXPECT_LE(coarse.lower, reference.upper);
  EXPECT_LE(reference.lower, coarse.upper);
  EXPECT_LT(coarse.width(), 0.3 * std::abs(coarse.upper));  // h = 1/6
  // an obstacle that rises between two vertices
  const Scene needle({paper_load}, StiffLayer{1e-2}, UnilateralContact{[](double x) {
                       return 0.02 - 0.5 * std::exp(-std::pow((x - 0.75) / 0.02, 2));
                     }});
  EXPECT_LE(energy_bounds(needle, fine).lower, energy_bounds(needle, mesh).upper);

  double before = reference.upper;
  for (const double noise : {0.0, 0.02, 0.2}) {
    Answered run(mesh, scene);
    disturb(run, noise, 7);
    EXPECT_LT(run.certified().energy_lower, before) << "less is known";
    before = run.certified().energy_lower;
  }
}

TEST(AlgebraicTolerance, FollowsTheBracket) {
  const EnergyBounds bracket{-1, -0.99};
  const AlgebraicTolerance enough = balanced_tolerance(bracket, 1, 0.5);
  EXPECT_NEAR(enough.relative, 0.005, 1e-15);  // half of 1 %
  EXPECT_NEAR(enough.energy, 0.005 * 0.005, 1e-18);
  EXPECT_NEAR(balanced_tolerance(bracket, 2, 0.5).relative, enough.relative / 4, 1e-15) << "h^2";
  for (const double bad : {0.0, -1.0, std::nan(""), infinity}) {
    test::expect_refused([&] { balanced_tolerance(bracket, bad); }, "times as coarse");
    test::expect_refused([&] { balanced_tolerance(bracket, 1, bad); }, "a share of");
  }
  for (const EnergyBounds& nothing :
       {EnergyBounds{0, 0}, EnergyBounds{-0.99, -1}, EnergyBounds{-1, NAN}}) {
    EXPECT_EQ(balanced_tolerance(nothing).energy, 0);
    EXPECT_EQ(balanced_tolerance(nothing).relative, 0);
  }
}

TEST(AlgebraicTolerance, SavesCorrectionsAndNoAccuracy) {
  const auto save = [](const std::string& element_name, const TriangleMesh& mesh,
                       const TriangleMesh& coarse) {
    const Space space(mesh, element(element_name));
    for (const double epsilon : {1e-6, 0.0}) {
      const ExactTable exact_solution(ExactSolution(paper_sine_load(), epsilon, true, 14));
      const VariationalInequality problem = stiff_problem(space, epsilon);
      const Solution full = active_set(problem);
      ActiveSetOptions options;
      options.corrections.tolerance =
          balanced_tolerance(energy_bounds(test::stiff_scene(epsilon), coarse), 2).relative;
      const Solution early = active_set(problem, options);
      EXPECT_LT(early.counters.corrections, full.counters.corrections) << element_name << epsilon;
      const Errors a = measure_errors(space, full, epsilon, reference(exact_solution)),
                   b = measure_errors(space, early, epsilon, reference(exact_solution));
      // the promise of balanced_tolerance
      EXPECT_LT(b.max, 1.01 * a.max) << element_name << epsilon;
      EXPECT_LT(b.energy, 1.01 * a.energy) << element_name << epsilon;
    }
  };
  save("P1", structured_mesh(32), structured_mesh(16));
  save("P1", unstructured_mesh(16), unstructured_mesh(8));  // locked
  save("CR", unstructured_mesh(16), unstructured_mesh(8));
}

using std::numbers::pi;

}  // namespace antilock::test::certificate_test::balanced_tolerance_test
