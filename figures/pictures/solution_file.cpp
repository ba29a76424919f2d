#include "pictures/solution_file.hpp"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"

namespace antilock::figures {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw Error(
      fmt::format("{}: {}; accepted: a VTU file as the tutorials write it", path.string(), reason));
}

/// VTK reports a bad file by an event (or, unheard, by several lines on standard error).
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path))
    throw Error(
        fmt::format("{}: no such file; run the tutorial that writes it first", path.string()));
  bool failed = false;
  vtkNew<vtkCallbackCommand> heard;
  heard->SetClientData(&failed);
  heard->SetCallback(
      [](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });

  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetReaderErrorObserver(heard);
  reader->SetParserErrorObserver(heard);
  reader->AddObserver(vtkCommand::ErrorEvent, heard);
  reader->AddObserver(vtkCommand::WarningEvent, heard);
  reader->SetFileName(path.c_str());
  reader->Update();
  if (failed || reader->GetErrorCode() != 0) refuse(path, "malformed");
  vtkSmartPointer<vtkUnstructuredGrid> grid = reader->GetOutput();
  if (grid->GetNumberOfCells() == 0) refuse(path, "no cells, or malformed");
  return grid;
}

/// An array of `components` finite numbers each.
vtkDataArray* array_of(const std::filesystem::path& path, vtkDataSetAttributes* data,
                       const char* name, int components) {
  vtkDataArray* array = data->GetArray(name);
  if (array == nullptr || array->GetNumberOfComponents() != components)
    refuse(path, fmt::format("no data {} of {} component(s)", name, components));
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int k = 0; k < components; ++k)
      if (!std::isfinite(array->GetComponent(i, k)))
        refuse(path, fmt::format("{} of entry {} is not finite", name, i));
  return array;
}

/// Refuses cells whose corners are not points of the file.
void check_corners(const std::filesystem::path& path, vtkUnstructuredGrid& grid) {
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    grid.GetCellPoints(cell, size, corners);
    for (vtkIdType i = 0; i < size; ++i)
      if (corners[i] < 0 || corners[i] >= grid.GetNumberOfPoints())
        refuse(path, fmt::format("cell {} has a corner {}, but there are {} points", cell,
                                 corners[i], grid.GetNumberOfPoints()));
  }
}

/// The points and the triangles or quadrilaterals, without data.
vtkSmartPointer<vtkPolyData> polygons_of(const std::filesystem::path& path,
                                         vtkUnstructuredGrid& grid) {
  vtkNew<vtkCellArray> polygons;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    const bool triangle = grid.GetCellType(cell) == VTK_TRIANGLE;
    if (!triangle && grid.GetCellType(cell) != VTK_QUAD)
      refuse(path, fmt::format("cell {} is not a triangle and not a quadrilateral", cell));
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    grid.GetCellPoints(cell, size, corners);
    if (size != (triangle ? 3 : 4))
      refuse(path, fmt::format("cell {} is a {} with {} corners", cell,
                               triangle ? "triangle" : "quadrilateral", size));
    polygons->InsertNextCell(size, corners);
  }
  check_corners(path, grid);
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(grid.GetPoints());
  surface->SetPolys(polygons);
  return surface;
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_solution(const std::filesystem::path& path) {
  const auto grid = read_grid(path);
  vtkDataArray* u = array_of(path, grid->GetPointData(), "u", 1);
  auto surface = polygons_of(path, *grid);
  surface->GetPointData()->SetScalars(u);
  return surface;
}

vtkSmartPointer<vtkUnstructuredGrid> read_body(const std::filesystem::path& path) {
  auto grid = read_grid(path);
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    if (grid->GetCellType(cell) != VTK_TETRA)
      refuse(path, fmt::format("cell {} is not a tetrahedron", cell));
  check_corners(path, *grid);
  grid->GetPointData()->SetScalars(array_of(path, grid->GetPointData(), "u", 1));
  return grid;
}

Range range_of(vtkPolyData& solution) {
  const double* ends = solution.GetPointData()->GetScalars()->GetRange();
  return {ends[0], ends[1]};
}

bool parts_at_zero(vtkPolyData& solution) {
  for (vtkIdType cell = 0; cell < solution.GetNumberOfCells(); ++cell) {
    double box[6];
    solution.GetCellBounds(cell, box);
    if (box[2] < -1e-9 && box[3] > 1e-9) return false;  // round-off of places of size 1
  }
  return true;
}

Range joined(const Range& a, const Range& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

Range drawn(const Range& data) {
  return data.low == data.high ? Range{data.low, data.low + 1} : data;
}

vtkSmartPointer<vtkPolyData> read_deformed(const std::filesystem::path& path) {
  const auto grid = read_grid(path);
  vtkDataArray* pressure = array_of(path, grid->GetCellData(), "pressure", 1);
  vtkDataArray* displacement = array_of(path, grid->GetPointData(), "displacement", 3);
  auto surface = polygons_of(path, *grid);
  surface->GetCellData()->SetScalars(pressure);
  surface->GetPointData()->AddArray(displacement);
  return surface;
}

}  // namespace antilock::figures
