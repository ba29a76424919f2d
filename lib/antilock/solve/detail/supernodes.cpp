#include "antilock/solve/detail/supernodes.hpp"

#include <algorithm>

namespace antilock {
namespace {

/// One supernode: the place of its first column, its dense block (height x columns) and the rows of the block.
struct Supernode {
  Supernode(const Supernodes& l, int s)
      : first(l.start[s]),
        block(l.value + l.block_start[s], l.row_start[s + 1] - l.row_start[s], l.start[s + 1] - first),
        row(l.row + l.row_start[s]) {}
  int first;
  Eigen::Map<const Eigen::MatrixXd> block;
  const int* row;
};

}  // namespace

void Supernodes::forward(Eigen::VectorXd& y) const {
  Eigen::VectorXd work(size);
  for (int s = 0; s < count; ++s) {
    const Supernode node(*this, s);
    const Eigen::Index height = node.block.rows(), columns = node.block.cols();
    if (y.segment(node.first, columns).isZero(0)) continue;  // where no load has come yet
    work.head(columns) = y.segment(node.first, columns);
    work.segment(columns, height - columns).setZero();
    for (Eigen::Index j = 0; j < columns; ++j) {
      work(j) /= node.block(j, j);
      const Eigen::Index below = height - j - 1;
      work.segment(j + 1, below) -= work(j) * node.block.col(j).tail(below);
    }
    y.segment(node.first, columns) = work.head(columns);
    for (Eigen::Index i = columns; i < height; ++i) y(node.row[i]) += work(i);
  }
}

void Supernodes::backward(Eigen::VectorXd& y) const {
  Eigen::VectorXd work(size);
  for (int s = count - 1; s >= 0; --s) {
    const Supernode node(*this, s);
    const Eigen::Index height = node.block.rows(), columns = node.block.cols();
    for (Eigen::Index i = 0; i < height; ++i) work(i) = y(node.row[i]);
    for (Eigen::Index j = columns - 1; j >= 0; --j) {
      const Eigen::Index below = height - j - 1;
      work(j) = (work(j) - node.block.col(j).tail(below).dot(work.segment(j + 1, below))) / node.block(j, j);
    }
    y.segment(node.first, columns) = work.head(columns);
  }
}

Eigen::MatrixXd Supernodes::trailing_block(int first) const {
  Eigen::MatrixXd trailing = Eigen::MatrixXd::Zero(size - first, size - first);
  for (int s = 0; s < count; ++s) {
    const Supernode node(*this, s);
    for (Eigen::Index j = std::max(first - node.first, 0); j < node.block.cols(); ++j)
      for (Eigen::Index i = j; i < node.block.rows(); ++i)
        trailing(node.row[i] - first, node.first + j - first) = node.block(i, j);
  }
  return trailing;
}

Eigen::VectorXd Supernodes::pivots() const {
  Eigen::VectorXd pivots(size);
  for (int s = 0; s < count; ++s) {
    const Supernode node(*this, s);
    pivots.segment(node.first, node.block.cols()) = node.block.diagonal().cwiseAbs2();
  }
  return pivots;
}

}  // namespace antilock
