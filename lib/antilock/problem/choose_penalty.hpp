#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The penalty delta of the iterated penalty (solve/) from the matrices alone; dimensionless like compliance. Too large
/// costs corrections, too small costs digits of A1 in the factor; the answer is the same.
///
///     delta = max( r min(2 mean(M), r, 1) / 4096,  6e-8 r^(1/3) R^(2/3) )
///     r = sum (B' M B)_jj / sum (A1)_jj    over the free unknowns where both are positive
///     R = max (B' M B)_jj / max (A1)_jj    each is 1 where it lies between 1/8 and 8
///
/// - A correction contracts like delta / (delta + sigma), sigma the smallest a0(v, v) / a1(v, v) that is not zero. In
///   the layer and in rubber A1 and B hold first derivatives (r = 1): sigma falls like h^2 = 2 mean(M), two triangles
///   to a square. In a beam and in a glue B holds no derivative (r = h^2/4, h^2/3): sigma falls like h^4.
/// - Round-off in the factor spoils a correction like 1 / (h^2 delta^2): with r = R = 1 a smaller delta than 6e-8 takes
///   more corrections, not fewer. In the beam, where r is far below R, 6e-11 on 512 cells took 3 corrections but 19
///   contact steps, 6e-10 takes 6 and 13, 1e-8 took 20 and 9.
///
/// Corrections measured with contact, the most over compliance 1e-4, 1e-8 and 0: layer, 1/h = 8 to 128: P1 2, CR
/// 2, locked P1 6 (with 256 in place of 4096: 3, 4, 10); rubber, n = 8 to 32: crossed, CR, Kouhia-Stenberg 2 (locked P1
/// 3); beam, n = 2 to 128: 3, 256: 4, 512: 6 (locked, where all of u tends to 0: 6).
double choose_penalty(const VariationalInequality& problem);

/// The smallest penalty of which a factor of K keeps digits enough of A1 to contract at all: 1e-13 r^(1/3) R^(2/3).
double smallest_penalty(const VariationalInequality& problem);

/// What the factor is made with: max(compliance, penalty), `penalty` chosen by the rule above where none is given.
/// Throws Error for a penalty that is not positive.
double moderate_delta(const VariationalInequality& problem, std::optional<double> penalty = {});

}  // namespace antilock
