#pragma once
#include <fmt/format.h>
#include <string>

#include "antilock/core/stopwatch.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// The output of a tutorial while it runs: stages with their seconds, and verdicts on claims.
class Report {
 public:
  /// Begins a stage and prints its name. Its seconds are printed when the next stage begins. Throws
  /// Error where the output cannot be written.
  void stage(const std::string& what);
  /// Prints whether the numbers confirm a claim of the paper: a line `VERDICT holds: ...` or
  /// `VERDICT FAILS: ...`.
  void claim(bool holds, const std::string& what);
  /// Does the same with a format string, `claim(order > 1.8, "falls like h^{:.2f}", order)`.
  template <class First, class... More>
  void claim(bool holds, fmt::format_string<First, More...> what, First&& first, More&&... more) {
    claim(holds, fmt::format(what, std::forward<First>(first), std::forward<More>(more)...));
  }
  /// Prints the verdict on the claim that a number lies in an interval. The line ends with the
  /// number and the interval.
  void claim_within(double value, double low, double high, const std::string& what);
  /// Does the same for the orders of `y` in h between each row and the next. These are observed
  /// orders, not proved ones.
  void claim_orders(const Table& rows, const std::string& y, double low, double high,
                    const std::string& what);
  /// Does the same for the order of y in x, a least-squares slope. The line ends with the order,
  /// the orders from row to row, and the interval. With fewer than four rows it calls not_judged.
  void claim_order(const Table& rows, const std::string& y, const std::string& x, double low,
                   double high, const std::string& what);
  /// Prints `NOT JUDGED: ...` with the reason why this run cannot decide a claim, so that no claim
  /// is left out in silence.
  void not_judged(const std::string& why);
  /// Ends the last stage.
  void finish();
  bool all_hold() const { return all_hold_; }

 private:
  Stopwatch watch_;
  bool in_stage_ = false, all_hold_ = true;
};

}  // namespace antilock::tutorial
