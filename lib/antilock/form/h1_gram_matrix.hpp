#pragma once
#include <Eigen/SparseCore>

#include "antilock/space/space.hpp"

namespace antilock {

/// N x N Gram matrix of the broken H1 norm, the ||.||_{1,Omega_h} of Section 4.2: sum over the triangles of int grad
/// u.grad v + u v.
Eigen::SparseMatrix<double> h1_gram_matrix(const Space& space);

}  // namespace antilock
