#include "antilock/analysis/kernel.hpp"

#include <fmt/format.h>

#include <Eigen/SPQRSupport>
#include <algorithm>
#include <set>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/memory.hpp"

namespace antilock {

SparseMatrix free_prolongation(const VariationalInequality& problem) {
  std::vector<char> fixed(problem.size(), 0);
  for (const int i : problem.dirichlet_dofs) fixed[i] = 1;
  SparseMatrix places(problem.size(), problem.free_count());
  for (int i = 0, column = 0; i < problem.size(); ++i)
    if (!fixed[i]) places.insert(i, column++) = 1;
  return places;
}

namespace {

/// Orthogonal triangular factors of b, in which what is dependent to `threshold(b)` counts as
/// dependent.
using Factors = Eigen::SPQR<SparseMatrix>;

double threshold(const SparseMatrix& b) {
  double largest = 0;
  for (Eigen::Index j = 0; j < b.cols(); ++j) largest = std::max(largest, b.col(j).norm());
  return 1e-10 * largest;  // what is dependent is so to round-off
}

void factorise(Factors& qr, const SparseMatrix& b, double threshold) {
  qr.setPivotThreshold(threshold);
  qr.compute(b);
  if (qr.info() != Eigen::Success)
    throw NotConverged(
        "kernel: the factorisation of B failed: out of memory; accepted: fewer unknowns", 1, 0);
}

}  // namespace

int kernel_dimension(const VariationalInequality& problem) {
  check(problem);
  const SparseMatrix b = assemble_fixed_rows(problem).b * free_prolongation(problem);
  if (b.nonZeros() == 0) return problem.free_count();
  const BlasCalls blas;
  Factors qr;
  factorise(qr, b, threshold(b));
  return problem.free_count() - static_cast<int>(qr.rank());
}

VariationalInequality stiff_part(VariationalInequality problem) {
  check(problem);
  problem = assemble_fixed_rows(std::move(problem));
  std::vector<char> held(problem.size(), 1);
  for (Eigen::Index row = 0; row < problem.b.rows(); ++row)
    for (RowMatrix::InnerIterator entry(problem.b, row); entry; ++entry) held[entry.col()] = 0;
  for (const int i : problem.dirichlet_dofs) held[i] = 1;
  problem.dirichlet_dofs.clear();
  for (int i = 0; i < problem.size(); ++i)
    if (held[i]) problem.dirichlet_dofs.push_back(i);
  problem.dirichlet_values =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.dirichlet_dofs.size()));
  std::set<int> bounded(problem.bounds.unknowns.begin(), problem.bounds.unknowns.end());
  for (Eigen::Index row = 0; row < problem.bounds.constraints.rows();
       ++row)  // what they combine counts as bounded
    for (RowMatrix::InnerIterator entry(problem.bounds.constraints, row); entry; ++entry)
      bounded.insert(static_cast<int>(entry.col()));
  std::erase_if(bounded, [&](int i) { return held[i] != 0; });
  // the values of the bounds have no part in the kernel of B
  problem.bounds =
      Bounds::lower_on({bounded.begin(), bounded.end()},
                       Eigen::VectorXd::Zero(static_cast<Eigen::Index>(bounded.size())));
  return problem;
}

int layer_kernel_dimension(const VariationalInequality& problem) {
  return kernel_dimension(stiff_part(problem));
}

int trace_dimension(const VariationalInequality& stiff) {
  const VariationalInequality held =
      equality_constrained(stiff, std::vector<bool>(stiff.bounds.unknowns.size(), true));
  return kernel_dimension(stiff) - (held.free_count() > 0 ? kernel_dimension(held) : 0);
}

Eigen::MatrixXd kernel_basis(const VariationalInequality& problem) {
  check(problem);
  const SparseMatrix places = free_prolongation(problem);
  const int n = problem.free_count();
  const SparseMatrix b = assemble_fixed_rows(problem).b * places;
  if (b.nonZeros() == 0) return places.toDense();
  // B' = Q R: the columns of Q behind the rank are orthogonal to every row of B
  const BlasCalls blas;
  Factors qr;
  factorise(qr, b.transpose(), threshold(b));
  const Eigen::MatrixXd behind = Eigen::MatrixXd::Identity(n, n).rightCols(n - qr.rank());
  if (behind.cols() == 0) return Eigen::MatrixXd(problem.size(), 0);
  const Eigen::MatrixXd basis = qr.matrixQ() * behind;
  return places * basis;
}

double coercivity(const VariationalInequality& with_fixed_rows, const SparseMatrix& norm) {
  constexpr int most = 2000;
  check(with_fixed_rows);
  const VariationalInequality problem = assemble_fixed_rows(with_fixed_rows);
  if (norm.rows() != problem.size() || norm.cols() != problem.size())
    throw Error(fmt::format("coercivity: the norm is {} x {}; accepted {} x {}", norm.rows(),
                            norm.cols(), problem.size(), problem.size()));
  if (problem.free_count() > most)
    throw Error(fmt::format("coercivity: {} free unknowns; accepted at most {}",
                            problem.free_count(), most));
  const SparseMatrix places = free_prolongation(problem);
  const SparseMatrix b = problem.b * places;
  const Eigen::MatrixXd form = SparseMatrix(places.transpose() * problem.a1 * places).toDense() +
                               SparseMatrix(b.transpose() * problem.m.asDiagonal() * b).toDense();
  const Eigen::MatrixXd gram = SparseMatrix(places.transpose() * norm * places).toDense();
  if (!Cholesky(gram).positive_definite())
    throw Error("coercivity: the norm is not positive definite");
  return generalised_eigenvalues(form, gram).minCoeff();
}

}  // namespace antilock
