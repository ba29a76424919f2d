#pragma once
#include <optional>
#include <utility>

#include "antilock/certificate/certificate.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// Intervals in which the contact force and the moment of the exact solution lie. Signs and units
/// are those of ContactForce (measure/contact_zone.hpp).
struct ContactForceBounds {
  std::pair<double, double> normal, moment;
};

/// Computes these intervals from a Crouzeix-Raviart solution and its certificate. Let phi be a
/// continuous function that is 1 on Gamma_C, the contact boundary, and 0 where u is prescribed.
/// Then the contact force F is the work of the contact pressure on phi, F = a(u, phi) - L(phi). The
/// flux S_h of the solution in place of A grad u gives F_h = (S_h, grad phi) - L(phi), and
///
///     |F - F_h| = |(A grad u - S_h, grad phi)| <= |A grad u - S_h| |phi|_a.
///
/// `certificate.gradient` bounds the first factor. phi is the P1 function on the mesh for which the
/// second one is smallest, which takes one solve of a linear problem. The moment has x in place of
/// 1 on Gamma_C. As the certificate, the intervals are guaranteed up to round-off and up to the
/// sampling of the data.
///
/// The result is empty where this proves nothing: without contact, for another element, for
/// Ventcel's layer, on a mesh without a vertex off Gamma_C where u is free, and where u is
/// prescribed at an end of Gamma_C, because then no function phi has a finite energy. Throws Error
/// as equilibrated_flux and active_set do.
std::optional<ContactForceBounds> contact_force_bounds(const Scene& scene, const Result& result,
                                                       const Certificate& certificate);

}  // namespace antilock
