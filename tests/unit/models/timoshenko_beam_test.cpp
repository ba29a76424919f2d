// The Timoshenko beam over an obstacle: another member of the class, the same solver; full
// integration locks.
#include "antilock/analysis/kernel.hpp"
#include "antilock/exact/exact_beam.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plate.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"

namespace antilock::test::models_test::timoshenko_beam_test {

Beam beam(int cells, double epsilon, ShearIntegration shear) {
  return {.cells = cells, .epsilon = epsilon, .shear = shear};
}

double nodal_error(const Beam& b) {
  const ExactBeam exact(b);
  const Solution solution = active_set(assemble(b));
  double largest = 0;
  for (int i = 0; i <= b.cells; ++i)
    largest = std::max(
        largest, std::abs(solution.u(2 * i) - exact.deflection(static_cast<double>(i) / b.cells)));
  return largest;
}

TEST(Beam, TheTruthHasItsKnownDigits) {
  const auto start = [](double epsilon) {
    return ExactBeam(beam(2, epsilon, ShearIntegration::reduced));
  };
  EXPECT_NEAR(start(1).contact_start(), 0.01852, 5e-6);
  EXPECT_NEAR(start(1e-2).contact_start(), 0.17822, 5e-6);
  EXPECT_NEAR(start(1e-4).contact_start(), 0.32230, 1e-5);
  const ExactBeam bernoulli = start(0);
  EXPECT_NEAR(bernoulli.contact_start(), 1.0 / 3, 1e-13);  // (72 gap / load)^(1/4)
  EXPECT_NEAR(bernoulli.contact_force(), 5 * 5832.0 / 9, 1e-8);
  EXPECT_NEAR(bernoulli.energy(), -3758.4, 1e-8);
}

TEST(Beam, TheTruthSolvesItsEquations) {
  // off the obstacle V' = q and theta'' = -V, V = (w' - theta)/epsilon, by differences
  const double epsilon = 1e-2, q = Beam{}.load, d = 1e-4;
  const ExactBeam exact(beam(2, epsilon, ShearIntegration::reduced));
  const auto shear = [&](double x) {
    return ((exact.deflection(x + d) - exact.deflection(x - d)) / (2 * d) - exact.rotation(x)) /
           epsilon;
  };
  for (const double x : {0.03, 0.1, 0.15}) {
    EXPECT_NEAR((shear(x + d) - shear(x - d)) / (2 * d) / q, 1, 1e-4) << x;
    const double bending =
        (exact.rotation(x + d) - 2 * exact.rotation(x) + exact.rotation(x - d)) / (d * d);
    EXPECT_NEAR(bending / shear(x), -1, 1e-4) << x;
  }
  // on it w' = 0: epsilon theta'' = theta; odd about the middle, and continuous where contact
  // begins
  for (const double x : {0.2, 0.3, 0.4}) {
    const double bending =
        (exact.rotation(x + d) - 2 * exact.rotation(x) + exact.rotation(x - d)) / (d * d);
    EXPECT_NEAR(epsilon * bending / exact.rotation(x), 1, 1e-4) << x;
    EXPECT_NEAR(exact.rotation(1 - x) / -exact.rotation(x), 1, 1e-13) << x;
  }
  EXPECT_NEAR(exact.rotation(exact.contact_start() + 1e-9) / exact.rotation(exact.contact_start()),
              1, 1e-6);
  EXPECT_EQ(ExactBeam(beam(2, 0, ShearIntegration::reduced)).rotation(0.4), 0)
      << "Bernoulli's beam lies flat";
}

TEST(Beam, FullIntegrationLocksAndReducedDoesNot) {
  struct Row {
    double epsilon;
    double full[3], reduced[3];
  };
  // two digits each, measured by a first program that shares no line with this library
  for (const Row& row : {Row{1e-2, {9.1e-3, 1.4e-3, 7e-5}, {9.5e-3, 1.4e-3, 7e-5}},
                         Row{1e-4, {0.27, 3.5e-2, 2.4e-3}, {2.4e-2, 1.4e-3, 7e-5}},
                         Row{1e-8, {1.0, 0.99, 0.91}, {2.3e-2, 1.6e-3, 1.1e-4}},
                         Row{0, {1.0, 1.0, 1.0}, {2.3e-2, 1.6e-3, 1.1e-4}}}) {
    int k = 0;
    for (const int cells : {16, 64, 256}) {
      SCOPED_TRACE("epsilon " + std::to_string(row.epsilon) + ", cells " + std::to_string(cells));
      EXPECT_NEAR(nodal_error(beam(cells, row.epsilon, ShearIntegration::full)) / row.full[k], 1,
                  0.05);
      EXPECT_NEAR(nodal_error(beam(cells, row.epsilon, ShearIntegration::reduced)) / row.reduced[k],
                  1, 0.05);
      ++k;
    }
  }
}

TEST(Beam, IsSolvedInAFewStepsAndCorrectionsHoweverFine) {
  // In contact the condition number grows like h^-4 (7e10 on 512 cells). Every digit of the default
  // tolerance is reached nevertheless: residuals are exact. From the nested start the contact steps
  // do not grow with n (cold: 306 on 512 cells).
  for (const double epsilon : {1e-4, 1e-8, 0.0})
    for (const int cells : {64, 256, 512}) {
      SCOPED_TRACE("epsilon " + std::to_string(epsilon) + ", cells " + std::to_string(cells));
      const Beam b = beam(cells, epsilon, ShearIntegration::reduced);
      const Solution solution = active_set(assemble(b));
      EXPECT_LE(solution.counters.contact_iterations, 30);             // measured: 23 at most
      EXPECT_LE(solution.counters.corrections, cells > 256 ? 25 : 5);  // measured: 19 and 5 at most
      EXPECT_LT(solution.kkt.residual, 1e-11);                         // measured: 4e-13 at most
      EXPECT_NEAR(solution.lambda.sum() / ExactBeam(b).contact_force(), 1, 1e-3);
    }
}

TEST(Beam, LockingIsABendingStiffnessThatIsTooLarge) {
  // the identity of the shear energies, and with it of the solutions, contact included
  for (const int cells : {16, 64})
    for (const double epsilon : {1e-2, 1e-4}) {
      const VariationalInequality full = assemble(beam(cells, epsilon, ShearIntegration::full));
      VariationalInequality reduced = assemble(beam(cells, epsilon, ShearIntegration::reduced));
      const double h = 1.0 / cells;
      const Eigen::MatrixXd full_shear = test::gram(full.b, full.m);
      const Eigen::MatrixXd reduced_shear = test::gram(reduced.b, reduced.m);
      EXPECT_LT((full_shear - reduced_shear - h * h / 12 * full.a1.toDense()).cwiseAbs().maxCoeff(),
                1e-14 * full_shear.cwiseAbs().maxCoeff());

      reduced.a1 *= 1 + h * h / (12 * epsilon);
      ActiveSetOptions options;
      options.corrections.tolerance = 1e-13;
      const Solution a = active_set(full, options), b = active_set(reduced, options);
      EXPECT_EQ(a.active, b.active);
      EXPECT_LT((a.u - b.u).cwiseAbs().maxCoeff(), 1e-12 * b.u.cwiseAbs().maxCoeff());
      EXPECT_GT(a.lambda.sum(), 0);
    }
}

TEST(Beam, LockingIsTheKernelOfB) {
  for (const int cells : {8, 16, 33}) {
    const VariationalInequality full = assemble(beam(cells, 0, ShearIntegration::full));
    const VariationalInequality reduced = assemble(beam(cells, 0, ShearIntegration::reduced));
    EXPECT_EQ(kernel_dimension(full), 0);
    EXPECT_EQ(kernel_dimension(reduced), cells - 2);
    const Eigen::MatrixXd basis = kernel_basis(reduced);
    ASSERT_EQ(basis.cols(), cells - 2);
    EXPECT_EQ(kernel_basis(full).cols(), 0);
    // rows of B are of size 1/h = cells
    EXPECT_LT((reduced.b * basis).cwiseAbs().maxCoeff(), 1e-13 * cells);
    EXPECT_LT(
        (test::product(basis.transpose(), basis) - Eigen::MatrixXd::Identity(cells - 2, cells - 2))
            .norm(),
        1e-12);
  }
}

TEST(Beam, ForcesConcentrateAtTheEndsOfContact) {
  const ExactBeam exact(beam(64, 0, ShearIntegration::reduced));
  const Solution solution = active_set(assemble(beam(64, 0, ShearIntegration::reduced)));
  // two point forces q c / 3 at the ends, spread over a few nodes there
  double at_end = 0;
  for (int i = 0; i < 63; ++i)
    if (std::abs((i + 1) / 64.0 - exact.contact_start()) < 3.0 / 64) at_end += solution.lambda(i);
  EXPECT_GT(at_end, 0.9 * Beam{}.load * exact.contact_start() / 3);
}

TEST(Beam, OneFormAloneIsSingularAndTheirSumIsNot) {
  // a1 knows nothing of the deflection; a1 + a0 is coercive in the H1 norm of (w, theta), uniformly
  // in h
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (const int cells : {8, 16, 32, 64}) {
    const VariationalInequality problem = assemble(beam(cells, 0, ShearIntegration::reduced));
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i <= cells; ++i) {
      for (const int k : {0, 1})
        entries.emplace_back(2 * i + k, 2 * i + k, 2.0 * cells + 1.0 / cells);
      if (i < cells)
        for (const int k : {0, 1}) {
          entries.emplace_back(2 * i + k, 2 * i + 2 + k, -cells);
          entries.emplace_back(2 * i + 2 + k, 2 * i + k, -cells);
        }
    }
    SparseMatrix norm(problem.size(), problem.size());
    norm.setFromTriplets(entries.begin(), entries.end());
    const double beta = coercivity(problem, norm);
    smallest = std::min(smallest, beta);
    largest = std::max(largest, beta);
  }
  EXPECT_GT(smallest, 0.1);
  EXPECT_LT(largest / smallest, 1.1);
}

TEST(Beam, RefusesValuesOutOfRange) {
  for (const Beam& bad : {Beam{.cells = 1}, Beam{.epsilon = -1e-9}, Beam{.epsilon = 1.1},
                          Beam{.epsilon = test::nan}, Beam{.gap = 0}, Beam{.load = test::infinity}})
    EXPECT_THROW(assemble(bad), Error);
  EXPECT_THROW(ExactBeam{Beam{.load = 1}}, Error);  // does not reach the obstacle
}

}  // namespace antilock::test::models_test::timoshenko_beam_test
