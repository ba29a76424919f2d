// The mesh as MSH 2.2 (gmsh and this library's reader) and in FreeFEM's own format, with one numbering; tables as CSV.
#include <algorithm>

#include "antilock/core/detail/atomic_file.hpp"
#include "antilock/core/detail/text.hpp"
#include "antilock/core/error.hpp"
#include "antilock/io/writers.hpp"

namespace antilock {
namespace {

/// An edge that carries a group, its vertices in the order of its first triangle: the domain lies on the left of a
/// boundary edge.
struct Labelled {
  int from, to, label;
};

std::vector<Labelled> labelled_edges(const TriangleMesh& mesh) {
  std::vector<Labelled> labelled;
  for (int edge = 0; edge < mesh.edge_count(); ++edge) {
    if (mesh.edge_tag[edge] == EdgeTag::interior) continue;
    const int triangle = mesh.edge_triangles(edge, 0);
    for (int i = 0; i < 3; ++i)  // edge i runs from vertex i+1 to vertex i+2
      if (mesh.triangle_edges(triangle, i) == edge)
        labelled.push_back({mesh.triangles(triangle, (i + 1) % 3), mesh.triangles(triangle, (i + 2) % 3),
                            static_cast<int>(mesh.edge_tag[edge])});
  }
  return labelled;
}

/// A physical group of curves (dimension 1) or surfaces (2).
struct Group {
  int dimension, number;
  std::string name;
};

/// The groups that the mesh has elements of, those of `named` last.
std::vector<Group> groups_of(const TriangleMesh& mesh, const std::vector<EdgeCondition>& named) {
  std::vector<Group> groups;
  const auto add = [&](int dimension, const auto& all, auto tag, const std::string& name) {
    if (std::find(all.begin(), all.end(), tag) != all.end()) groups.push_back({dimension, static_cast<int>(tag), name});
  };
  add(1, mesh.edge_tag, EdgeTag::sigma, "sigma");
  add(1, mesh.edge_tag, EdgeTag::clamped, "clamped");
  add(1, mesh.edge_tag, EdgeTag::contact, "contact");
  add(1, mesh.edge_tag, EdgeTag::free, "free");
  add(2, mesh.region, Region::body, "body");
  add(2, mesh.region, Region::layer, "layer");
  for (int k = 0; k < static_cast<int>(named.size()); ++k)
    for (const EdgeTag tag : {natural_group(k), held_group(k)}) add(1, mesh.edge_tag, tag, named[k].group);
  return groups;
}

}  // namespace

void write_msh(const std::filesystem::path& path, const TriangleMesh& mesh, const std::vector<EdgeCondition>& named) {
  const auto edges = labelled_edges(mesh);
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    text.print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    const std::vector<Group> groups = groups_of(mesh, named);
    text.print("$PhysicalNames\n{}\n", groups.size());
    for (const Group& group : groups) text.print("{} {} \"{}\"\n", group.dimension, group.number, group.name);
    text.print("$EndPhysicalNames\n$Nodes\n{}\n", mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v)
      text.print(FMT_COMPILE("{} {} {} 0\n"), v + 1, mesh.vertices(v, 0), mesh.vertices(v, 1));
    // number type tags(2) group entity vertices; the entity repeats the group
    text.print("$EndNodes\n$Elements\n{}\n", edges.size() + mesh.region.size());
    std::size_t number = 0;
    for (const auto& [from, to, label] : edges)
      text.print(FMT_COMPILE("{} 1 2 {} {} {} {}\n"), ++number, label, label, from + 1, to + 1);
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      const int group = static_cast<int>(mesh.region[t]);
      text.print(FMT_COMPILE("{} 2 2 {} {} {} {} {}\n"), ++number, group, group, mesh.triangles(t, 0) + 1,
                 mesh.triangles(t, 1) + 1, mesh.triangles(t, 2) + 1);
    }
    text.print("$EndElements\n");
  });
}

void write_freefem_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const auto edges = labelled_edges(mesh);
  std::vector<int> vertex_label(mesh.vertex_count(), 0);  // a corner takes the larger of its two labels; none reads it
  for (const auto& [from, to, label] : edges)
    for (const int v : {from, to}) vertex_label[v] = std::max(vertex_label[v], label);
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    text.print("{} {} {}\n", mesh.vertex_count(), mesh.triangle_count(), edges.size());
    for (int v = 0; v < mesh.vertex_count(); ++v)
      text.print(FMT_COMPILE("{} {} {}\n"), mesh.vertices(v, 0), mesh.vertices(v, 1), vertex_label[v]);
    for (int t = 0; t < mesh.triangle_count(); ++t)
      text.print(FMT_COMPILE("{} {} {} {}\n"), mesh.triangles(t, 0) + 1, mesh.triangles(t, 1) + 1,
                 mesh.triangles(t, 2) + 1, static_cast<int>(mesh.region[t]));
    for (const auto& [from, to, label] : edges) text.print("{} {} {}\n", from + 1, to + 1, label);
  });
}

void write_csv(const std::filesystem::path& path, const std::vector<std::string>& header, const Eigen::MatrixXd& rows) {
  if (header.empty() || static_cast<Eigen::Index>(header.size()) != rows.cols())
    throw Error(fmt::format("{}: {} names for {} columns; accepted: one name per column, at least one", path.string(),
                            header.size(), rows.cols()));
  for (const std::string& name : header)
    if (name.empty() || name.find_first_of(",\"\n\r") != std::string::npos)
      throw Error(fmt::format("{}: column name {:?} is empty or holds a comma, a quote or a line end", path.string(),
                              std::string_view(name)));
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    text.print("{}\n", fmt::join(header, ","));
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      for (Eigen::Index j = 0; j < rows.cols(); ++j)
        text.print(FMT_COMPILE("{}{}"), rows(i, j), j + 1 < rows.cols() ? ',' : '\n');
  });
}

void write_solution_csv(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u) {
  if ((u.size() != space.size() && u.size() != 2 * space.size()) || !u.allFinite())
    throw Error(fmt::format("{}: u must be {} finite values, one an unknown; it has {}, {} of them finite",
                            path.string(), space.size(), u.size(), u.array().isFinite().count()));
  const Eigen::Index components = u.size() / space.size();
  Eigen::MatrixXd rows(space.size(), 2 + components);
  rows << space.points(), u.reshaped(space.size(), components);
  std::vector<std::string> header{"x", "y", "u"};
  if (components == 2) header = {"x", "y", "u_x", "u_y"};
  write_csv(path, header, rows);
}

}  // namespace antilock
