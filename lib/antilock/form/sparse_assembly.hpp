#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <vector>

#include "antilock/space/space.hpp"

namespace antilock {

/// Sums element matrices into a sparse matrix, in linear time: entries are dropped into their column, then merged there
/// (a column receives a few dozen). `local(t)` returns the m x m matrix of triangle t.
template <class LocalMatrix>
Eigen::SparseMatrix<double> sum_element_matrices(const Space& space, LocalMatrix&& local) {
  const auto& unknowns = space.unknowns();
  const auto triangles = unknowns.rows(), m = unknowns.cols();
  std::vector<int> start(space.size() + 1, 0);
  for (Eigen::Index t = 0; t < triangles; ++t)
    for (Eigen::Index j = 0; j < m; ++j) start[unknowns(t, j) + 1] += static_cast<int>(m);
  for (int j = 0; j < space.size(); ++j) start[j + 1] += start[j];

  struct Entry {
    int row;
    double value;
  };
  std::vector<Entry> entries(start.back());
  std::vector<int> end(start.begin(), start.end() - 1);  // each column is kept merged and sorted by row
  for (Eigen::Index t = 0; t < triangles; ++t) {
    const auto matrix = local(static_cast<int>(t));
    for (Eigen::Index j = 0; j < m; ++j) {
      const int column = unknowns(t, j);
      for (Eigen::Index i = 0; i < m; ++i) {
        const int row = unknowns(t, i);
        Entry* const first = entries.data() + start[column];
        Entry* place = entries.data() + end[column];
        while (place != first && place[-1].row > row) --place;
        if (place != first && place[-1].row == row) {
          place[-1].value += matrix(i, j);
        } else {
          std::move_backward(place, entries.data() + end[column], entries.data() + end[column] + 1);
          *place = {row, matrix(i, j)};
          ++end[column];
        }
      }
    }
  }

  Eigen::SparseMatrix<double> sum(space.size(), space.size());
  int* const outer = sum.outerIndexPtr();
  outer[0] = 0;
  for (int j = 0; j < space.size(); ++j) outer[j + 1] = outer[j] + end[j] - start[j];
  sum.resizeNonZeros(outer[space.size()]);
  for (int j = 0; j < space.size(); ++j)
    for (int k = start[j], to = outer[j]; k < end[j]; ++k, ++to) {
      sum.innerIndexPtr()[to] = entries[k].row;
      sum.valuePtr()[to] = entries[k].value;
    }
  return sum;
}

}  // namespace antilock
