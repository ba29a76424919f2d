#pragma once
#include <optional>
#include <vector>

#include "antilock/distributed/detail/coarse_space.hpp"
#include "antilock/distributed/detail/layer_strips.hpp"
#include "antilock/distributed/detail/split_operator.hpp"

namespace antilock::distributed {

/// The two-level preconditioner of A_delta on a contact set, for a layer on any mesh:
///
///     smoother:      v += 1.5 / N  sum_s R_s' A_s^-1 R_s r,   r = rhs - A_delta v,
///     coarse space:  one cycle of BoomerAMG for P' A_delta P,
///
/// where the sets s are the strips of the layer (LayerStrips), each solved by a Cholesky factor,
/// and the body of each rank, by symmetric SOR, and P holds the coarse functions (CoarseSpace). It
/// is PETSc's PCMG with one smoothing step before and one after the coarse correction. N is
/// LayerStrips::most_sets_per_triangle(). The sum over the sets has no eigenvalue above N, so that
/// the damped one has none above 1.5. This is below 2, and therefore the V-cycle is symmetric and
/// positive definite, on every mesh, for every delta and every contact set.
///
/// Sets, coarse functions and N do not depend on the contact set, and are made once. Between two
/// contact sets only the factors of the strips with a row that entered or left the set are made
/// again, and the coarse matrix.
class StripMultigrid {
 public:
  /// `problem` must live as long as this object. Every rank must call it. Throws NotConverged, on
  /// every rank, as LayerStrips and CoarseSpace do.
  explicit StripMultigrid(const DistributedProblem& problem);
  StripMultigrid(const StripMultigrid&) = delete;
  StripMultigrid& operator=(const StripMultigrid&) = delete;

  /// The prefix of the options of its solver. Those of the coarse problem begin with
  /// `prefix` mg_coarse_.
  static constexpr auto prefix = "strips_";

  /// Prepares `solver` for the contact set `held`, the rows of this rank, ascending. `summed` is
  /// A_delta whose rows and columns of the set are those of a diagonal matrix. Solver and `summed`
  /// must be the same objects in every call. Every rank must call it. Throws NotConverged, on every
  /// rank, where the matrix of a strip is singular.
  void set_up(KSP solver, Mat summed, const std::vector<PetscInt>& held);

 private:
  void set_coarse_matrix(Mat summed);
  void prepare_coarse_product(Mat summed);
  void configure(KSP solver, Mat summed);
  void renew_operators(KSP solver, Mat summed);
  void configure_strips();
  void factor_strips();
  void keep_untouched_factors(const std::vector<PetscInt>& held);

  LayerStrips strips_;
  CoarseSpace coarse_;
  SplitOperator split_;
  Matrix interpolation_;  ///< that of coarse_, with empty rows on the contact set
  Matrix coarse_matrix_;
  PC schwarz_ = nullptr;  ///< the corrections on the sets; it belongs to the solver
  /// The contact set of the last call; empty before the first one.
  std::optional<std::vector<PetscInt>> last_held_;
};

}  // namespace antilock::distributed
