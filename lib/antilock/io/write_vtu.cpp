// VTU, the unstructured grid of VTK's XML formats: for ParaView and for the figures. The arrays are
// bytes (little-endian doubles and integers) in base64, each in its element of the XML: a million
// triangles as decimal numbers take ten times the seconds. Raw bytes behind the XML would be a
// quarter smaller, but meshio reads them by way of one text in base64 for all arrays, which Python
// 3.13 refuses to decode from the middle.
#include "antilock/io/write_vtu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/mesh/layered.hpp"

namespace antilock {
namespace {

/// n x components numbers.
struct Array {
  std::string name;
  Eigen::MatrixXd values;
  bool integers = false;  ///< written as Int32
};

/// Cells of one kind, with values at the points and on the cells.
struct Grid {
  CellKind kind;
  Points points;
  IndexRows cells;
  std::vector<Array> point_data = {},
                     cell_data = {};  ///< the first of each is the one that a viewer shows
  bool regions = false;               ///< with names for the numbers in the cell data `region`
};

/// The bytes in base64 (RFC 4648): three bytes are four letters, the last group is filled up with
/// "=".
std::string base64(const std::string& bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text(4 * ((bytes.size() + 2) / 3), '=');
  for (std::size_t first = 0, to = 0; first < bytes.size(); first += 3, to += 4) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - first);
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < count; ++i)
      group |= std::uint32_t{static_cast<unsigned char>(bytes[first + i])} << (16 - 8 * i);
    for (std::size_t i = 0; i <= count; ++i) text[to + i] = letters[group >> (18 - 6 * i) & 63];
  }
  return text;
}

/// The element of the XML for an array of numbers: its length in bytes (UInt64) and its numbers,
/// together in base64.
template <class Number>
std::string data_array(const char* type, const std::string& name, Eigen::Index components,
                       const std::vector<Number>& values) {
  const std::uint64_t length = values.size() * sizeof(Number);
  std::string bytes(sizeof length + length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  if (length > 0) std::memcpy(bytes.data() + sizeof length, values.data(), length);
  const std::string text = base64(bytes);
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
      "format=\"binary\">{}</DataArray>\n",
      type, name, components, text);
}

/// The section of the XML with these arrays, in their order.
std::string data_section(const char* section, const std::vector<Array>& arrays) {
  std::string xml = fmt::format("<{} Scalars=\"{}\">\n", section, arrays.front().name);
  for (const auto& [name, values, integers] : arrays) {
    const auto in_rows = values.transpose().reshaped();
    if (integers)
      xml += data_array("Int32", name, values.cols(),
                        std::vector<std::int32_t>(in_rows.begin(), in_rows.end()));
    else
      xml += data_array("Float64", name, values.cols(),
                        std::vector<double>(in_rows.begin(), in_rows.end()));
  }
  return xml + fmt::format("</{}>\n", section);
}

/// The names of the numbers in `region`: an array of one number per name. VTK's own text arrays
/// (type "String") make meshio refuse the whole file.
const char* const region_names =
    "<FieldData>\n"
    "<DataArray type=\"Int32\" Name=\"body\" NumberOfTuples=\"1\" format=\"ascii\">1</DataArray>\n"
    "<DataArray type=\"Int32\" Name=\"layer\" NumberOfTuples=\"1\" format=\"ascii\">2</DataArray>\n"
    "</FieldData>\n";
static_assert(static_cast<int>(Region::body) == 1 && static_cast<int>(Region::layer) == 2);

/// VTK's number of a kind of cells.
std::uint8_t vtk_type(CellKind kind) {
  if (kind == CellKind::triangle) return 5;
  return kind == CellKind::quadrilateral ? 9 : 10;
}

void write(const std::filesystem::path& path, const Grid& grid) {
  const ReferenceCell& cell = reference_cell(grid.kind);
  const auto points = grid.points.rows(), cells = grid.cells.rows();
  std::vector<double> in_space(3 * points, 0.0);
  for (Eigen::Index i = 0; i < points; ++i)
    for (int k = 0; k < cell.dimension; ++k) in_space[3 * i + k] = grid.points(i, k);
  const std::vector<std::int32_t> corners(grid.cells.data(), grid.cells.data() + grid.cells.size());
  std::vector<std::int32_t> ends(cells);
  for (Eigen::Index t = 0; t < cells; ++t)
    ends[t] = static_cast<std::int32_t>(cell.vertices * (t + 1));

  write_file(path, [&](std::ostream& out) {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
           "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n";
    if (grid.regions) out << region_names;
    out << fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points, cells);
    out << data_section("PointData", grid.point_data) << data_section("CellData", grid.cell_data);
    out << "<Points>\n" << data_array("Float64", "points", 3, in_space) << "</Points>\n<Cells>\n";
    out << data_array("Int32", "connectivity", 1, corners)
        << data_array("Int32", "offsets", 1, ends)
        << data_array("UInt8", "types", 1, std::vector<std::uint8_t>(cells, vtk_type(grid.kind)));
    out << "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  });
}

/// The vertices of the mesh, or points of its own for each cell, so that a field can jump between
/// cells.
Grid grid_of(const TriangleMesh& mesh, bool shared) {
  const Points vertices = mesh.curved() ? drawn_along_normals(mesh) : mesh.vertices;
  if (shared) return {mesh.kind, vertices, mesh.triangles};
  const int n = mesh.reference().vertices;
  Grid grid{mesh.kind, Points(n * mesh.triangle_count(), mesh.dimension()),
            IndexRows(mesh.triangle_count(), n)};
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < n; ++i) {
      grid.points.row(n * t + i) = vertices.row(mesh.triangles(t, i));
      grid.cells(t, i) = n * t + i;
    }
  return grid;
}

