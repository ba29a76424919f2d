#pragma once
#include <vector>

#include "antilock/core/matrix.hpp"

namespace antilock {

/// The discrete problem of the paper's whole class, (6), and (7) where compliance = 0:
///
///     u in K_h:  a1(u, v - u) + compliance^-1 a0(u, v - u) >= L(v - u)   for all v in K_h
///     K_h = { v : v = dirichlet_values on the dirichlet_dofs, lower <= v <= upper on the contact unknowns,
///                 lower <= constraints v <= upper }
///
/// A bound with a finite force_limit g is no part of K_h: it carries a force of at most g (a soft constraint), and
/// slips under more. It adds j(v) - j(u) on the left, j(v) = sum g dist(v, [lower, upper]), and |lambda| <= g; lambda
/// = g below it, -g above. Tresca's friction with the bound g is the one of a tangential displacement with lower =
/// upper = 0: it sticks where
/// |lambda| < g and slips against lambda where |lambda| = g.
///
/// a0(u, v) = (B u, M B v) stays in factored form: summed into a1 it destroys a1 by round-off. Everything is
/// dimensionless. N unknowns, R rows of B, C bounds: those on unknowns and then those on constraints, in lower, in
/// upper and in the answer's lambda. lambda >= 0 at a lower bound, <= 0 at an upper one.
///
/// M is diagonal. A form whose M has a block per cell fits as well: with block = G G', rows G' B of the cell and M = 1.
/// No unit is better than another: A1 times s is the same problem at compliance / s, M times s at compliance s, and a
/// compliance above 1 is taken as it is.
struct VariationalInequality {
  SparseMatrix a1;        ///< N x N, symmetric; positive definite together with B' M B on the free unknowns
  RowMatrix b;            ///< R x N; R = 0 where nothing is stiff
  Eigen::VectorXd m;      ///< R, the diagonal of M, positive (areas of cells)
  double compliance = 1;  ///< the class parameter, 0 or more. In (23) it is epsilon^2, by `class_parameter`
                          ///< (models/anti_plane.hpp)
  Eigen::VectorXd load;   ///< N, L(phi_i)
  std::vector<int> dirichlet_dofs;   ///< unknowns with a prescribed value
  Eigen::VectorXd dirichlet_values;  ///< one per dirichlet_dof
  std::vector<int> contact;          ///< bounded unknowns, in the order of the reports (by x)
  Eigen::VectorXd lower;             ///< C: lower <= u there (= -gap). -infinity: no bound from below
  Eigen::VectorXd upper = {};        ///< C, or empty: none. +infinity: no bound from above; = lower: an equation
  Eigen::VectorXd force_limit = {};  ///< C, or empty: none. The largest |lambda|, 0 or more; +infinity: no limit
  RowMatrix constraints = {};  ///< a row per bound beyond `contact` x N, or empty: a row c bounds c . u, such as the
                               ///< normal displacement on a slope or the gap between two bodies

  /// The compliances of the last rows of B, 0 or more, whatever `compliance` is: their energy m (B u)^2 / (2 own) belongs
  /// to a1, in factors because a sum would lose its digits (a part of the body that is far stiffer than the rest). 0: a
  /// tie, B u = 0. All other rows are those of the class, the first parametric_row_count() ones.
  Eigen::VectorXd fixed_compliances = {};

  int size() const { return static_cast<int>(load.size()); }
  int free_count() const { return size() - static_cast<int>(dirichlet_dofs.size()); }
  Eigen::Index parametric_row_count() const { return b.rows() - fixed_compliances.size(); }
  /// R, the compliance of each row of B.
  Eigen::VectorXd compliances() const {
    Eigen::VectorXd rows = Eigen::VectorXd::Constant(b.rows(), compliance);
    rows.tail(fixed_compliances.size()) = fixed_compliances;
    return rows;
  }
  int bound_count() const { return static_cast<int>(contact.size()) + static_cast<int>(constraints.rows()); }
};

/// Throws Error with the first thing that is wrong: sizes that do not fit, entries that are not finite, an a1 that is
/// not symmetric, M not positive, compliance out of range, indices out of range or named twice, no free unknown, a
/// bound without a finite side or with its lower side above its upper one.
void check(const VariationalInequality& problem);

/// The same but for the symmetry of a1, in one walk over the data: what a solver asks at every call, whoever made the
/// factor. The factor has asked for the symmetry of its matrix.
void check_data(const VariationalInequality& problem);

/// Appends rows of B (r x N) with M = m (r) and compliances of their own (r, 0 or more).
void append_rows(VariationalInequality& problem, const RowMatrix& b, const Eigen::VectorXd& m,
                 const Eigen::VectorXd& fixed_compliances);

/// The same problem in the form in which the class is studied: rows with an own compliance above 0 are summed into A1,
/// which loses the digits that they keep. Rows of the class and of an own compliance of 0 stay.
VariationalInequality assemble_fixed_rows(VariationalInequality problem);

/// The part of `check` that looks at the bounds: sizes, numbers, an empty or unbounded interval, a row of constraints
/// without a free unknown. Throws Error.
void check_bounds(const VariationalInequality& problem);

}  // namespace antilock
