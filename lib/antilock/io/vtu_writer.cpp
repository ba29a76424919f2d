// VTU, the unstructured grid of VTK's XML formats, as text: for ParaView and for the figures.
#include "antilock/io/atomic_file.hpp"
#include "antilock/io/text.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/scene/error.hpp"

namespace antilock {
namespace {

/// What the file shows: points with a value each, triangles of them.
struct Surface {
  Points points;
  Eigen::VectorXd values;
  Triples triangles;
};

/// The values of u at the triangles' corners. Elements without unknowns at the vertices jump there, so each triangle
/// brings three points of its own (for CR the corner values are m_j + m_k - m_i); the others share their vertices.
Surface corner_surface(const Space& space, const Eigen::VectorXd& u) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  if (element.per_vertex() > 0) return {mesh.vertices, u.head(mesh.vertex_count()), mesh.triangles};

  const int corners = 3 * mesh.triangle_count();
  Surface surface{Points(corners, 2), Eigen::VectorXd(corners), Triples(mesh.triangle_count(), 3)};
  Eigen::MatrixXd basis(3, element.unknowns());  // a row a corner
  for (int i = 0; i < 3; ++i) basis.row(i) = element.basis(Eigen::Vector3d::Unit(i)).transpose();
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::VectorXi unknowns = space.unknowns().row(t);
    surface.values.segment<3>(3 * t) = basis * u(unknowns);
    for (int i = 0; i < 3; ++i) {
      surface.points.row(3 * t + i) = mesh.vertices.row(mesh.triangles(t, i));
      surface.triangles(t, i) = 3 * t + i;
    }
  }
  return surface;
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u) {
  if (u.size() != space.size() || !u.allFinite())
    throw Error(fmt::format("{}: u must be {} finite values, one an unknown; it has {}, {} of them finite",
                            path.string(), space.size(), u.size(), u.array().isFinite().count()));
  const auto [points, values, triangles] = corner_surface(space, u);
  write_file(path, [&, &points = points, &values = values, &triangles = triangles](std::ostream& out) {
    const auto& region = space.mesh().region;
    constexpr int vtk_triangle = 5;
    Text text(out);
    text.print(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">"
        "\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
        points.rows(), region.size());
    text.print("<PointData Scalars=\"u\">\n<DataArray type=\"Float64\" Name=\"u\" format=\"ascii\">\n");
    for (const double value : values) text.print("{}\n", value);
    text.print(
        "</DataArray>\n</PointData>\n<CellData Scalars=\"region\">\n"
        "<DataArray type=\"Int32\" Name=\"region\" format=\"ascii\">\n");
    for (const Region group : region) text.print("{}\n", static_cast<int>(group));
    text.print(
        "</DataArray>\n</CellData>\n<Points>\n"
        "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n");
    for (Eigen::Index i = 0; i < points.rows(); ++i) text.print("{} {} 0\n", points(i, 0), points(i, 1));
    text.print("</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n");
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
      text.print("{} {} {}\n", triangles(t, 0), triangles(t, 1), triangles(t, 2));
    text.print("</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n");
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) text.print("{}\n", 3 * (t + 1));
    text.print("</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n");
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) text.print("{}\n", vtk_triangle);
    text.print("</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  });
}

}  // namespace antilock
