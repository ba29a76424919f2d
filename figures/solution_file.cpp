#include "solution_file.hpp"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>

#include "antilock/scene/error.hpp"

namespace antilock::figures {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw Error(fmt::format("{}: {}; accepted: a VTU file of triangles with point data u", path.string(), reason));
}

/// VTK reports a bad file by an event (or, unheard, by several lines on standard error).
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::filesystem::path& path) {
  bool failed = false;
  vtkNew<vtkCallbackCommand> heard;
  heard->SetClientData(&failed);
  heard->SetCallback([](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });

  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetReaderErrorObserver(heard);
  reader->SetParserErrorObserver(heard);
  reader->AddObserver(vtkCommand::ErrorEvent, heard);
  reader->AddObserver(vtkCommand::WarningEvent, heard);
  reader->SetFileName(path.c_str());
  reader->Update();
  if (failed || reader->GetErrorCode() != 0) refuse(path, "malformed");
  return reader->GetOutput();
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_solution(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path))
    throw Error(fmt::format("{}: no such file; run the tutorial that writes it first", path.string()));
  const auto grid = read_grid(path);
  if (grid->GetNumberOfCells() == 0) refuse(path, "no cells, or malformed");
  vtkDataArray* u = grid->GetPointData()->GetArray("u");
  if (u == nullptr || u->GetNumberOfComponents() != 1) refuse(path, "no point data u of one component");
  for (vtkIdType i = 0; i < u->GetNumberOfTuples(); ++i)
    if (!std::isfinite(u->GetTuple1(i))) refuse(path, fmt::format("u of point {} is not finite", i));

  vtkNew<vtkCellArray> triangles;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    if (grid->GetCellType(cell) != VTK_TRIANGLE) refuse(path, fmt::format("cell {} is not a triangle", cell));
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    grid->GetCellPoints(cell, size, corners);
    for (int i = 0; i < 3; ++i)
      if (corners[i] < 0 || corners[i] >= grid->GetNumberOfPoints())
        refuse(path, fmt::format("cell {} has a corner {}, but there are {} points", cell, corners[i],
                                 grid->GetNumberOfPoints()));
    triangles->InsertNextCell(size, corners);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(grid->GetPoints());
  surface->SetPolys(triangles);
  surface->GetPointData()->SetScalars(u);
  return surface;
}

}  // namespace antilock::figures
