#include "antilock/mesh/detail/msh_sections.hpp"

#include <cmath>
#include <limits>
#include <set>

namespace antilock {
namespace {

int read_dimension(const MshLines& lines, std::size_t field) {
  const std::int64_t dimension = lines.integer(field);
  if (dimension < 0 || dimension > 3) lines.refuse("dimension {}; accepted: 0 to 3", dimension);
  return static_cast<int>(dimension);
}

/// How many nodes an element of gmsh's type has.
int element_size(const MshLines& lines, std::int64_t type) {
  if (type == 15) return 1;
  if (type == 1 || type == 2) return static_cast<int>(type) + 1;
  lines.refuse("element type {}; accepted: 15 (point), 1 (line), 2 (triangle of 3 nodes)", type);
}

void read_format(MshLines& lines, MshFile& file) {
  lines.next_record("MeshFormat", 3, "version, 0 for ASCII, size of a number");
  const std::string_view version = lines.field(0);
  if (version != "2.2" && version != "4.1") lines.refuse("MSH version {}; accepted: 2.2 and 4.1", in_quotes(version));
  if (lines.field(1) != "0") lines.refuse("a binary file; accepted: ASCII (gmsh option Mesh.Binary = 0)");
  file.version_4 = version == "4.1";
}

/// Records: dimension number "name".
void read_names(MshLines& lines, MshFile& file, std::map<std::string, int> known) {
  known.insert({{"body", 2}, {"layer", 2}, {"sigma", 1}, {"clamped", 1}, {"contact", 1}});
  lines.next_record("PhysicalNames", 1, "their number");
  const std::int64_t count = lines.count(0);
  for (std::int64_t i = 0; i < count; ++i) {
    lines.next_record("PhysicalNames");
    const std::string_view line = lines.line();
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (lines.fields() < 3 || lines.field(2).front() != '"' || close == open)
      lines.refuse("a group must read: dimension number \"name\"");
    const int dimension = read_dimension(lines, 0);
    if (dimension == 0) continue;  // points carry nothing here
    const std::string name(line.substr(open + 1, close - open - 1));
    const auto group = known.find(name);
    if (group == known.end() || group->second != dimension) {
      std::string accepted;  // the scene's own names stand here, too: a misspelt one is seen
      for (const auto& [each, of] : known)
        if (of == dimension) accepted += each + ", ";
      lines.refuse("unknown {} group {}; accepted: {}and others that a scene names in [[edge]] or in [body] stiffness",
                   dimension_names[dimension], in_quotes(name), accepted);
    }
    for (const auto& [place, other] : file.names)
      if (other == name) lines.refuse("the group {} is named twice", in_quotes(name));
    if (!file.names.emplace(Place{dimension, lines.integer(1)}, name).second)
      lines.refuse("{} group {} has two names", dimension_names[dimension], lines.integer(1));
  }
}

/// Records: tag, a point (0-D) or a bounding box, number of physical groups, the groups, what bounds it.
void read_entities(MshLines& lines, MshFile& file) {
  lines.next_record("Entities", 4, "numbers of points, curves, surfaces, volumes");
  const std::array counts = {lines.count(0), lines.count(1), lines.count(2), lines.count(3)};
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::int64_t i = 0; i < counts[dimension]; ++i) {
      lines.next_record("Entities");
      const std::size_t first_group = dimension == 0 ? 5 : 8;
      if (lines.fields() < first_group) lines.refuse("{} fields; accepted: {} or more", lines.fields(), first_group);
      const std::int64_t tag = lines.integer(0), groups = lines.count(first_group - 1);
      if (groups > static_cast<std::int64_t>(lines.fields() - first_group))
        lines.refuse("{} physical groups declared, but the line ends", groups);
      if (dimension == 0) continue;
      if (groups > 1)
        lines.refuse("{} {} is in {} physical groups; accepted: one", dimension_names[dimension], tag, groups);
      const std::int64_t group = groups == 0 ? 0 : lines.integer(first_group);
      if (std::abs(static_cast<double>(group)) > std::numeric_limits<int>::max())
        lines.refuse("physical group {} is out of range", group);
      if (!file.entities.emplace(Place{dimension, tag}, group).second)
        lines.refuse("{} {} is listed twice", dimension_names[dimension], tag);
    }
}

/// The coordinates of a node, from field `first` on.
FileNode read_node(const MshLines& lines, std::int64_t tag, std::size_t first) {
  constexpr double flat = 1e-12;  // what a generator's round-off may leave
  if (std::abs(lines.coordinate(first + 2)) > flat)
    lines.refuse("node {} has z = {}; accepted: a mesh in the plane z = 0", tag, in_quotes(lines.field(first + 2)));
  return {tag, lines.coordinate(first), lines.coordinate(first + 1)};
}

void read_nodes_2(MshLines& lines, MshFile& file) {
  lines.next_record("Nodes", 1, "their number");
  const std::int64_t count = lines.count(0);
  for (std::int64_t i = 0; i < count; ++i) {
    lines.next_record("Nodes", 4, "tag x y z");
    file.nodes.push_back(read_node(lines, lines.integer(0), 1));
  }
}

/// Blocks: a header, the tags a line each, then the coordinates a line each.
void read_nodes_4(MshLines& lines, MshFile& file) {
  lines.next_record("Nodes", 4, "blocks, nodes, smallest tag, largest tag");
  const std::int64_t blocks = lines.count(0), total = lines.count(1);
  for (std::int64_t block = 0; block < blocks; ++block) {
    lines.next_record("Nodes", 4, "dimension, entity, parametric, nodes");
    const int dimension = read_dimension(lines, 0);
    const std::int64_t count = lines.count(3);
    const std::size_t fields = lines.integer(2) == 0 ? 3 : 3 + static_cast<std::size_t>(dimension);
    std::vector<std::int64_t> tags;
    for (std::int64_t i = 0; i < count; ++i) {
      lines.next_record("Nodes", 1, "a node tag");
      tags.push_back(lines.integer(0));
    }
    for (const std::int64_t tag : tags) {
      lines.next_record("Nodes", fields, "x y z and the parameters declared");
      file.nodes.push_back(read_node(lines, tag, 0));
    }
  }
  if (static_cast<std::int64_t>(file.nodes.size()) != total)
    lines.refuse("$Nodes declares {} nodes, its blocks hold {}", total, file.nodes.size());
}

FileElement read_element(const MshLines& lines, int size, std::int64_t group, std::size_t first_node) {
  FileElement element{lines.integer(0), group, size, {}, lines.line_number()};
  for (int i = 0; i < size; ++i) element.nodes[i] = lines.integer(first_node + i);
  return element;
}

/// Records: number type tag-count tags nodes; the first tag is the physical group.
void read_elements_2(MshLines& lines, MshFile& file) {
  lines.next_record("Elements", 1, "their number");
  const std::int64_t count = lines.count(0);
  for (std::int64_t i = 0; i < count; ++i) {
    lines.next_record("Elements");
    if (lines.fields() < 4) lines.refuse("too few fields; accepted: number type tag-count tags nodes");
    const int size = element_size(lines, lines.integer(1));
    const std::int64_t tags = lines.count(2);
    if (tags != static_cast<std::int64_t>(lines.fields()) - 3 - size)
      lines.refuse("{} fields; accepted: 3, the {} tags declared and {} nodes", lines.fields(), tags, size);
    const std::int64_t group = tags == 0 ? 0 : lines.integer(3);
    file.elements.push_back(read_element(lines, size, group, lines.fields() - size));
  }
}

/// Blocks: a header, then records: number nodes.
void read_elements_4(MshLines& lines, MshFile& file) {
  lines.next_record("Elements", 4, "blocks, elements, smallest tag, largest tag");
  const std::int64_t blocks = lines.count(0), total = lines.count(1);
  for (std::int64_t block = 0; block < blocks; ++block) {
    lines.next_record("Elements", 4, "dimension, entity, element type, elements");
    const int size = element_size(lines, lines.integer(2));
    if (read_dimension(lines, 0) != size - 1)
      lines.refuse("element type {} in a block of dimension {}", in_quotes(lines.field(2)), in_quotes(lines.field(0)));
    const std::int64_t entity = lines.integer(1), count = lines.count(3);
    for (std::int64_t i = 0; i < count; ++i) {
      lines.next_record("Elements", 1 + static_cast<std::size_t>(size), "number and nodes");
      file.elements.push_back(read_element(lines, size, entity, 1));
    }
  }
  if (static_cast<std::int64_t>(file.elements.size()) != total)
    lines.refuse("$Elements declares {} elements, its blocks hold {}", total, file.elements.size());
}

}  // namespace

