#pragma once
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// The constant c_h of condition (9), Definition 1 of [SR04] (cited in
/// problem/variational_inequality.hpp):
///
///     |min(v_h, 0)| <= c_h |v_h|_h   for all v_h of K_h with the bounds 0
///
/// in the norms of L2(Gamma_C), Gamma_C the contact boundary, and the broken H1 norm |.|_h. K_h is
/// the admissible set of the discrete problem. c_h is computed as an upper bound, the largest |v_h
/// - I v_h| / |v_h|_h over all of V_h, by an eigenvalue problem. Here I v_h is a function through
/// the values of v_h at the contact points of an edge E. Where these are not negative, I v_h >= 0,
/// so that |min(v_h, 0)| is at most |v_h - I v_h|. With v_a, v_m, v_b the values of v_h at the ends
/// and at the midpoint of E,
///
///     CR: I v_h is the mean,         |v_h - I v_h|^2 = |E| (v_b - v_a)^2 / 12 on E
///     P2: I v_h are two chords,      |v_h - I v_h|^2 = |E| (v_a - 2 v_m + v_b)^2 / 120
///     P1: I v_h is v_h,              so that c_h = 0
struct NegativePart {
  double constant = 0;    ///< c_h
  Eigen::VectorXd worst;  ///< the v_h of norm 1 with the largest |v_h - I v_h|; empty for P1
};

/// Computes this constant. `norm` is h1_gram_matrix. Where the bounded unknowns of `problem` are
/// fixed to 0, CR's worst v_h is in K_h, and its negative part has the norm c_h / 2^(1/2). The
/// eigenvalue problem is dense and has one row per edge of Gamma_C. Throws Error for other elements
/// than P1, P2 and CR.
NegativePart negative_part(const Space& space, VariationalInequality problem,
                           const SparseMatrix& norm);

}  // namespace antilock
