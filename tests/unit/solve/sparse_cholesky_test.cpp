// Two factors behind one interface: what each promises, and that both give the same answers over
// the uniformity table.
#include "antilock/solve/sparse_cholesky.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/solve/eigen_cholesky.hpp"
#include "antilock/solve/penalised_matrix.hpp"
#include "antilock/study/method.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"

namespace antilock::test::solve_test::sparse_cholesky_test {

/// The upper triangle of two tridiagonal matrices (2 on the diagonal, -1 beside it; `size` rows
/// each) that share nothing. Where it `floats`, the second has 1 at both ends of its diagonal: it
/// is held at neither, and singular.
SparseMatrix two_strings(int size, bool floats) {
  SparseMatrix k(2 * size, 2 * size);
  for (int i = 0; i < 2 * size; ++i) {
    const bool end = i == size || i == 2 * size - 1;
    k.insert(i, i) = floats && end ? 1 : 2;
    if (i > 0 && i != size) k.insert(i - 1, i) = -1;
  }
  k.makeCompressed();
  return k;
}

class CholeskyOf : public testing::TestWithParam<CholeskyMaker> {};
INSTANTIATE_TEST_SUITE_P(BothFactors, CholeskyOf,
                         testing::Values(default_cholesky, eigen_cholesky));

TEST_P(CholeskyOf, SolvesAndLeavesTheLastRowsLast) {
  const Space space(unstructured_mesh(8), crouzeix_raviart());
  const VariationalInequality problem = stiff_problem(space, 0.1);
  const DofOrdering free(problem);
  SparseMatrix k = penalised_matrix(problem, free, 1e-3);
  const Eigen::MatrixXd full = Eigen::MatrixXd(k).selfadjointView<Eigen::Upper>();
  const int size = static_cast<int>(k.cols());
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(size, -1, 2), x = Cholesky(full).solve(r);
  const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(full);
  const double round_off = 1e-16 * eigenvalues(size - 1) / eigenvalues(0);  // of x, to first order
  for (const int last : {0, size - free.interior, size}) {
    const auto factor = GetParam()();
    factor->analyse(k, last);
    ASSERT_FALSE(factor->factorise(k));
    EXPECT_LT(relative_difference(factor->backward(factor->forward(r)), x), round_off) << last;
    // L L' of the last rows is their Schur complement
    const Eigen::MatrixXd l = factor->trailing_block(size - last),
                          inside = full.topLeftCorner(size - last, size - last),
                          beside = full.topRightCorner(size - last, last);
    Eigen::MatrixXd schur = full.bottomRightCorner(last, last);
    if (last < size) schur -= test::product(beside.transpose(), Cholesky(inside).solve(beside));
    if (last == 0) continue;
    EXPECT_LT((test::product(l, l.transpose()) - schur).cwiseAbs().maxCoeff(),
              1e-12 * full.cwiseAbs().maxCoeff());
  }
}

// 64 rows: the pivot that is lost is 0 or a few times the round-off of 2; the sign that it comes
// with is chance.
TEST_P(CholeskyOf, NamesARowOfThePieceThatFloatsAndRecovers) {
  for (const int last : {0, 3}) {
    const auto factor = GetParam()();
    SparseMatrix sound = two_strings(64, false), floating = two_strings(64, true), negative = sound;
    negative.coeffRef(70, 70) = -1;
    factor->analyse(sound, last);
    for (SparseMatrix* k : {&floating, &sound, &negative, &sound}) {
      const std::optional<int> lost = factor->factorise(*k);
      EXPECT_EQ(lost.has_value(), k != &sound);
      EXPECT_GE(lost.value_or(64), 64) << "the first piece is sound";
    }
    const Eigen::VectorXd r = Eigen::VectorXd::Ones(128), x = factor->backward(factor->forward(r));
    // backward stable: a small multiple of eps |K| |x|, and |K| < 4; measured 0.06 times 4 of these
    EXPECT_LT((sound.selfadjointView<Eigen::Upper>() * x - r).norm(),
              4 * std::numeric_limits<double>::epsilon() * 4 * x.norm());
  }
}

// In space the factor is so large that METIS orders it.
TEST(DefaultCholesky, LeavesTheLastRowsLastOfALargeFactor) {
  const Space space(structured_mesh(24, {1, CellKind::tetrahedron}), p1(CellKind::tetrahedron));
  const VariationalInequality problem = stiff_problem(space, 0.1);
  const SparseMatrix k = penalised_matrix(problem, DofOrdering(problem), 1e-2);
  const int size = static_cast<int>(k.cols()), last = 4;
  const auto factor = default_cholesky();
  factor->analyse(k, last);
  ASSERT_FALSE(factor->factorise(k));
  Eigen::Matrix4d of_inverse;  // (K^-1) of the last rows and columns
  for (int i = 0; i < last; ++i) {
    const Eigen::VectorXd r = Eigen::VectorXd::Unit(size, size - last + i);
    const Eigen::VectorXd x = factor->backward(factor->forward(r));
    // backward stable, and |K| |x| is at most some 1e3 here
    EXPECT_LT((k.selfadjointView<Eigen::Upper>() * x - r).norm(), 1e-11);
    of_inverse.col(i) = x.tail(last);
  }
  const Eigen::MatrixXd l = factor->trailing_block(size - last);
  EXPECT_TRUE((l * l.transpose() * of_inverse).isIdentity(1e-9));
  // CAMD alone leaves 1.0e7
  EXPECT_LT(factor->entries(), 9e6);
}

// CHOLMOD stores zeros in its supernodes: all entries of the triangle at most.
TEST_P(CholeskyOf, CountsItsEntries) {
  SparseMatrix k = two_strings(64, false);
  const auto factor = GetParam()();
  factor->analyse(k, 0);
  ASSERT_FALSE(factor->factorise(k));
  EXPECT_GE(factor->entries(), 128 + 126);  // each string of 64 has 63 entries below the diagonal
  EXPECT_LE(factor->entries(), 128 * 129 / 2);
  if (GetParam() == &eigen_cholesky) {
    EXPECT_EQ(factor->entries(), 128 + 126);
  }
}

TEST_P(CholeskyOf, SmallestPivotIsThatOfTheElimination) {
  SparseMatrix k(3, 3);
  for (const int i : {0, 1, 2}) k.insert(i, i) = std::pow(10, -i);
  k.makeCompressed();
  const auto factor = GetParam()();
  factor->analyse(k, 0);
  ASSERT_FALSE(factor->factorise(k));
  EXPECT_NEAR(factor->smallest_pivot(), 1e-2, 1e-15);
}

constexpr double every_epsilon[]{1.0,  1e-1,  1e-2,  1e-3,  1e-4,  1e-6,
                                 1e-8, 1e-10, 1e-12, 1e-16, 1e-20, 0.0};

// The answers of 12 epsilons, 2 elements, 2 meshes and 2 values of 1/h. The tolerance of the
// corrections is 1e-10; two factors of the same K take the same ones, and so stand much closer to
// each other than to the solution.
TEST(TwoFactors, BothFactorsGiveTheSameAnswersOverTheUniformityTable) {
  double worst = 0;
  int answers = 0;
  for (const int cells : {16, 64})
    for (const Method& method : methods()) {
      const Space discrete = method.space(cells);
      for (const double epsilon : every_epsilon) {
        SCOPED_TRACE(fmt::format("{}, 1/h = {}, epsilon = {}", method.name(), cells, epsilon));
        const VariationalInequality problem = stiff_problem(discrete, epsilon);
        PenalisedCholesky cholmod(problem, {}, ContactReduction::automatic, default_cholesky);
        PenalisedCholesky eigen(problem, {}, ContactReduction::automatic, eigen_cholesky);
        const Solution one = active_set(problem, cholmod), other = active_set(problem, eigen);
        const double apart = relative_difference(other.u, one.u);
        EXPECT_LT(apart, 1e-12);
        EXPECT_LT(std::abs(eigen.smallest_pivot() / cholmod.smallest_pivot() - 1), 0.9)
            << "pivots of the same K, in another order";
        worst = std::max(worst, apart);
        ++answers;
      }
    }
  EXPECT_EQ(answers, 96);
  fmt::print("{} answers, largest difference {:.1e} (relative, largest entry)\n", answers, worst);
}

// The road on which unknowns are held, and factors are made anew for every set of them.
TEST(TwoFactors, BothFactorsGiveTheSameAnswersOnTheSparseRoad) {
  for (const Method& method : methods()) {
    const Space discrete = method.space(16);
    for (const double epsilon : {1.0, 1e-4, 0.0}) {
      const VariationalInequality problem = stiff_problem(discrete, epsilon);
      PenalisedCholesky cholmod(problem, {}, ContactReduction::sparse, default_cholesky);
      PenalisedCholesky eigen(problem, {}, ContactReduction::sparse, eigen_cholesky);
      EXPECT_NE(eigen.sparse_factor(), nullptr);
      EXPECT_LT(relative_difference(active_set(problem, eigen).u, active_set(problem, cholmod).u),
                1e-12)
          << method.name();
    }
  }
}

}  // namespace antilock::test::solve_test::sparse_cholesky_test
