#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The stiffness of B' M B relative to A1, from their diagonals at the free unknowns. Of a problem on subdomains: the
/// sums over them, and the largest of them.
struct StiffnessRatio {
  double trace_a0 = 0, trace_a1 = 0;  ///< of the diagonals of B' M B and of A1, where both are positive
  double max_a0 = 0, max_a1 = 0;      ///< the largest entry of each

  /// s = r^(1/3) R^(2/3), r the ratio of the sums and R that of the largest; 1 where they cannot be compared. In the layer
  /// and in rubber A1 and B hold first derivatives, and s is about 1. In a beam and in a glue B holds none. (The exponents
  /// are a fit: they serve all models of the library.)
  double value() const;
};
StiffnessRatio stiffness_ratio(const VariationalInequality& problem);

/// The penalty delta of the iterated penalty (solve/) from the matrices alone: A1 times t asks for delta / t, M times t for
/// t delta. Too large costs corrections, too small costs digits of A1 in the factor; the answer is the same.
///
///     delta = 6e-8 s
///
/// A correction contracts like delta / (delta + sigma), sigma the smallest eigenvalue of a0 against a1 that is not
/// zero; it falls with the mesh, like h^2 in the layer, like h^4 in a beam. Round-off in the factor spoils a correction
/// by about 0.005 eps / (h^2 delta). With s = 1 and 1/h = 64 there are 2 corrections from 6e-8 down to 1e-9, 3 at 1e-10
/// and 5 at 1e-12: 6e-8 leaves room for finer meshes. In the beam, where r is far below R, 6e-11 on 512 cells took 3
/// corrections but 19 contact steps, 6e-10 takes 6 and 13, 1e-8 took 20 and 9.
///
/// Corrections measured with contact, the most over compliance 1 to 1e-12 and 0: layer, 1/h = 8 to 128: P1 2, CR 2, locked
/// P1 4 (with 1e-6 in place of 6e-8: 4, 4, 20); beam, 512 cells: 6, 1024: 12 (locked, where all of u tends to 0).
constexpr double default_penalty = 6e-8;
inline double choose_penalty(const StiffnessRatio& s) { return default_penalty * s.value(); }
inline double choose_penalty(const VariationalInequality& problem) { return choose_penalty(stiffness_ratio(problem)); }

/// The penalty parameter delta of the factor: max(compliance, penalty), `penalty` chosen by the rule above where none
/// is given; the compliance counts where B has a row of the class, or none at all. Throws Error for a penalty that is not
/// positive.
double penalty_parameter(const VariationalInequality& problem, std::optional<double> penalty = {});

}  // namespace antilock