MshFile read_sections(MshLines& lines, const std::map<std::string, int>& more) {
  if (!lines.next() || lines.field(0) != "$MeshFormat")
    lines.refuse_file("is no MSH file: it does not start with $MeshFormat; accepted: MSH 2.2 or 4.1, ASCII");
  MshFile file;
  std::set<std::string, std::less<>> seen;
  do {
    if (lines.fields() != 1 || lines.field(0).front() != '$' || lines.field(0).starts_with("$End"))
      lines.refuse("{} outside every section", in_quotes(lines.line()));
    const std::string section(lines.field(0).substr(1));
    if (!seen.insert(section).second && section != "Comments") lines.refuse("a second {}", in_quotes('$' + section));
    if (section == "MeshFormat") {
      read_format(lines, file);
    } else if (section == "PhysicalNames") {
      read_names(lines, file, more);
    } else if (section == "Entities" && file.version_4) {
      read_entities(lines, file);
    } else if (section == "Nodes") {
      file.version_4 ? read_nodes_4(lines, file) : read_nodes_2(lines, file);
    } else if (section == "Elements") {
      file.version_4 ? read_elements_4(lines, file) : read_elements_2(lines, file);
    } else if (section == "PartitionedEntities") {
      lines.refuse("a partitioned mesh; accepted: one partition");
    } else {
      lines.skip_section(section);
      continue;
    }
    lines.end_section(section);
  } while (lines.next());
  for (const char* section : {"PhysicalNames", "Nodes", "Elements"})
    if (!seen.contains(section)) lines.refuse_file("has no section ${}, which is needed", section);
  if (file.version_4 && !seen.contains("Entities"))
    lines.refuse_file("has no section $Entities, which in MSH 4.1 tells the physical groups");
  return file;
}

}  // namespace antilock
