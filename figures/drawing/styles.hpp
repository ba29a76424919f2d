#pragma once
#include <string>
#include <vector>

#include "drawing/colours.hpp"
#include "drawing/shapes.hpp"

namespace antilock::figures {

/// How a curve is drawn: one colour, marker and width per meaning, in every chart.
struct Look {
  Colour colour;
  Marker marker;
  double width;  ///< pixels; wider curves lie below narrower ones
  double marker_size() const { return 8 + 4 * width; }
};

/// What a chart shows by a curve or a panel: a method, an epsilon, a solver, a norm, ...
struct Meaning {
  std::string name;        ///< markup, for titles and legends
  std::string short_name;  ///< where the name does not fit
  std::vector<int> rank;   ///< its place among panels and in legends, compared lexicographically
  Look look{};
  bool known = true;  ///< false: the table of styles.cpp does not have it
};

/// The meaning of an entry of a table's column, such as ("epsilon", "1e-06"), or of entries of
/// several columns together, such as element and mesh. Entries that the table of styles.cpp does
/// not have are their own names.
Meaning meaning_of(const std::vector<std::string>& columns, const std::vector<std::string>& entries);

/// The same for a key of that table, such as "P1 structured"; words behind a colon are added to its
/// name.
Meaning meaning_of(const std::string& key);

/// One line on standard error about a meaning that the table does not have: a key that is misspelt looks like a name.
void tell_unknown(const Meaning& meaning);

/// Every key of that table, in its order.
std::vector<std::string> known_keys();

/// Looks for meanings that the table does not have, the n-th of a chart (six, then again from the
/// first).
Look other_look(std::size_t n);

}  // namespace antilock::figures
