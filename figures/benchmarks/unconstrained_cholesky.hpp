#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The measuring stick of the benchmark: seconds that CHOLMOD, as it comes (its own choice of the ordering, supernodes
/// as it likes), takes to analyse, factor and solve K u = L on the free unknowns, the contact ones unconstrained.
struct CholeskySeconds {
  double analyse = 0, factor = 0, solve = 0;
  double total() const { return analyse + factor + solve; }
};

/// K = A1 + penalty^-1 B' M B: the same matrix that the contact solver factors. Assembly of K is not counted here.
/// Throws Error where CHOLMOD fails.
CholeskySeconds unconstrained_cholesky(const VariationalInequality& problem);

}  // namespace antilock
