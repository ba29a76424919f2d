#include "antilock/io/detail/vtu_grid.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "antilock/core/detail/atomic_file.hpp"

namespace antilock {
namespace {

/// The XML names each array and its place; their bytes follow it one after the other, each array behind its length.
class Arrays {
 public:
  /// The element of the XML that stands for `values`, which are kept until write().
  template <class Number>
  std::string add(const char* type, const std::string& name, Eigen::Index components,
                  const std::vector<Number>& values) {
    const std::uint64_t length = values.size() * sizeof(Number);
    const std::size_t place = bytes_.size();
    bytes_.append(reinterpret_cast<const char*>(&length), sizeof length);
    bytes_.append(reinterpret_cast<const char*>(values.data()), length);
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
        "offset=\"{}\"/>\n",
        type, name, components, place);
  }
  std::string add(const char* section, const std::vector<VtuArray>& arrays) {
    if (arrays.empty()) return "";
    std::string xml = fmt::format("<{} Scalars=\"{}\">\n", section, arrays.front().name);
    for (const VtuArray& array : arrays) {
      const auto in_rows = array.values.transpose().reshaped();
      if (array.integers)
        xml += add("Int32", array.name, array.values.cols(), std::vector<std::int32_t>(in_rows.begin(), in_rows.end()));
      else
        xml += add("Float64", array.name, array.values.cols(), std::vector<double>(in_rows.begin(), in_rows.end()));
    }
    return xml + fmt::format("</{}>\n", section);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Text in the manner of VTK: the codes of its signs, each text closed by a zero.
std::string names_in_codes(const std::vector<std::string>& names) {
  if (names.empty()) return "";
  std::string xml = fmt::format(
      "<FieldData>\n<DataArray type=\"String\" Name=\"region_names\" NumberOfTuples=\"{}\" format=\"ascii\">\n",
      names.size());
  for (const std::string& name : names) {
    for (const char sign : name) xml += fmt::format("{} ", static_cast<int>(sign));
    xml += "0\n";
  }
  return xml + "</DataArray>\n</FieldData>\n";
}

}  // namespace

void write_grid(const std::filesystem::path& path, const VtuGrid& grid) {
  constexpr std::uint8_t vtk_triangle = 5;
  const auto points = grid.points.rows(), triangles = grid.triangles.rows();
  std::vector<double> in_space(3 * points, 0.0);
  for (Eigen::Index i = 0; i < points; ++i)
    for (int k = 0; k < 2; ++k) in_space[3 * i + k] = grid.points(i, k);
  std::vector<std::int32_t> corners(3 * triangles), ends(triangles);
  for (Eigen::Index t = 0; t < triangles; ++t) {
    for (int i = 0; i < 3; ++i) corners[3 * t + i] = grid.triangles(t, i);
    ends[t] = static_cast<std::int32_t>(3 * (t + 1));
  }

  Arrays arrays;
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n";
  xml += names_in_codes(grid.region_names);
  xml += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points, triangles);
  xml += arrays.add("PointData", grid.point_data) + arrays.add("CellData", grid.cell_data);
  xml += "<Points>\n" + arrays.add("Float64", "points", 3, in_space) + "</Points>\n<Cells>\n";
  xml += arrays.add("Int32", "connectivity", 1, corners) + arrays.add("Int32", "offsets", 1, ends);
  xml += arrays.add("UInt8", "types", 1, std::vector<std::uint8_t>(triangles, vtk_triangle));
  xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  write_file(path, [&](std::ostream& out) { out << xml << arrays.bytes() << "\n</AppendedData>\n</VTKFile>\n"; });
}

}  // namespace antilock
