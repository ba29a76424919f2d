// A reader of its own: gmsh's reader takes truncated sections, unknown nodes and wrong counts without a word.
// The file is first read as it stands (msh_sections.cpp), then its tags are resolved here, so that the order of the
// sections is free.
#include "antilock/mesh/msh_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "antilock/core/error.hpp"
#include "antilock/mesh/detail/msh_sections.hpp"

namespace antilock {
namespace {

/// The name of the physical group that an element is in; points have none.
const std::string& group_name(const MshLines& lines, const MshFile& file, const FileElement& element) {
  const char* dimension = dimension_names[element.dimension()];
  std::int64_t group = element.group;
  if (file.version_4) {
    const auto entity = file.entities.find({element.dimension(), element.group});
    if (entity == file.entities.end())
      lines.refuse_at(element.line, "element {} is on {} {}, which $Entities does not list", element.tag, dimension,
                      element.group);
    group = entity->second < 0 ? -entity->second : entity->second;  // a negative group turns the entity round
  }
  if (group == 0)
    lines.refuse_at(element.line, "element {} is in no physical group; accepted: body, layer, sigma, clamped, contact",
                    element.tag);
  const auto name = file.names.find({element.dimension(), group});
  if (name == file.names.end())
    lines.refuse_at(element.line, "element {} is in {} group {}, which $PhysicalNames does not name", element.tag,
                    dimension, group);
  return name->second;
}

/// FileNode tags, which may have gaps, to indices from 0 in the order of the file.
std::unordered_map<std::int64_t, int> number_nodes(const MshLines& lines, const std::vector<FileNode>& nodes) {
  std::unordered_map<std::int64_t, int> index;
  index.reserve(nodes.size());
  for (const FileNode& node : nodes) {
    if (node.tag < 1) lines.refuse_file("node tag {}; accepted: 1 or more", node.tag);
    if (!index.emplace(node.tag, static_cast<int>(index.size())).second)
      lines.refuse_file("node tag {} is used twice", node.tag);
  }
  return index;
}

TriangleMesh resolve(const MshLines& lines, const MshFile& file, const MoreGroups& more, std::vector<int>* part) {
  std::map<std::string, EdgeTag> edge_tags = more.curves;
  edge_tags.insert({{"sigma", EdgeTag::sigma}, {"clamped", EdgeTag::clamped}, {"contact", EdgeTag::contact}});
  const auto index = number_nodes(lines, file.nodes);
  std::vector<std::array<int, 3>> corners;
  std::vector<Region> region;
  std::vector<TaggedEdge> edges;
  std::set<std::string_view> found;
  std::unordered_set<std::int64_t> tags;
  for (const FileElement& element : file.elements) {
    if (!tags.insert(element.tag).second) lines.refuse_at(element.line, "element number {} is used twice", element.tag);
    std::array<int, 3> vertices{};
    for (int i = 0; i < element.size; ++i) {
      const auto node = index.find(element.nodes[i]);
      if (node == index.end())
        lines.refuse_at(element.line, "element {} has node {}, which $Nodes does not list", element.tag,
                        element.nodes[i]);
      vertices[i] = node->second;
    }
    if (element.dimension() == 0) continue;
    const std::string& name = group_name(lines, file, element);
    found.insert(name);
    if (element.dimension() == 1) {
      edges.push_back({vertices[0], vertices[1], edge_tags.at(name)});
    } else {
      corners.push_back(vertices);
      region.push_back(name == "layer" ? Region::layer : Region::body);
      if (part != nullptr) {
        const auto at = std::find(more.bodies.begin(), more.bodies.end(), name);
        part->push_back(at == more.bodies.end() ? -1 : static_cast<int>(at - more.bodies.begin()));
      }
    }
  }
  for (const std::string name : {"body", "clamped", "contact"})
    if (!found.contains(name) && !(name == "body" && !more.bodies.empty()) &&
        !(name == "clamped" && !more.curves.empty()))
      lines.refuse_file("has nothing in the physical group {}; needed: body, clamped, contact", in_quotes(name));
  for (const auto& [name, tag] : more.curves)
    if (!found.contains(name)) lines.refuse_file("has no curve in the group {}", in_quotes(name));
  for (const std::string& name : more.bodies)
    if (!found.contains(name)) lines.refuse_file("has no surface in the group {}", in_quotes(name));
  for (const auto& [place, name] : file.names)
    if (!found.contains(name)) lines.refuse_file("names the physical group {}, but it is empty", in_quotes(name));

  Points points(file.nodes.size(), 2);
  for (std::size_t i = 0; i < file.nodes.size(); ++i) points.row(i) << file.nodes[i].x, file.nodes[i].y;
  Triples triangles = Eigen::Map<Triples>(corners[0].data(), static_cast<Eigen::Index>(corners.size()), 3);
  return make_triangle_mesh(std::move(points), std::move(triangles), std::move(region), edges, lines.name());
}

}  // namespace

TriangleMesh read_msh(std::istream& in, const std::string& name, const MoreGroups& more, std::vector<int>* part) {
  MshLines lines(in, name);
  std::map<std::string, int> dimensions;
  for (const auto& [curve, tag] : more.curves) dimensions[curve] = 1;
  for (const std::string& body : more.bodies) dimensions[body] = 2;
  return resolve(lines, read_sections(lines, dimensions), more, part);
}

TriangleMesh read_msh(const std::string& path, const MoreGroups& more, std::vector<int>* part) {
  std::error_code ignored;  // a folder, or a device that never ends
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    throw Error(path + ": is a folder or a device; accepted: a MSH file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path + ": cannot be opened; accepted: a MSH file, 2.2 or 4.1, ASCII");
  return read_msh(in, path, more, part);
}

}  // namespace antilock
