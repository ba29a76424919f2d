#include "antilock/solve/detail/eigen_cholesky.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <limits>
#include <numeric>

namespace antilock {
namespace {

using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

/// Where Eigen's factorisation stops at a pivot, its columns from there on hold what they held before: here zeros, so that
/// the first of them is found.
struct Factor : Eigen::SimplicialLLT<SparseMatrix, Eigen::Upper, Eigen::NaturalOrdering<int>> {
  void clear() { std::fill_n(m_matrix.valuePtr(), m_matrix.data().size(), 0.0); }
};

}  // namespace

struct EigenCholesky::Simplicial {
  Factor factor;
  Permutation order;  ///< row of K -> place
  bool analysed = false;

  SparseMatrix permuted(const SparseMatrix& k) const {
    SparseMatrix p(k.rows(), k.cols());
    p.selfadjointView<Eigen::Upper>() = k.selfadjointView<Eigen::Upper>().twistedBy(order);
    return p;
  }
  const SparseMatrix& l() const { return factor.matrixL().nestedExpression(); }
};

EigenCholesky::EigenCholesky() : simplicial_(std::make_unique<Simplicial>()) {}
EigenCholesky::~EigenCholesky() = default;

void EigenCholesky::analyse(SparseMatrix& k, int last) {
  const Eigen::Index first = k.cols() - last;
  const SparseMatrix inside = SparseMatrix(k.topLeftCorner(first, first)).selfadjointView<Eigen::Upper>();
  Permutation by_degree;
  if (first > 0) Eigen::AMDOrdering<int>()(inside, by_degree);
  Eigen::VectorXi place(k.cols());
  std::iota(place.begin(), place.end(), 0);
  for (Eigen::Index i = 0; i < first; ++i) place(by_degree.indices()(i)) = static_cast<int>(i);
  simplicial_->order = Permutation(place);
  simplicial_->factor.analyzePattern(simplicial_->permuted(k));
  simplicial_->analysed = true;
}

bool EigenCholesky::analysed() const { return simplicial_->analysed; }

std::optional<int> EigenCholesky::factorise(SparseMatrix& k) {
  const SparseMatrix p = simplicial_->permuted(k);
  simplicial_->factor.clear();
  simplicial_->factor.factorize(p);
  for (Eigen::Index j = 0; j < p.cols(); ++j)
    if (const double root = simplicial_->l().coeff(j, j); !(root * root > lost_pivot * p.coeff(j, j)))
      return Permutation(simplicial_->order.inverse()).indices()(j);
  return std::nullopt;
}

double EigenCholesky::smallest_pivot() const {
  const SparseMatrix& l = simplicial_->l();
  return l.cols() > 0 ? l.diagonal().cwiseAbs2().minCoeff() : std::numeric_limits<double>::infinity();
}

Eigen::VectorXd EigenCholesky::forward(const Eigen::VectorXd& r) const {
  return simplicial_->factor.matrixL().solve(Eigen::VectorXd(simplicial_->order * r));
}

Eigen::VectorXd EigenCholesky::backward(Eigen::VectorXd y) const {
  return simplicial_->order.transpose() * Eigen::VectorXd(simplicial_->factor.matrixU().solve(y));
}

Eigen::MatrixXd EigenCholesky::trailing_block(int first) const {
  const SparseMatrix& l = simplicial_->l();
  const Eigen::Index size = l.cols() - first;
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index j = first; j < l.cols(); ++j)
    for (SparseMatrix::InnerIterator i(l, j); i; ++i) block(i.row() - first, j - first) = i.value();
  return block;
}

}  // namespace antilock
