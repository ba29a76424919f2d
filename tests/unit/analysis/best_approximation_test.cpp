// The nearest element of K_h and of K_0h, dual norms, and the numbers of (5) that they are compared
// with.
#include "antilock/analysis/best_approximation.hpp"
#include "antilock/exact/exact_norms.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "antilock/measure/residual.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/study/method.hpp"
#include "support/scenes.hpp"

namespace antilock::test::analysis_test::best_approximation_test {

// A function of K that P1 holds on a structured mesh with a line x = 1/2; not constant across the
// layer.
const Reference tent{[](double x, double y) { return std::min(x, 1 - x) * (1 - y); },
                     [](double x, double y) {
                       return Eigen::Vector2d(std::copysign(1 - y, 0.5 - x), -std::min(x, 1 - x));
                     },
                     [](double, double) { return 0.0; }};

TEST(BestApproximation, AFunctionOfTheSetIsItsOwnNearestElement) {
  const Reference flat{[](double x, double y) { return std::min(x, 1 - x) * (y > 0 ? 1 - y : 1); },
                       [](double x, double y) {
                         const double slope = std::copysign(1.0, 0.5 - x);
                         return y > 0 ? Eigen::Vector2d(slope * (1 - y), -std::min(x, 1 - x))
                                      : Eigen::Vector2d(slope, 0);
                       },
                       [](double, double) { return 0.0; }};
  // bilinear in the body: nearest in P2, exact for no triangle of P1
  const Space space(structured_mesh(4), p2());
  const auto problem = test::stiff_problem(space, 0);
  for (const AdmissibleSet within : {AdmissibleSet::k_h, AdmissibleSet::k_0h}) {
    const BestApproximation found = best_approximation(space, problem, flat, within);
    EXPECT_LT(found.distance, 1e-7);
    EXPECT_NEAR(found.value, found.distance * found.distance, 1e-12);
  }
}

TEST(BestApproximation, TheKernelIsFartherAndHoldsItsCondition) {
  const Space space(structured_mesh(8), p1());
  const auto problem = test::stiff_problem(space, 0);
  const BestApproximation any = best_approximation(space, problem, tent, AdmissibleSet::k_h),
                          kernel = best_approximation(space, problem, tent, AdmissibleSet::k_0h);
  EXPECT_LT(any.distance, 0.5 * kernel.distance);  // what it cannot have: |d/dy v| in the layer
  EXPECT_LT((problem.b * kernel.v).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT((problem.b * any.v).cwiseAbs().maxCoeff(), 0.1);
}

TEST(BestApproximation, TheFunctionalIsPartOfWhatIsMinimised) {
  const Space space(structured_mesh(8), p1());
  auto problem = test::stiff_problem(space, 0);
  problem
      .bounds = {};  // then the derivative of |u - v|_h^2 + load . v vanishes at the smallest value
  const Eigen::VectorXd load = load_vector(space, paper_load);
  const BestApproximation found =
      best_approximation(space, problem, tent, AdmissibleSet::k_h, load);
  Eigen::VectorXd derivative =
      2 * (h1_gram_matrix(space) * found.v - h1_products(space, tent)) + load;
  for (const int i : problem.dirichlet_dofs) derivative(i) = 0;
  EXPECT_LT(derivative.cwiseAbs().maxCoeff(), 1e-10 * load.cwiseAbs().maxCoeff());
  EXPECT_NEAR(found.value, found.distance * found.distance + load.dot(found.v), 1e-12);
}

TEST(DualNorm, OfARieszRepresentativeIsItsNorm) {
  const Space space(unstructured_mesh(6), crouzeix_raviart());
  const auto problem = test::stiff_problem(space, 0);
  const SparseMatrix norm = h1_gram_matrix(space);
  Eigen::VectorXd w =
      (3 * space.dof_coordinates().col(0).array()).sin() * space.dof_coordinates().col(1).array();
  for (const int i : problem.dirichlet_dofs) w(i) = 0;
  const double all = dual_norm(problem, norm, norm * w),
               in_kernel = dual_norm(problem, norm, norm * w, true);
  VariationalInequality other = problem;  // a norm knows no bounds and no given values
  other.bounds.upper = Eigen::VectorXd::Ones(other.bounds.lower.size());
  other.dirichlet_values.setOnes();
  EXPECT_EQ(dual_norm(other, norm, norm * w), all);
  EXPECT_NEAR(all, std::sqrt(w.dot(norm * w)), 1e-10 * all);
  EXPECT_LT(in_kernel, 0.99 * all);  // w is not in the kernel
  EXPECT_GT(in_kernel, 0);
}

TEST(StressNorm, IsTheIntegralOfTheLayerStress) {
  for (const double epsilon : {1.0, 0.1, 0.0}) {
    const ExactSolution exact(paper_sine_load(), epsilon, true, 12);
    double sum = 0;
    constexpr int n = 40;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double p = exact.layer_stress((i + 0.5) / n, (j + 0.5) / n - 1);
        sum += p * p / (n * n);
      }
    EXPECT_NEAR(stress_norm(exact), std::sqrt(sum), 0.01 * std::sqrt(sum))
        << epsilon;  // the rule's h^2, and a jump of p
  }
}

// The limit on the layer is a function of x, and u^0 - u^c on the body is its harmonic extension:
// both by midpoints.
TEST(LayerNorm, AndWhatClampingCostsAreIntegralsOfTheLimit) {
  constexpr double pi = std::numbers::pi;
  const ExactSolution limit(paper_sine_load(), 0, true, 14);
  constexpr int n = 400;
  double layer = 0;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    layer += (std::pow(limit.value(x, -0.5), 2) + std::pow(limit.gradient(x, -0.5).x(), 2)) / n;
  }
  EXPECT_NEAR(layer_norm(limit), std::sqrt(layer), 1e-4 * std::sqrt(layer));  // the rules' h^2
  double body = 0;
  for (int k = 1; k <= 60; ++k) {  // the waves of u^0 on Sigma fall like k^-3
    double w = 0, square = 0;
    for (int i = 0; i < n; ++i)
      w += 2.0 / n * limit.value((i + 0.5) / n, 0) * std::sin(k * pi * (i + 0.5) / n);
    for (int j = 0; j < 4 * n; ++j) {
      const double a = k * pi, y = (j + 0.5) / (4 * n), scale = 1 / std::sinh(a);
      const double v = scale * std::sinh(a * (1 - y)), slope = a * scale * std::cosh(a * (1 - y));
      square += (v * v + a * a * v * v + slope * slope) / (4 * n);
    }
    body += 0.5 * w * w * square;
  }
  EXPECT_NEAR(clamped_distance(limit), std::sqrt(layer + body), 1e-4 * std::sqrt(layer));
}

using std::numbers::pi;

}  // namespace antilock::test::analysis_test::best_approximation_test
