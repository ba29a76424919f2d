// Uniform in epsilon, down to and including 0: the solver against the same discrete problem in
// quadruple precision, and the discrete answer against the truth.
#include <Eigen/SPQRSupport>
#include <Eigen/UmfPackSupport>
#include <cstdlib>

#include "antilock/core/dense.hpp"
#include "antilock/exact/exact_table.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "hard/quad_reference.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"

namespace antilock::hard::uniformity_test {

constexpr std::array every_epsilon{1.0,  1e-1,  1e-2,  1e-3,  1e-4,  1e-6,
                                   1e-8, 1e-10, 1e-12, 1e-16, 1e-20, 0.0};
constexpr std::array few_epsilons{1e-6, 0.0};  // 1/h = 256, where a solve takes long

struct Case {
  const char* element;
  bool structured;
  int cells;
  bool locks() const { return !structured && element == std::string("P1"); }
};
std::string name(const testing::TestParamInfo<Case>& info) {
  return std::string(info.param.element) + (info.param.structured ? "Structured" : "Unstructured") +
         std::to_string(info.param.cells);
}

class Uniformity : public testing::TestWithParam<Case> {
 protected:
  Uniformity()
      : space_(GetParam().structured ? structured_mesh(GetParam().cells)
                                     : unstructured_mesh(GetParam().cells),
               element(GetParam().element)) {}
  std::vector<double> epsilons() const {
    if (GetParam().cells > 64 && std::getenv("ANTILOCK_THOROUGH") == nullptr) {
      // where P1 has locked, every contact set but one is off by round-off: the reference searches
      // for minutes
      if (GetParam().locks()) return {1e-2};
      return {few_epsilons.begin(), few_epsilons.end()};
    }
    return {every_epsilon.begin(), every_epsilon.end()};
  }
  Space space_;
};

// 1e-9 is what the solver promises (its tolerance is 1e-10, estimated). The quadruple solution of
// the contact set found is the solution of the inequality where its own gaps and pressures have the
// right sign; at a locked epsilon the gap is compliance itself, and no double precision solve can
// tell the contact set: there the set is found again.
TEST_P(Uniformity, AlgebraicErrorBelow1e9AtEveryEpsilon) {
  RefinedReference reference;
  QuadSolution exact;  // each one is the neighbour of the next
  for (const double epsilon : epsilons()) {
    SCOPED_TRACE(epsilon);
    const VariationalInequality problem = test::stiff_problem(space_, epsilon);
    const Solution solution = active_set(problem);
    exact = settle(problem, solution.active, std::ref(reference), exact);
    ASSERT_LT(exact.residual, 1e-20);
    EXPECT_GE(exact.min_gap, -1e-18);
    EXPECT_GE(exact.min_pressure, -1e-18);
    EXPECT_LT(distance(solution.u, exact.u), 1e-9);
    EXPECT_LT(distance(solution.u, exact.u), 10 * solution.error);
    EXPECT_TRUE(solution.warning.empty()) << solution.warning;
    if (!GetParam().locks()) {
      EXPECT_LE(solution.counters.corrections, 10);
      EXPECT_EQ(exact.sets, 1) << "the contact set is exactly right";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Paper, Uniformity,
                         testing::Values(Case{"P1", true, 16}, Case{"CR", true, 16},
                                         Case{"P1", false, 16}, Case{"CR", false, 16},
                                         Case{"P1", true, 64}, Case{"CR", true, 64},
                                         Case{"P1", false, 64}, Case{"CR", false, 64},
                                         Case{"P1", true, 256}, Case{"CR", true, 256},
                                         Case{"P1", false, 256}, Case{"CR", false, 256}),
                         name);

using SmallUniformity = Uniformity;

// No double precision factor anywhere in this reference: L D L' in quadruple precision.
TEST_P(SmallUniformity, AgreesWithAFactorisationInQuadruplePrecision) {
  QuadSolution exact;
  for (const double epsilon : every_epsilon) {
    SCOPED_TRACE(epsilon);
    const VariationalInequality problem = test::stiff_problem(space_, epsilon);
    const Solution solution = active_set(problem);
    exact = settle(problem, solution.active, quad_reference, exact);
    ASSERT_LT(exact.residual, 1e-24);
    EXPECT_GE(std::min(exact.min_gap, exact.min_pressure), -1e-18);
    EXPECT_LT(distance(solution.u, exact.u), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Paper, SmallUniformity,
                         testing::Values(Case{"P1", true, 16}, Case{"CR", true, 16},
                                         Case{"P1", false, 16}, Case{"CR", false, 16}),
                         name);

/// u with the contact set held, from the saddle-point form [A1 B'M; MB -compliance M] by UMFPACK:
/// another formulation, another library, no penalty and no correction.
Eigen::VectorXd saddle_point(const VariationalInequality& problem,
                             const std::vector<bool>& active) {
  const VariationalInequality linear = equality_constrained(problem, active);
  const DofOrdering ordering(linear);
  const int size = static_cast<int>(ordering.dof.size()), rows = static_cast<int>(problem.b.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < problem.a1.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(problem.a1, j); a; ++a)
      if (ordering.position[a.row()] >= 0 && ordering.position[j] >= 0)
        entries.emplace_back(ordering.position[a.row()], ordering.position[j], a.value());
  for (int r = 0; r < rows; ++r) {
    for (RowMatrix::InnerIterator b(problem.b, r); b; ++b)
      if (const int place = ordering.position[b.col()]; place >= 0) {
        entries.emplace_back(place, size + r, b.value() * problem.m(r));
        entries.emplace_back(size + r, place, b.value() * problem.m(r));
      }
    entries.emplace_back(size + r, size + r, -problem.compliance * problem.m(r));
  }
  SparseMatrix k(size + rows, size + rows);
  k.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(size + rows);
  rhs.head(size) = problem.load(ordering.dof);
  const Eigen::UmfPackLU<SparseMatrix> factor(k);
  EXPECT_EQ(factor.info(), Eigen::Success);
  const Eigen::VectorXd both = factor.solve(rhs);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(problem.size());
  u(ordering.dof) = both.head(size);
  return u;
}

// The rows of B are independent for Crouzeix-Raviart alone, so the saddle point is regular at
// epsilon = 0 there.
TEST(Formulations, SaddlePointByUmfpackAgreesForCrouzeixRaviart) {
  for (const bool structured : {true, false}) {
    const Space space(structured ? structured_mesh(64) : unstructured_mesh(64), crouzeix_raviart());
    for (const double epsilon : {1.0, 1e-3, 1e-8, 1e-16, 0.0}) {
      const VariationalInequality problem = test::stiff_problem(space, epsilon);
      const Solution solution = active_set(problem);
      const Eigen::VectorXd other = saddle_point(problem, solution.active);
      EXPECT_LT((solution.u - other).lpNorm<Eigen::Infinity>() / other.lpNorm<Eigen::Infinity>(),
                1e-9)
          << epsilon << (structured ? " structured" : " unstructured");
    }
  }
}

/// Columns that span the kernel of B on the free unknowns, from the rank-revealing QR of B'.
Eigen::MatrixXd kernel_basis(const VariationalInequality& linear, const DofOrdering& ordering) {
  const int size = static_cast<int>(ordering.dof.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < linear.b.rows(); ++r)
    for (RowMatrix::InnerIterator b(linear.b, r); b; ++b)
      if (const int place = ordering.position[b.col()]; place >= 0)
        entries.emplace_back(place, r, b.value());
  SparseMatrix b_transposed(size, linear.b.rows());
  b_transposed.setFromTriplets(entries.begin(), entries.end());
  Eigen::SPQR<SparseMatrix> qr;
  qr.setPivotThreshold(1e-10);
  qr.compute(b_transposed);
  const Eigen::Index kernel = size - qr.rank();
  Eigen::MatrixXd last = Eigen::MatrixXd::Zero(size, kernel);
  last.bottomRows(kernel).setIdentity();
  return qr.matrixQ() * last;  // the columns of Q beyond the rank are orthogonal to the range of B'
}

// (7): the inequality on G_h, the kernel of a0, without any penalty. Projected on a basis of G_h it
// is a small dense complementarity problem, solved here with the contact set of the solver and
// checked for both signs.
TEST(Formulations, EpsilonZeroIsTheProblemOnTheKernelOfA0) {
  for (const Case c :
       {Case{"P1", true, 16}, Case{"CR", true, 16}, Case{"CR", false, 16}, Case{"P1", false, 16}}) {
    SCOPED_TRACE(std::string(c.element) + (c.structured ? " structured" : " unstructured"));
    const TriangleMesh mesh = c.structured ? structured_mesh(c.cells) : unstructured_mesh(c.cells);
    const Space space(mesh, element(c.element));
    const VariationalInequality problem = test::stiff_problem(space, 0);
    const Solution solution = active_set(problem);
    const VariationalInequality linear = equality_constrained(problem, solution.active);
    const DofOrdering ordering(linear);
    const Eigen::MatrixXd z = kernel_basis(linear, ordering);
    const Eigen::MatrixXd a1 = Eigen::MatrixXd(problem.a1)(ordering.dof, ordering.dof);
    const Eigen::VectorXd load = problem.load(ordering.dof);
    const Eigen::MatrixXd projected = test::product(z.transpose(), test::product(a1, z));
    const Eigen::VectorXd y = Cholesky(projected).solve(Eigen::VectorXd(z.transpose() * load));
    Eigen::VectorXd u = Eigen::VectorXd::Zero(problem.size());
    u(ordering.dof) = z * y;
    // 1e-10 is the solver's tolerance; the projected problem itself carries about 1e-13
    EXPECT_LT((solution.u - u).lpNorm<Eigen::Infinity>() / u.lpNorm<Eigen::Infinity>(), 1e-9);
    EXPECT_GE(u(problem.bounds.unknowns).minCoeff(), -1e-12);
    EXPECT_LT((problem.b * solution.u).lpNorm<Eigen::Infinity>() * mesh.diameter(), 1e-9);
  }
}

// The paper's promise in numbers: below 1e-3 the error no longer depends on epsilon, for elements
// that do not lock. The truth table carries 1e-7 or better, the errors are 8e-5 and more: within 1
// % of each other.
TEST(UniformError, IsFlatInEpsilonWhereNothingLocks) {
  const TriangleMesh structured = structured_mesh(32), unstructured = unstructured_mesh(32);
  struct Row {
    const TriangleMesh* mesh;
    const char* element;
    double limit = 0;  // the error at epsilon = 0
  };
  std::array rows{Row{&structured, "P1"}, Row{&structured, "CR"}, Row{&unstructured, "CR"}};
  for (const double epsilon : {0.0, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-16, 1e-20}) {
    const ExactTable exact_solution{ExactSolution(paper_sine_load(), epsilon)};
    for (Row& row : rows) {
      const Space space(*row.mesh, element(row.element));
      const Solution solution = active_set(test::stiff_problem(space, epsilon));
      double error = 0;
      for (int i = 0; i < space.size(); ++i)
        error = std::max(
            error, std::abs(solution.u(i) - exact_solution.value(space.dof_coordinates()(i, 0),
                                                                 space.dof_coordinates()(i, 1))));
      if (epsilon == 0) row.limit = error;
      EXPECT_NEAR(error / row.limit, 1, 0.01) << row.element << " at epsilon = " << epsilon;
      EXPECT_LT(error, 2e-3) << "an absolute cap: half the locked error would be 2e-2";
    }
  }
}

}  // namespace antilock::hard::uniformity_test
