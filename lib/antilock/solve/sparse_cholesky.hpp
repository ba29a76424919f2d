#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/core/matrix.hpp"
#include "antilock/core/stopwatch.hpp"

namespace antilock {

/// The sparse Cholesky factor L of P K P' = L L', P a permutation. K (n_free x n_free) is symmetric
/// positive definite, and its upper triangle is read.
class SparseCholesky {
 public:
  virtual ~SparseCholesky() = default;

  /// Chooses P and analyses the pattern of K. The last `trailing_count` rows of K stay the last
  /// ones of P K P', in their order. Throws NotConverged where memory runs out.
  virtual void analyse(const SparseMatrix& k, int trailing_count) = 0;

  /// Computes L for a matrix of the analysed pattern. Returns nothing where K is positive definite.
  /// Otherwise it returns a row of K with a useless pivot: l_ii^2 is not positive, or it is
  /// round-off, that is, at most defaults::round_off times the diagonal entry k_ii. Throws
  /// NotConverged where memory runs out.
  virtual std::optional<int> factorise(const SparseMatrix& k) = 0;

  /// Returns the smallest pivot, min_i l_ii^2, and infinity for a K without rows. It is an upper
  /// bound of the smallest eigenvalue of K, because the pivot l_ii^2 is 1 / (e' S^-1 e), S the
  /// leading i x i block of P K P' and e its last unit vector. As an estimate of that eigenvalue it
  /// is a heuristic: for an L with ones on its diagonal and -1 everywhere below, all pivots are 1,
  /// and the smallest eigenvalue falls exponentially with n_free.
  virtual double smallest_pivot() const = 0;
  /// Returns the number of stored entries of L, which may contain zeros. It is known once K has
  /// been analysed.
  virtual double entries() const = 0;
  virtual Eigen::VectorXd forward(const Eigen::VectorXd& r) const = 0;  ///< y = L^-1 P r
  virtual Eigen::VectorXd backward(Eigen::VectorXd y) const = 0;        ///< x = P' L'^-1 y
  /// Returns the rows and columns of L from position `first` on: a lower triangular block.
  virtual Eigen::MatrixXd trailing_block(int first) const = 0;
};

/// A function that makes an empty factor.
using CholeskyMaker = std::unique_ptr<SparseCholesky> (*)();

/// Returns CHOLMOD's supernodal factor, which works on a BLAS. Where rows must stay last, CAMD
/// orders the others (a minimum degree ordering under that constraint), or METIS where the factor
/// is large. Otherwise CHOLMOD chooses between AMD and METIS. A browser has neither CHOLMOD nor a
/// BLAS. There this function returns Eigen's factor (tutorials/book/wasm/host), and results agree
/// up to round-off.
std::unique_ptr<SparseCholesky> default_cholesky();

/// A symmetric positive definite K (n_free x n_free) and its factor on the unknowns that are not
/// constrained, that is, whose values are not prescribed. In the factored matrix the rows and
/// columns of constrained unknowns keep only their diagonal entries. The pattern is analysed once,
/// so that another constrained set costs one numeric factorisation.
class ConstrainedCholesky {
 public:
  explicit ConstrainedCholesky(CholeskyMaker make = default_cholesky) : cholesky_(make()) {}

  /// Takes the upper triangle of K and factors it with no unknown constrained. A later K must have
  /// the same pattern; `trailing_count` is used in the first call only. Returns and throws as
  /// SparseCholesky::factorise does.
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

  /// Constrains the marked unknowns (n_free marks) and no others, and factors the rest of K. Throws
  /// Error where that is not positive definite.
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

  /// Returns x (n_free): K x = r on the unknowns that are not constrained, x = 0 on the others.
  Eigen::VectorXd solve(const Eigen::VectorXd& r) const {
    Eigen::VectorXd x = cholesky_->backward(cholesky_->forward(r));
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (constrained_[i] != 0) x(i) = 0;
    return x;
  }

  /// Returns K x, with the whole K.
  Eigen::VectorXd times(const Eigen::VectorXd& x) const {
    return k_.selfadjointView<Eigen::Upper>() * x;
  }
  /// Returns |K| x, with the absolute values of the entries of K.
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
