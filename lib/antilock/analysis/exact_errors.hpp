#pragma once
#include "antilock/analysis/certificate.hpp"
#include "antilock/exact/truth_table.hpp"

namespace antilock {

/// The errors that a certificate bounds, of a problem whose exact solution is known: in the norms of the scaled layer,
/// dimensionless, by a rule of degree 8.
struct ExactErrors {
  double gradient = 0;      ///< |A grad u - S_h|
  double displacement = 0;  ///< |u - v|_a
  double stress = 0;        ///< |A grad u - (sigma + A grad v) / 2|; 0 where v has columns of its own
};
ExactErrors exact_errors(const TriangleMesh& mesh, const EquilibratedFlux& flux, const Companion& v,
                         const TruthTable& truth);

}  // namespace antilock
