#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The problem in other unknowns w, among which the bounded combinations are, so that every bound is one on an unknown:
///
///     u = T w:   A1' = T' A1 T,   B' = B T,   L' = T' L,   the same M, compliance and forces p.
///
/// A row c of `combinations` takes the place of one of its unknowns, its pivot k: w_k = c . u, and with it
/// u_k = (w_k - the rest of c . u) / c_k. The other unknowns stay. A0 stays a product, B T, and is never summed.
///
/// A pivot is neither fixed nor bounded by itself. Rows whose pivot is in no other row are taken first, so that one row
/// per point of a slope, or per pair of points of two bodies, leaves T as sparse as the rows. Rows that share all their
/// unknowns (two walls of a groove at one point) are eliminated one after the other. Every row is scaled by a power of
/// two, its largest entry to 1 or more and below 2: the units of the rows do not matter.
struct BoundedUnknowns {
  /// Throws Error as `check_data` does, and for a row that has no pivot (its unknowns are fixed or bounded, or it depends
  /// on the rows before to within 1e-10 of its entries), and for a T with more than 20 N + 1e6 entries.
  explicit BoundedUnknowns(const VariationalInequality& of);

  VariationalInequality problem;  ///< in w; its bounds in the order of the original ones
  SparseMatrix t;                 ///< N x N
  Eigen::VectorXd scale;          ///< C: the bounded value of w over that of u, a power of two
};

}  // namespace antilock
