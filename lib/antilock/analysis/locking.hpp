#pragma once
#include <string>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The slope d/dy of P1's interpolant of w(x) on a triangle is +-k_T w'', exactly where w is a parabola:
/// k_T = abc / (4 area), with a, b, c the extents of the three sides in x. That is the formula of the circumradius, which
/// it never exceeds, and 0 where a side is vertical. A length.
double bending_length(const TriangleMesh& mesh, int triangle);
/// Its root mean square over the layer, k: P1 resists bending there as if (k / epsilon)^2 |u_xx|^2 stood in its energy.
/// 0 for a mesh without a layer.
double bending_length(const TriangleMesh& mesh);

/// Whether a discretisation can follow the limit epsilon -> 0, from its kernel alone, before anything is solved. In (23)
/// the whole kernel G_h of a0 says nothing: every unknown of the body is in it, on every mesh. What decides is the kernel
/// on the stiff part, the unknowns that stand in a row of B (the layer), and whether it grows under refinement: the
/// functions of K_0 that it must approach (Theorem 4) are infinitely many.
struct LockingDiagnosis {
  int coarse = 0, fine = 0;                    ///< dim of the kernel on the stiff part, on a mesh and on a finer one
  int coarse_unknowns = 0, fine_unknowns = 0;  ///< free unknowns of the stiff part

  /// It locks: the kernel on the stiff part is 0, or does not grow. (That it grows is necessary, not sufficient: its
  /// functions must come near every one of K_0, too.)
  bool locks() const { return fine == 0 || fine <= coarse; }
  /// The kernel grows like unknowns^order: 1/2 for P1 in columns, 1 for Crouzeix-Raviart; 0 where it locks.
  double order() const;
  std::string text() const;  ///< one line: both counts, and what they mean
};

/// `coarse` and `fine` are the same method on a mesh and on a finer one. Throws Error where a problem is malformed or has
/// nothing stiff (no row of B), or where `fine` has not more unknowns in its stiff part.
LockingDiagnosis diagnose_locking(const VariationalInequality& coarse, const VariationalInequality& fine);

}  // namespace antilock
