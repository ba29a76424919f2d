#include "antilock/analysis/inf_sup.hpp"

#include <fmt/format.h>

#include <Eigen/CholmodSupport>

#include "antilock/analysis/kernel.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"

namespace antilock {

Eigen::MatrixXd multiplier_gram(const VariationalInequality& with_fixed_rows,
                                const SparseMatrix& norm, int merged) {
  check(with_fixed_rows);
  const VariationalInequality problem = assemble_fixed_rows(with_fixed_rows);
  if (norm.rows() != problem.size() || norm.cols() != problem.size())
    throw Error(fmt::format("inf-sup: the norm is {} x {}; accepted {} x {}", norm.rows(),
                            norm.cols(), problem.size(), problem.size()));
  if (merged < 1 || problem.b.rows() % merged != 0)
    throw Error(fmt::format("inf-sup: {} rows of B, {} a multiplier; accepted: a divisor",
                            problem.b.rows(), merged));
  const SparseMatrix places = free_prolongation(problem);
  const RowMatrix b = problem.b * places;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(
      places.cols(), b.rows() / merged);  // B' M, the rows of a multiplier added up
  for (Eigen::Index r = 0; r < b.rows(); ++r)
    right.col(r / merged) += problem.m(r) * b.row(r).transpose();
  const Eigen::CholmodSupernodalLLT<SparseMatrix> factor(
      SparseMatrix(places.transpose() * norm * places));
  if (factor.info() != Eigen::Success) throw Error("inf-sup: the norm is not positive definite");
  const Eigen::MatrixXd gram = right.transpose() * factor.solve(right).eval();
  return 0.5 * (gram + gram.transpose());  // round-off alone
}

double inf_sup(const Eigen::MatrixXd& space_gram, const Eigen::MatrixXd& norm_gram) {
  if (!Cholesky(norm_gram).positive_definite())
    throw Error("inf-sup: the multipliers' norm is not positive definite");
  const Eigen::VectorXd squares = generalised_eigenvalues(space_gram, norm_gram);
  const double least = squares.minCoeff(), largest = squares.maxCoeff();
  return least > 1e-12 * largest ? std::sqrt(least) : 0;  // a dependent row of B, to round-off
}

}  // namespace antilock
