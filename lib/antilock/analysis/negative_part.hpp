#pragma once
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// The constant c_h of condition (9) of Definition 1: |min(v_h, 0)| <= c_h |v_h|_h in L2(Gamma_C) for v_h in K_h
/// (bounds 0), since where v_h >= 0 at its points on an edge the part below 0 is no larger than what separates v_h from
/// the function through those points: the mean (CR: |E| (v_b - v_a)^2 / 12 for the square), the two chords (P2: |E|
/// (v_a - 2 v_m + v_b)^2 / 120), nothing (P1: c_h = 0). The largest eigenvalue over V_h, so an upper bound.
struct NegativePart {
  double constant = 0;    ///< c_h
  Eigen::VectorXd worst;  ///< the v_h of norm 1 that is furthest from that function; empty for P1
};

/// `norm`: h1_gram_matrix. Where the bounded unknowns of `problem` are fixed to 0, CR's worst v_h is in K_h, and what it has
/// below 0 is c_h / 2^(1/2). Dense in the edges of Gamma_C. Throws Error for other elements.
NegativePart negative_part(const Space& space, VariationalInequality problem, const SparseMatrix& norm);

}  // namespace antilock
