#include "antilock/solve/detail/cholmod_cholesky.hpp"

#include <cholmod.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/solve/detail/loops_on_one_thread.hpp"
#include "antilock/solve/detail/supernodes.hpp"

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

}  // namespace

struct CholmodCholesky::Cholmod {
  cholmod_common common{};
  cholmod_factor* l = nullptr;
  double smallest_pivot = std::numeric_limits<double>::infinity();

  Cholmod() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
  }
  ~Cholmod() {
    cholmod_free_factor(&l, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  void analyse_with_the_last(cholmod_sparse& whole, int last) {
    const int size = static_cast<int>(whole.ncol), interior = size - last;
    std::vector<int> order(size), group(size, 0);
    std::fill(group.begin() + interior, group.end(), interior > 0 ? 1 : 0);  // CAMD wants groups below `size`
    if (!cholmod_camd(&whole, nullptr, 0, group.data(), order.data(), &common))
      throw Error("solve: the ordering of the sparse factor failed: out of memory");
    std::iota(order.begin() + interior, order.end(), interior);  // among themselves in the order of the reports
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    for (const int postorder : {1, 0}) {
      common.postorder = postorder;
      cholmod_free_factor(&l, &common);
      l = cholmod_analyze_p(&whole, order.data(), nullptr, 0, &common);
      if (l == nullptr) throw Error("solve: the analysis of the sparse factor failed: out of memory");
      const int* perm = static_cast<int*>(l->Perm);
      bool kept = true;
      for (int i = interior; i < size; ++i) kept = kept && perm[i] == i;
      if (kept) return;  // else a postorder moved one of the last: do without
    }
    throw Error("solve: the contact unknowns did not come last in the sparse factor");
  }

  Supernodes supernodes() const {
    return {.size = static_cast<int>(l->n),
            .count = static_cast<int>(l->nsuper),
            .start = static_cast<const int*>(l->super),
            .row_start = static_cast<const int*>(l->pi),
            .block_start = static_cast<const int*>(l->px),
            .row = static_cast<const int*>(l->s),
            .value = static_cast<const double*>(l->x)};
  }

  /// The order of the columns of L: place -> row of K.
  Eigen::Map<const Eigen::VectorXi> order() const {
    return {static_cast<const int*>(l->Perm), static_cast<Eigen::Index>(l->n)};
  }
};

CholmodCholesky::CholmodCholesky() : cholmod_(std::make_unique<Cholmod>()) {}
CholmodCholesky::~CholmodCholesky() = default;

void CholmodCholesky::analyse(SparseMatrix& k, int last) {
  cholmod_sparse whole = view(k);
  if (last > 0) return cholmod_->analyse_with_the_last(whole, last);
  cholmod_->l = cholmod_analyze(&whole, &cholmod_->common);
  if (cholmod_->l == nullptr) throw Error("solve: the analysis of the sparse factor failed: out of memory");
}

bool CholmodCholesky::analysed() const { return cholmod_->l != nullptr; }

std::optional<int> CholmodCholesky::factorise(SparseMatrix& k) {
  cholmod_sparse whole = view(k);
  {
    const LoopsOnOneThread loops;
    cholmod_factorize(&whole, cholmod_->l, &cholmod_->common);
  }
  if (cholmod_->common.status < CHOLMOD_OK) throw Error("solve: the sparse factorisation failed: out of memory");
  if (cholmod_->common.status == CHOLMOD_NOT_POSDEF) {
    cholmod_->smallest_pivot = 0;
    return cholmod_->order()(static_cast<int>(cholmod_->l->minor));
  }
  const Eigen::VectorXd pivots = cholmod_->supernodes().pivots();
  if (pivots.size() > 0) cholmod_->smallest_pivot = pivots.minCoeff();
  for (Eigen::Index i = 0; i < pivots.size(); ++i)
    if (const int row = cholmod_->order()(i); !(pivots(i) > lost_pivot * k.coeff(row, row))) return row;
  return std::nullopt;
}

double CholmodCholesky::smallest_pivot() const { return cholmod_->smallest_pivot; }

Eigen::VectorXd CholmodCholesky::forward(const Eigen::VectorXd& r) const {
  Eigen::VectorXd y = r(cholmod_->order());
  cholmod_->supernodes().forward(y);
  return y;
}

Eigen::VectorXd CholmodCholesky::backward(Eigen::VectorXd y) const {
  cholmod_->supernodes().backward(y);
  Eigen::VectorXd x(y.size());
  x(cholmod_->order()) = y;
  return x;
}

Eigen::MatrixXd CholmodCholesky::trailing_block(int first) const {
  return cholmod_->supernodes().trailing_block(first);
}

}  // namespace antilock
