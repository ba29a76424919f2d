// A reader of its own: gmsh's reader takes truncated sections, unknown nodes and wrong counts
// without a word. The file is first read as it stands, then its tags are resolved, so that the
// order of the sections is free.
#include "antilock/mesh/read_msh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <istream>
#include <limits>
#include <set>
#include <sstream>
#include <unordered_map>
#include <unordered_set>

#include "antilock/core/error.hpp"
#include "antilock/core/input_file.hpp"
#include "antilock/core/number.hpp"
#include "antilock/core/plain_text.hpp"

namespace antilock {
namespace {

std::string in_quotes(std::string_view text) { return fmt::format("\"{}\"", printable(text, 40)); }

/// A MSH file as lines of fields, one record a line as gmsh writes them; blank lines are skipped.
/// It knows where it is, so that every refusal names the file and the line. Throws Error alone.
class MshLines {
 public:
  /// Takes the whole stream.
  MshLines(std::istream& in, std::string name) : name(std::move(name)) {
    std::ostringstream all;
    if (in) all << in.rdbuf();
    if (in.bad()) refuse_file<MeshError>("cannot be read");
    text_ = std::move(all).str();
    text_.erase(0, text_.size() - plain_text(text_, this->name).size());
    if (text_.empty()) refuse_file("is empty or cannot be read; accepted: MSH 2.2 or 4.1, ASCII");
  }

  /// Moves to the next line that is not blank; false at the end of the file.
  bool next() {
    while (position_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', position_), text_.size());
      line = std::string_view(text_).substr(position_, end - position_);
      position_ = end + 1;
      ++number;
      fields.clear();
      for (std::size_t from = line.find_first_not_of(blanks); from != line.npos;) {
        const std::size_t to = std::min(line.find_first_of(blanks, from), line.size());
        fields.push_back(line.substr(from, to - from));
        from = line.find_first_not_of(blanks, to);
      }
      if (!fields.empty()) return true;
    }
    return false;
  }
  /// Moves to the next record of `section`. Refuses the end of the file, and a line that starts
  /// with $, because the section then has fewer records than it declares. Unless `count` is 0, a
  /// record must have `count` fields; `what` names them in the refusal.
  void next_record(std::string_view section, std::size_t count = 0, std::string_view what = "") {
    if (!next()) refuse_file<MeshError>("truncated: it ends within ${}", section);
    if (fields[0].front() == '$')
      refuse<MeshError>("{} where ${} declares further entries", in_quotes(fields[0]), section);
    if (count > 0 && fields.size() != count)
      refuse("{} fields in ${}; accepted: {} ({})", fields.size(), section, count, what);
  }
  /// Refuses anything but the end of `section`: more records than declared, or a truncated file.
  void end_section(std::string_view section) {
    if (!next()) refuse_file<MeshError>("truncated: it ends within ${}", section);
    if (fields.size() != 1 || fields[0] != fmt::format("$End{}", section))
      refuse("{} where the entries that ${} declares are over; accepted: $End{}", in_quotes(line),
             section, section);
  }
  /// Passes over a section that the mesh does not need.
  void skip_section(std::string_view section) {
    const std::string end = fmt::format("$End{}", section);
    while (next())
      if (fields[0] == end) return;
    refuse_file<MeshError>("truncated: no {} follows", in_quotes(end));
  }

  std::int64_t integer(std::size_t field) const {
    std::int64_t value = 0;
    if (!read_number(fields[field], value))
      refuse<MeshError>("{} is no integer", in_quotes(fields[field]));
    return value;
  }
  std::int64_t count(std::size_t field) const {
    const std::int64_t value = integer(field);
    if (value < 0) refuse("{} is no count; accepted: 0 or more", value);
    return value;
  }
  double coordinate(std::size_t field) const {
    double value = 0;
    if (!read_number(fields[field], value) || !std::isfinite(value))
      refuse("{} is no coordinate; accepted: a finite number, as -2.5e-01",
             in_quotes(fields[field]));
    return value;
  }

