#pragma once
// The keys of a scene file: one table, from which files are read, keys are refused and the help is written.
#include <optional>
#include <string>
#include <vector>

namespace antilock {

/// A key of a scene file, or one of its sections.
struct SceneKey {
  enum class Type {
    section,     ///< [name]
    sections,    ///< [[name]], any number of times
    text,        ///< in quotes
    path,        ///< in quotes, relative to the scene file
    formula_xy,  ///< in quotes, in x and y (runner/expression.hpp)
    formula_x,   ///< the same, in x
    choice,      ///< one of `choices`, in quotes
    number,      ///< whole numbers are numbers, too
    count,       ///< a whole number
    flag,        ///< true
    places,      ///< a list of points, as [[0.25, -1.0]]
  };
  /// Numbers between two others, both of which are accepted unless `above` and `below` say that they are not.
  struct Range {
    double least = 0, most = 0;
    bool above = false;
    bool below = false;
    bool whole = false;  ///< whole numbers alone
    bool holds(double value) const;
  };

  std::string section;  ///< whose key it is; empty: the file itself, the keys of which are its title and its sections
  std::string name;
  Type type;
  std::string does;                        ///< one line
  std::optional<std::string> otherwise{};  ///< where the key is absent: without the quotes of TOML; empty: no value
  bool required = false;                   ///< always, where its section is
  std::vector<std::string> choices{};
  std::string accepted{};             ///< the end of a message that refuses a value: of a number without "a number, "
  std::optional<Range> range{};       ///< empty: the section's reader knows what is accepted
  std::vector<std::string> models{};  ///< of [model]: the kinds that have it, of "rubber" and "coating"; empty: all

  // A section's lines in the help are in the order of `line`. A key without a line is told by the comment of another one.
  int line = 0;           ///< 0: none
  std::string example{};  ///< its value there
  std::string comment{};  ///< behind the value, further lines below it
};

/// In the order in which messages name them.
const std::vector<SceneKey>& scene_keys();

/// A row of the table. Throws std::logic_error for a key that it does not have: reader and table differ then.
const SceneKey& scene_key(const std::string& section, const std::string& name);

/// The names of a section's keys; of [model], those of a kind ("rubber", "coating", or "" for the rest).
std::vector<std::string> key_names(const std::string& section, const std::string& model = {});

/// An example of a scene file that has every section, with the comments of its keys: the first part of `run_scene --help`.
std::string scene_keys_help();

}  // namespace antilock
