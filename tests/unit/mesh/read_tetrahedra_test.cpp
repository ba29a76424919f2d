// MSH files of tetrahedra, as they are written and broken.
#include <Eigen/Geometry>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>

#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/labelled_edges.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"
#include "unit/mesh/helpers.hpp"

namespace antilock::test::mesh_test::read_tetrahedra_test {

/// An element of the file: its physical group and its nodes, from 1.
struct Element {
  int group;
  std::vector<int> nodes;
  int type() const { return nodes.size() == 3 ? 2 : 4; }
  int dimension() const { return static_cast<int>(nodes.size()) - 1; }
};

constexpr int body = 1, layer = 2;  // as Region; the groups of faces are those of physical_number

/// A file, to be spoilt before it is written.
struct File {
  std::string names =
      "$PhysicalNames\n5\n3 1 \"body\"\n3 2 \"layer\"\n2 3 \"sigma\"\n2 4 \"clamped\"\n"
      "2 5 \"contact\"\n$EndPhysicalNames\n";
  Points nodes;
  std::vector<Element> elements;

  std::string nodes_text(int v) const {
    return fmt::format("{} {} {}\n", nodes(v, 0), nodes(v, 1), nodes(v, 2));
  }

  std::string version_2() const {
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names;
    text += fmt::format("$Nodes\n{}\n", nodes.rows());
    for (int v = 0; v < nodes.rows(); ++v) text += fmt::format("{} ", v + 1) + nodes_text(v);
    text += fmt::format("$EndNodes\n$Elements\n{}\n", elements.size());
    for (std::size_t k = 0; k < elements.size(); ++k)
      text += fmt::format("{} {} 2 {} {} {}\n", k + 1, elements[k].type(), elements[k].group,
                          elements[k].group, fmt::join(elements[k].nodes, " "));
    return text + "$EndElements\n";
  }

  /// An entity for each group, with the same number.
  std::string version_4() const {
    std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names;
    text += "$Entities\n0 0 3 2\n";
    for (const int surface : {3, 4, 5}) text += fmt::format("{0} 0 0 -1 1 1 1 1 {0} 0\n", surface);
    for (const int volume : {body, layer})
      text += fmt::format("{0} 0 0 -1 1 1 1 1 {0} 0\n", volume);
    const auto count = nodes.rows();
    text += fmt::format("$EndEntities\n$Nodes\n1 {0} 1 {0}\n3 1 0 {0}\n", count);
    for (int v = 0; v < count; ++v) text += fmt::format("{}\n", v + 1);
    for (int v = 0; v < count; ++v) text += nodes_text(v);
    text += fmt::format("$EndNodes\n$Elements\n{0} {0} 1 {0}\n", elements.size());
    for (std::size_t k = 0; k < elements.size(); ++k)  // a block for each element
      text += fmt::format("{} {} {} 1\n{} {}\n", elements[k].dimension(), elements[k].group,
                          elements[k].type(), k + 1, fmt::join(elements[k].nodes, " "));
    return text + "$EndElements\n";
  }
};

Mesh boxes() { return structured_mesh(1, {1, CellKind::tetrahedron}); }

/// The faces first, then the tetrahedra.
File file_of(const Mesh& mesh) {
  File file;
  file.nodes = mesh.vertices;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] != EdgeTag::interior)
      file.elements.push_back({physical_number(mesh.edge_tag[e]),
                               {mesh.edges(e, 0) + 1, mesh.edges(e, 1) + 1, mesh.edges(e, 2) + 1}});
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    Element cell{static_cast<int>(mesh.region[t]), {}};
    for (const int v : mesh.triangles.row(t)) cell.nodes.push_back(v + 1);
    file.elements.push_back(cell);
  }
  return file;
}

TEST(ReadTetrahedra, GivesTheMeshThatWasWritten) {
  for (const Mesh& mesh : {boxes(), structured_mesh(3, {0, CellKind::tetrahedron})}) {
    File file = file_of(mesh);
    const bool has_layer = mesh.region.back() == Region::layer || mesh.region[0] == Region::layer;
    if (!has_layer)
      file.names =
          "$PhysicalNames\n3\n3 1 \"body\"\n2 4 \"clamped\"\n2 5 \"contact\"\n"
          "$EndPhysicalNames\n";
    expect_same(read(file.version_2()), mesh);
    expect_same(read(file.version_4()), mesh);
  }
}

