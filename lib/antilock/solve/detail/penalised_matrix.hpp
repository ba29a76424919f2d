#pragma once
#include <vector>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// Where each unknown stands among the unknowns to solve for: the free ones in their own order, the contact ones last.
struct FreeNumbering {
  explicit FreeNumbering(const VariationalInequality& problem);
  std::vector<int> unknown;  ///< F: place -> unknown
  std::vector<int> place;    ///< N: unknown -> place, -1 where fixed
  int interior = 0;          ///< F - C: the contact unknowns stand at interior, interior + 1, ...
};

/// Upper triangle (F x F, in the places of FreeNumbering) of K = A1 + B' M diag(deltas)^-1 B on the free unknowns.
/// Only the factorisation may see this sum: in it A1 has lost digits to delta^-1 (tutorial 16: the round-off trap).
SparseMatrix penalised_matrix(const VariationalInequality& problem, const FreeNumbering& numbering,
                              const Eigen::VectorXd& deltas);
/// The same with one delta for all R rows.
inline SparseMatrix penalised_matrix(const VariationalInequality& problem, const FreeNumbering& numbering,
                                     double delta) {
  return penalised_matrix(problem, numbering, Eigen::VectorXd(Eigen::VectorXd::Constant(problem.b.rows(), delta)));
}

}  // namespace antilock
