#pragma once
#include "antilock/certificate/companion.hpp"
#include "antilock/certificate/equilibrated_flux.hpp"
#include "antilock/exact/exact_table.hpp"

namespace antilock {

/// The errors that a certificate bounds, by a rule of degree 8 against the exact solution of the scaled layer. Fluxes
/// count by A^-1; everything is dimensionless.
struct ExactErrors {
  double gradient = 0;      ///< |A grad u - S_h|
  double flux = 0;          ///< |A grad u - sigma|
  double displacement = 0;  ///< |u - v|_a
  double stress = 0;        ///< |A grad u - (sigma + A grad v) / 2|; 0 where v has columns of its own
};

ExactErrors exact_errors(const TriangleMesh& mesh, const EquilibratedFlux& flux, const ConformingCompanion& v,
                         const ExactTable& exact);

}  // namespace antilock
