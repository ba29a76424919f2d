#pragma once
#include <string>
#include <vector>

#include "drawing/colours.hpp"
#include "drawing/shapes.hpp"

namespace antilock::figures {

/// The style of a curve: one colour, marker and width per meaning, in every chart.
struct Look {
  Colour colour;
  Marker marker;
  double width;  ///< pixels; wider curves lie below narrower ones
  double marker_size() const { return 8 + 4 * width; }
};

/// The subject of a curve or a panel: a method, an epsilon, a solver, a norm, ...
struct Meaning {
  std::string name;        ///< markup, for titles and legends
  std::string short_name;  ///< used where the name does not fit
  std::vector<int> rank;   ///< its place among panels and in legends, compared lexicographically
  Look look{};
  bool known = true;  ///< whether the table of styles.cpp has it
};

/// Returns the meaning of an entry of a column of a table, such as ("epsilon", "1e-06"), or of
/// entries of several columns together, such as element and mesh. An entry that the table of
/// styles.cpp does not have is its own name.
Meaning meaning_of(const std::vector<std::string>& columns,
                   const std::vector<std::string>& entries);

/// Returns the meaning of a key of that table, such as "P1 structured". Words behind a colon are
/// added to its name.
Meaning meaning_of(const std::string& key);

/// Prints one line on standard error about a meaning that the table does not have, because a
/// misspelt key looks like a name.
void tell_unknown(const Meaning& meaning);

/// Returns every key of that table, in its order.
std::vector<std::string> known_keys();

/// Returns the style of the n-th meaning of a chart that the table does not have. There are six
/// such styles, which are used cyclically.
Look other_look(std::size_t n);

}  // namespace antilock::figures