  /// Throws Error, or MeshError where `why` does not say what is accepted, about this line, another
  /// one or the file; `why` is a format of the values.
  template <class Thrown = Error, class... Values>
  [[noreturn]] void refuse(fmt::format_string<const Values&...> why,
                           const Values&... values) const {
    refuse_at<Thrown>(number, why, values...);
  }
  template <class Thrown = Error, class... Values>
  [[noreturn]] void refuse_at(int at, fmt::format_string<const Values&...> why,
                              const Values&... values) const {
    throw Thrown(fmt::format("{}: line {}: {}", name, at, fmt::format(why, values...)));
  }
  template <class Thrown = Error, class... Values>
  [[noreturn]] void refuse_file(fmt::format_string<const Values&...> why,
                                const Values&... values) const {
    throw Thrown(fmt::format("{}: {}", name, fmt::format(why, values...)));
  }

  const std::string name;
  std::string_view line;  ///< this one, and its fields
  std::vector<std::string_view> fields;
  int number = 0;  ///< of this line

 private:
  static constexpr std::string_view blanks = " \t\r\v\f";
  std::string text_;
  std::size_t position_ = 0;
};

/// A node, in the plane z = 0 if an element needs it.
struct FileNode {
  std::int64_t tag;
  std::array<double, 3> at;
  int line;
};

/// A point, line, triangle or tetrahedron: 1, 2, 3 or 4 nodes.
struct FileElement {
  std::int64_t tag;
  std::int64_t
      group;  ///< MSH 2.2: the physical group; 4.1: the entity, whose group $Entities tells
  std::int64_t surface;  ///< the point, curve, surface or volume that it is on; MSH 2.2: the group,
                         ///< where that is not told
  int size;
  std::array<std::int64_t, 4> nodes;
  int line;
  int dimension() const { return size - 1; }
};

/// Dimension and number of a physical group or an entity.
using Place = std::pair<int, std::int64_t>;

/// Names of physical groups, each with its dimension before it.
using GroupNames = std::set<std::pair<int, std::string>>;

/// The name of a physical group, and the line of the file that gives it.
struct GroupName {
  std::string text;
  int line;
};

/// A MSH file as it stands, its tags not yet resolved.
struct MshFile {
  bool version_4 = false;
  std::map<Place, GroupName> names;  ///< of the physical groups of curves, surfaces and volumes
  std::map<Place, std::int64_t>
      entities;  ///< 4.1: the physical group of a curve, surface or volume, 0 for none
  std::vector<FileNode> nodes;
  std::vector<FileElement> elements;
};

constexpr std::array dimension_names = {"point", "curve", "surface", "volume"};

int read_dimension(const MshLines& lines, std::size_t field) {
  const std::int64_t dimension = lines.integer(field);
  if (dimension < 0 || dimension > 3) lines.refuse("dimension {}; accepted: 0 to 3", dimension);
  return static_cast<int>(dimension);
}

/// How many nodes an element of gmsh's type has.
int element_size(const MshLines& lines, std::int64_t type) {
  if (type == 15) return 1;
  if (type == 1 || type == 2) return static_cast<int>(type) + 1;
  if (type == 4) return 4;
  lines.refuse(
      "element type {}; accepted: 15 (point), 1 (line), 2 (triangle of 3 nodes), 4 (tetrahedron of "
      "4 nodes)",
      type);
}

void read_format(MshLines& lines, MshFile& file) {
  lines.next_record("MeshFormat", 3, "version, 0 for ASCII, size of a number");
  const std::string_view version = lines.fields[0];
  if (version != "2.2" && version != "4.1")
    lines.refuse("MSH version {}; accepted: 2.2 and 4.1", in_quotes(version));
  if (lines.fields[1] != "0")
    lines.refuse("a binary file; accepted: ASCII (gmsh option Mesh.Binary = 0)");
  file.version_4 = version == "4.1";
}

/// Records: dimension number "name". A curve and a surface may have one name.
void read_names(MshLines& lines, MshFile& file) {
  lines.next_record("PhysicalNames", 1, "their number");
  for (std::int64_t left = lines.count(0); left > 0; --left) {
    lines.next_record("PhysicalNames");
    const std::string_view line = lines.line;
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (lines.fields.size() < 3 || lines.fields[2].front() != '"' || close == open)
      lines.refuse<MeshError>("a group must read: dimension number \"name\"");
    const int dimension = read_dimension(lines, 0);
    if (dimension == 0) continue;  // points carry nothing here
    const std::string name(line.substr(open + 1, close - open - 1));
    for (const auto& [place, other] : file.names)
      if (other.text == name && place.first == dimension)
        lines.refuse<MeshError>("the {} group {} is named twice", dimension_names[dimension],
                                in_quotes(name));
    const GroupName group{name, lines.number};
    if (!file.names.emplace(Place{dimension, lines.integer(1)}, group).second)
      lines.refuse<MeshError>("{} group {} has two names", dimension_names[dimension],
                              lines.integer(1));
  }
}

/// The dimension d of the mesh of a file: 3 where it has tetrahedra, and 2 else.
int mesh_dimension(const MshFile& file) {
  int dimension = 2;
  for (const FileElement& element : file.elements)
    dimension = std::max(dimension, element.dimension());
  return dimension;
}

/// Throws unless all groups of cells and of facets have names that are known. Where the mesh is one
/// of tetrahedra, curves carry nothing.
void check_names(const MshLines& lines, const MshFile& file, const ExtraGroups& more, int d) {
  GroupNames known{{d, "body"}, {d, "layer"}};
  for (const char* facets : {"sigma", "clamped", "contact"}) known.emplace(d - 1, facets);
  for (const auto& [name, tag] : more.curves) known.emplace(d - 1, name);
  for (const std::string& body : more.bodies) known.emplace(d, body);
  for (const auto& [place, name] : file.names) {
    const int dimension = place.first;
    if (dimension < d - 1 || known.contains({dimension, name.text})) continue;
    std::string accepted;  // the scene's own names stand here, too: a misspelt one is seen
    for (const auto& [of, each] : known)
      if (of == dimension) accepted += each + ", ";
    lines.refuse_at(
        name.line,
        "unknown {} group {}; accepted: {}and others that a scene names in [[edge]] or in [body] "
        "stiffness",
        dimension_names[dimension], in_quotes(name.text), accepted);
  }
}

/// The number of a physical group: an int for gmsh, below 0 where it turns the entity round.
std::int64_t read_group(const MshLines& lines, std::size_t field) {
  const std::int64_t group = lines.integer(field);
  if (group > std::numeric_limits<int>::max() || group < -std::numeric_limits<int>::max())
    lines.refuse<MeshError>("physical group {} is out of range", group);
  return group;
}

/// Records: tag, a point (0-D) or a bounding box, number of physical groups, the groups, what
/// bounds it.
void read_entities(MshLines& lines, MshFile& file) {
  lines.next_record("Entities", 4, "numbers of points, curves, surfaces, volumes");
  const std::array counts = {lines.count(0), lines.count(1), lines.count(2), lines.count(3)};
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::int64_t i = 0; i < counts[dimension]; ++i) {
      lines.next_record("Entities");
      const std::size_t first_group = dimension == 0 ? 5 : 8;
      if (lines.fields.size() < first_group)
        lines.refuse("{} fields; accepted: {} or more", lines.fields.size(), first_group);
      const std::int64_t tag = lines.integer(0), groups = lines.count(first_group - 1);
      if (groups > static_cast<std::int64_t>(lines.fields.size() - first_group))
        lines.refuse<MeshError>("{} physical groups declared, but the line ends", groups);
      if (dimension == 0) continue;
      if (groups > 1)
        lines.refuse("{} {} is in {} physical groups; accepted: one", dimension_names[dimension],
                     tag, groups);
      const std::int64_t group = groups == 0 ? 0 : read_group(lines, first_group);
      if (!file.entities.emplace(Place{dimension, tag}, group).second)
        lines.refuse<MeshError>("{} {} is listed twice", dimension_names[dimension], tag);
    }
}

/// A node, its coordinates from field `first` on.
void read_node(const MshLines& lines, MshFile& file, std::int64_t tag, std::size_t first) {
  file.nodes.push_back(
      {tag,
       {lines.coordinate(first), lines.coordinate(first + 1), lines.coordinate(first + 2)},
       lines.number});
}

/// Reads records `tag x y z`. In $ParametricNodes (gmsh's Mesh.SaveParametric) a record also has
/// the dimension and the tag of the entity that the node is on, and one parameter on a curve or two
/// on a surface.
void read_nodes_2(MshLines& lines, MshFile& file, const std::string& section) {
  lines.next_record(section, 1, "their number");
  for (std::int64_t left = lines.count(0); left > 0; --left) {
    if (section == "Nodes") {
      lines.next_record(section, 4, "tag x y z");
    } else {
      lines.next_record(section);
      if (lines.fields.size() < 6 || lines.fields.size() > 8)
        lines.refuse("{} fields in ${}; accepted: 6 to 8 (tag x y z dimension entity parameters)",
                     lines.fields.size(), section);
    }
    read_node(lines, file, lines.integer(0), 1);
  }
}

/// Blocks: a header, the tags a line each, then the coordinates a line each.
void read_nodes_4(MshLines& lines, MshFile& file) {
  lines.next_record("Nodes", 4, "blocks, nodes, smallest tag, largest tag");
  const std::int64_t total = lines.count(1);
  for (std::int64_t blocks = lines.count(0); blocks > 0; --blocks) {
    lines.next_record("Nodes", 4, "dimension, entity, parametric, nodes");
    const int dimension = read_dimension(lines, 0);
    const std::size_t fields = lines.integer(2) == 0 ? 3 : 3 + static_cast<std::size_t>(dimension);
    std::vector<std::int64_t> tags;
    for (std::int64_t left = lines.count(3); left > 0; --left) {
      lines.next_record("Nodes", 1, "a node tag");
      tags.push_back(lines.integer(0));
    }
    for (const std::int64_t tag : tags) {
      lines.next_record("Nodes", fields, "x y z and the parameters declared");
      read_node(lines, file, tag, 0);
    }
  }
  if (static_cast<std::int64_t>(file.nodes.size()) != total)
    lines.refuse<MeshError>("$Nodes declares {} nodes, its blocks hold {}", total,
                            file.nodes.size());
}

FileElement read_element(const MshLines& lines, int size, std::int64_t group, std::int64_t surface,
                         std::size_t first_node) {
  FileElement element{lines.integer(0), group, surface, size, {}, lines.number};
  for (int i = 0; i < size; ++i) element.nodes[i] = lines.integer(first_node + i);
  return element;
}

/// Records: number type tag-count tags nodes; the first tag is the physical group, the second the
/// entity.
void read_elements_2(MshLines& lines, MshFile& file) {
  lines.next_record("Elements", 1, "their number");
  for (std::int64_t left = lines.count(0); left > 0; --left) {
    lines.next_record("Elements");
    if (lines.fields.size() < 4)
      lines.refuse("too few fields; accepted: number type tag-count tags nodes");
    const int size = element_size(lines, lines.integer(1));
    const std::int64_t tags = lines.count(2);
    if (tags != static_cast<std::int64_t>(lines.fields.size()) - 3 - size)
      lines.refuse("{} fields; accepted: 3, the {} tags declared and {} nodes", lines.fields.size(),
                   tags, size);
    const std::int64_t group = tags == 0 ? 0 : read_group(lines, 3);
    const std::int64_t surface = tags < 2 ? group : lines.integer(4);
    file.elements.push_back(read_element(lines, size, group, surface, lines.fields.size() - size));
  }
}

/// Blocks: a header, then records: number nodes.
void read_elements_4(MshLines& lines, MshFile& file) {
  lines.next_record("Elements", 4, "blocks, elements, smallest tag, largest tag");
  const std::int64_t total = lines.count(1);
  for (std::int64_t blocks = lines.count(0); blocks > 0; --blocks) {
    lines.next_record("Elements", 4, "dimension, entity, element type, elements");
    const int size = element_size(lines, lines.integer(2));
    if (read_dimension(lines, 0) != size - 1)
      lines.refuse<MeshError>("element type {} in a block of dimension {}",
                              in_quotes(lines.fields[2]), in_quotes(lines.fields[0]));
    const std::int64_t entity = lines.integer(1);
    for (std::int64_t left = lines.count(3); left > 0; --left) {
      lines.next_record("Elements", 1 + static_cast<std::size_t>(size), "number and nodes");
      file.elements.push_back(read_element(lines, size, entity, entity, 1));
    }
  }
  if (static_cast<std::int64_t>(file.elements.size()) != total)
    lines.refuse<MeshError>("$Elements declares {} elements, its blocks hold {}", total,
                            file.elements.size());
}

/// Reads every section that a mesh needs, 2.2 or 4.1.
MshFile read_sections(MshLines& lines) {
  bool any = lines.next();
  for (; any && lines.fields[0] == "$Comments"; any = lines.next()) lines.skip_section("Comments");
  if (!any || lines.fields[0] != "$MeshFormat")
    lines.refuse_file(
        "is no MSH file: it does not start with $MeshFormat; accepted: MSH 2.2 or 4.1, ASCII");
  MshFile file;
  std::set<std::string, std::less<>> seen;
  const auto first_time = [&](const std::string& section) {
    if (!seen.insert(section).second)
      lines.refuse<MeshError>("a second {}", in_quotes('$' + section));
  };
  do {
    if (lines.fields.size() != 1 || lines.fields[0].front() != '$' ||
        lines.fields[0].starts_with("$End"))
      lines.refuse<MeshError>("{} outside every section", in_quotes(lines.line));
    const std::string section(lines.fields[0].substr(1));
    if (section == "MeshFormat") {
      first_time(section);
      read_format(lines, file);
    } else if (section == "PhysicalNames") {
      first_time(section);
      read_names(lines, file);
    } else if (section == "Entities" && file.version_4) {
      first_time(section);
      read_entities(lines, file);
    } else if (section == "Nodes" || (section == "ParametricNodes" && !file.version_4)) {
      first_time("Nodes");
      file.version_4 ? read_nodes_4(lines, file) : read_nodes_2(lines, file, section);
    } else if (section == "Elements") {
      first_time(section);
      file.version_4 ? read_elements_4(lines, file) : read_elements_2(lines, file);
    } else if (section == "PartitionedEntities") {
      lines.refuse("a partitioned mesh; accepted: one partition");
    } else {
      lines.skip_section(section);  // which may come again, as $NodeData does for each step of time
      continue;
    }
    lines.end_section(section);
  } while (lines.next());
  for (const char* section : {"PhysicalNames", "Nodes", "Elements"})
    if (!seen.contains(section))
      lines.refuse_file<MeshError>("has no section ${}, which is needed", section);
  if (file.version_4 && !seen.contains("Entities"))
    lines.refuse_file<MeshError>(
        "has no section $Entities, which in MSH 4.1 tells the physical groups");
  return file;
}

/// The physical group that an element is in, 0 for none; a negative number, which turns the entity
/// round, is that of the same group.
std::int64_t group_number(const MshLines& lines, const MshFile& file, const FileElement& element) {
  if (!file.version_4) return std::abs(element.group);
  const auto entity = file.entities.find({element.dimension(), element.group});
  if (entity == file.entities.end())
    lines.refuse_at<MeshError>(element.line,
                               "element {} is on {} {}, which $Entities does not list", element.tag,
                               dimension_names[element.dimension()], element.group);
  return std::abs(entity->second);
}

/// Its name.
const std::string& group_name(const MshLines& lines, const MshFile& file,
                              const FileElement& element) {
  const char* dimension = dimension_names[element.dimension()];
  const std::int64_t group = group_number(lines, file, element);
  if (group == 0)
    lines.refuse_at(
        element.line,
        "element {} is in no physical group; accepted: body, layer, sigma, clamped, contact",
        element.tag);
  const auto name = file.names.find({element.dimension(), group});
  if (name == file.names.end())
    lines.refuse_at<MeshError>(element.line,
                               "element {} is in {} group {}, which $PhysicalNames does not name",
                               element.tag, dimension, group);
  return name->second.text;
}

/// Node tags, which may have gaps, to places in the file from 0 on.
std::unordered_map<std::int64_t, int> number_nodes(const MshLines& lines,
                                                   const std::vector<FileNode>& nodes) {
  std::unordered_map<std::int64_t, int> place;
  place.reserve(nodes.size());
  for (const auto& [tag, at, line] : nodes) {
    if (tag < 1) lines.refuse_at(line, "node tag {}; accepted: 1 or more", tag);
    if (!place.emplace(tag, static_cast<int>(place.size())).second)
      lines.refuse_at<MeshError>(line, "node tag {} is used twice", tag);
  }
  return place;
}

/// The vertices of the mesh: the nodes that a cell or a facet has, in the order of the file. A node
/// of none of them (the centre of a circle, a physical point) is left out.
class Vertices {
 public:
  explicit Vertices(const std::vector<FileNode>& nodes)
      : nodes_(nodes), number_(nodes.size(), unused) {}
  void use(int place) { number_[place] = 0; }

