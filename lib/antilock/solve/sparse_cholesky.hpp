#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/core/matrix.hpp"
#include "antilock/core/stopwatch.hpp"

namespace antilock {

/// Sparse Cholesky factor L L' = P K P' of a symmetric positive definite K (n_free x n_free), of which the upper
/// triangle is read.
class SparseCholesky {
 public:
  virtual ~SparseCholesky() = default;

  /// Orders and analyses the pattern of K. `trailing_count` > 0: the last rows of K stay the last ones, in their order, and the
  /// factor's own ordering is for the rest. Throws NotConverged out of memory.
  virtual void analyse(const SparseMatrix& k, int trailing_count) = 0;

  /// A numeric factorisation of a matrix of the analysed pattern. Returns the row of K whose pivot is not positive or
  /// nothing but round-off (defaults::round_off); empty: K is positive definite. Throws NotConverged out of memory.
  virtual std::optional<int> factorise(const SparseMatrix& k) = 0;

  /// The smallest pivot, min_i l_ii^2; infinity for a K without rows. It is an upper bound of the smallest eigenvalue of
  /// K, because a pivot is 1 / (e' S^-1 e) of a principal submatrix S. It is no more than a heuristic estimate of it: an
  /// L with ones on its diagonal and -1 below has the pivots 1, and an eigenvalue of L L' falls exponentially with n_free.
  virtual double smallest_pivot() const = 0;
  virtual Eigen::VectorXd forward(const Eigen::VectorXd& r) const = 0;  ///< y = L^-1 P r
  virtual Eigen::VectorXd backward(Eigen::VectorXd y) const = 0;        ///< x = P' L'^-1 y
  /// The trailing block of L (lower triangular) from place `first` of the order on.
  virtual Eigen::MatrixXd trailing_block(int first) const = 0;
};

/// A function that makes a factor.
using CholeskyMaker = std::unique_ptr<SparseCholesky> (*)();

/// CHOLMOD's, supernodal on a BLAS: the fastest that there is. Where rows are to stay last, CAMD orders the rest (a
/// minimum degree under that constraint, as good as AMD without it); else CHOLMOD chooses between AMD and METIS. In a
/// browser, which has neither CHOLMOD nor a BLAS, this is Eigen's (tutorials/book/wasm/host), which answers alike, to
/// round-off.
std::unique_ptr<SparseCholesky> default_cholesky();

/// A symmetric positive definite K (n_free x n_free) of which some unknowns may be eliminated, as prescribed values
/// are: the factor is that of the others, the rows and columns of the eliminated ones keep their diagonal alone. One
/// analysis serves every set, so that another set costs one numeric factorisation.
class ConstrainedCholesky {
 public:
  explicit ConstrainedCholesky(CholeskyMaker make = default_cholesky) : cholesky_(make()) {}

  /// Takes the upper triangle of K and factors it with nothing eliminated; a later one must have the same pattern, and
  /// `trailing_count` is of the first alone. Returns the row of a lost pivot. All as SparseCholesky.
  std::optional<int> factorise(SparseMatrix&& k, int trailing_count = 0) {
    k_.swap(k);  // Eigen 3.4 copies a sparse matrix that is moved
    constrained_.assign(k_.cols(), 0);
    Stopwatch watch;
    if (factorisations_++ == 0) {
      cholesky_->analyse(k_, trailing_count);
      analyse_seconds_ = watch.lap();
    }
    const std::optional<int> lost_pivot = cholesky_->factorise(k_);
    factor_seconds_ = watch.lap();
    return lost_pivot;
  }

  /// Eliminates the marked unknowns, and those alone. Throws Error where the rest of K is not positive definite.
  void constrain(const std::vector<char>& constrained) {
    if (constrained == constrained_) return;
    SparseMatrix rest = k_;
    for (Eigen::Index j = 0; j < rest.cols(); ++j)
      for (SparseMatrix::InnerIterator it(rest, j); it; ++it)
        if (it.row() != j && (constrained[j] != 0 || constrained[it.row()] != 0)) it.valueRef() = 0;
    constrained_.clear();
    ++factorisations_;
    if (cholesky_->factorise(rest))
      throw Error("contact: K on the unknowns that are not held is not positive definite");
    constrained_ = constrained;
  }

  /// x = K^-1 r on the unknowns that are not eliminated, 0 on the others.
  Eigen::VectorXd solve(const Eigen::VectorXd& r) const {
    Eigen::VectorXd x = cholesky_->backward(cholesky_->forward(r));
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (constrained_[i] != 0) x(i) = 0;
    return x;
  }

  /// K x, the whole K; and |K| x.
  Eigen::VectorXd times(const Eigen::VectorXd& x) const { return k_.selfadjointView<Eigen::Upper>() * x; }
  Eigen::VectorXd absolute_times(const Eigen::VectorXd& x) const {
    const SparseMatrix sizes = k_.cwiseAbs();
    return sizes.selfadjointView<Eigen::Upper>() * x;
  }
  const SparseMatrix& upper_triangle() const { return k_; }
  const SparseCholesky& cholesky() const { return *cholesky_; }

  int factorisations() const { return factorisations_; }       ///< so far
  double analyse_seconds() const { return analyse_seconds_; }  ///< of the one analysis
  double factor_seconds() const { return factor_seconds_; }    ///< of the last `factorise`

 private:
  SparseMatrix k_;
  std::vector<char> constrained_;
  int factorisations_ = 0;
  double analyse_seconds_ = 0, factor_seconds_ = 0;
  std::unique_ptr<SparseCholesky> cholesky_;
};

}  // namespace antilock
