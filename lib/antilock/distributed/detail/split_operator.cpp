#include "antilock/distributed/detail/split_operator.hpp"

#include <exception>

namespace antilock::distributed {
namespace {

/// The callback of the shell matrix. No exception may pass through the frames of PETSc, which is
/// written in C.
PetscErrorCode multiply_shell(Mat matrix, Vec x, Vec y) {
  SplitOperator* split = nullptr;
  if (MatShellGetContext(matrix, &split) != 0) return PETSC_ERR_LIB;
  try {
    split->multiply(x, y);
  } catch (const std::exception&) {
    return PETSC_ERR_LIB;
  }
  return 0;
}

}  // namespace

SplitOperator::SplitOperator(const DistributedProblem& problem)
    : problem_(problem),
      free_(problem.rows().vector()),
      diagonal_(problem.rows().vector()),
      work_(problem.rows().vector()) {
  const auto owned = static_cast<PetscInt>(problem.rows().owned());
  ok(MatCreateShell(PETSC_COMM_WORLD, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, this,
                    &matrix_));
  ok(MatShellSetOperation(matrix_, MATOP_MULT, reinterpret_cast<void (*)(void)>(multiply_shell)));
}

void SplitOperator::fix_rows(const std::vector<PetscInt>& held, Mat summed) {
  const DofMap& rows = problem_.rows();
  ok(MatGetDiagonal(summed, diagonal_));
  ok(VecSet(free_, 1));
  Entries is_free(free_);
  Entries diagonal(diagonal_);
  for (const PetscInt row : held) is_free[row - rows.first()] = 0;
  for (int place = 0; place < rows.owned(); ++place)
    if (rows.clamped(rows.unknown(place))) is_free[place] = 0;
  diagonal.array() *= 1 - is_free.array();
}

void SplitOperator::multiply(Vec x, Vec y) {
  const VariationalInequality& part = problem_.part();
  ok(VecPointwiseMult(work_, free_, x));
  const Eigen::VectorXd v = problem_.rows().local(work_);
  const Eigen::VectorXd stress = part.m.cwiseProduct(part.b * v) / problem_.delta();
  const Eigen::VectorXd product = part.a1 * v + part.b.transpose() * stress;
  problem_.rows().summed(product, y);
  ok(VecPointwiseMult(y, free_, y));
  ok(VecPointwiseMult(work_, diagonal_, x));
  ok(VecAXPY(y, 1, work_));
}

}  // namespace antilock::distributed
