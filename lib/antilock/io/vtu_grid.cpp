#include "antilock/io/vtu_grid.hpp"

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/text.hpp"

namespace antilock {
namespace {

void print_arrays(Text& text, const char* section, const std::vector<VtuArray>& arrays) {
  if (arrays.empty()) return;
  text.print("<{} Scalars=\"{}\">\n", section, arrays.front().name);
  for (const VtuArray& array : arrays) {
    const Eigen::MatrixXd& values = array.values;
    text.print("<DataArray type=\"{}\" Name=\"{}\"", array.integers ? "Int32" : "Float64", array.name);
    if (values.cols() > 1) text.print(" NumberOfComponents=\"{}\"", values.cols());
    text.print(" format=\"ascii\">\n");
    for (Eigen::Index i = 0; i < values.rows(); ++i)
      for (Eigen::Index j = 0; j < values.cols(); ++j)
        text.print("{}{}", values(i, j), j + 1 < values.cols() ? ' ' : '\n');
    text.print("</DataArray>\n");
  }
  text.print("</{}>\n", section);
}

/// Text in the manner of VTK: the codes of its signs, each text closed by a zero.
void print_names(Text& text, const std::vector<std::string>& names) {
  if (names.empty()) return;
  text.print("<FieldData>\n<DataArray type=\"String\" Name=\"region_names\" NumberOfTuples=\"{}\" format=\"ascii\">\n",
             names.size());
  for (const std::string& name : names) {
    for (const char sign : name) text.print("{} ", static_cast<int>(sign));
    text.print("0\n");
  }
  text.print("</DataArray>\n</FieldData>\n");
}

}  // namespace

void write_grid(const std::filesystem::path& path, const VtuGrid& grid) {
  const auto& [points, triangles, point_data, cell_data, region_names] = grid;
  write_file(path, [&, &points = points, &triangles = triangles, &point_data = point_data, &cell_data = cell_data,
                    &region_names = region_names](std::ostream& out) {
    constexpr int vtk_triangle = 5;
    Text text(out);
    text.print(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">"
        "\n<UnstructuredGrid>\n");
    print_names(text, region_names);
    text.print("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points.rows(), triangles.rows());
    print_arrays(text, "PointData", point_data);
    print_arrays(text, "CellData", cell_data);
    text.print("<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n");
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
