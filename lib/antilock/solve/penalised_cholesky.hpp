#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/penalised_matrix.hpp"
#include "antilock/solve/sparse_cholesky.hpp"

namespace antilock {

class SlackForm;

/// How the linear system of a correction is reduced for the contact iteration. K is the penalised
/// matrix on its n_free unknowns, and n_bounds of them are bounded.
/// - schur_complement: the contact unknowns come last in the factor of K, and the contact iteration
///   works on their dense n_bounds x n_bounds Schur complement (static condensation). Uzawa's
///   method needs it.
/// - sparse: each contact iteration factors K on the unknowns that are not active. Its cost is that
///   of a sparse factor, whatever n_bounds is.
/// - automatic: sparse where n_bounds > 10 sqrt(n_free), else schur_complement.
///   penalised_cholesky.cpp has the measurements behind the 10.
enum class ContactReduction { automatic, schur_complement, sparse };

/// The sparse Cholesky factor of the penalised matrix K = A1 + delta^-1 B' M B of a problem in
/// slack form (detail/slack_form.hpp). With schur_complement the C contact unknowns are ordered
/// last. Then the trailing C x C block of the factor is the Cholesky factor of their Schur
/// complement in K, and the whole contact problem is solved on it. One factor serves every load,
/// every bound and, while delta is the same, every compliance of one pair (A1, B).
class PenalisedCholesky {
 public:
  /// Analyses and factors K for delta = penalty_parameter(problem, penalty). Throws Error for a
  /// malformed problem, for a penalty that is not positive, and where K is not positive definite
  /// (then A1 + B' M B is singular: a component of the mesh has no support). Throws NotConverged
  /// where memory runs out.
  explicit PenalisedCholesky(const VariationalInequality& problem,
                             std::optional<double> penalty = std::nullopt,
                             ContactReduction reduction = ContactReduction::automatic,
                             CholeskyMaker make = default_cholesky);

  /// Throws Error for a malformed problem, for one with other free or contact unknowns, and for one
  /// whose A1, B, M or fixed compliances differ from this factor's in one bit. Costs about as much
  /// as a residual.
  void check_fits(const VariationalInequality& problem) const;
  /// Does the same, and returns the problem in slack form, in which all bounds are on unknowns.
  SlackForm slack_form(const VariationalInequality& problem) const;
  /// Computes a new numeric factor for another delta; the analysis is kept. If factorisation fails,
  /// delta grows by defaults::penalty_reduction until it succeeds. If no delta succeeds, it throws
  /// as the constructor does, and delta() is 0 from then on.
  void refactor(double delta);

  /// Returns the penalty of the parametric rows, or 0 where the last refactor() has failed.
  double delta() const { return delta_; }
  /// Returns the penalty of each row of B of the problem in slack form. It is delta, except for the
  /// rows with a fixed compliance c > 0. There it is the larger one of c and
  /// defaults::fixed_row_penalty_ratio min(delta, choose_penalty(problem)).
  const Eigen::VectorXd& penalties() const { return penalties_; }
  const DofOrdering& ordering() const { return ordering_; }
  /// Returns the smallest pivot of K: an upper bound, and a heuristic estimate, of its smallest
  /// eigenvalue (sparse_cholesky.hpp).
  double smallest_pivot() const { return factor_.cholesky().smallest_pivot(); }
  double entries() const { return factor_.cholesky().entries(); }  ///< of the factor
  /// Returns K^-1 r (n_free). With sparse, the result solves the system restricted to the unknowns
  /// that are not constrained, and is 0 at the others.
  Eigen::VectorXd solve(const Eigen::VectorXd& r) const { return factor_.solve(r); }

  /// Returns the factor whose unknowns can be constrained, or nullptr with schur_complement.
  ConstrainedCholesky* sparse_factor() { return sparse_ ? &factor_ : nullptr; }

  // These throw Error with sparse.
  /// Returns the factor itself. The last C entries of its forward(r) belong to the contact
  /// unknowns, in their order.
  const SparseCholesky& cholesky() const;
  /// Returns the lower triangular trailing block of the factor (C x C).
  const Eigen::MatrixXd& contact_block() const {
    cholesky();
    return contact_block_;
  }
  /// Returns the Schur complement of the contact unknowns in K (C x C); contact_block() is its
  /// Cholesky factor.
  const Eigen::MatrixXd& schur() const {
    cholesky();
    return schur_;
  }

  int factorisations() const { return factor_.factorisations(); }  ///< numeric ones so far
  double analyse_seconds() const { return factor_.analyse_seconds(); }
  /// Returns the wall seconds of the last refactor().
  double factor_seconds() const { return factor_.factor_seconds() + schur_seconds_; }

 private:
  double first_delta_, delta_ = 0;
  Eigen::VectorXd penalties_;
  VariationalInequality problem_;  ///< in slack form
  DofOrdering ordering_;
  bool sparse_;
  ConstrainedCholesky factor_;
  Eigen::MatrixXd contact_block_, schur_;  ///< with schur_complement
  double schur_seconds_ = 0;
};

}  // namespace antilock