void add_regions(Grid& grid, const TriangleMesh& mesh) {
  Eigen::VectorXd region(mesh.triangle_count());
  for (int t = 0; t < mesh.triangle_count(); ++t) region(t) = static_cast<int>(mesh.region[t]);
  grid.cell_data.push_back({"region", region, true});
  grid.regions = true;
}

/// The values of u at the corners of the cells (for CR in the plane they are m_j + m_k - m_i).
Eigen::VectorXd corner_values(const Space& space, const Eigen::VectorXd& u) {
  const Element& element = space.element();
  const int n = space.mesh().reference().vertices;
  Eigen::MatrixXd basis(n, element.dofs());  // a row per corner
  for (int i = 0; i < n; ++i)
    basis.row(i) = element.basis(reference_vertex(element.kind(), i)).transpose();
  Eigen::VectorXd values(n * space.mesh().triangle_count());
  for (int t = 0; t < space.mesh().triangle_count(); ++t) {
    const Eigen::VectorXi unknowns = space.cell_dofs().row(t);
    values.segment(n * t, n) = basis * u(unknowns);
  }
  return values;
}

/// The contact pressure at the points of the grid: at a vertex its own, on a Crouzeix-Raviart facet
/// that of the facet, and at the ends of an edge of hybrid_bdm1 those of its two unknowns.
Eigen::VectorXd point_pressure(const Space& space, const Eigen::VectorXd& pressure, bool shared) {
  const TriangleMesh& mesh = space.mesh();
  Eigen::VectorXd of_unknown = Eigen::VectorXd::Zero(space.size());
  of_unknown(space.contact_dofs()) = pressure;
  if (shared) return of_unknown.head(mesh.vertex_count());
  const ReferenceCell& cell = mesh.reference();
  Eigen::VectorXd values =
      Eigen::VectorXd::Zero(cell.vertices * static_cast<Eigen::Index>(mesh.triangle_count()));
  const int per_facet = space.element().dofs_per_facet();  // 1, or 2 on an edge
  for (int facet = 0; facet < mesh.edge_count(); ++facet) {
    if (mesh.edge_tag[facet] != EdgeTag::contact) continue;
    const int t = mesh.edge_triangles(facet, 0);
    const int i = local_edge(mesh, t, facet);
    const auto dofs = space.cell_dofs().row(t).segment(per_facet * i, per_facet);
    for (int k = 0; k < cell.dimension; ++k)
      values(cell.vertices * t + cell.facet[i][k]) = of_unknown(dofs(std::min(k, per_facet - 1)));
  }
  return values;
}

void check_values(const std::filesystem::path& path, const char* name, const char* each,
                  const Eigen::VectorXd& values, int count) {
  if (values.size() != count || !values.allFinite())
    throw Error(fmt::format("{}: {} must be {} finite values, one {}; it has {}, {} of them finite",
                            path.string(), name, count, each, values.size(),
                            values.array().isFinite().count()));
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u,
               const VtuFields& more) {
  check_values(path, "u", "per unknown", u, space.size());
  const TriangleMesh& mesh = space.mesh();
  if (more.p.size() > 0) check_values(path, "p", "per triangle", more.p, mesh.triangle_count());
  if (more.pressure.size() > 0)
    check_values(path, "pressure", "per contact unknown", more.pressure,
                 static_cast<int>(space.contact_dofs().size()));
  // elements with unknowns at the vertices share them; the others jump there
  const bool shared = space.element().dofs_per_vertex() > 0;
  Grid grid = grid_of(mesh, shared);
  grid.point_data.push_back(
      {"u", shared ? Eigen::VectorXd(u.head(mesh.vertex_count())) : corner_values(space, u)});
  if (more.pressure.size() > 0)
    grid.point_data.push_back({"pressure", point_pressure(space, more.pressure, shared)});
  add_regions(grid, mesh);
  if (more.p.size() > 0) grid.cell_data.push_back({"p", more.p});
  write(path, grid);
}

void write_vtu(const std::filesystem::path& path, const TriangleMesh& mesh,
               const Eigen::MatrixX3d& corners) {
  require_triangles(mesh, "VTU of corner values");
  const Eigen::VectorXd values = corners.transpose().reshaped();
  check_values(path, "u", "per corner", values, 3 * mesh.triangle_count());
  Grid grid = grid_of(mesh, false);
  grid.point_data.push_back({"u", values});
  add_regions(grid, mesh);
  write(path, grid);
}

void write_deformed_vtu(const std::filesystem::path& path, const VectorSpace& space,
                        const Eigen::VectorXd& u, const Eigen::VectorXd& pressure) {
  const TriangleMesh& mesh = space.x.mesh();
  check_values(path, "u", "per unknown", u, space.size());
  check_values(path, "pressure", "per triangle", pressure, mesh.triangle_count());
  Grid grid = grid_of(mesh, false);
  Eigen::MatrixXd displacement = Eigen::MatrixXd::Zero(grid.points.rows(), 3);
  displacement.col(0) = corner_values(space.x, u.head(space.x.size()));
  displacement.col(1) = corner_values(space.y, u.tail(space.y.size()));
  grid.points += displacement.leftCols(2);
  grid.point_data.push_back({"displacement", displacement});
  grid.cell_data.push_back({"pressure", pressure});
  write(path, grid);
}

}  // namespace antilock
