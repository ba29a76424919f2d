#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/penalised_matrix.hpp"
#include "antilock/solve/sparse_cholesky.hpp"

namespace antilock {

class SlackForm;

/// How the linear system of a correction is reduced for the contact iteration.
///
/// schur_complement: the contact unknowns come last in the factor, everything else is eliminated once, and the contact
/// iteration works on their C x C Schur complement (static condensation). sparse: each step of the contact iteration
/// factors K on the unknowns that are not active; its cost follows the sparse factor, whatever n_bounds is. automatic
/// takes sparse where
///
///     n_bounds > 10 sqrt(n_free)
///
/// Measured on a membrane (figures/benchmarks/many_bounds.cpp) with bounds on k rows of n x n vertices, n_bounds = k
/// sqrt(n_free): the seconds of schur_complement over those of sparse are 0.2 to 0.4 at k = 1 to 4, 0.5 to 0.9 at 8,
/// 0.6, 1.1 and 1.4 at 10 and 0.8, 1.4 and 2.5 at 12, for n = 32, 64 and 128: n_bounds^3 stands against n_free^(3/2).
/// Where all unknowns are bounded, sparse is taken from 101 on: at 225 both cost the same, at 529 it takes a fifth.
/// Uzawa needs schur_complement. (A beam of 512 cells takes as many steps with either.)
enum class ContactReduction { automatic, schur_complement, sparse };

/// Sparse Cholesky factor L L' = P K P' of the penalised matrix A_delta, K = A1 + delta^-1 B' M B. With
/// schur_complement the contact unknowns are ordered last: the trailing C x C block of L is then the Cholesky factor
/// of their Schur complement, so the whole contact problem is solved on it for next to nothing. It serves every load,
/// every bound and, where delta is the same, every compliance of one matrix pair (A1, B).
class PenalisedCholesky {
 public:
  /// refactor(penalty_parameter(problem, penalty)). Throws Error for a malformed problem or a penalty that is not
  /// positive, if K is not positive definite (then A1 + B' M B is singular: a component of the mesh is held nowhere),
  /// or out of memory.
  explicit PenalisedCholesky(const VariationalInequality& problem, std::optional<double> penalty = std::nullopt,
                             ContactReduction reduction = ContactReduction::automatic,
                             CholeskyMaker make = default_cholesky);

  /// Throws Error for a malformed problem, for one with other free or contact unknowns, and for one with another A1, B
  /// or M than this factor's, to the last bit: one walk over the data, about the cost of a residual.
  void check_fits(const VariationalInequality& problem) const;
  /// The same, and the problem in slack form, with all bounds on unknowns (slack_form.hpp).
  SlackForm slack_form(const VariationalInequality& problem) const;
  /// A new numeric factorisation for another delta, or one so much larger that the factor has its pivots; the symbolic
  /// analysis is kept. Throws as the constructor does, and delta() is 0 then, until it succeeds.
  void refactor(double delta);

  double delta() const { return delta_; }
  /// R, of the problem in slack form: delta, and of rows with compliances of their own these or defaults::fixed_row_penalty_ratio.
  const Eigen::VectorXd& penalties() const { return penalties_; }
  const DofOrdering& ordering() const { return ordering_; }
  /// The smallest pivot of K: an upper bound, and a heuristic estimate, of its smallest eigenvalue (sparse_cholesky.hpp).
  double smallest_pivot() const { return factor_.cholesky().smallest_pivot(); }
  /// K^-1 r on the n_free unknowns; with sparse on those that are not eliminated, 0 on the others.
  Eigen::VectorXd solve(const Eigen::VectorXd& r) const { return factor_.solve(r); }

  /// The factor of K with eliminated unknowns; nullptr with schur_complement.
  ConstrainedCholesky* sparse_factor() { return sparse_ ? &factor_ : nullptr; }

  // With schur_complement alone; with sparse they throw Error.
  /// The factor itself: of L^-1 P r the last C entries belong to the contact unknowns, in their order.
  const SparseCholesky& cholesky() const;
  /// C x C lower triangular trailing block of L, and the Schur complement of which it is the factor.
  const Eigen::MatrixXd& contact_block() const { return cholesky(), contact_block_; }
  const Eigen::MatrixXd& schur() const { return cholesky(), schur_; }

  int factorisations() const { return factor_.factorisations(); }  ///< numeric ones so far
  double analyse_seconds() const { return factor_.analyse_seconds(); }
  double factor_seconds() const { return factor_.factor_seconds() + schur_seconds_; }  ///< of the last whole K

 private:
  double first_delta_, delta_ = 0;
  Eigen::VectorXd penalties_;
  VariationalInequality problem_;  ///< that it was made of, in slack form
  DofOrdering ordering_;
  bool sparse_;
  ConstrainedCholesky factor_;
  Eigen::MatrixXd contact_block_, schur_;  ///< with schur_complement
  double schur_seconds_ = 0;
};

}  // namespace antilock
