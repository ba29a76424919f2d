#include "antilock/solve/detail/penalised_matrix.hpp"

#include <algorithm>

namespace antilock {

FreeNumbering::FreeNumbering(const VariationalInequality& problem) : place(problem.size(), 0) {
  for (const int i : problem.fixed) place[i] = -1;
  for (const int i : problem.contact) place[i] = -2;
  unknown.reserve(problem.free_count());
  for (int i = 0; i < problem.size(); ++i)
    if (place[i] == 0) {
      place[i] = static_cast<int>(unknown.size());
      unknown.push_back(i);
    }
  interior = static_cast<int>(unknown.size());
  for (const int i : problem.contact) {
    place[i] = static_cast<int>(unknown.size());
    unknown.push_back(i);
  }
}

SparseMatrix penalised_matrix(const VariationalInequality& problem, const FreeNumbering& numbering,
                              const Eigen::VectorXd& deltas) {
  const int size = static_cast<int>(numbering.unknown.size());
  const SparseMatrix b_by_column = problem.b;
  SparseMatrix k(size, size);
  k.reserve((problem.a1.nonZeros() + size) / 2 + b_by_column.nonZeros() / 2);
  std::vector<int> touched;
  std::vector<double> sum(size, 0.0);
  std::vector<char> seen(size, 0);
  // Gustavson's algorithm: one column of the sum at a time, in a dense accumulator.
  for (int column = 0; column < size; ++column) {
    const int j = numbering.unknown[column];
    touched.clear();
    const auto add = [&](int unknown, double value) {
      const int row = numbering.place[unknown];
      if (row < 0 || row > column) return;
      if (!seen[row]) {
        seen[row] = 1;
        touched.push_back(row);
      }
      sum[row] += value;
    };
    for (SparseMatrix::InnerIterator a(problem.a1, j); a; ++a) add(static_cast<int>(a.row()), a.value());
    for (SparseMatrix::InnerIterator r(b_by_column, j); r; ++r) {
      const double weight = problem.m(r.row()) * r.value() / deltas(r.row());
      for (RowMatrix::InnerIterator b(problem.b, r.row()); b; ++b) add(static_cast<int>(b.col()), weight * b.value());
    }
    std::sort(touched.begin(), touched.end());
    k.startVec(column);
    for (const int row : touched) {
      k.insertBackByOuterInner(column, row) = sum[row];
      sum[row] = 0;
      seen[row] = 0;
    }
  }
  k.finalize();
  return k;
}

}  // namespace antilock
