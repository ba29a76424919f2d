// VTU, the unstructured grid of VTK's XML formats: for ParaView and for the figures. The arrays are raw bytes behind
// the XML (little-endian doubles and integers): a million triangles as text take ten times the seconds.
#include <fmt/format.h>

#include <cstdint>

#include "antilock/core/detail/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/layered.hpp"

namespace antilock {
namespace {

/// n x components numbers.
struct Array {
  std::string name;
  Eigen::MatrixXd values;
  bool integers = false;  ///< written as Int32
};

/// Triangles in the plane, with values at the points and on the triangles.
struct Grid {
  Points points;
  Triples triangles;
  std::vector<Array> point_data = {}, cell_data = {};  ///< the first of each is the one that a viewer shows
  bool regions = false;                                ///< with names for the numbers in the cell data `region`
};

/// The XML names each array and its place; their bytes follow it one after the other, each array behind its length. The
/// last array of the XML is added first: meshio puts places of its own into the XML, first array first, while it still
/// looks for the next one by its place; where both agree, it takes the one that stands earlier in the XML.
class Bytes {
 public:
  /// The element of the XML that stands for `values`, which are kept until they are written.
  template <class Number>
  std::string add(const char* type, const std::string& name, Eigen::Index components,
                  const std::vector<Number>& values) {
    const std::uint64_t length = values.size() * sizeof(Number);
    const std::size_t place = bytes.size();
    bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
    bytes.append(reinterpret_cast<const char*>(values.data()), length);
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        name, components, place);
  }
  std::string add(const char* section, const std::vector<Array>& arrays) {
    std::string xml = fmt::format("</{}>\n", section);
    for (auto array = arrays.rbegin(); array != arrays.rend(); ++array) {
      const auto& [name, values, integers] = *array;
      const auto in_rows = values.transpose().reshaped();
      xml.insert(0, integers
                        ? add("Int32", name, values.cols(), std::vector<std::int32_t>(in_rows.begin(), in_rows.end()))
                        : add("Float64", name, values.cols(), std::vector<double>(in_rows.begin(), in_rows.end())));
    }
    return fmt::format("<{} Scalars=\"{}\">\n", section, arrays.front().name) + xml;
  }

  std::string bytes;
};

/// The names of the numbers in `region`: an array of one number per name. VTK's own text arrays (type "String") make
/// meshio refuse the whole file.
const char* const region_names =
    "<FieldData>\n"
    "<DataArray type=\"Int32\" Name=\"body\" NumberOfTuples=\"1\" format=\"ascii\">1</DataArray>\n"
    "<DataArray type=\"Int32\" Name=\"layer\" NumberOfTuples=\"1\" format=\"ascii\">2</DataArray>\n"
    "</FieldData>\n";
static_assert(static_cast<int>(Region::body) == 1 && static_cast<int>(Region::layer) == 2);

void write(const std::filesystem::path& path, const Grid& grid) {
  constexpr std::uint8_t vtk_triangle = 5;
  const auto points = grid.points.rows(), triangles = grid.triangles.rows();
  std::vector<double> in_space(3 * points, 0.0);
  for (Eigen::Index i = 0; i < points; ++i)
    for (int k = 0; k < 2; ++k) in_space[3 * i + k] = grid.points(i, k);
  const std::vector<std::int32_t> corners(grid.triangles.data(), grid.triangles.data() + grid.triangles.size());
  std::vector<std::int32_t> ends(triangles);
  for (Eigen::Index t = 0; t < triangles; ++t) ends[t] = static_cast<std::int32_t>(3 * (t + 1));

  Bytes arrays;  // the last one first
  const std::string types = arrays.add("UInt8", "types", 1, std::vector<std::uint8_t>(triangles, vtk_triangle));
  const std::string offsets = arrays.add("Int32", "offsets", 1, ends);
  const std::string connectivity = arrays.add("Int32", "connectivity", 1, corners);
  const std::string places = arrays.add("Float64", "points", 3, in_space);
  const std::string cell_data = arrays.add("CellData", grid.cell_data);
  const std::string point_data = arrays.add("PointData", grid.point_data);
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n";
  if (grid.regions) xml += region_names;
  xml += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points, triangles);
  xml += point_data + cell_data + "<Points>\n" + places + "</Points>\n<Cells>\n";
  xml += connectivity + offsets + types + "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  write_file(path, [&](std::ostream& out) { out << xml << arrays.bytes << "\n</AppendedData>\n</VTKFile>\n"; });
}

