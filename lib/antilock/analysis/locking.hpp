#pragma once
#include <string>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// Returns the bending length k_T = abc / (4 area) of a triangle T, where a, b, c are the extents
/// of its three sides in x. A function w(x) has d_y w = 0, but its P1 interpolant on T has the
/// slope d_y = +-k_T w''. That is exact if w is a polynomial of degree 2, and else holds up to
/// third derivatives of w. The formula is that of the circumradius with extents in place of
/// lengths. So k_T is at most the circumradius, and it is 0 where a side is vertical. The unit is
/// that of the mesh.
double bending_length(const TriangleMesh& mesh, int triangle);
/// Returns k, the root mean square of k_T over the layer; 0 for a mesh without a layer. Where a
/// layer is bent with the same u_xx everywhere, the energy of its P1 interpolant contains the term
/// (k / epsilon)^2 int u_xx^2 over the layer.
double bending_length(const TriangleMesh& mesh);

/// A relative effect up to a twentieth is attributed to the mesh width, and not to locking.
inline constexpr double significance = 0.05;

enum class Verdict { locks_completely, locks, locks_in_part, not_detected };

/// A diagnosis of whether a discretisation can follow the limit compliance -> 0. It depends on the
/// forms and on which unknowns are bounded, and not on the load or on the values of the bounds. The
/// dimension of the kernel G_h of B does not decide it. In (23) of [SR04] (cited in
/// problem/variational_inequality.hpp) the body's unknowns are in G_h on every mesh, and in a
/// coating of plane strain u_x has a large kernel where u_y, which is in contact, has none. Locking
/// depends on the dimension of the trace of G_h on the bounded unknowns (trace_dimension,
/// kernel.hpp). This dimension is compared on a mesh and on a finer one:
/// - If it is 0 on the finer mesh, the bounded unknowns tend to 0 as compliance -> 0 (Proposition
///   1: u_h tends to a function of G_h). This is proved.
/// - If it is not larger on the finer mesh, some load locks. This is proved if the dimension is the
///   same number m on all meshes. The discrete traces then have at most m independent limits. But
///   K_0, the set of all v in the admissible set K with B v = 0, has infinitely many independent
///   traces.
/// - If it grows by less than 19/20 of the number of additional bounds, a part of the boundary
///   cannot move. (Example: the layer is cut into columns under one half of the boundary, and its
///   triangles are connected under the other half. The dimension grows, but the other half locks.)
/// - If it grows by more, the flexibilities are compared. Refinement makes the bounded unknowns
///   more flexible. If this effect is larger at a small compliance than at the compliance where
///   both forms are equally stiff, the method locks. This criterion is observed, not proved.
///   (Example: P1 for nearly incompressible plane strain with free sides, on a mesh with parallel
///   diagonals. There the dimension grows by one per additional bound, and the method locks.)
/// - Otherwise no locking for this reason is detected. This is necessary for uniform convergence,
///   but not sufficient: the traces must also approximate those of K_0 (Theorem 4).
///
/// B is that of the limit: rows that depend on a thickness must be taken at thickness 0.
struct LockingDiagnosis {
  int coarse = 0, fine = 0;                ///< dimensions of the trace on the bounds
  int coarse_bounds = 0, fine_bounds = 0;  ///< bounded unknowns of the stiff part
  /// Whether a stiff unknown is bounded. If none is, all stiff unknowns count as bounded, and
  /// locking in part is not diagnosed.
  bool bounded = true;
  /// r(compliance) / r(c) - 1. Here r is the flexibility on the finer mesh divided by the
  /// flexibility on the coarser one. The flexibility is the mean displacement of the bounded
  /// unknowns under a force of 1 that is spread over them, and c is the compliance at which both
  /// forms are about as stiff (StiffnessRatio, rounded to a decade). It is evaluated at
  /// `compliance`, or at 1e-6 c if `compliance` is 0.
  double refinement_softening = 0;
  /// The largest compliance at which the flexibilities show locking: the first of 1e-1 c, 1e-2 c,
  /// ..., 1e-6 c at which `refinement_softening` is above `significance` and above |r(c) - 1|. It
  /// is 0 if there is none.
  double compliance = 0;

  Verdict verdict() const;
  bool locks() const { return verdict() != Verdict::not_detected; }
  std::string text() const;  ///< one line with both dimensions and the verdict
};

/// Diagnoses one method by its problems on a mesh and on a finer one. Throws Error where a problem
/// is malformed or B has no rows, and where `fine` does not have more bounds than `coarse`.
LockingDiagnosis diagnose_locking(const VariationalInequality& coarse,
                                  const VariationalInequality& fine);

}  // namespace antilock
