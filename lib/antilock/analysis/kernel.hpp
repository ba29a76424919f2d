#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// Returns the prolongation (N x n_free) of the free unknowns to all unknowns, with 0 at the
/// prescribed ones.
SparseMatrix free_prolongation(const VariationalInequality& problem);

/// Returns dim G_h, G_h = { v : B v = 0, v = 0 on the prescribed unknowns } (Section 2 of [SR04],
/// (H2); cited in problem/variational_inequality.hpp), by rank-revealing sparse QR. Values below
/// 1e-10 of the largest column norm of B count as zero. Where dim G_h = 0, u_h tends to 0 as
/// epsilon -> 0 (Proposition 1), which is complete locking. Throws Error for a malformed problem.
int kernel_dimension(const VariationalInequality& problem);

/// Returns the restriction of the problem to the unknowns with entries in B; a stored zero counts
/// as an entry. The other unknowns, which are in the kernel of any B, are fixed at 0. `bounds` of
/// the result lists the bounded unknowns among the restricted ones, including the unknowns in a row
/// of `constraints`.
VariationalInequality stiff_part(VariationalInequality problem);
/// Returns kernel_dimension of the stiff part.
int layer_kernel_dimension(const VariationalInequality& problem);
/// Returns the dimension of the trace of the kernel on the bounded unknowns, for the stiff part of
/// a problem: the number of independent motions of the bounded unknowns that have no stiff energy.
/// It is dim G_h less the dimension of the subspace of G_h that is 0 on all bounds.
int trace_dimension(const VariationalInequality& stiff);

/// Returns an orthonormal basis of G_h (N x kernel_dimension), zero on the prescribed unknowns. It
/// is computed densely, for small problems.
Eigen::MatrixXd kernel_basis(const VariationalInequality& problem);

/// Returns the coercivity constant of (H1) and (H1nc): the smallest a1(v, v) + a0(v, v) over the
/// free v with norm(v, v) = 1. Where it is zero up to round-off, or negative, the form is not
/// coercive. `norm` is the N x N Gram matrix of the norm of the space. The eigenvalues are computed
/// densely. Throws Error for more than 2000 free unknowns, a malformed problem, or a norm that is
/// not positive definite on the free unknowns.
double coercivity(const VariationalInequality& problem, const SparseMatrix& norm);

}  // namespace antilock
