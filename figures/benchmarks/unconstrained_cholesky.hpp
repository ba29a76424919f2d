#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The unit of comparison of the benchmark: the seconds of CHOLMOD with its default options to
/// analyse, factor and solve K u = L on the free unknowns, with unconstrained contact unknowns.
struct CholeskySeconds {
  double analyse = 0, factor = 0, solve = 0;
  double total() const { return analyse + factor + solve; }
};

/// Measures them for K = A1 + penalty^-1 B' M B, the matrix that the contact solver factors. The
/// seconds do not include the assembly of K. Throws Error where CHOLMOD fails.
CholeskySeconds unconstrained_cholesky(const VariationalInequality& problem);

}  // namespace antilock