  /// Numbers those in use, for a mesh of dimension d. Throws Error for one of a plane mesh that is
  /// off the plane z = 0.
  void number(const MshLines& lines, int d) {
    std::vector<const FileNode*> used;
    for (std::size_t place = 0; place < nodes_.size(); ++place) {
      if (number_[place] == unused) continue;
      number_[place] = static_cast<int>(used.size());
      used.push_back(&nodes_[place]);
    }
    points.resize(static_cast<Eigen::Index>(used.size()), d);
    for (std::size_t v = 0; v < used.size(); ++v)
      for (int k = 0; k < d; ++k) points(static_cast<Eigen::Index>(v), k) = used[v]->at[k];
    if (used.empty() || d == 3) return;
    const double size = (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
    constexpr double flat = 1e-12;  // of the mesh's size: what a generator's round-off may leave
    for (const FileNode* node : used)
      if (std::abs(node->at[2]) > flat * size)
        lines.refuse_at(node->line, "node {} has z = {:.6g}; accepted: a mesh in the plane z = 0",
                        node->tag, node->at[2]);
  }
  int at(int place) const { return number_[place]; }
  Points points;

 private:
  static constexpr int unused = -1;
  const std::vector<FileNode>& nodes_;
  std::vector<int> number_;  ///< by place in the file
};

/// The places of the nodes of an element, up to four.
std::array<int, 4> places_of_nodes(const MshLines& lines, const FileElement& element,
                                   const std::unordered_map<std::int64_t, int>& place_of) {
  std::array<int, 4> places{};
  for (int i = 0; i < element.size; ++i) {
    const auto node = place_of.find(element.nodes[i]);
    if (node == place_of.end())
      lines.refuse_at<MeshError>(element.line, "element {} has node {}, which $Nodes does not list",
                                 element.tag, element.nodes[i]);
    places[i] = node->second;
  }
  return places;
}

/// Throws unless every group that is needed, and every one that the file names, has elements. d is
/// the dimension of the mesh.
void check_groups(const MshLines& lines, const MshFile& file, const ExtraGroups& more,
                  const GroupNames& found, int d) {
  for (const auto& [dimension, name] :
       GroupNames{{d, "body"}, {d - 1, "clamped"}, {d - 1, "contact"}}) {
    if (found.contains({dimension, name})) continue;
    const bool is_optional = (name == "body" && !more.bodies.empty()) ||
                             (name == "clamped" && !more.curves.empty()) ||
                             (name == "contact" && !more.needs_contact);
    if (!is_optional)
      lines.refuse_file<MeshError>(
          "has nothing in the physical group {}; needed: body, clamped, contact", in_quotes(name));
  }
  for (const auto& [name, tag] : more.curves)
    if (!found.contains({d - 1, name}))
      lines.refuse_file<MeshError>("has no {} in the group {}", dimension_names[d - 1],
                                   in_quotes(name));
  for (const std::string& name : more.bodies)
    if (!found.contains({d, name}))
      lines.refuse_file<MeshError>("has no {} in the group {}", dimension_names[d],
                                   in_quotes(name));
  for (const auto& [place, name] : file.names)
    if (place.first >= d - 1 && !found.contains({place.first, name.text}))
      lines.refuse_file<MeshError>("names the physical group {}, but it is empty",
                                   in_quotes(name.text));
}

/// The cells of a file, while they are collected.
struct Cells {
  std::vector<int> corners;  ///< of one cell after the other
  std::vector<Region> region;
  std::vector<int> surface;
  std::map<std::pair<std::int64_t, std::int64_t>, int> surfaces;  ///< of a group and its entity
  /// By their nodes in ascending order. A triangle has place 0 as its fourth node.
  std::map<std::array<int, 4>, const FileElement*> seen;
};

/// Adds a cell, in the group `name`. Throws Error where the file has the same cell before.
void add_cell(Cells& cells, const MshLines& lines, const MshFile& file, const FileElement& element,
              const std::array<int, 4>& vertices, const std::string& name) {
  std::array<int, 4> nodes = vertices;
  std::sort(nodes.begin(), nodes.end());
  if (const auto [first, alone] = cells.seen.emplace(nodes, &element); !alone)
    lines.refuse_at(element.line,
                    "element {}, in the group {}, is the same {} as element {}, in the group {}; "
                    "accepted: each {} once, in one group",
                    element.tag, in_quotes(name), element.size == 3 ? "triangle" : "tetrahedron",
                    first->second->tag, in_quotes(group_name(lines, file, *first->second)),
                    element.size == 3 ? "triangle" : "tetrahedron");
  cells.corners.insert(cells.corners.end(), vertices.begin(), vertices.begin() + element.size);
  const std::pair named(element.group, element.surface);
  const auto next = static_cast<int>(cells.surfaces.size());
  cells.surface.push_back(cells.surfaces.emplace(named, next).first->second);
  cells.region.push_back(name == "layer" ? Region::layer : Region::body);
}

/// A facet of the file in a group. Its vertices are places in the file.
TaggedEdge tagged_facet(const FileElement& element, const std::array<int, 4>& vertices,
                        EdgeTag tag) {
  if (element.size == 2) return {vertices[0], vertices[1], tag};
  return {vertices[0], vertices[1], vertices[2], tag};
}

TriangleMesh resolve(const MshLines& lines, const MshFile& file, const ExtraGroups& more,
                     std::vector<int>* part) {
  const int d = mesh_dimension(file);
  check_names(lines, file, more, d);
  std::map<std::string, EdgeTag> edge_tags = more.curves;
  edge_tags.insert(
      {{"sigma", EdgeTag::sigma}, {"clamped", EdgeTag::clamped}, {"contact", EdgeTag::contact}});
  const auto place_of = number_nodes(lines, file.nodes);
  Vertices used(file.nodes);
  Cells cells;
  std::vector<TaggedEdge> edges;
  GroupNames found;
  std::unordered_set<std::int64_t> tags;
  if (part != nullptr) part->clear();
  for (const FileElement& element : file.elements) {
    if (!tags.insert(element.tag).second)
      lines.refuse_at<MeshError>(element.line, "element number {} is used twice", element.tag);
    const std::array<int, 4> vertices = places_of_nodes(lines, element, place_of);
    const bool is_facet = element.dimension() == d - 1;
    if (element.dimension() < d - 1) continue;
    // Mesh.SaveAll: of the facets within the body nothing is said, and a side in no group is
    // refused with its place
    if (is_facet && group_number(lines, file, element) == 0) continue;
    const std::string& name = group_name(lines, file, element);
    found.emplace(element.dimension(), name);
    for (int i = 0; i < element.size; ++i) used.use(vertices[i]);
    if (is_facet) {
      edges.push_back(tagged_facet(element, vertices, edge_tags.at(name)));
      continue;
    }
    add_cell(cells, lines, file, element, vertices, name);
    if (part == nullptr) continue;
    const auto at = std::find(more.bodies.begin(), more.bodies.end(), name);
    part->push_back(at == more.bodies.end() ? -1 : static_cast<int>(at - more.bodies.begin()));
  }
  check_groups(lines, file, more, found, d);
  used.number(lines, d);
  for (int& corner : cells.corners) corner = used.at(corner);
  for (TaggedEdge& edge : edges)
    for (int i = 0; i < d; ++i) edge.vertices[i] = used.at(edge.vertices[i]);
  const auto count = static_cast<Eigen::Index>(cells.region.size());
  IndexRows corners = Eigen::Map<IndexRows>(cells.corners.data(), count, d + 1);
  return make_mesh(std::move(used.points), std::move(corners), std::move(cells.region), edges,
                   lines.name, cells.surface);
}

}  // namespace

TriangleMesh read_msh(std::istream& in, const std::string& name, const ExtraGroups& more,
                      std::vector<int>* part) {
  MshLines lines(in, name);
  return resolve(lines, read_sections(lines), more, part);
}

TriangleMesh read_msh(const std::string& path, const ExtraGroups& more, std::vector<int>* part) {
  return read_msh(*open_file(path, path, "a MSH file, 2.2 or 4.1, ASCII"), path, more, part);
}

int named_dimension(const std::string& path) {
  constexpr std::streamsize most = 1 << 20;
  std::string start(most, '\0');
  try {
    const std::unique_ptr<std::istream> in = open_file(path, path, "a MSH file");
    in->read(start.data(), most);
    start.resize(static_cast<std::size_t>(in->gcount()));
  } catch (const Error&) {  // read_msh refuses the file, with the reason
    return 2;
  }
  std::istringstream lines(start);
  bool are_names = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("$")) are_names = line.starts_with("$PhysicalNames");
    std::istringstream words(line);
    int dimension = 0, number = 0;
    std::string name;
    if (are_names && words >> dimension >> number >> name && dimension == 3) return 3;
  }
  return 2;
}

}  // namespace antilock
