#include "antilock/solve/detail/aggregation.hpp"

namespace antilock {
namespace {

/// Calls `visit` with each neighbour of unknown i in K, by columns.
template <class Visit>
void for_neighbours(const SparseMatrix& k, const Eigen::VectorXd& diagonal, int i, const Visit& visit) {
  for (SparseMatrix::InnerIterator it(k, i); it; ++it)
    if (it.row() != i && it.value() * it.value() > 0.0064 * diagonal(i) * diagonal(it.row()))
      visit(static_cast<int>(it.row()));
}

std::vector<int> aggregates_of(const SparseMatrix& k, const Eigen::VectorXd& diagonal, int& count) {
  const int size = static_cast<int>(k.cols());
  std::vector<int> of(size, -1);
  for (int i = 0; i < size; ++i) {
    bool alone = of[i] < 0;
    for_neighbours(k, diagonal, i, [&](int j) { alone = alone && of[j] < 0; });
    if (!alone) continue;
    of[i] = count;
    for_neighbours(k, diagonal, i, [&](int j) { of[j] = count; });
    ++count;
  }
  const std::vector<int> first = of;
  for (int i = 0; i < size; ++i)
    if (first[i] < 0)
      for_neighbours(k, diagonal, i, [&](int j) {
        if (of[i] < 0) of[i] = first[j];
      });
  for (int& aggregate : of)
    if (aggregate < 0) aggregate = count++;
  return of;
}

}  // namespace

Aggregates smoothed_aggregation(const SparseMatrix& upper) {
  const SparseMatrix k = upper.selfadjointView<Eigen::Upper>();
  const Eigen::VectorXd diagonal = k.diagonal();
  int count = 0;
  Aggregates aggregates{aggregates_of(k, diagonal, count), {}, {}};
  SparseMatrix p0(k.cols(), count);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(k.cols());
  for (int i = 0; i < k.cols(); ++i) entries.emplace_back(i, aggregates.of[i], 1.0);
  p0.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd weight = (2.0 / 3) * diagonal.cwiseInverse();
  const SparseMatrix kp0 = k * p0;
  aggregates.prolongation = p0 - SparseMatrix(weight.asDiagonal() * kp0);
  const SparseMatrix kp = k * aggregates.prolongation;
  const SparseMatrix coarse = aggregates.prolongation.transpose() * kp;
  aggregates.coarse = coarse.triangularView<Eigen::Upper>();
  return aggregates;
}

}  // namespace antilock
