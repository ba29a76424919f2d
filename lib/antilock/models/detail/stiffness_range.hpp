#pragma once
#include <limits>

#include "antilock/form/factored_form.hpp"
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The stiffnesses of a problem, and the part of them that one A1 may hold.
///
/// Entries of A1 are rounded to eps. In a part of stiffness k this leaves a spring of about eps k
/// to the ground at each unknown. Where a stiffness k0 alone holds the part, n unknowns move by n
/// eps k / k0 of themselves: at k / k0 = 1e3 and n = 1e6 by 2e-7. So A1 sums the forms up to 1e3
/// times the softest one. The others are rows of B with fixed compliances. There the energy of a
/// motion without strain is the square of a rounding error, and the unknowns move by n eps^2 k /
/// k0: 5e-10 at k / k0 = 1e16.
class StiffnessRange {
 public:
  /// `unit` is the stiffness by which the entries of M of the problem's rows of B are multiplied.
  explicit StiffnessRange(double unit) : unit_(unit) {}

  /// Notes a stiffness of the problem; 0 is none.
  void note(double stiffness);
  /// Throws Error if the noted stiffnesses differ by a factor of more than 1e16. Its message begins
  /// with `what`.
  void check(const char* what) const;

  /// Returns whether a form of this stiffness may be assembled into A1: it is at most 1e3 times the
  /// softest one.
  bool fits_in_a1(double stiffness) const { return stiffness <= 1e3 * softest_; }
  double softest() const { return softest_; }
  /// Appends the form to B. Its entries of M are multiplied by the unit, and its compliances are
  /// unit / stiffness.
  void append(VariationalInequality& problem, const WeightedFactoredForm& rows) const;

 private:
  double unit_, softest_ = std::numeric_limits<double>::infinity(), stiffest_ = 0;
};

}  // namespace antilock
