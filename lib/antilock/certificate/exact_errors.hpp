#pragma once
#include "antilock/certificate/companion.hpp"
#include "antilock/certificate/equilibrated_flux.hpp"
#include "antilock/exact/exact_table.hpp"

namespace antilock {

/// The errors that a certificate bounds (certificate.hpp), computed against the exact solution u of
/// the scaled layer by a quadrature rule of degree 8. The norm of fluxes is that of A^-1.
/// Everything is dimensionless. The names S_h, sigma and v are those of certificate.hpp.
struct ExactErrors {
  double gradient = 0;      ///< |A grad u - S_h|
  double flux = 0;          ///< |A grad u - sigma|
  double displacement = 0;  ///< |u - v|_a
  /// |A grad u - (sigma + A grad v) / 2|; 0 where v has columns of its own.
  double stress = 0;
};

ExactErrors exact_errors(const TriangleMesh& mesh, const EquilibratedFlux& flux,
                         const ConformingCompanion& v, const ExactTable& exact);

}  // namespace antilock
