#include "programs/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string>
#include <vector>

#include "antilock/core/standard_output.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

void Report::stage(const std::string& what) {
  finish();
  fmt::print("  {:<60}", what + " ...");
  require_output();  // better now than after minutes of work
  watch_.lap();
  in_stage_ = true;
}

void Report::finish() {
  if (in_stage_) fmt::print(" {:8.3f} s\n", watch_.lap());
  in_stage_ = false;
  std::fflush(stdout);
}

void Report::claim(bool holds, const std::string& what) {
  finish();
  fmt::print("VERDICT {}: {}\n", holds ? "holds" : "FAILS", what);
  all_hold_ = all_hold_ && holds;
}

void Report::claim_orders(const Table& rows, const std::string& y, double low, double high,
                          const std::string& what) {
  const std::vector<double> orders = rows.pairwise_orders(y, "h");
  const bool hold =
      std::all_of(orders.begin(), orders.end(), [&](double o) { return o >= low && o <= high; });
  claim(hold && !orders.empty(), "{}: orders in h {:.2f} (accepted {:g} to {:g}; observed)", what,
        fmt::join(orders, ", "), low, high);
}

void Report::not_judged(const std::string& why) {
  finish();
  fmt::print("NOT JUDGED: {}\n", why);
}

void Report::claim_within(double value, double low, double high, const std::string& what) {
  claim(value >= low && value <= high, "{} {:.4g} (accepted {:.4g} to {:.4g})", what, value, low,
        high);
}

void Report::claim_order(const Table& rows, const std::string& y, const std::string& x, double low,
                         double high, const std::string& what) {
  if (rows.size() < 4)
    return not_judged(fmt::format("{}: an order needs four rows, here are {}", what, rows.size()));
  const double order = rows.order(y, x);
  claim(order >= low && order <= high,
        "{}: order {:.2f} ({:.2f} from row to row; accepted {:.2f} to {:.2f})", what, order,
        fmt::join(rows.pairwise_orders(y, x), ", "), low, high);
}

}  // namespace antilock::tutorial
