// SparseCholesky (solve/sparse_cholesky.hpp) on Eigen's own factor, where CHOLMOD and a BLAS are not to be had: minimum
// degree on what is not to stay last.
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <limits>
#include <numeric>

#include "antilock/solve/sparse_cholesky.hpp"

namespace antilock {

struct SparseCholesky::Cholmod {
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Upper, Eigen::NaturalOrdering<int>> factor;
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;  ///< row of K -> place
  bool analysed = false;

  SparseMatrix permuted(const SparseMatrix& k) const {
    SparseMatrix p(k.rows(), k.cols());
    p.selfadjointView<Eigen::Upper>() = k.selfadjointView<Eigen::Upper>().twistedBy(order);
    return p;
  }
  const SparseMatrix& l() const { return factor.matrixL().nestedExpression(); }
};

SparseCholesky::SparseCholesky() : cholmod_(std::make_unique<Cholmod>()) {}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::analyse(SparseMatrix& k, int last) {
  const Eigen::Index first = k.cols() - last;
  const SparseMatrix inside = SparseMatrix(k.topLeftCorner(first, first)).selfadjointView<Eigen::Upper>();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> by_degree;
  if (first > 0) Eigen::AMDOrdering<int>()(inside, by_degree);
  Eigen::VectorXi place(k.cols());
  std::iota(place.begin(), place.end(), 0);
  for (Eigen::Index i = 0; i < first; ++i) place(by_degree.indices()(i)) = static_cast<int>(i);
  cholmod_->order = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>(place);
  cholmod_->factor.analyzePattern(cholmod_->permuted(k));
  cholmod_->analysed = true;
}

bool SparseCholesky::analysed() const { return cholmod_->analysed; }

std::optional<int> SparseCholesky::factorise(SparseMatrix& k) {
  const SparseMatrix p = cholmod_->permuted(k);
  cholmod_->factor.factorize(p);
  const Eigen::VectorXi row =
      Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>(cholmod_->order.inverse()).indices();
  const bool ended = cholmod_->factor.info() == Eigen::Success;
  constexpr double lost = 64 * std::numeric_limits<double>::epsilon();  // as for CHOLMOD's pivots (supernodes.hpp)
  for (Eigen::Index j = 0; j < p.cols(); ++j) {
    const double root = cholmod_->l().coeff(j, j);
    if (!(root * root > lost * p.coeff(j, j))) return row(j);
  }
  return ended ? std::optional<int>() : row(p.cols() - 1);
}

double SparseCholesky::rcond() const {
  const Eigen::VectorXd pivots = cholmod_->l().diagonal();
  const double ratio = pivots.minCoeff() / pivots.maxCoeff();
  return ratio * ratio;
}

Eigen::VectorXd SparseCholesky::forward(const Eigen::VectorXd& r) const {
  return cholmod_->factor.matrixL().solve(Eigen::VectorXd(cholmod_->order * r));
}

Eigen::VectorXd SparseCholesky::backward(Eigen::VectorXd y) const {
  return cholmod_->order.transpose() * Eigen::VectorXd(cholmod_->factor.matrixU().solve(y));
}

Eigen::MatrixXd SparseCholesky::trailing_block(int first) const {
  const SparseMatrix& l = cholmod_->l();
  const Eigen::Index size = l.cols() - first;
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index j = first; j < l.cols(); ++j)
    for (SparseMatrix::InnerIterator i(l, j); i; ++i) block(i.row() - first, j - first) = i.value();
  return block;
}

}  // namespace antilock
