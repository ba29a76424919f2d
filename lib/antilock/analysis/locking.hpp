#pragma once
#include <string>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The slope d/dy of P1's interpolant of w(x) on a triangle is +-k_T w'', exactly where w is a parabola:
/// k_T = abc / (4 area), with a, b, c the extents of the three sides in x. That is the formula of the circumradius, which
/// it never exceeds, and 0 where a side is vertical. A length.
double bending_length(const TriangleMesh& mesh, int triangle);
/// Its root mean square over the layer, k: P1's interpolant pays (k / epsilon)^2 |u_xx|^2 there, in the mean over a
/// layer bent alike. 0 for a mesh without a layer.
double bending_length(const TriangleMesh& mesh);

/// A relative effect up to a twentieth is put down to the mesh width, and not to locking.
inline constexpr double significance = 0.05;

enum class Verdict { locks_completely, locks, locks_in_part, not_detected };

/// Whether a discretisation can follow the limit compliance -> 0, before anything is solved. The dimension of the kernel
/// G_h of B does not decide: in (23) the body's unknowns are in it on every mesh, and in a coating of plane strain u_x has
/// a rich kernel where u_y, which bears the contact, has none. What decides is the trace of G_h on the bounded unknowns.
/// - none: as compliance -> 0 the bounds do not move (Proposition 1: u_h tends to a function of G_h). Proved.
/// - no more on the finer mesh: K_0 has infinitely many independent traces; m + 1 of them cannot all be limits of
///   functions whose traces have the dimension m, so that some load locks. Proved, if the number stays m on all meshes.
/// - more, and bounds without a motion of their own in proportion: a part of the boundary is held (counterexample to "it
///   grows": a layer aligned under one half of it and with connected triangles under the other).
/// - more, but refinement makes the bounds softer under a force at a small compliance than it does at compliance 1: a
///   stiffness of the mesh is in the way. Observed, not proved. (Counterexample to "it grows": P1 for rubber with free
///   sides has motions of every bound that reach one triangle deep.)
/// - else: no locking for this reason. That is necessary for uniform convergence, not sufficient: the traces must come
///   near every one of K_0, too (Theorem 4).
/// B is the one of the limit: rows that depend on a thickness are asked for at thickness 0.
struct LockingDiagnosis {
  int coarse = 0, fine = 0;                ///< dimension of the trace on the bounds, on a mesh and on a finer one
  int coarse_bounds = 0, fine_bounds = 0;  ///< bounded unknowns of the stiff part
  bool bounded = true;  ///< false: nothing stiff is bounded, and all of the stiff part stands for the bounds
  /// The flexibility under a force on the bounds, on the finer mesh over the coarser one, over the same at compliance
  /// 1, less 1: of `compliance`, else of 1e-6.
  double refinement_softening = 0;
  double compliance =
      0;  ///< which compliances locking concerns: the first of 1e-1 to 1e-6 where the softening is above
          ///< a twentieth and above what refinement changes at compliance 1; 0: none

  Verdict verdict() const;
  bool locks() const { return verdict() != Verdict::not_detected; }
  std::string text() const;  ///< one line: both counts, and what they mean
};

/// `coarse` and `fine` are the same method on a mesh and on a finer one. Throws Error where a problem is malformed, has
/// nothing stiff (no row of B), or where `fine` has not more bounds there.
LockingDiagnosis diagnose_locking(const VariationalInequality& coarse, const VariationalInequality& fine);

}  // namespace antilock
