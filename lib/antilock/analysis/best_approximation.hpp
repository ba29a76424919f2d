#pragma once
#include "antilock/measure/errors.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Where to look for the nearest element: in K_h, or in K_0h = K_h and the kernel of a0 (B v = 0).
enum class AdmissibleSet { k_h, k_0h };

struct BestApproximation {
  Eigen::VectorXd v;    ///< N, the element
  double distance = 0;  ///< |u - v|_h, the broken H1 norm
  double value = 0;     ///< distance^2 + functional . v
};

/// The v of K_h, or of K_0h, that makes |u - v|_h^2 + functional . v smallest: a contact problem with the form of the
/// norm. Without a functional it is the best approximation of (8), Definition 1; with the residual of u it is the first
/// infimum of (13). K_h and B are those of `problem`; its forms and load are not used. Throws Error or NotConverged as
/// `active_set` does.
BestApproximation best_approximation(const Space& space, VariationalInequality problem, const Reference& u,
                                     AdmissibleSet within, const Eigen::VectorXd& functional = {});

/// The largest functional . w over the free w with w' norm w = 1; over those with B w = 0 where `kernel` says so.
/// `norm`: N x N Gram matrix. Riesz's representative is a linear problem.
double dual_norm(VariationalInequality problem, const SparseMatrix& norm, const Eigen::VectorXd& functional,
                 bool kernel = false);

}  // namespace antilock
