#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// N x n_free: the prolongation of the free unknowns to all of them.
SparseMatrix free_prolongation(const VariationalInequality& problem);

/// dim G_h, G_h = { v : B v = 0, v = 0 on the fixed unknowns } (Section 2, (H2)): by rank-revealing sparse QR. Zero:
/// u_h -> 0 as epsilon -> 0 (Proposition 1), complete locking. Values below 1e-10 of B's largest column count as zero. Throws Error for a
/// malformed problem.
int kernel_dimension(const VariationalInequality& problem);

/// The stiff part alone: the unknowns that stand in no row of B (an entry that is zero counts), which are in every
/// kernel, are held at 0. Its `contact` are the bounded unknowns of the stiff part, those in constraints, too.
VariationalInequality stiff_part(VariationalInequality problem);
/// kernel_dimension of the stiff part.
int layer_kernel_dimension(const VariationalInequality& problem);
/// Of a stiff part: the dimension of the trace of its kernel on the bounded unknowns, how many independent motions of
/// the bounds cost nothing at compliance 0. The kernel, less the part of it that is 0 on all bounds.
int trace_dimension(const VariationalInequality& stiff);

/// An orthonormal basis of G_h, N x kernel_dimension, zero on the fixed unknowns. Dense: for small problems.
Eigen::MatrixXd kernel_basis(const VariationalInequality& problem);

/// The coercivity constant of (H1) and (H1nc): the smallest a1(v, v) + a0(v, v) over the free v with norm(v, v) = 1.
/// Zero up to round-off or below: not coercive. `norm` is the N x N Gram matrix of the space's norm. Dense eigenvalues:
/// throws Error for more than 2000 free unknowns, a malformed problem, or a norm that is not positive definite there.
double coercivity(const VariationalInequality& problem, const SparseMatrix& norm);

}  // namespace antilock
