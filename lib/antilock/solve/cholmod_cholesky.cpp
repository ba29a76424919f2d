#include <Eigen/CholmodSupport>
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/core/memory.hpp"
#include "antilock/solve/defaults.hpp"
#include "antilock/solve/sparse_cholesky.hpp"

// These functions belong to the OpenMP library that CHOLMOD is linked to. They are declared here,
// because the <omp.h> that a compiler finds may be that of another library. Where CHOLMOD was built
// without OpenMP they are absent, and their addresses are null.
extern "C" {
[[gnu::weak]] int omp_get_max_active_levels();
[[gnu::weak]] void omp_set_max_active_levels(int levels);
// Absent where CHOLMOD was built without METIS.
[[gnu::weak]] int cholmod_metis(cholmod_sparse* a, int* fset, size_t fsize, int postorder,
                                int* perm, cholmod_common* common);
}

namespace antilock {
namespace {

/// Columns of a supernodal factor L from `first` on, as one dense block. Its own columns come first
/// among its rows; above the diagonal it holds nothing of meaning.
struct Supernode {
  int first;
  const int* row;  ///< of L, one per row of the block
  Eigen::Map<const Eigen::MatrixXd> block;
};

Supernode supernode(const cholmod_factor& l, std::size_t s) {
  const int* const start = static_cast<const int*>(l.super) + s;
  const int* const rows = static_cast<const int*>(l.pi) + s;
  const double* const values = static_cast<const double*>(l.x) + static_cast<const int*>(l.px)[s];
  return {start[0],
          static_cast<const int*>(l.s) + rows[0],
          {values, rows[1] - rows[0], start[1] - start[0]}};
}

/// The two sweeps are those of CHOLMOD without its copies and without its calls of the BLAS, two
/// per supernode and most of them for a few numbers. Measured on the membrane with its layer (P1),
/// a pair of them against CHOLMOD's: 0.34 against 0.47 ms at 1/h = 64, 1.9 against 2.7 at 128, 18
/// against 22 at 256, where both wait for the memory; with Eigen's triangular solve of each block
/// they take 1.5 times as long.
class CholmodCholesky final : public SparseCholesky {
 public:
  CholmodCholesky() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.final_ll = 1;
    // Two supernodes are merged into one of up to 16 columns always, of up to 32, up to 64 and of
    // more where the merged block has at most 90, 30 and 10 % zeros. CHOLMOD's own are 4, 16, 48
    // columns and 80, 10, 5 %: the BLAS is called twice per supernode, most of which are small. At
    // 1/h = 512 (P1) 28,509 supernodes for 68,896, the factor in 0.6 of the seconds and with 1.29
    // of the entries, which the sweeps read. Twice these columns: 15,174, 0.4 and 1.83.
    std::copy_n(std::array<std::size_t, 3>{16, 32, 64}.data(), 3, common_.nrelax);
    std::copy_n(std::array{0.9, 0.3, 0.1}.data(), 3, common_.zrelax);
  }
  ~CholmodCholesky() override {
    cholmod_free_factor(&l_, &common_);
    cholmod_finish(&common_);
  }
  CholmodCholesky(const CholmodCholesky&) = delete;
  CholmodCholesky& operator=(const CholmodCholesky&) = delete;

  void analyse(const SparseMatrix& k, int trailing_count) override {
    cholmod_sparse whole = viewAsCholmod(k.selfadjointView<Eigen::Upper>());
    if (trailing_count > 0) return analyse_with_trailing_rows(whole, trailing_count);
    l_ = cholmod_analyze(&whole, &common_);
    require(l_ != nullptr, "analysis");
  }

  std::optional<int> factorise(const SparseMatrix& k) override {
    if (l_->xtype == CHOLMOD_PATTERN)  // the entries of L and the largest update of a supernode are
                                       // not allocated yet
      require_memory((l_->xsize + l_->maxcsize) * sizeof(double), "solve: the sparse factor");
    const BlasCalls blas;
    cholmod_sparse whole = viewAsCholmod(k.selfadjointView<Eigen::Upper>());
    // CHOLMOD 3 shares the assembly of every supernode among four OpenMP threads, on any number of
    // cores, and the four wait for each other at every loop, which is over in microseconds; a BLAS
    // with threads of its own keeps them. On one thread, the least wall seconds of a factor on two
    // cores (P1, the membrane with its layer): 5.5 against 6.7 ms at 1/h = 64, 31 against 39 at
    // 128; where other programs want the cores as well, the four cost up to ten times the factor.
    const bool has_openmp = omp_get_max_active_levels && omp_set_max_active_levels;
    const int levels = has_openmp ? omp_get_max_active_levels() : 0;
    if (has_openmp) omp_set_max_active_levels(0);
    cholmod_factorize(&whole, l_, &common_);
    if (has_openmp) omp_set_max_active_levels(levels);
    require(common_.status >= CHOLMOD_OK, "factorisation");
    smallest_pivot_ = 0;
    if (common_.status == CHOLMOD_NOT_POSDEF) return order()(static_cast<int>(l_->minor));
    smallest_pivot_ = std::numeric_limits<double>::infinity();
    std::optional<int> lost;
    for (std::size_t s = 0; s < l_->nsuper; ++s) {
      const Supernode node = supernode(*l_, s);
      for (Eigen::Index j = 0; j < node.block.cols(); ++j) {
        const double pivot = node.block(j, j) * node.block(j, j);
        const int row = order()(node.first + j);
        smallest_pivot_ = std::min(smallest_pivot_, pivot);
        if (!lost && !(pivot > defaults::round_off * k.coeff(row, row))) lost = row;
      }
    }
    return lost;
  }

