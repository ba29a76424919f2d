#pragma once
#include <map>
#include <vector>

#include "antilock/core/matrix.hpp"
#include "antilock/problem/bounds.hpp"

namespace antilock {

/// A discrete variational inequality with a parameter, (6) of [SR04], and its limit (7) at
/// compliance = 0:
///
///     u in K_h:  a1(u, v - u) + compliance^-1 a0(u, v - u) >= L(v - u)   for all v in K_h
///     K_h = { v : v = dirichlet_values on the dirichlet_dofs,
///                 lower <= s(v) <= upper },   s(v) the bounded values of v (bounds.hpp)
///
/// [SR04] is L. Slimane and Y. Renard, The treatment of the locking phenomenon for a general class
/// of variational inequalities, J. Comput. Appl. Math. 170 (2004), 121-143. The headers of this
/// library cite its equations, propositions and remarks by number.
///
/// N is the number of unknowns, R the number of rows of B, and C the number of bounds. Every
/// quantity is dimensionless.
///
/// The stiff form a0(u, v) = (B u, M B v), M diagonal, is kept as its factors, because the sum A1 +
/// compliance^-1 B' M B loses the digits of A1 to round-off as the compliance falls. A form with a
/// symmetric positive semidefinite block of M per cell fits as well: with block = G G', the rows of
/// the cell are G' B and M is 1. The choice of units is free: u stays the same where A1 and L are
/// multiplied by s > 0 and the compliance by 1 / s, and also where M and the compliance are
/// multiplied by s. Therefore a compliance above 1 is accepted.
///
/// A bound with a finite force limit g is a soft constraint and does not restrict K_h. It carries a
/// force of at most g and yields once the force would exceed g. With s_i its bounded value, it adds
/// j(v) - j(u) to the left side,
///
///     j(v) = sum_i g_i dist(s_i, [lower_i, upper_i]),   so that |lambda_i| <= g_i,
///
/// and lambda_i = g_i where s_i < lower_i, lambda_i = -g_i where s_i > upper_i. Tresca's friction
/// is the case lower = upper = 0 of a tangential displacement: the body sticks where |lambda| < g.
/// Where it slips, lambda opposes the motion and |lambda| = g.
struct VariationalInequality {
  SparseMatrix a1;    ///< N x N, symmetric; A1 + B' M B is positive definite on the free unknowns
  RowMatrix b;        ///< R x N; R = 0 where nothing is stiff
  Eigen::VectorXd m;  ///< R, the diagonal of M, positive (for example areas of cells)
  /// The parameter by which a0 is divided, 0 or more. In (23) of [SR04] it is epsilon^2:
  /// `class_parameter` (models/anti_plane.hpp).
  double compliance = 1;
  Eigen::VectorXd load;              ///< N, L(phi_i)
  std::vector<int> dirichlet_dofs;   ///< unknowns with a prescribed value
  Eigen::VectorXd dirichlet_values;  ///< one per dirichlet_dof
  Bounds bounds;                     ///< C, the admissible set K_h and the force limits

  /// At most R entries, each 0 or more: the compliances of the last rows of B. They do not vary
  /// with `compliance`. Row j with c_j > 0 has the energy m_j (B u)_j^2 / (2 c_j), which belongs to
  /// a1. It is kept as factors, because it may be so much stiffer than A1 that their sum would lose
  /// the digits of A1. c_j = 0 is a linear equality constraint, (B u)_j = 0. The compliance of the
  /// other rows, the first parametric_row_count() ones, is `compliance`.
  Eigen::VectorXd fixed_compliances = {};

  int size() const { return static_cast<int>(load.size()); }
  int free_count() const { return size() - static_cast<int>(dirichlet_dofs.size()); }
  Eigen::Index parametric_row_count() const { return b.rows() - fixed_compliances.size(); }
  /// Returns the compliance of each row of B (R).
  Eigen::VectorXd compliances() const {
    Eigen::VectorXd rows = Eigen::VectorXd::Constant(b.rows(), compliance);
    rows.tail(fixed_compliances.size()) = fixed_compliances;
    return rows;
  }
};

/// Throws an Error that names the first requirement which does not hold: sizes that fit, finite
/// entries, an a1 that is symmetric up to 1e-12 of its largest entry, M > 0, a compliance that is
/// finite and at least 0, indices that are in range and named once, one free unknown or more, and
/// the requirements of check_bounds.
void check(const VariationalInequality& problem);

/// Does the same without the symmetry of a1, in one pass over the data. Every call of a solver
/// makes this check. The symmetry is checked once, when the factor of the matrix is made.
void check_data(const VariationalInequality& problem);

/// Appends r rows to B: b (r x N), their entries m (r) of M and their fixed compliances (r, each 0
/// or more).
void append_rows(VariationalInequality& problem, const RowMatrix& b, const Eigen::VectorXd& m,
                 const Eigen::VectorXd& fixed_compliances);

/// Assembles the rows b_j of B with a fixed compliance c_j > 0 into A1:
///
///     A1 + sum_j (m_j / c_j) b_j' b_j
///
/// Parametric rows and rows with the fixed compliance 0 stay in B. The analysis works with this
/// form, whose only positive compliance is the parameter. A1 may lose the digits that the factors
/// keep.
VariationalInequality assemble_fixed_rows(VariationalInequality problem);

/// Throws Error unless the bounds are well formed: sizes that fit, no NaN, lower <= upper, one
/// finite side or two, force limits of 0 or more, and a free unknown in every row of constraints.
void check_bounds(const VariationalInequality& problem);

/// Replaces the dirichlet_dofs of the problem and their values by these.
void set_dirichlet(VariationalInequality& problem, const std::map<int, double>& values);

/// Returns the equality-constrained problem of an active set (J. Nocedal and S. J. Wright,
/// Numerical Optimization, ch. 16). `active` has one mark per bounded unknown. Marked bounds hold
/// as equations, u = lower, and the other bounds are removed, so that the problem is linear. Where
/// `active` is the contact set of the solution, both problems have the same solution. Throws Error
/// for another number of marks, and for bounds other than lower bounds on unknowns.
VariationalInequality equality_constrained(VariationalInequality problem,
                                           const std::vector<bool>& active);

}  // namespace antilock
