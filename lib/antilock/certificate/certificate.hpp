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
/// of K, the admissible set of the exact problem. A is the stiffness (FluxLaw), so that A grad u is
/// the flux of u. J(u) = a(u, u) / 2 - L(u) is the energy, and |.|_a the energy norm of Remark 4.
/// Everything is dimensionless. The bound holds for every epsilon in [0, 1], up to round-off, and
/// up to the sampling of the data: load and traction are integrated by quadrature rules, and gap,
/// displacement and stiffness are checked at sample points. At the epsilons that were tried it was
/// at most 1.5 times the error (chapter 19).
struct Certificate {
  double displacement = 0;  ///< >= |u - v|_a
  double gradient = 0;      ///< >= |A grad u - S_h|, S_h the flux of the Crouzeix-Raviart solution
  double stress = 0;        ///< >= |A grad u - (sigma + A grad v) / 2|

  double energy_lower = 0, energy_upper = 0;  ///< J(u) lies between them
  double constitutive_error = 0;              ///< m = |A grad v - sigma|
  /// C >= 0, the work of the contact forces on the gap of v.
  double contact_work = 0;
  /// osc, from the part of load and traction that is not affine.
  double oscillation = 0;
  double algebraic_residual_norm = 0;  ///< rho, the norm of the residual after an early stop
  double norm = 0;                     ///< |v|_a
  double midpoint_norm = 0;            ///< |(sigma + A grad v) / 2|
  Eigen::VectorXd indicator;           ///< T, >= 0: an indicator per triangle for refinement
  /// The fraction of the sum of the indicators in the layer.
  double layer_share = 0;

  /// Returns the bound of a quantity.
  double bound(Quantity of) const { return of == Quantity::displacement ? displacement : stress; }
  /// Returns an upper bound of the relative error. It is the bound divided by a lower bound of
  /// |u|_a, the larger one of |v|_a - displacement and midpoint_norm - stress. It is infinite if
  /// this lower bound is not positive.
  double relative(Quantity of) const;
};

struct CertificateOptions {
  /// A factor of the problem; if null, certify makes one.
  PenalisedCholesky* factor = nullptr;
  const ConformingCompanion* companion = nullptr;  ///< v; if null, local_companion
};

/// Computes the certificate; certificate.cpp has the derivation. u and p of the result may be any
/// vectors of their sizes, for example of a solve that was stopped early, because the bound
/// contains their residual. Throws Error where equilibrated_flux or local_companion do, for a
/// companion that does not fit or is not in K, and where the constitutive error is below round-off.
Certificate certify(const Scene& scene, const Result& result,
                    const CertificateOptions& options = {});

/// Returns rho = (r1' A_delta^-1 r1)^(1/2), the norm of the unbalanced forces r1 of the flux
/// (EquilibratedFlux::imbalance). It bounds their work, |R(v)| <= rho |v|_a. A_delta = A1 +
/// delta^-1 B' M B is the matrix of `factor`; without one a factor is made. Throws Error for a
/// factor of another problem, or with a delta below the compliance.
double residual_norm(const VariationalInequality& problem, const EquilibratedFlux& flux,
                     PenalisedCholesky* factor = nullptr);

/// Returns an upper bound of |u - w|_a (broken where w jumps) for another solution w of the
/// certified scene on the same mesh, for example of P2 or P1: |u - v|_a, which the certificate
/// bounds, plus |v - w|_a, which is computed exactly. It is guaranteed, but never below the bound
/// of v, however accurate w is. Throws Error for a companion
/// v with columns of its own (accepted: local_companion with on_mesh, p1_companion, an extruded
/// mesh) and for sizes that do not fit.
double certified_distance(const Certificate& certificate, const ConformingCompanion& v,
                          const Result& w);

}  // namespace antilock
