#pragma once
#include <fmt/format.h>
#include <string>

#include "antilock/core/stopwatch.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// What a tutorial says while it runs: stages with their seconds, and the verdict at its end.
class Report {
 public:
  /// Prints what is being done now; the seconds of the stage before are printed when the next begins. Throws Error
  /// where what is printed does not arrive.
  void stage(const std::string& what);
  /// A claim of the paper and whether the numbers bear it out: a line `VERDICT holds: ...` or `VERDICT FAILS: ...`.
  void claim(bool holds, const std::string& what);
  /// The same with a format string, `claim(order > 1.8, "falls like h^{:.2f}", order)`.
  template <class First, class... More>
  void claim(bool holds, fmt::format_string<First, More...> what, First&& first, More&&... more) {
    claim(holds, fmt::format(what, std::forward<First>(first), std::forward<More>(more)...));
  }
  /// A claim that a number lies in an interval; its line ends with the number and the interval.
  void claim_within(double value, double low, double high, const std::string& what);
  /// The same of the orders of `y` in h between each row and the next; they are observed.
  void claim_orders(const Table& rows, const std::string& y, double low, double high, const std::string& what);
  /// The same of the order of y in x, a least-squares slope; its line ends with the order, those from row to row, and
  /// the interval. Not judged from fewer than four rows.
  void claim_order(const Table& rows, const std::string& y, const std::string& x, double low, double high,
                   const std::string& what);
  /// A claim that this run cannot decide, and why: a line `NOT JUDGED: ...`. Nothing is left out in silence.
  void not_judged(const std::string& why);
  /// Ends the last stage.
  void finish();
  bool all_hold() const { return all_hold_; }

 private:
  Stopwatch watch_;
  bool in_stage_ = false, all_hold_ = true;
};

}  // namespace antilock::tutorial