  double smallest_pivot() const override { return smallest_pivot_; }
  double entries() const override {
    double sum = 0;
    for (std::size_t s = 0; s < l_->nsuper; ++s) {
      const int* const columns = static_cast<const int*>(l_->super) + s;
      const int* const rows = static_cast<const int*>(l_->pi) + s;
      const double width = columns[1] - columns[0], height = rows[1] - rows[0];
      sum += width * height - width * (width - 1) / 2;  // above the diagonal it holds nothing
    }
    return sum;
  }

  Eigen::VectorXd forward(const Eigen::VectorXd& r) const override {
    Eigen::VectorXd y = r(order()), work(r.size());
    for (std::size_t s = 0; s < l_->nsuper; ++s) {
      const Supernode node = supernode(*l_, s);
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
    return y;
  }

  Eigen::VectorXd backward(Eigen::VectorXd y) const override {
    Eigen::VectorXd work(y.size()), x(y.size());
    for (std::size_t s = l_->nsuper; s-- > 0;) {
      const Supernode node = supernode(*l_, s);
      const Eigen::Index height = node.block.rows(), columns = node.block.cols();
      for (Eigen::Index i = 0; i < height; ++i) work(i) = y(node.row[i]);
      for (Eigen::Index j = columns - 1; j >= 0; --j) {
        const Eigen::Index below = height - j - 1;
        work(j) = (work(j) - node.block.col(j).tail(below).dot(work.segment(j + 1, below))) /
                  node.block(j, j);
      }
      y.segment(node.first, columns) = work.head(columns);
    }
    x(order()) = y;
    return x;
  }

  Eigen::MatrixXd trailing_block(int first) const override {
    const auto size = static_cast<Eigen::Index>(l_->n) - first;
    Eigen::MatrixXd trailing = Eigen::MatrixXd::Zero(size, size);
    for (std::size_t s = 0; s < l_->nsuper; ++s) {
      const Supernode node = supernode(*l_, s);
      for (Eigen::Index j = std::max(first - node.first, 0); j < node.block.cols(); ++j)
        for (Eigen::Index i = j; i < node.block.rows(); ++i)
          trailing(node.row[i] - first, node.first + j - first) = node.block(i, j);
    }
    return trailing;
  }

 private:
  /// CAMD orders all but the trailing rows. METIS orders them, too, where the factor takes longer
  /// than METIS, and the smaller factor is kept. METIS takes some 1.5e-6 s per entry of K, and a
  /// multiplication of the factor 4e-11 s. Measured with contact, multiplications per entry of K:
  /// in the plane 4,200 (P1, 1/h = 512) and 8,100 (1/h = 1024), where METIS saves 4 % of them; in
  /// space 24,000 (CR, 1/h = 12), where METIS takes longer than it saves, 51,000 (P1, 1/h = 24),
  /// where both together take 0.7 of the seconds, and 212,000 (CR, 1/h = 20), where METIS leaves an
  /// eighth of the multiplications and a third of the entries.
  void analyse_with_trailing_rows(cholmod_sparse& whole, int trailing_count) {
    const int size = static_cast<int>(whole.ncol);
    const int interior = size - trailing_count;
    std::vector<int> order(size), group(size, 0);
    std::fill(group.begin() + interior, group.end(),
              interior > 0 ? 1 : 0);  // CAMD wants groups below `size`
    require(cholmod_camd(&whole, nullptr, 0, group.data(), order.data(), &common_) != 0,
            "ordering");
    analyse_in_order(whole, order, interior);
    constexpr double as_long_as_metis = 40'000;
    if (common_.fl < as_long_as_metis * common_.anz) return;
    if (!cholmod_metis || cholmod_metis(&whole, nullptr, 0, 1, order.data(), &common_) == 0)
      return;  // the factor in the order of CAMD takes longer, and is as accurate
    std::stable_partition(order.begin(), order.end(), [&](int row) { return row < interior; });
    const double entries_by_camd = common_.lnz;
    const auto release = [&](cholmod_factor* l) { cholmod_free_factor(&l, &common_); };
    std::unique_ptr<cholmod_factor, decltype(release)> by_camd(std::exchange(l_, nullptr), release);
    analyse_in_order(whole, order, interior);
    if (common_.lnz <= entries_by_camd) return;
    cholmod_factor* const by_metis = std::exchange(l_, by_camd.release());
    by_camd.reset(by_metis);
  }

  /// Analyses the pattern in an order of the first `interior` rows. The others follow in their own
  /// order.
  void analyse_in_order(cholmod_sparse& whole, std::vector<int>& order, int interior) {
    const int size = static_cast<int>(whole.ncol);
    std::iota(order.begin() + interior, order.end(),
              interior);  // among themselves in the order of the reports
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    for (const int postorder : {1, 0}) {
      common_.postorder = postorder;
      cholmod_free_factor(&l_, &common_);
      l_ = cholmod_analyze_p(&whole, order.data(), nullptr, 0, &common_);
      require(l_ != nullptr, "analysis");
      const int* perm = static_cast<const int*>(l_->Perm);
      if (std::equal(perm + interior, perm + size, order.begin() + interior))
        return;  // else a postorder moved them
    }
    throw Error("solve: the contact unknowns did not come last in the sparse factor");
  }

  static void require(bool holds, const std::string& step) {
    if (holds) return;
    throw NotConverged("solve: the " + step +
                           " of the sparse factor failed: out of memory; accepted: fewer unknowns",
                       1, 0);
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
