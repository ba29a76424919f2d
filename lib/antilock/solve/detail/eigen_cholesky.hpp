#pragma once
#include <memory>

#include "antilock/solve/detail/sparse_cholesky.hpp"

namespace antilock {

/// The factor of Eigen (simplicial, headers alone), where CHOLMOD and a BLAS are not to be had: in a browser. AMD orders
/// what is not to stay last. On the machine it is the second opinion on `CholmodCholesky`.
class EigenCholesky final : public SparseCholesky {
 public:
  EigenCholesky();
  ~EigenCholesky() override;

  void analyse(SparseMatrix& k, int last) override;
  bool analysed() const override;
  std::optional<int> factorise(SparseMatrix& k) override;
  double smallest_pivot() const override;
  Eigen::VectorXd forward(const Eigen::VectorXd& r) const override;
  Eigen::VectorXd backward(Eigen::VectorXd y) const override;
  Eigen::MatrixXd trailing_block(int first) const override;

 private:
  struct Simplicial;
  std::unique_ptr<Simplicial> simplicial_;
};

}  // namespace antilock
