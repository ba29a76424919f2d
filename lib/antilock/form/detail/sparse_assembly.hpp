#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <utility>
#include <vector>

#include "antilock/space/space.hpp"

namespace antilock {

/// Sums element matrices into a sparse matrix, in linear time: the mesh says which entries there are, and each element
/// adds to them in place. `local(t)` returns the m x m matrix of triangle t.
template <class LocalMatrix>
Eigen::SparseMatrix<double> sum_element_matrices(const Space& space, LocalMatrix&& local) {
  const auto& unknowns = space.unknowns();
  const auto triangles = unknowns.rows(), m = unknowns.cols();
  std::vector<int> start(space.size() + 1, 0), around(unknowns.size());  // the triangles around each unknown
  for (const int j : unknowns.reshaped()) ++start[j + 1];
  for (int j = 0; j < space.size(); ++j) start[j + 1] += start[j];
  std::vector<int> end(start.begin(), start.end() - 1);
  for (Eigen::Index t = 0; t < triangles; ++t)
    for (Eigen::Index j = 0; j < m; ++j) around[end[unknowns(t, j)]++] = static_cast<int>(t);

  // column j has a row per unknown that shares a triangle with unknown j
  Eigen::SparseMatrix<double> sum(space.size(), space.size());
  int* const outer = sum.outerIndexPtr();
  std::vector<int> rows, last(space.size(), -1);  // the last column that a row was found in
  rows.reserve(m * around.size());
  outer[0] = 0;
  for (int j = 0; j < space.size(); ++j) {
    for (int k = start[j]; k < start[j + 1]; ++k)
      for (Eigen::Index i = 0; i < m; ++i)
        if (const int row = unknowns(around[k], i); std::exchange(last[row], j) != j) rows.push_back(row);
    std::sort(rows.begin() + outer[j], rows.end());
    outer[j + 1] = static_cast<int>(rows.size());
  }
  sum.resizeNonZeros(outer[space.size()]);
  std::copy(rows.begin(), rows.end(), sum.innerIndexPtr());
  sum.coeffs().setZero();

  for (Eigen::Index t = 0; t < triangles; ++t) {
    const auto matrix = local(static_cast<int>(t));
    for (Eigen::Index j = 0; j < m; ++j) {
      const auto column = rows.begin() + outer[unknowns(t, j)];
      for (Eigen::Index i = 0; i < m; ++i)
        sum.valuePtr()[std::find(column, rows.end(), unknowns(t, i)) - rows.begin()] += matrix(i, j);
    }
  }
  return sum;
}

}  // namespace antilock
