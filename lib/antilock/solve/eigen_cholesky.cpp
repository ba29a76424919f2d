#include "antilock/solve/eigen_cholesky.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <limits>
#include <numeric>

#include "antilock/solve/defaults.hpp"

namespace antilock {
namespace {

using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

/// Where Eigen's factorisation stops at a pivot, its columns from there on hold what they held
/// before: here zeros, so that the first of them is found.
struct Factor : Eigen::SimplicialLLT<SparseMatrix, Eigen::Upper, Eigen::NaturalOrdering<int>> {
  void clear() { std::fill_n(m_matrix.valuePtr(), m_matrix.data().size(), 0.0); }
};

class EigenCholesky final : public SparseCholesky {
 public:
  void analyse(const SparseMatrix& k, int trailing_count) override {
    const Eigen::Index first = k.cols() - trailing_count;
    const SparseMatrix inside =
        SparseMatrix(k.topLeftCorner(first, first)).selfadjointView<Eigen::Upper>();
    Permutation by_degree;
    if (first > 0) Eigen::AMDOrdering<int>()(inside, by_degree);
    Eigen::VectorXi place(k.cols());
    std::iota(place.begin(), place.end(), 0);
    for (Eigen::Index i = 0; i < first; ++i) place(by_degree.indices()(i)) = static_cast<int>(i);
    order_ = Permutation(place);
    factor_.analyzePattern(permuted(k));
  }

  std::optional<int> factorise(const SparseMatrix& k) override {
    const SparseMatrix p = permuted(k);
    factor_.clear();
    factor_.factorize(p);
    for (Eigen::Index j = 0; j < p.cols(); ++j)
      if (const double root = l().coeff(j, j); !(root * root > defaults::round_off * p.coeff(j, j)))
        return Permutation(order_.inverse()).indices()(j);
    return std::nullopt;
  }

  double smallest_pivot() const override {
    return l().cols() > 0 ? l().diagonal().cwiseAbs2().minCoeff()
                          : std::numeric_limits<double>::infinity();
  }
  double entries() const override { return static_cast<double>(l().nonZeros()); }
  Eigen::VectorXd forward(const Eigen::VectorXd& r) const override {
    return factor_.matrixL().solve(Eigen::VectorXd(order_ * r));
  }
  Eigen::VectorXd backward(Eigen::VectorXd y) const override {
    return order_.transpose() * Eigen::VectorXd(factor_.matrixU().solve(y));
  }
  Eigen::MatrixXd trailing_block(int first) const override {
    const Eigen::Index size = l().cols() - first;
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index j = first; j < l().cols(); ++j)
      for (SparseMatrix::InnerIterator i(l(), j); i; ++i)
        block(i.row() - first, j - first) = i.value();
    return block;
  }

 private:
  SparseMatrix permuted(const SparseMatrix& k) const {
    SparseMatrix p(k.rows(), k.cols());
    p.selfadjointView<Eigen::Upper>() = k.selfadjointView<Eigen::Upper>().twistedBy(order_);
    return p;
  }
  const SparseMatrix& l() const { return factor_.matrixL().nestedExpression(); }

  Factor factor_;
  Permutation order_;  ///< row of K -> place
};

}  // namespace

std::unique_ptr<SparseCholesky> eigen_cholesky() { return std::make_unique<EigenCholesky>(); }

}  // namespace antilock
