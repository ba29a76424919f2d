#pragma once
#include <functional>
#include <string>
#include <vector>

#include "drawing/styles.hpp"
#include "pictures/table.hpp"

namespace antilock::figures {

/// Returns whether a row satisfies every filter `column=value`. Throws Error for a filter of
/// another form.
bool selected(const CsvTable& table, std::size_t row, const std::vector<std::string>& filters);

/// Returns the common meaning of the entries of a row in these columns.
Meaning row_meaning(const CsvTable& table, std::size_t row,
                    const std::vector<std::string>& columns);

/// The distinct meanings of the rows of a table, for example those that make panels, ordered by
/// their ranks.
class Meanings {
 public:
  /// Adds a meaning unless there is one of that name.
  void add(Meaning meaning);
  /// Returns the long names if they satisfy `fit`, and otherwise the short ones.
  std::vector<std::string> names(
      const std::function<bool(const std::vector<std::string>&)>& fit) const;

  std::size_t size() const { return meanings_.size(); }
  const Meaning& operator[](std::size_t n) const { return meanings_[n]; }

 private:
  std::vector<Meaning> meanings_;
  std::size_t others_ = 0;  // meanings that the table of styles does not have
};

}  // namespace antilock::figures
