#pragma once
#include "antilock/measure/errors.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// The set of admissible v: K_h of the problem (problem/variational_inequality.hpp), or K_0h, the v
/// of K_h with B v = 0.
enum class AdmissibleSet { k_h, k_0h };

struct BestApproximation {
  Eigen::VectorXd v;    ///< N, the element
  double distance = 0;  ///< |u - v|_h, in the broken H1 norm
  double value = 0;     ///< distance^2 + functional . v
};

/// Returns the v of K_h or K_0h that minimises |u - v|_h^2 + functional . v, where |.|_h is the
/// broken H1 norm. That is a contact problem whose form is the inner product of the norm.
/// `functional` has N entries, or is empty for 0. Without it v is the best approximation of (8),
/// Definition 1 of [SR04]. With the residual of u as the functional, v attains the first infimum of
/// (13). K_h and B are those of `problem`, whose forms and load are not used. Throws Error or
/// NotConverged as active_set does. ([SR04] is cited in problem/variational_inequality.hpp.)
BestApproximation best_approximation(const Space& space, VariationalInequality problem,
                                     const Reference& u, AdmissibleSet within,
                                     const Eigen::VectorXd& functional = {});

/// Returns the dual norm of the functional (N): the largest functional . w over all w with w' norm
/// w = 1 that are 0 on the prescribed unknowns, and with B w = 0 where `kernel` is true. `norm` is
/// an N x N Gram matrix. The norm is computed from Riesz's representative of the functional, the
/// solution of a linear problem.
double dual_norm(VariationalInequality problem, const SparseMatrix& norm,
                 const Eigen::VectorXd& functional, bool kernel = false);

}  // namespace antilock
