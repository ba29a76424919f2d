#pragma once
#include <vector>

#include "antilock/distributed/detail/distributed_problem.hpp"

namespace antilock::distributed {

/// The operator of all ranks
///
///     v -> A1 v + delta^-1 B' M (B v)   on the free rows,
///     v -> diag(A_delta) v              on the fixed rows: the clamped ones and the contact set.
///
/// A1, B and M are the factors of a DistributedProblem. They are never summed, because A_delta, the
/// sum, loses the digits of A1 as delta falls (measured, relative errors of a solution: 7e-6 with
/// the sum at delta = 1e-8 and 3e-2 at 1e-12; 3e-9 with the factors).
class SplitOperator {
 public:
  /// `problem` must live as long as the operator. Every rank must call it.
  explicit SplitOperator(const DistributedProblem& problem);
  SplitOperator(const SplitOperator&) = delete;
  SplitOperator& operator=(const SplitOperator&) = delete;

  /// Fixes the rows of the contact set `held`, those of this rank, and the clamped rows. `summed`
  /// is A_delta with its diagonal on these rows.
  void fix_rows(const std::vector<PetscInt>& held, Mat summed);

  /// The operator as a shell matrix of PETSc.
  Mat matrix() const { return matrix_; }
  /// 1 on free rows and 0 on fixed ones.
  Vec free_rows() const { return free_; }
  /// Sets y to the operator times x.
  void multiply(Vec x, Vec y);

 private:
  const DistributedProblem& problem_;
  Vector free_;      ///< 1 on free rows, 0 on fixed ones
  Vector diagonal_;  ///< 0 on free rows, the diagonal on fixed ones
  Vector work_;
  Matrix matrix_;
};

}  // namespace antilock::distributed
