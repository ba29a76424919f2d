#pragma once
#include <vector>

#include "antilock/analysis/detail/interface_line.hpp"
#include "antilock/core/matrix.hpp"

namespace antilock {

/// Returns the basis of W, the space of the corrections of u_h in the body: N x H, the values of
/// each of its H hat functions at the unknowns in the body, and rows of 0 at all others.
///
/// The hats stand in rows above each other. Row 0 is Sigma, with one hat per unknown, in the order
/// of their places. The heights of the rows above are top, top / 2, top / 4, ... as long as they
/// are more than the mean distance of two unknowns on Sigma. The hats of a row are at most its
/// height apart. Between two rows a function is bilinear. Section 2 of
/// tutorials/guides/locking_loss.md says why this is enough.
RowMatrix correction_space(const Space& space, const InterfaceLine& sigma,
                           const std::vector<char>& in_body);

/// The body's part of the comparison as a problem on Sigma alone: min over the hats above Sigma of
/// w' A w / 2 - F' w, which is d' form d / 2 - force' d plus a constant for the values d of w on
/// Sigma. The constant is at most 0, and is left out: the bound is then too small, never too large.
struct CondensedBody {
  Eigen::MatrixXd form;   ///< n x n, symmetric: the Schur complement
  Eigen::VectorXd force;  ///< n values
  /// Per hat: whether its coefficient is 0, because a value is prescribed where it does not vanish.
  std::vector<char> held;
};

/// Eliminates the hats above Sigma. `form` (N x N) and `force` (N) are those of the body, `w` is
/// the basis of correction_space, `dirichlet_dofs` are the unknowns with prescribed values, and n
/// is the number of unknowns on Sigma.
CondensedBody condensed_body(const SparseMatrix& form, const Eigen::VectorXd& force,
                             const std::vector<int>& dirichlet_dofs, const RowMatrix& w,
                             Eigen::Index n);

}  // namespace antilock