TEST(ReadTetrahedra, GivesTheMeshThatTheLibraryWrites) {
  const TemporaryFolder folder;
  for (const Mesh& mesh : {boxes(), structured_mesh(3, {0, CellKind::tetrahedron}),
                           unstructured_mesh(3, {1, CellKind::tetrahedron})}) {
    write_msh(folder / "boxes.msh", mesh);
    expect_same(read_msh((folder / "boxes.msh").string()), mesh);
  }
  expect_refused(
      [&] {
        write_msh(folder / "q.msh", structured_mesh(2, {1, CellKind::quadrilateral}));
      },
      "accepted: triangles and tetrahedra");
}

// All tetrahedra of a volume in the other orientation are turned round.
TEST(ReadTetrahedra, TurnsAVolumeRoundAsAWhole) {
  const Mesh mesh = boxes();
  File file = file_of(mesh);
  for (Element& element : file.elements)
    if (element.group == body) std::swap(element.nodes[0], element.nodes[1]);
  const Mesh turned = read(file.version_2());
  for (int t = 0; t < turned.triangle_count(); ++t)
    EXPECT_NEAR(turned.measure(t), mesh.measure(t), 1e-15);
}

// gmsh's Mesh.SaveAll: points, lines, and faces within the body that are in no group.
TEST(ReadTetrahedra, PassesOverCurvesAndOverFacesInNoGroup) {
  const Mesh mesh = boxes();
  File file = file_of(mesh);
  const auto inner = std::find(mesh.edge_tag.begin(), mesh.edge_tag.end(), EdgeTag::interior);
  const auto e = static_cast<int>(inner - mesh.edge_tag.begin());
  file.elements.push_back({0, {mesh.edges(e, 0) + 1, mesh.edges(e, 1) + 1, mesh.edges(e, 2) + 1}});
  file.names = with(with(file.names, "\n5\n", "\n6\n"), "3 1", "1 9 \"rim\"\n3 1");
  expect_same(read(file.version_2()), mesh);
}

TEST(ReadTetrahedra, RefusesBrokenFiles) {
  struct Case {
    std::string name;
    std::function<void(File&)> spoil;
    std::string words;
  };
  const auto first_cell = [](File& file) -> Element& {
    return *std::find_if(file.elements.begin(), file.elements.end(),
                         [](const Element& element) { return element.nodes.size() == 4; });
  };
  const auto first_of = [](File& file, int group) -> Element& {
    return *std::find_if(file.elements.begin(), file.elements.end(),
                         [&](const Element& element) { return element.group == group; });
  };
  const std::vector<Case> cases{
      {"an unknown node", [&](File& f) { first_cell(f).nodes[3] = 99; }, "node 99"},
      {"one inverted", [&](File& f) { std::swap(first_cell(f).nodes[0], first_cell(f).nodes[1]); },
       "inverted tetrahedron"},
      {"a vertex twice", [&](File& f) { first_cell(f).nodes[3] = first_cell(f).nodes[0]; },
       "its volume is zero"},
      {"the same twice", [&](File& f) { f.elements.push_back(first_cell(f)); },
       "is the same tetrahedron as"},
      {"no group", [&](File& f) { first_cell(f).group = 0; }, "no physical group"},
      {"a group without a name", [&](File& f) { first_cell(f).group = 8; }, "volume group 8"},
      {"an unknown name", [](File& f) { f.names = with(f.names, "body", "Body"); },
       "unknown volume group \"Body\""},
      {"a body of faces", [](File& f) { f.names = with(f.names, "2 4", "3 4"); },
       "unknown volume group \"clamped\""},
      {"a side in no group", [&](File& f) { first_of(f, 4).group = 0; }, "the boundary face"},
      {"no contact",
       [&](File& f) {
         for (Element& element : f.elements)
           if (element.group == 5) element.group = 4;
       },
       "\"contact\""},
      {"contact on Sigma", [&](File& f) { first_of(f, 3).group = 5; }, "dangling or misplaced"},
      {"a face of no cell",
       [&](File& f) {
         const auto last = static_cast<int>(f.nodes.rows());
         first_of(f, 4).nodes = {1, 2, last};
       },
       "dangling or misplaced"},
      {"a missing cell", [](File& f) { f.elements.pop_back(); }, "dangling or misplaced"},
      {"a node that is no number", [](File& f) { f.nodes(0, 2) = std::nan(""); }, "coordinate"},
  };
  for (const Case& broken : cases) {
    File file = file_of(boxes());
    broken.spoil(file);
    expect_refused([&] { read(file.version_2()); }, broken.words);
  }
  const File file = file_of(boxes());
  const std::string text = file.version_2();
  const std::size_t last = file.elements.size();
  const std::string quadratic = with(text, fmt::format("\n{} 4 2 ", last), "\n99 11 2 ");
  expect_refused([&] { read(quadratic); }, "type 11");
  const std::string half = text.substr(0, text.rfind('\n', text.size() / 2) + 1);
  expect_refused([&] { read(half); }, "truncated");
}

