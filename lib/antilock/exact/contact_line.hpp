#pragma once
#include <Eigen/Core>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// The solution of the contact problem reduced to Gamma_C, the contact boundary, at the points x_j
/// = j / n. Each vector has n + 1 entries, which are zero at both ends.
struct ContactLine {
  Eigen::VectorXd displacement;  ///< c_j = u(x_j, -1) >= 0, exactly 0 where in contact
  Eigen::VectorXd pressure;      ///< lambda_j >= 0, exactly 0 where not in contact
};

/// Solves c >= 0, lambda = D c - q >= 0, lambda c = 0, where D is diagonal in the basis of the
/// sines sin(k pi x). `stiffness` is D_k > 0 and `load` is q_k, by wave number k. Each has n + 1
/// entries, of which 0 and n are unused. n is a power of two, at least 64. The method is the
/// primal-dual active set method, on nested grids from n = 64 on. Throws NotConverged if an active
/// set or an inner solve does not converge.
ContactLine solve_contact_line(const Eigen::VectorXd& stiffness, const Eigen::VectorXd& load);

}  // namespace antilock
