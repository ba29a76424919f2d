// The table of keys: files are read by it, and the help and the how-to say what it says.
#include "antilock/runner/scene_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <string>
#include <vector>

#include "antilock/runner/scene_file.hpp"
#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::scene_keys_test {

using Type = SceneKey::Type;

bool is_section(const SceneKey& key) {
  return key.type == Type::section || key.type == Type::sections;
}

/// What must stand before a key of a section, so that nothing else is refused first.
std::string lines_before(const SceneKey& key) {
  const std::string place = key.section + "." + key.name;
  if (place == "layer.load") return "epsilon = 0.1\n";
  if (place == "layer.stiffness") return "thickness = 0.1\n";
  if (place == "method.of" || place == "method.most_unknowns") return "accuracy = 0.1\n";
  if (place == "contact.master") return "slave = \"a\"\n";
  if (place == "contact.method") return "slave = \"a\"\nmaster = \"b\"\n";
  if (place == "mesh.cells") return "kind = \"structured\"\n";
  if (place == "mesh.dimension") return "kind = \"structured\"\ncells = 8\n";
  if (place == "mesh.refinements") return "kind = \"structured\"\ncells = 8\n";
  if (place == "mesh.file") return "kind = \"file\"\n";
  if (place == "mesh.geometry") return "kind = \"file\"\nfile = \"my.msh\"\n";
  if (key.section == "edge" && key.name != "group") return "group = \"top\"\n";
  if (key.section == "model" && key.name != "kind") return "kind = \"plane strain\"\n";
  return "";
}

/// A scene with `key = value`.
std::string scene_with(const SceneKey& key, const std::string& value) {
  std::map<std::string, std::string> sections{{"load", "f = \"1\"\n"},
                                              {"mesh", "kind = \"structured\"\ncells = 8\n"}};
  if (key.models == std::vector<std::string>{"coating"}) sections["layer"] = "epsilon = 0.1\n";
  const std::string line = key.name + " = " + value + "\n";
  std::string scene;
  if (key.section.empty()) {
    scene = line;
    sections.erase(key.name);
  } else {
    sections[key.section] = lines_before(key) + line;
  }
  for (const auto& [section, lines] : sections)
    scene += (section == "edge" ? "[[edge]]\n" : "[" + section + "]\n") + lines;
  return scene;
}

/// A value that no row accepts: a table, and a number where a table may stand.
std::string wrong_value(const SceneKey& key) {
  const bool takes_a_table = is_section(key) || (key.section == "body" && key.name == "stiffness");
  return takes_a_table ? "1" : "{}";
}

/// The end of the message that refuses such a value; empty where the reader has words of its own.
std::string end_of_refusal(const SceneKey& key) {
  if (is_section(key) || key.type == Type::count || key.name == "thickness") return "";
  if (key.type == Type::choice)
    return fmt::format("; accepted: \"{}\"", fmt::join(key.choices, "\", \""));
  return (key.type == Type::number ? "; accepted: a number, " : "; accepted: ") + key.accepted;
}

// A key that the table has and that nothing reads would be taken with any value.
TEST(SceneKeys, EachIsReadAndRefusedAsItsRowSays) {
  for (const SceneKey& key : scene_keys()) {
    const std::string where =
        key.section + (key.section == "edge" ? "[0]" : "") + (key.section.empty() ? "" : ".");
    const std::string message =
        refusal([&] { read_scene(scene_with(key, wrong_value(key)), "scene.toml"); });
    EXPECT_TRUE(message.starts_with("scene.toml: " + where + key.name + ": "))
        << key.name << ": " << message;
    EXPECT_TRUE(message.ends_with(end_of_refusal(key))) << message;
  }
}

