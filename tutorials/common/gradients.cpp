#include "common/gradients.hpp"

#include <cmath>

namespace antilock::tutorial {

Table gradient_ratios(const Table& one, const Table& other) {
  const auto seminorm = [](const Table& row) {
    return std::sqrt(std::pow(row.number("h1"), 2) - std::pow(row.number("l2"), 2));
  };
  Table ratios({"cells", "epsilon", "ratio"});
  for (const Table& row : one.rows()) {
    const Table there = other.where("cells", row.entry("cells")).where("epsilon", row.entry("epsilon"));
    ratios.add({row.entry("cells"), row.entry("epsilon"), seminorm(there) / seminorm(row)});
  }
  return ratios;
}

}  // namespace antilock::tutorial