/// Three points per triangle, so that a field that jumps from triangle to triangle can; or the vertices of the mesh.
Grid grid_of(const TriangleMesh& mesh, bool shared) {
  const Points vertices = mesh.curved() ? drawn_along_normals(mesh) : mesh.vertices;
  if (shared) return {vertices, mesh.triangles};
  Grid grid{Points(3 * mesh.triangle_count(), 2), Triples(mesh.triangle_count(), 3)};
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      grid.points.row(3 * t + i) = vertices.row(mesh.triangles(t, i));
      grid.triangles(t, i) = 3 * t + i;
    }
  return grid;
}

void add_regions(Grid& grid, const TriangleMesh& mesh) {
  Eigen::VectorXd region(mesh.triangle_count());
  for (int t = 0; t < mesh.triangle_count(); ++t) region(t) = static_cast<int>(mesh.region[t]);
  grid.cell_data.push_back({"region", region, true});
  grid.regions = true;
}

/// The values of u at the corners of the triangles (for CR they are m_j + m_k - m_i).
Eigen::VectorXd corner_values(const Space& space, const Eigen::VectorXd& u) {
  const Element& element = space.element();
  Eigen::MatrixXd basis(3, element.unknowns());  // a row per corner
  for (int i = 0; i < 3; ++i) basis.row(i) = element.basis(Eigen::Vector3d::Unit(i)).transpose();
  Eigen::VectorXd values(3 * space.mesh().triangle_count());
  for (int t = 0; t < space.mesh().triangle_count(); ++t) {
    const Eigen::VectorXi unknowns = space.unknowns().row(t);
    values.segment<3>(3 * t) = basis * u(unknowns);
  }
  return values;
}

/// The contact pressure at the points of the grid: at a vertex its own, on a Crouzeix-Raviart edge that of the edge.
Eigen::VectorXd point_pressure(const Space& space, const Eigen::VectorXd& pressure, bool shared) {
  const TriangleMesh& mesh = space.mesh();
  Eigen::VectorXd of_unknown = Eigen::VectorXd::Zero(space.size());
  of_unknown(space.contact()) = pressure;
  if (shared) return of_unknown.head(mesh.vertex_count());
  Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(mesh.triangle_count()));
  for (const int edge : space.contact()) {
    const int triangle = mesh.edge_triangles(edge, 0);
    for (int i = 0; i < 3; ++i)
      if (mesh.triangle_edges(triangle, i) == edge)
        values(3 * triangle + (i + 1) % 3) = values(3 * triangle + (i + 2) % 3) = of_unknown(edge);
  }
  return values;
}

void check_values(const std::filesystem::path& path, const char* name, const char* each, const Eigen::VectorXd& values,
                  int count) {
  if (values.size() != count || !values.allFinite())
    throw Error(fmt::format("{}: {} must be {} finite values, one {}; it has {}, {} of them finite", path.string(),
                            name, count, each, values.size(), values.array().isFinite().count()));
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u, const VtuFields& more) {
  check_values(path, "u", "per unknown", u, space.size());
  const TriangleMesh& mesh = space.mesh();
  if (more.p.size() > 0) check_values(path, "p", "per triangle", more.p, mesh.triangle_count());
  if (more.pressure.size() > 0)
    check_values(path, "pressure", "per contact unknown", more.pressure, static_cast<int>(space.contact().size()));
  // elements with unknowns at the vertices share them; the others jump there
  const bool shared = space.element().per_vertex() > 0;
  Grid grid = grid_of(mesh, shared);
  grid.point_data.push_back({"u", shared ? Eigen::VectorXd(u.head(mesh.vertex_count())) : corner_values(space, u)});
  if (more.pressure.size() > 0) grid.point_data.push_back({"pressure", point_pressure(space, more.pressure, shared)});
  add_regions(grid, mesh);
  if (more.p.size() > 0) grid.cell_data.push_back({"p", more.p});
  write(path, grid);
}

void write_vtu(const std::filesystem::path& path, const TriangleMesh& mesh, const Eigen::MatrixX3d& corners) {
  const Eigen::VectorXd values = corners.transpose().reshaped();
  check_values(path, "u", "per corner", values, 3 * mesh.triangle_count());
  Grid grid = grid_of(mesh, false);
  grid.point_data.push_back({"u", values});
  add_regions(grid, mesh);
  write(path, grid);
}

void write_deformed_vtu(const std::filesystem::path& path, const VectorSpace& space, const Eigen::VectorXd& u,
                        const Eigen::VectorXd& pressure) {
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
