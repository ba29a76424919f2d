#pragma once
#include "antilock/analysis/certificate.hpp"

namespace antilock {

/// >= |u - w|_a (broken where w jumps), u the exact solution, w any other solution of the certified scene on the same
/// mesh, P2 or P1 say: |u - v|_a, proved by the certificate of v, plus |v - w|_a, computed exactly. Honest and blunt: it
/// is not below the certificate, however good w is. `space` and `problem` are those of w. Throws Error for a companion v
/// with columns of its own (accepted: strip_companion with on_mesh, p1_companion, an extruded mesh) and for sizes that
/// do not fit.
double certified_distance(const Certificate& certificate, const Companion& v, const Space& space,
                          const VariationalInequality& problem, const Solution& w);

}  // namespace antilock
