#pragma once
// The keys of a scene file. One table defines them: the reader, its error messages and the help use
// it.
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
  /// The numbers between two others. Both ends are accepted unless `above` and `below` exclude
  /// them.
  struct Range {
    double least = 0, most = 0;
    bool above = false;
    bool below = false;
    bool whole = false;  ///< only whole numbers
    bool holds(double value) const;
  };

  /// The section of the key; empty for the title and for the sections themselves.
  std::string section;
  std::string name;
  Type type;
  std::string does;  ///< its description, one line
  /// The default, without the quotes of TOML; empty: there is none.
  std::optional<std::string> otherwise{};
  /// Whether each section of this name must contain the key.
  bool required = false;
  std::vector<std::string> choices{};
  /// The text after "accepted: " in a message; for a number without the words "a number, ".
  std::string accepted{};
  /// The accepted numbers; empty: the reader of the section checks the value.
  std::optional<Range> range{};
  /// For a key of [model]: the kinds that have it, "rubber" or "coating"; empty: all.
  std::vector<std::string> models{};

  // The help lists the keys of a section in the order of `line`. A key whose `line` is 0 has no
  // line of its own: the comment of another key describes it.
  int line = 0;           ///< 0: none
  std::string example{};  ///< the value of the key in this line
  std::string comment{};  ///< the comment behind the value; further lines stand below it
};

/// Returns all keys, in the order in which messages name them.
const std::vector<SceneKey>& scene_keys();

/// Returns a row of the table. Throws std::logic_error for a key that the table does not have,
/// because the reader and the table then differ.
const SceneKey& scene_key(const std::string& section, const std::string& name);

/// Returns the names of the keys of a section; for [model] those of a kind ("rubber", "coating", or
/// "" for the rest).
std::vector<std::string> key_names(const std::string& section, const std::string& model = {});

/// Returns an example of a scene file that has every section, with the comments of its keys. It is
/// the first part of `run_scene --help`.
std::string scene_keys_help();

}  // namespace antilock
