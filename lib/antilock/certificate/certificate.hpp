#pragma once
#include "antilock/certificate/companion.hpp"
#include "antilock/certificate/equilibrated_flux.hpp"
#include "antilock/solve/penalised_cholesky.hpp"

namespace antilock {

/// What an accuracy is asked of: the companion v, or the midpoint of the two fluxes, (sigma + A grad v) / 2.
enum class Quantity { displacement, stress };

/// A proved bound of the error against the exact solution u of (23), (24), (22) or the body alone, known from one
/// Crouzeix-Raviart solution and one conforming function v of K. It holds for every epsilon in [0, 1], and was within
/// 1.5 of the error at those tried (chapter 19). Everything is dimensionless, in the energy norm |.|_a of Remark 4. It
/// holds up to round-off, for load, gap, traction, displacement and stiffness as sampled.
struct Certificate {
  double displacement = 0;  ///< >= |u - v|_a, v the companion
  double gradient = 0;      ///< >= |A grad u - S_h|, S_h the broken flux of Crouzeix-Raviart: the same number
  double stress = 0;        ///< >= |A grad u - (sigma + A grad v) / 2|

  double energy_lower = 0, energy_upper = 0;  ///< J(u) lies between: J = a(u, u) / 2 - L(u)
  double constitutive_error = 0;              ///< m = |A grad v - sigma|
  double contact_work = 0;                    ///< C >= 0, the contact forces on the gap that v leaves
  double oscillation = 0;                     ///< osc: what f varies beyond affine on the triangles
  double algebraic_residual_norm = 0;         ///< rho: what an early stop left of the residual
  double norm = 0;                            ///< |v|_a
  double midpoint_norm = 0;                   ///< |(sigma + A grad v) / 2|
  Eigen::VectorXd indicator;                  ///< T, all >= 0: where the error is, to refine by
  double layer_share = 0;                     ///< of the indicators' sum, in the layer

  double bound(Quantity of) const { return of == Quantity::displacement ? displacement : stress; }
  /// bound / |u|_a at most, proved: |u|_a >= |v|_a - bound. Infinite where the bound says nothing.
  double relative(Quantity of) const;
};

struct CertificateOptions {
  PenalisedCholesky* factor = nullptr;  ///< of the problem, where there is one: rho costs one half of a solve with it
  const ConformingCompanion* companion = nullptr;  ///< v; none: local_companion makes it
};

/// Derivation in certificate.cpp. u and p may come from anywhere: a solve stopped early, with another contact set, or
/// from Uzawa after a few steps; only what they leave of the balance of forces counts, and it is counted. Throws Error
/// where equilibrated_flux or local_companion do, for a companion that does not fit or is not in K, and where round-off
/// has eaten the mismatch.
Certificate certify(const Scene& scene, const Result& result, const CertificateOptions& options = {});

/// rho of the solution: >= |R(v)| / |v|_a for the forces r1 that it leaves unbalanced. Without a factor one is made.
double residual_norm(const VariationalInequality& problem, const EquilibratedFlux& flux,
                     PenalisedCholesky* factor = nullptr);

/// >= |u - w|_a (broken where w jumps), u the exact solution, w any other solution of the certified scene on the same
/// mesh, P2 or P1 say: |u - v|_a, proved by the certificate of v, plus |v - w|_a, computed exactly. Honest and blunt:
/// not below the certificate, however good w is. Throws Error for a companion v
/// with columns of its own (accepted: local_companion with on_mesh, p1_companion, an extruded mesh) and for sizes that
/// do not fit.
double certified_distance(const Certificate& certificate, const ConformingCompanion& v, const Result& w);

}  // namespace antilock