TEST(SceneKeys, ARangeIsThatOfItsRow) {
  for (const SceneKey& key : scene_keys()) {
    if (!key.range) continue;
    const auto read = [&](double value) {
      const bool whole = key.type == Type::count;
      return refusal([&] {
        read_scene(
            scene_with(key, whole ? fmt::format("{:.0f}", value) : fmt::format("{:.17g}", value)),
            "scene.toml");
      });
    };
    const auto& [least, most, above, below, whole] = *key.range;
    const std::string words = "is out of range; accepted: ";
    for (const double value : {least - 1, most * 1.1 + 1})
      EXPECT_NE(read(value).find(words), std::string::npos)
          << key.name << " = " << value << ": " << read(value);
    EXPECT_EQ(read(least).find(words) != std::string::npos, above)
        << key.name << ": " << read(least);
    EXPECT_EQ(key.range->holds(most), !below) << key.name;
    EXPECT_EQ(key.range->holds(least + 0.5), !whole && least + 0.5 <= most) << key.name;
  }
}

// The structures have a default of their own for what a scene file leaves out.
TEST(SceneKeys, TheDefaultsAreThoseOfTheStructures) {
  const auto of = [](const std::string& section, const std::string& name) {
    return scene_key(section, name).otherwise.value_or("none");
  };
  const auto number = [&](const std::string& section, const std::string& name) {
    return std::stod(of(section, name));
  };
  const MethodRequest method;
  EXPECT_EQ(of("method", "element"), method.element);
  EXPECT_EQ(of("method", "solver"), method.solver);
  EXPECT_EQ(number("method", "tolerance"), method.tolerance);
  EXPECT_EQ(number("method", "most_unknowns"), method.most_unknowns);
  EXPECT_EQ(number("model", "push"), BlockLoading{}.prescribed_displacement);
  EXPECT_EQ(number("model", "epsilon"), PlaneStrain{}.epsilon);
  const double young = number("model", "young"), nu = number("model", "poisson");
  EXPECT_DOUBLE_EQ(young / (2 * (1 + nu)), Coating{}.body.mu);
  EXPECT_DOUBLE_EQ(young * nu / ((1 + nu) * (1 - 2 * nu)), Coating{}.body.lambda);
}

TEST(SceneKeys, TheHelpHasThemAll) {
  const TemporaryFolder log;
  const std::string help = scene_keys_help();
  EXPECT_NE(run_scene("--help", log).out.find(help), std::string::npos)
      << "run_scene --help does not hold the table";
  for (const SceneKey& key : scene_keys()) {
    const std::string words = is_section(key) ? "[" + key.name + "]" : key.name + " = ";
    EXPECT_NE(help.find(words), std::string::npos) << words;
  }
}

/// What a value is, for the how-to.
std::string value_of(const SceneKey& key) {
  switch (key.type) {
    case Type::choice:
      return fmt::format("`\"{}\"`", fmt::join(key.choices, "\"`, `\""));
    case Type::formula_xy:
      return "a formula in x and y";
    case Type::formula_x:
      return "a formula in x";
    case Type::number:
      return "a number, " + key.accepted;
    case Type::count:
      return "a whole number, " + key.accepted;
    case Type::flag:
      return "`true`";
    default:
      return key.accepted;
  }
}

std::string default_of(const SceneKey& key) {
  if (key.required) return "(required)";
  if (!key.otherwise || key.otherwise->empty()) return "";
  const bool quoted = key.type != Type::number && key.type != Type::count;
  return quoted ? "`\"" + *key.otherwise + "\"`" : "`" + *key.otherwise + "`";
}

/// The how-to's table.
std::string howto_table() {
  std::string table = "| section | key | value | default | what it does |\n|---|---|---|---|---|\n";
  for (const SceneKey& key : scene_keys()) {
    if (is_section(key)) continue;
    const std::string section = key.section.empty() ? "" : "`[" + key.section + "]`";
    table += fmt::format("| {} | `{}` | {} | {} | {} |\n",
                         key.section == "edge" ? "`[[edge]]`" : section, key.name, value_of(key),
                         default_of(key), key.does);
  }
  return table;
}

TEST(SceneKeys, TheHowToHasThisTable) {
  EXPECT_NE(contents(EXAMPLE_SCENES "/../guides/howto_scene.md").find("\n" + howto_table()),
            std::string::npos)
      << "tutorials/guides/howto_scene.md holds another table; it should be\n"
      << howto_table();
}

}  // namespace antilock::test::scene_keys_test
