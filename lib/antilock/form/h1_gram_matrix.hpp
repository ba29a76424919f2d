#pragma once
#include <Eigen/SparseCore>

#include "antilock/space/space.hpp"

namespace antilock {

/// Returns the N x N Gram matrix of the broken H1 norm, ||.||_{1,Omega_h} of Section 4.2 of [SR04]
/// (cited in problem/variational_inequality.hpp):
///
///     (u, v) -> sum over the cells T of int_T grad u . grad v + u v
///
/// The gradients are integrated by gradient_quadrature. For Q1-reduced take the matrix of Q1 on
/// the same mesh, whose unknowns are the same.
Eigen::SparseMatrix<double> h1_gram_matrix(const Space& space);

}  // namespace antilock
