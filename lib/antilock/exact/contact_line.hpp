#pragma once
#include <Eigen/Core>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// The contact problem reduced to Gamma_C, at the points x_j = j / n: values with n + 1 entries, zero at both ends.
struct ContactLine {
  Eigen::VectorXd displacement;  ///< c_j = u(x_j, -1) >= 0, exactly 0 where in contact
  Eigen::VectorXd pressure;      ///< lambda_j >= 0, exactly 0 where not in contact
};

/// Solves c >= 0, lambda = D c - q >= 0, lambda c = 0, D diagonal in the sines.
/// stiffness, load: D_k > 0 and q_k by wave number k, n + 1 entries (0 and n unused), n >= 64 a power of two.
/// Primal-dual active set, nested from n = 64. Throws NotConverged if a set or an inner solve does not settle.
ContactLine solve_contact_line(const Eigen::VectorXd& stiffness, const Eigen::VectorXd& load);

}  // namespace antilock
