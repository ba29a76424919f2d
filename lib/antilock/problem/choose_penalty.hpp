#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The stiffness of a0 relative to a1: sums and maxima of the diagonals of B' M B and of A1 over
/// the free unknowns. For a problem on subdomains the sums are added and the maxima compared.
struct StiffnessRatio {
  /// Sums of the diagonal entries of B' M B and of A1 over the unknowns at which both are positive.
  double trace_a0 = 0, trace_a1 = 0;
  double max_a0 = 0, max_a1 = 0;  ///< the largest diagonal entries

  /// Returns s = (trace_a0 / trace_a1)^(1/3) (max_a0 / max_a1)^(2/3), or 1 where this is not a
  /// positive number. Where A1 and B both hold first derivatives (the layer, rubber), s is about 1.
  /// In a beam and in an adhesive layer, rows of B hold unknowns without a derivative, and s
  /// depends on the mesh. This is a heuristic scaling of the augmented Lagrangian: the exponents
  /// are fitted to the models of this library, and choose_penalty.cpp has the measurements.
  double value() const;
};
StiffnessRatio stiffness_ratio(const VariationalInequality& problem);

/// The default of delta, the penalty of the iterated penalty method (solve/active_set.hpp), is
///
///     delta = 6e-8 s,   s = StiffnessRatio::value(),
///
/// and 1 / delta is the penalty stiffness. So a larger delta is a softer penalty. Scaling A1 by t >
/// 0 scales delta by 1 / t, and scaling M by t scales it by t. The solution does not depend on
/// delta: a larger one needs more outer iterations, a smaller one leaves the factor of A1 +
/// delta^-1 B' M B fewer digits of A1. choose_penalty.cpp has the measurements behind 6e-8.
constexpr double default_penalty = 6e-8;
inline double choose_penalty(const StiffnessRatio& s) { return default_penalty * s.value(); }
inline double choose_penalty(const VariationalInequality& problem) {
  return choose_penalty(stiffness_ratio(problem));
}

/// Returns the delta of a factor, max(compliance, penalty). If `penalty` is empty, the penalty is
/// choose_penalty(problem). If all rows of B have fixed compliances, the compliance is left out of
/// this maximum, because it belongs to no row. Throws Error for a penalty that is not a positive
/// finite number.
double penalty_parameter(const VariationalInequality& problem, std::optional<double> penalty = {});

}  // namespace antilock
