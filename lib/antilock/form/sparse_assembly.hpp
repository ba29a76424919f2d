#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "antilock/form/factored_form.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Returns the matrix (rows x columns) whose entries are the sums of the triplets at each place.
template <class Matrix>
Matrix from_triplets(Eigen::Index rows, Eigen::Index columns, const Triplets& entries) {
  Matrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// A factored form while it is collected row by row.
class FactoredFormBuilder {
 public:
  /// Adds a row for this cell, with this entry of M.
  void add(int cell, double weight) {
    cell_.push_back(cell);
    m_.push_back(weight);
  }
  /// Adds an entry to the newest row of B.
  void put(int unknown, double value) {
    b_.emplace_back(static_cast<int>(m_.size()) - 1, unknown, value);
  }
  FactoredForm form(int unknowns) const {
    const auto rows = static_cast<Eigen::Index>(m_.size());
    return {from_triplets<RowMatrix>(rows, unknowns, b_),
            Eigen::Map<const Eigen::VectorXd>(m_.data(), rows), cell_};
  }

 private:
  Triplets b_;
  std::vector<double> m_;
  std::vector<int> cell_;
};

/// Returns the column pointers (N + 1) of the compressed matrix of a space of triangles: the
/// position at which each column begins, and the one at which the last column ends. The rows of a
/// column are the unknowns that share a triangle with its unknown. Their number follows from the
/// numbers of vertices, edges and triangles around this unknown.
inline std::vector<int> column_pointers_of_triangles(const Space& space) {
  const TriangleMesh& mesh = space.mesh();
  const int v = space.element().dofs_per_vertex(), e = space.element().dofs_per_edge(),
            t = space.element().dofs_per_cell();
  std::vector<int> at_vertex(mesh.vertex_count(), v), at_edge(mesh.edge_count(), 2 * v + e);
  for (const int end : mesh.edges.reshaped<Eigen::RowMajor>()) at_vertex[end] += v + e;
  for (const int corner : mesh.triangles.reshaped<Eigen::RowMajor>()) at_vertex[corner] += e + t;
  for (const int edge : mesh.triangle_edges.reshaped<Eigen::RowMajor>())
    at_edge[edge] += v + 2 * e + t;
  std::vector<int> start{0};
  start.reserve(space.size() + 1);
  const auto add = [&](int columns, int rows) {
    for (int k = 0; k < columns; ++k) start.push_back(start.back() + rows);
  };
  for (const int rows : at_vertex) add(v, rows);
  for (const int rows : at_edge) add(e, rows);
  add(t * mesh.triangle_count(), space.element().dofs());
  return start;
}

/// Returns the column pointers (N + 1) of the compressed matrix of a space: the position at which
/// each column begins, and the one at which the last column ends. The rows of a column are the
/// unknowns that share a cell with its unknown. They are visited cell by cell, and counted at their
/// first visit. On triangles they need not be visited, because the edges tell the neighbours.
inline std::vector<int> column_pointers(const Space& space) {
  if (space.mesh().kind == CellKind::triangle) return column_pointers_of_triangles(space);
  const auto& unknowns = space.cell_dofs();
  std::vector<int> first(space.size() + 1, 0), cells(unknowns.size());  // the cells of each unknown
  for (const int unknown : unknowns.reshaped<Eigen::RowMajor>()) ++first[unknown + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> next(first.begin(), first.end() - 1), seen(space.size(), -1), start{0};
  for (Eigen::Index t = 0; t < unknowns.rows(); ++t)
    for (const int unknown : unknowns.row(t)) cells[next[unknown]++] = static_cast<int>(t);
  start.reserve(space.size() + 1);
  for (int column = 0; column < space.size(); ++column) {
    int rows = 0;
    for (int k = first[column]; k < first[column + 1]; ++k)
      for (const int row : unknowns.row(cells[k]))
        if (std::exchange(seen[row], column) != column) ++rows;
    start.push_back(start.back() + rows);
  }
  return start;
}

/// Assembles element matrices into a sparse matrix (N x N), in linear time: column_pointers gives
/// the number of entries of each column, and each element adds its entries in place. `local(t)`
/// returns the m x m matrix of cell t.
template <class LocalMatrix>
Eigen::SparseMatrix<double> assemble_cells(const Space& space, LocalMatrix&& local) {
  const auto& unknowns = space.cell_dofs();
  const std::vector<int> start = column_pointers(space);
  std::vector<int> end(
      start.begin(),
      start.end() - 1);  // behind the rows that a column has so far, in ascending order
  Eigen::SparseMatrix<double> sum(space.size(), space.size());
  sum.resizeNonZeros(start.back());
  std::copy(start.begin(), start.end(), sum.outerIndexPtr());
  int* const row = sum.innerIndexPtr();
  double* const value = sum.valuePtr();
  for (Eigen::Index t = 0; t < unknowns.rows(); ++t) {
    const auto matrix = local(static_cast<int>(t));
    for (Eigen::Index j = 0; j < unknowns.cols(); ++j) {
      const int first = start[unknowns(t, j)];
      int& last = end[unknowns(t, j)];
      for (Eigen::Index i = 0; i < unknowns.cols(); ++i) {
        int k = last;
        while (k > first && row[k - 1] > unknowns(t, i)) --k;
        if (k > first && row[k - 1] == unknowns(t, i)) {
          value[k - 1] += matrix(i, j);
          continue;
        }
        for (int s = last++; s > k; --s) {
          row[s] = row[s - 1];
          value[s] = value[s - 1];
        }
        row[k] = unknowns(t, i);
        value[k] = matrix(i, j);
      }
    }
  }
  return sum;
}

}  // namespace antilock
