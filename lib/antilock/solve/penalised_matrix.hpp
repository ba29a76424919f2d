#pragma once
#include <algorithm>
#include <vector>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The order of the n_free unknowns that are solved for: the free unknowns without a bound in their
/// own order, then the bounded unknowns in the order of Bounds::unknowns.
struct DofOrdering {
  explicit DofOrdering(const VariationalInequality& problem) : position(problem.size(), 0) {
    for (const std::vector<int>* list : {&problem.dirichlet_dofs, &problem.bounds.unknowns})
      for (const int i : *list) position[i] = -1;
    for (int i = 0; i < problem.size(); ++i)
      if (position[i] == 0) append(i);
    interior = static_cast<int>(dof.size());
    for (const int i : problem.bounds.unknowns) append(i);
  }
  /// Returns the number of contact unknowns.
  int contact_count() const { return static_cast<int>(dof.size()) - interior; }

  std::vector<int> dof;       ///< n_free: position -> unknown
  std::vector<int> position;  ///< N: unknown -> position, -1 where it is prescribed
  int interior = 0;           ///< the position of the first contact unknown

 private:
  void append(int i) {
    position[i] = static_cast<int>(dof.size());
    dof.push_back(i);
  }
};

/// Returns the penalty of each row of B (R): delta for parametric rows and for rows with the fixed
/// compliance 0, and max(c, least) for a row with the fixed compliance c > 0.
inline Eigen::VectorXd row_penalties(const VariationalInequality& problem, double delta,
                                     double least) {
  Eigen::VectorXd penalties = Eigen::VectorXd::Constant(problem.b.rows(), delta);
  const Eigen::ArrayXd own = problem.fixed_compliances.array();
  penalties.tail(own.size()) = (own > 0).select(own.max(least), delta);
  return penalties;
}

/// Returns the upper triangle of K = A1 + B' M diag(penalty)^-1 B on the free unknowns (n_free x
/// n_free, in the order of `ordering`), for R penalties. K is used only for the factorisation:
/// where delta^-1 B' M B dominates A1, the sum has lost digits of A1 by cancellation, and residuals
/// with it would be wrong (tutorial 18).
inline SparseMatrix penalised_matrix(const VariationalInequality& problem,
                                     const DofOrdering& ordering, const Eigen::VectorXd& penalty) {
  const int size = static_cast<int>(ordering.dof.size());
  const SparseMatrix b_by_column = problem.b;
  SparseMatrix k(size, size);
  k.reserve((problem.a1.nonZeros() + size) / 2 + b_by_column.nonZeros() / 2);
  std::vector<int> touched;
  std::vector<double> sum(size, 0.0);
  std::vector<char> seen(size, 0);
  // Gustavson's algorithm: one column of the sum at a time, in a dense accumulator. (At 1/h = 256
  // assembly from triplets takes ten times as long, because it moves more memory. That would be an
  // eighth of the time of a solution.)
  for (int column = 0; column < size; ++column) {
    const int j = ordering.dof[column];
    const auto add = [&](Eigen::Index dof, double value) {
      const int row = ordering.position[dof];
      if (row < 0 || row > column) return;
      if (seen[row] == 0) touched.push_back(row);
      seen[row] = 1;
      sum[row] += value;
    };
    for (SparseMatrix::InnerIterator a(problem.a1, j); a; ++a) add(a.row(), a.value());
    for (SparseMatrix::InnerIterator r(b_by_column, j); r; ++r) {
      const double weight = problem.m(r.row()) * r.value() / penalty(r.row());
      for (RowMatrix::InnerIterator b(problem.b, r.row()); b; ++b) add(b.col(), weight * b.value());
    }
    std::sort(touched.begin(), touched.end());
    k.startVec(column);
    for (const int row : touched) {
      k.insertBackByOuterInner(column, row) = sum[row];
      sum[row] = seen[row] = 0;
    }
    touched.clear();
  }
  k.finalize();
  return k;
}

/// Returns the same for one penalty delta of all rows; a fixed compliance above delta is the
/// penalty of its row.
inline SparseMatrix penalised_matrix(const VariationalInequality& problem,
                                     const DofOrdering& ordering, double delta) {
  return penalised_matrix(problem, ordering, row_penalties(problem, delta, delta));
}

}  // namespace antilock
