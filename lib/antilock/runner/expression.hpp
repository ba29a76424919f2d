#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace antilock {

/// Returns a list of names for a sentence: "x", "x and y" or "x, y and z".
std::string in_words(const std::vector<std::string>& names);

/// A formula from a file, such as `10*sin(2*pi*x)`, parsed once. It may contain numbers, the named
/// variables, pi, + - * / ^, comparisons, && ||, `condition ? a : b`, and the functions sin cos tan
/// asin acos atan atan2 sinh cosh tanh exp ln log log2 log10 sqrt abs sign rint min max. Values are
/// dimensionless; angles are in radians.
///
/// 2^3^2 is 2^(3^2), and -x^2 is -(x^2). A chain 0.2 < x <= 0.5 holds where both of its comparisons
/// hold. Ascending, descending and == chains are read, and every other chain is refused. A
/// comparison is 1 or 0 in a sum. The condition of ? : and both sides of && and || must contain a
/// comparison. log is the natural logarithm, and rint(a) is floor(a + 0.5). Several threads may
/// evaluate the same formula at the same time.
class Expression {
 public:
  /// Throws Error, which says what is wrong and what is accepted, for a text that is empty, is
  /// longer than 4,000 characters, does not parse, or contains an unknown name.
  Expression(std::string text, std::vector<std::string> variables);

  /// Returns the value of the formula. `variables` has one number per variable. Throws Error, with
  /// the place, where the value is not finite or beyond 1e100.
  double operator()(std::span<const double> variables) const;
  double operator()(double x) const { return (*this)(std::span(&x, 1)); }
  double operator()(double x, double y) const;
  double operator()(double x, double y, double z) const;

 private:
  std::string text_;
  std::vector<std::string> names_;
  std::function<double(const double* variables)> value_;
};

}  // namespace antilock
