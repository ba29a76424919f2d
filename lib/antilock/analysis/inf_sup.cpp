#include "antilock/analysis/inf_sup.hpp"

#include <fmt/format.h>

#include <Eigen/CholmodSupport>
#include <algorithm>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/solve/detail/penalised_matrix.hpp"

namespace antilock {

Eigen::MatrixXd multiplier_gram(const VariationalInequality& problem, const SparseMatrix& norm, int merged) {
  check(problem);
  if (norm.rows() != problem.size() || norm.cols() != problem.size())
    throw Error(fmt::format("inf-sup: the norm is {} x {}; accepted {} x {}", norm.rows(), norm.cols(), problem.size(),
                            problem.size()));
  if (merged < 1 || problem.b.rows() % merged != 0)
    throw Error(fmt::format("inf-sup: {} rows of B, {} a multiplier; accepted: a divisor", problem.b.rows(), merged));
  const FreeNumbering numbering(problem);
  const auto free = static_cast<Eigen::Index>(numbering.unknown.size());
  SparseMatrix places(problem.size(), free);
  for (Eigen::Index i = 0; i < free; ++i) places.insert(numbering.unknown[i], i) = 1;

  // column q of B' M, the rows of a multiplier added up
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(free, problem.b.rows() / merged);
  for (Eigen::Index r = 0; r < problem.b.rows(); ++r)
    for (RowMatrix::InnerIterator entry(problem.b, r); entry; ++entry)
      if (const int place = numbering.place[entry.col()]; place >= 0)
        right(place, r / merged) += problem.m(r) * entry.value();
  const Eigen::CholmodSupernodalLLT<SparseMatrix> factor(SparseMatrix(places.transpose() * norm * places));
  if (factor.info() != Eigen::Success) throw Error("inf-sup: the norm is not positive definite");
  const Eigen::MatrixXd gram = right.transpose() * factor.solve(right).eval();
  return 0.5 * (gram + gram.transpose());  // round-off alone
}

double inf_sup(const Eigen::MatrixXd& seen, const Eigen::MatrixXd& norm) {
  if (!Cholesky(norm).positive_definite()) throw Error("inf-sup: the multipliers' norm is not positive definite");
  const Eigen::VectorXd squares = generalised_eigenvalues(seen, norm);
  const double least = squares.minCoeff(), largest = squares.maxCoeff();
  return least > 1e-12 * largest ? std::sqrt(least) : 0;  // a dependent row of B, to round-off
}

}  // namespace antilock
