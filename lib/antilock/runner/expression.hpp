#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace antilock {

/// A formula from a file, such as `10*sin(2*pi*x)`, parsed once: numbers, the named variables, pi,
/// + - * / ^, comparisons, && ||, `condition ? a : b`, and the functions sin cos tan asin acos atan atan2 sinh cosh
/// tanh exp ln log log2 log10 sqrt abs sign rint min max. Values are dimensionless; angles in radians.
/// 2^3^2 is 2^(3^2), and -x^2 is -(x^2). A chain 0.2 < x <= 0.5 holds where both of its comparisons do; ascending,
/// descending and == chains are read, every other one is refused. A comparison is 1 or 0 in a sum; the condition of
/// ? : and both sides of && and || hold a comparison. log is the natural logarithm, rint(a) is floor(a + 0.5). Calls
/// from several threads do not meet.
class Expression {
 public:
  /// Throws Error, with what is wrong and what is accepted, for a text that is empty, longer than 4,000 characters,
  /// that does not parse, or that names anything unknown.
  Expression(std::string text, std::vector<std::string> variables);

  /// The value at one number per variable. Throws Error, with the place, where it is not finite or beyond 1e100.
  double operator()(std::span<const double> variables) const;
  double operator()(double x) const { return (*this)(std::span(&x, 1)); }
  double operator()(double x, double y) const;

 private:
  std::string text_;
  std::vector<std::string> names_;
  std::function<double(const double* variables)> value_;
};

}  // namespace antilock
