#include "unconstrained_cholesky.hpp"

#include <Eigen/CholmodSupport>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/penalised_matrix.hpp"

namespace antilock {

CholeskySeconds unconstrained_cholesky(const VariationalInequality& problem) {
  const DofOrdering ordering(problem);
  const SparseMatrix k = penalised_matrix(problem, ordering, penalty_parameter(problem));
  const Eigen::VectorXd load = problem.load(ordering.dof);
  CholeskySeconds seconds;
  Stopwatch watch;
  Eigen::CholmodDecomposition<SparseMatrix, Eigen::Upper> cholesky;
  cholesky.analyzePattern(k);
  seconds.analyse = watch.lap();
  cholesky.factorize(k);
  seconds.factor = watch.lap();
  const Eigen::VectorXd u = cholesky.solve(load);
  seconds.solve = watch.lap();
  if (cholesky.info() != Eigen::Success || !u.allFinite())
    throw Error("benchmark: the Cholesky factorisation failed");
  return seconds;
}

}  // namespace antilock
