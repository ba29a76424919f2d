#include <cholmod.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/solve/detail/loops_on_one_thread.hpp"
#include "antilock/solve/detail/sparse_cholesky.hpp"
#include "antilock/solve/detail/tuned.hpp"

namespace antilock {
namespace {

/// CHOLMOD's view of an upper triangle that Eigen owns.
cholmod_sparse view(SparseMatrix& k) {
  cholmod_sparse a{};
  a.nrow = a.ncol = static_cast<std::size_t>(k.cols());
  a.nzmax = static_cast<std::size_t>(k.nonZeros());
  a.p = k.outerIndexPtr();
  a.i = k.innerIndexPtr();
  a.x = k.valuePtr();
  a.stype = 1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  return a;
}

/// A view of the factor L (F x F) of a supernodal Cholesky factorisation: supernode s holds the columns from start[s] to
/// start[s + 1] of L as one dense block by columns. The rows of the block are row[row_start[s]] and following; its own
/// columns come first among them, and above the diagonal the block holds nothing of meaning.
///
/// The two sweeps below are those of CHOLMOD without its copies and without its calls of the BLAS, two per supernode and
/// most of them for a few numbers. Measured on the membrane with its layer (P1), a pair of them against CHOLMOD's: 0.34
/// against 0.47 ms at 1/h = 64, 1.9 against 2.7 at 128, 18 against 22 at 256, where both wait for the memory.
struct Supernodes {
  int size = 0, count = 0;           ///< F; number of supernodes
  const int* start = nullptr;        ///< count + 1
  const int* row_start = nullptr;    ///< count + 1
  const int* block_start = nullptr;  ///< count + 1, in `value`
  const int* row = nullptr;
  const double* value = nullptr;

  void forward(Eigen::VectorXd& y) const;   ///< y <- L^-1 y (F)
  void backward(Eigen::VectorXd& y) const;  ///< y <- L'^-1 y (F)

  /// The trailing block of L (lower triangular) from `first` on.
  Eigen::MatrixXd trailing_block(int first) const;

  /// The pivots of the elimination, the squares of the diagonal of L: F, in the order of L.
  Eigen::VectorXd pivots() const;
};

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
  Eigen::VectorXd pivots = Eigen::VectorXd::Zero(size);
  for (int s = 0; s < count; ++s) {
    const Supernode node(*this, s);
    pivots.segment(node.first, node.block.cols()) = node.block.diagonal().cwiseAbs2();
  }
  return pivots;
}

class CholmodCholesky final : public SparseCholesky {
 public:
  CholmodCholesky() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.final_ll = 1;
  }
  ~CholmodCholesky() override {
    cholmod_free_factor(&l_, &common_);
    cholmod_finish(&common_);
  }
  CholmodCholesky(const CholmodCholesky&) = delete;
  CholmodCholesky& operator=(const CholmodCholesky&) = delete;

  void analyse(SparseMatrix& k, int last) override {
    cholmod_sparse whole = view(k);
    if (last > 0) return analyse_with_the_last(whole, last);
    l_ = cholmod_analyze(&whole, &common_);
    if (l_ == nullptr) throw Error("solve: the analysis of the sparse factor failed: out of memory");
  }

  std::optional<int> factorise(SparseMatrix& k) override {
    cholmod_sparse whole = view(k);
    {
      const LoopsOnOneThread loops;
      cholmod_factorize(&whole, l_, &common_);
    }
    if (common_.status < CHOLMOD_OK) throw Error("solve: the sparse factorisation failed: out of memory");
    if (common_.status == CHOLMOD_NOT_POSDEF) {
      smallest_pivot_ = 0;
      return order()(static_cast<int>(l_->minor));
    }
    const Eigen::VectorXd pivots = supernodes().pivots();
    if (pivots.size() > 0) smallest_pivot_ = pivots.minCoeff();
    for (Eigen::Index i = 0; i < pivots.size(); ++i)
      if (const int row = order()(i); !(pivots(i) > tuned::round_off * k.coeff(row, row))) return row;
    return std::nullopt;
  }

  double smallest_pivot() const override { return smallest_pivot_; }
  Eigen::VectorXd forward(const Eigen::VectorXd& r) const override {
    Eigen::VectorXd y = r(order());
    supernodes().forward(y);
    return y;
  }
  Eigen::VectorXd backward(Eigen::VectorXd y) const override {
    supernodes().backward(y);
    Eigen::VectorXd x(y.size());
    x(order()) = y;
    return x;
  }
  Eigen::MatrixXd trailing_block(int first) const override { return supernodes().trailing_block(first); }

 private:
  void analyse_with_the_last(cholmod_sparse& whole, int last) {
    const int size = static_cast<int>(whole.ncol), interior = size - last;
    std::vector<int> order(size), group(size, 0);
    std::fill(group.begin() + interior, group.end(), interior > 0 ? 1 : 0);  // CAMD wants groups below `size`
    if (!cholmod_camd(&whole, nullptr, 0, group.data(), order.data(), &common_))
      throw Error("solve: the ordering of the sparse factor failed: out of memory");
    std::iota(order.begin() + interior, order.end(), interior);  // among themselves in the order of the reports
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    for (const int postorder : {1, 0}) {
      common_.postorder = postorder;
      cholmod_free_factor(&l_, &common_);
      l_ = cholmod_analyze_p(&whole, order.data(), nullptr, 0, &common_);
      if (l_ == nullptr) throw Error("solve: the analysis of the sparse factor failed: out of memory");
      const int* perm = static_cast<int*>(l_->Perm);
      bool kept = true;
      for (int i = interior; i < size; ++i) kept = kept && perm[i] == i;
      if (kept) return;  // else a postorder moved one of the last: do without
    }
    throw Error("solve: the contact unknowns did not come last in the sparse factor");
  }

  Supernodes supernodes() const {
    return {.size = static_cast<int>(l_->n),
            .count = static_cast<int>(l_->nsuper),
            .start = static_cast<const int*>(l_->super),
            .row_start = static_cast<const int*>(l_->pi),
            .block_start = static_cast<const int*>(l_->px),
            .row = static_cast<const int*>(l_->s),
            .value = static_cast<const double*>(l_->x)};
  }

  /// The order of the columns of L: place -> row of K.
  Eigen::Map<const Eigen::VectorXi> order() const {
    return {static_cast<const int*>(l_->Perm), static_cast<Eigen::Index>(l_->n)};
  }

  cholmod_common common_{};
  cholmod_factor* l_ = nullptr;
  double smallest_pivot_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::unique_ptr<SparseCholesky> default_cholesky() { return std::make_unique<CholmodCholesky>(); }

}  // namespace antilock
