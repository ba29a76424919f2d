#pragma once
#include "antilock/certificate/companion.hpp"
#include "antilock/certificate/equilibrated_flux.hpp"
#include "antilock/solve/penalised_cholesky.hpp"

namespace antilock {

/// The quantity whose accuracy counts: the conforming companion v, or the midpoint of the two
/// fluxes, (sigma + A grad v) / 2.
enum class Quantity { displacement, stress };

/// A guaranteed bound of the error against the exact solution u of (22), (23) or (24) of [SR04]
/// (cited in problem/variational_inequality.hpp), or of the body alone. It is computed from a
/// Crouzeix-Raviart solution, the equilibrated flux sigma made of it, and one conforming function v
/// of K. A is the stiffness of the fluxes A grad u, J(u) = a(u, u) / 2 - L(u), and |.|_a is the
/// energy norm of Remark 4, in which everything is dimensionless. It holds for every epsilon in [0,
/// 1], up to round-off, for load, gap, traction, displacement and stiffness as sampled. At the
/// epsilons tried it was within 1.5 of the error (chapter 19).
struct Certificate {
  double displacement = 0;  ///< >= |u - v|_a
  double gradient = 0;      ///< >= |A grad u - S_h|, S_h that of Crouzeix-Raviart
  double stress = 0;        ///< >= |A grad u - (sigma + A grad v) / 2|

  double energy_lower = 0, energy_upper = 0;  ///< J(u) lies between them
  double constitutive_error = 0;              ///< m = |A grad v - sigma|
  double contact_work = 0;                    ///< C >= 0, of the contact forces on the gap of v
  double oscillation = 0;                     ///< osc, of the load less its affine parts
  double algebraic_residual_norm = 0;         ///< rho, of the residual that an early stop leaves
  double norm = 0;                            ///< |v|_a
  double midpoint_norm = 0;                   ///< |(sigma + A grad v) / 2|
  Eigen::VectorXd indicator;                  ///< T, >= 0: an indicator per triangle for refinement
  double layer_share = 0;                     ///< the layer's part of the sum of the indicators

  /// Returns the bound of a quantity.
  double bound(Quantity of) const { return of == Quantity::displacement ? displacement : stress; }
  /// Returns an upper bound of the relative error, bound over a lower bound of |u|_a: the larger
  /// one of |v|_a - displacement and midpoint_norm - stress. Infinite where that is not positive.
  double relative(Quantity of) const;
};

struct CertificateOptions {
  PenalisedCholesky* factor = nullptr;             ///< of the problem; none: certify makes one
  const ConformingCompanion* companion = nullptr;  ///< v; none: local_companion
};

/// Computes the certificate; certificate.cpp has the derivation. u and p of the result may be any
/// vectors of their sizes, for example of a solve that was stopped early, because the residual that
/// they leave is part of the bound. Throws Error where equilibrated_flux or local_companion do, for
/// a companion that does not fit or is not in K, and where the constitutive error is below
/// round-off.
Certificate certify(const Scene& scene, const Result& result, const CertificateOptions& options = {});

/// Returns rho = (r1' A_delta^-1 r1)^(1/2), the norm of the unbalanced forces r1 of the flux
/// (EquilibratedFlux::imbalance). It bounds their work, |R(v)| <= rho |v|_a. A_delta is the matrix
/// of `factor`; without one a factor is made. Throws Error for a factor of another problem, or with
/// a delta below the compliance.
double residual_norm(const VariationalInequality& problem, const EquilibratedFlux& flux,
                     PenalisedCholesky* factor = nullptr);

/// Returns an upper bound of |u - w|_a (broken where w jumps) for another solution w of the
/// certified scene on the same mesh, for example of P2 or P1: |u - v|_a, which the certificate
/// bounds, plus |v - w|_a, which is computed exactly. It is guaranteed, but never below the bound
/// of v, however accurate w is. Throws Error for a companion
/// v with columns of its own (accepted: local_companion with on_mesh, p1_companion, an extruded
/// mesh) and for sizes that do not fit.
double certified_distance(const Certificate& certificate, const ConformingCompanion& v, const Result& w);

}  // namespace antilock
