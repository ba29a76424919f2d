#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The hypotheses of the theorems of [SR04] (Sections 2 and 3.1; cited in
/// problem/variational_inequality.hpp), computed for one discrete problem. The values on several
/// meshes indicate whether the hypotheses hold uniformly in h. G_h is the kernel of a0 on the free
/// unknowns.
struct Hypotheses {
  /// (H1), (H1nc): the smallest (a1 + a0)(v, v) / norm(v, v). The theorems need a positive lower
  /// bound beta for all h.
  double coercivity = 0;
  /// (H2): dim G_h. G_h contains every function on which a0 vanishes. In (23) these include all
  /// functions that are 0 in the layer. So its size alone does not diagnose locking; locking.hpp
  /// does.
  int kernel = 0;
  int free = 0;  ///< free unknowns; B v = 0 means free - kernel independent conditions
  /// The distance of the admissible set K_h from G_h (distance_to_kernel). The theorems need a
  /// common element of both.
  double distance = 0;

  bool coercive() const { return coercivity > 1e-10; }        ///< far above round-off
  bool intersects_kernel() const { return distance < 1e-6; }  ///< the violation that solvers accept
};

/// Computes the hypotheses. The part a0 >= 0 of (H2) holds by construction, since M > 0 is checked.
/// `distance` is NaN where (H1) fails, because (7) may then be singular. `norm` is the N x N Gram
/// matrix of the norm of the space. Throws Error as coercivity() does: for a malformed problem or
/// too many unknowns.
Hypotheses check_hypotheses(const VariationalInequality& problem, const SparseMatrix& norm);

/// Returns a measure of the distance of K_h from G_h. Let v be the minimiser of (B v, M B v) over
/// K_h, computed with a small compliance. The measure is the largest |(B v)_j| / (sum_k |B_jk| max
/// |v|) over the rows j. It is 0 up to round-off (below 1e-6) where problem (7), epsilon = 0, has a
/// solution, and larger where it has none. Throws Error for a malformed or singular problem.
double distance_to_kernel(const VariationalInequality& problem);

}  // namespace antilock
