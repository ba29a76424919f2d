#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// What the paper's theorems ask of a discrete problem (Sections 2 and 3.1), computed for one given problem. Uniformity
/// in h is seen by asking on two meshes.
struct Hypotheses {
  double coercivity = 0;  ///< (H1), (H1nc): smallest (a1 + a0)(v, v) / norm(v, v); the theory wants it >= beta > 0
  int kernel = 0;       ///< (H2): dim G_h, G_h the kernel of a0 on the free unknowns. All that a0 does not see is in it
                        ///< (in (23) the whole body), so that its size does not tell locking: locking.hpp does
  int free = 0;         ///< free unknowns: free - kernel conditions are asked
  double distance = 0;  ///< of K_h from G_h (distance_to_kernel); the theory wants K_h and G_h to meet

  bool coercive() const { return coercivity > 1e-10; }        ///< far above the round-off of an eigenvalue
  bool intersects_kernel() const { return distance < 1e-6; }  ///< below what the solvers refuse
};

/// (H2) also wants a0 >= 0: with M > 0 that is so by construction, and checked as such. `norm` is the N x N Gram matrix
/// of the space's norm. Throws Error as `coercivity` does (a malformed problem, too many unknowns).
Hypotheses check_hypotheses(const VariationalInequality& problem, const SparseMatrix& norm);

/// How far K_h and G_h are from meeting: the smallest B v over K_h, least squares in M, each row relative to its own
/// sum |B| times max|v|. Zero up to round-off (below 1e-6) where problem (7), epsilon = 0, has a solution; larger where
/// it has none. Throws Error for a malformed or singular problem.
double distance_to_kernel(const VariationalInequality& problem);

}  // namespace antilock