// A vertex in the middle of a face of a larger cell.
TEST(ReadTetrahedra, RefusesAHangingVertex) {
  // a tetrahedron below z = 0, and above it three that share a vertex on its face
  const Points vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0.25, 0.25, 0}};
  const IndexRows cells{{0, 2, 1, 3}, {0, 1, 5, 4}, {1, 2, 5, 4}, {2, 0, 5, 4}};
  std::vector<TaggedEdge> sides;
  for (const int tip : {3, 4})
    for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {2, 0}})
      sides.push_back({a, b, tip, EdgeTag::clamped});
  expect_refused(
      [&] { make_mesh(vertices, cells, std::vector<Region>(4, Region::body), sides, "input"); },
      "hangs on the face");
}

/// The mesh with other vertices, checked anew.
Mesh with_vertices(const Mesh& mesh, const Points& vertices) {
  std::vector<TaggedEdge> tagged;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] != EdgeTag::interior)
      tagged.push_back({mesh.edges(e, 0), mesh.edges(e, 1), mesh.edges(e, 2), mesh.edge_tag[e]});
  return make_mesh(vertices, mesh.triangles, mesh.region, tagged, "input");
}

// Needles and thin cells are well formed: at one of their vertices the edges are perpendicular.
TEST(ReadTetrahedra, TakesThinCellsInAnyUnit) {
  const Mesh mesh = structured_mesh(2, {1, CellKind::tetrahedron});
  for (const double unit : {1e-9, 1.0, 1e9})
    for (const double stretch : {1e-12, 1e-9, 1.0, 1e9, 1e12}) {
      Points vertices = unit * mesh.vertices;
      vertices.col(2) *= stretch;
      const Mesh thin = with_vertices(mesh, vertices);
      EXPECT_EQ(thin.triangles, mesh.triangles) << unit << " " << stretch;
    }
  // a body in nanometres on a layer of the depth 1 in 16 rows
  Mesh body = structured_mesh(4, {0, CellKind::tetrahedron});
  body.vertices *= 1e-9;
  EXPECT_EQ(extruded(body, 4e-9).triangle_count(), body.triangle_count() + 3 * 16 * 32);
}

// The volume of an oblique needle of the width w is a sum of products of the size 1 that is w^2.
TEST(ReadTetrahedra, RefusesANeedleWhoseVolumeIsRoundOff) {
  const Eigen::Vector3d along = Eigen::Vector3d(1, 2, 3).normalized();
  const Eigen::Vector3d across = along.unitOrthogonal();
  const auto needle = [&](double width) {
    Points vertices(4, 3);
    vertices.row(0) = along.transpose();
    vertices.row(1).setZero();
    vertices.row(2) = width * across.transpose();
    vertices.row(3) = width * along.cross(across).transpose();
    return vertices;
  };
  const IndexRows cells{{0, 1, 2, 3}};
  const std::vector<TaggedEdge> faces{{0, 1, 2, EdgeTag::clamped},
                                      {0, 1, 3, EdgeTag::clamped},
                                      {0, 2, 3, EdgeTag::clamped},
                                      {1, 2, 3, EdgeTag::clamped}};
  const Mesh thin = make_mesh(needle(1e-6), cells, {Region::body}, faces, "input");
  EXPECT_NEAR(thin.measure(0) / (1e-12 / 6), 1, 1e-3);  // 1e-16 of the sum is 1e-4 of the volume
  expect_refused([&] { make_mesh(needle(1e-9), cells, {Region::body}, faces, "input"); },
                 "its volume is zero up to round-off");
}

TEST(ReadTetrahedra, RefusesFlatCellsInAnyUnit) {
  for (const double unit : {1e-9, 1.0, 1e9})
    for (const Points& corner : {Points{{0.3, 0.3, 0}}, Points{{0.3, 0.3, 1e-15}},
                                 Points{{1, 1, 1e-15}}, Points{{0.5, 0.5, 0}}}) {
      Points vertices(4, 3);
      vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, corner;
      const IndexRows cells{{0, 1, 2, 3}};
      expect_refused([&] { make_mesh(unit * vertices, cells, {Region::body}, {}, "input"); },
                     "its volume is zero");
    }
}

}  // namespace antilock::test::mesh_test::read_tetrahedra_test
