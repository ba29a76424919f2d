// PenaltyFactor (solve/penalty_factor.hpp) on Eigen's own sparse Cholesky.
#include <fmt/format.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <limits>
#include <numeric>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/penalty_factor.hpp"

namespace antilock {

struct PenaltyFactor::Cholmod {
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Upper, Eigen::NaturalOrdering<int>> factor;
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  bool analysed = false;

  void analyse(const SparseMatrix& k, int interior) {
    const SparseMatrix inside = SparseMatrix(k.topLeftCorner(interior, interior)).selfadjointView<Eigen::Upper>();
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;
    if (interior > 0) Eigen::AMDOrdering<int>()(inside, inverse);
    Eigen::VectorXi place(k.cols());
    std::iota(place.begin(), place.end(), 0);
    for (int i = 0; i < interior; ++i) place(inverse.indices()(i)) = i;
    order = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>(place);
  }
  SparseMatrix permuted(const SparseMatrix& k) const {
    SparseMatrix p(k.rows(), k.cols());
    p.selfadjointView<Eigen::Upper>() = k.selfadjointView<Eigen::Upper>().twistedBy(order);
    return p;
  }
};

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem, double delta)
    : numbering_(problem), cholmod_(std::make_unique<Cholmod>()) {
  factorise(problem, delta);
}
PenaltyFactor::PenaltyFactor(const VariationalInequality& problem) : PenaltyFactor(problem, moderate_delta(problem)) {}
PenaltyFactor::~PenaltyFactor() = default;
PenaltyFactor::PenaltyFactor(PenaltyFactor&&) noexcept = default;
PenaltyFactor& PenaltyFactor::operator=(PenaltyFactor&&) noexcept = default;

void PenaltyFactor::check_fits(const VariationalInequality& problem) const { check_data(problem); }
void PenaltyFactor::refactor(const VariationalInequality& problem, double delta) { factorise(problem, delta); }

void PenaltyFactor::factorise(const VariationalInequality& problem, double delta) {
  delta_ = delta;
  const SparseMatrix k = penalised_matrix(problem, numbering_, delta);
  Stopwatch watch;
  if (!cholmod_->analysed) cholmod_->analyse(k, numbering_.interior);
  const SparseMatrix p = cholmod_->permuted(k);
  if (!cholmod_->analysed) {
    cholmod_->factor.analyzePattern(p);
    cholmod_->analysed = true;
    analyse_seconds = watch.lap();
  }
  cholmod_->factor.factorize(p);
  if (cholmod_->factor.info() != Eigen::Success)
    throw Error(fmt::format("solve: A1 + B' M B / {:.3g} is not positive definite", delta));
  const SparseMatrix& l = cholmod_->factor.matrixL().nestedExpression();
  const int first = numbering_.interior, contact = static_cast<int>(l.cols()) - first;
  contact_block_ = Eigen::MatrixXd::Zero(contact, contact);
  for (int j = first; j < l.cols(); ++j)
    for (SparseMatrix::InnerIterator i(l, j); i; ++i) contact_block_(i.row() - first, j - first) = i.value();
  factor_seconds = watch.lap();
  ++factorisations;
}

double PenaltyFactor::rcond() {
  const Eigen::VectorXd pivots = cholmod_->factor.matrixL().nestedExpression().diagonal();
  const double ratio = pivots.minCoeff() / pivots.maxCoeff();
  return ratio * ratio;
}
Eigen::VectorXd PenaltyFactor::forward(const Eigen::VectorXd& r) {
  return cholmod_->factor.matrixL().solve(Eigen::VectorXd(cholmod_->order * r));
}
Eigen::VectorXd PenaltyFactor::backward(const Eigen::VectorXd& y) {
  ++solves;
  return cholmod_->order.transpose() * Eigen::VectorXd(cholmod_->factor.matrixU().solve(y));
}

}  // namespace antilock
