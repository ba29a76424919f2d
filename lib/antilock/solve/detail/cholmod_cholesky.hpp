#pragma once
#include <memory>

#include "antilock/solve/detail/sparse_cholesky.hpp"

namespace antilock {

/// The factor of CHOLMOD, supernodal on a BLAS: the fastest that there is, and the one page that knows CHOLMOD. Where rows
/// are to stay last, CAMD orders the rest (a minimum degree under that constraint, as good as AMD without it); else CHOLMOD
/// chooses between AMD and METIS.
class CholmodCholesky final : public SparseCholesky {
 public:
  CholmodCholesky();
  ~CholmodCholesky() override;

  void analyse(SparseMatrix& k, int last) override;
  bool analysed() const override;
  std::optional<int> factorise(SparseMatrix& k) override;
  double smallest_pivot() const override;
  Eigen::VectorXd forward(const Eigen::VectorXd& r) const override;
  Eigen::VectorXd backward(Eigen::VectorXd y) const override;
  Eigen::MatrixXd trailing_block(int first) const override;

 private:
  struct Cholmod;
  std::unique_ptr<Cholmod> cholmod_;
};

}  // namespace antilock
