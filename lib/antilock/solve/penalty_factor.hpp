#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/penalised_matrix.hpp"

namespace antilock {

/// Sparse Cholesky factor L L' = P K P' of the moderately penalised K = A1 + delta^-1 B' M B (CHOLMOD, supernodal) with
/// the contact unknowns ordered last: the trailing C x C block of L is then the Cholesky factor of their Schur
/// complement, so the whole contact problem is solved on it for next to nothing. It serves every load, every bound and,
/// where delta is the same, every compliance of one matrix pair (A1, B).
class PenaltyFactor {
 public:
  /// Throws Error for a malformed problem or a delta that is not positive, if K is not positive definite (then
  /// A1 + B' M B is singular: a piece is held nowhere), or out of memory.
  PenaltyFactor(const VariationalInequality& problem, double delta);
  /// The usual one: delta = moderate_delta(problem), the compliance itself where nothing is gained by less.
  explicit PenaltyFactor(const VariationalInequality& problem);
  /// The same with the penalty chosen by the caller, where there is one.
  static PenaltyFactor moderate(const VariationalInequality& problem, std::optional<double> penalty);
  ~PenaltyFactor();
  PenaltyFactor(PenaltyFactor&&) noexcept;
  PenaltyFactor& operator=(PenaltyFactor&&) noexcept;

  /// Throws Error for a malformed problem, for one with other free or contact unknowns, and for one with another A1, B or
  /// M than this factor's: one walk over the data, about the cost of a residual.
  void check_fits(const VariationalInequality& problem) const;
  /// A new numeric factorisation for another delta; the symbolic analysis is kept. Throws as the constructor does, and
  /// for a problem with other free or contact unknowns.
  void refactor(const VariationalInequality& problem, double delta);

  double delta() const { return delta_; }
  const FreeNumbering& numbering() const { return numbering_; }
  /// Smallest by largest pivot of K: an upper estimate of 1 / condition number, for next to nothing.
  double rcond();
  /// y = L^-1 P r for r on the F free places; the last C entries of y belong to the contact unknowns, in their order.
  Eigen::VectorXd forward(const Eigen::VectorXd& r);
  /// x = P' L'^-1 y.
  Eigen::VectorXd backward(Eigen::VectorXd y);
  /// C x C lower triangular trailing block of L.
  const Eigen::MatrixXd& contact_block() const { return contact_block_; }

  int factorisations = 0;                          ///< numeric factorisations so far
  int solves = 0;                                  ///< forward + backward pairs so far
  double analyse_seconds = 0, factor_seconds = 0;  ///< of the last analysis and factorisation

 private:
  struct Cholmod;
  struct Checked {};  ///< the problem has passed `check`
  PenaltyFactor(const VariationalInequality& problem, double delta, Checked);
  void check_unknowns(const VariationalInequality& problem) const;
  void factorise(const VariationalInequality& problem, double delta);
  FreeNumbering numbering_;
  double delta_ = 0;
  std::uint64_t matrices_ = 0;  ///< fingerprint of the A1, B and M that it was made of
  std::unique_ptr<Cholmod> cholmod_;
  Eigen::MatrixXd contact_block_;
};

}  // namespace antilock
