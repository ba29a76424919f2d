#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <filesystem>

#include "drawing/colour_bar.hpp"

namespace antilock::figures {

/// Reads a VTU file of triangles with point data `u`. Returns a surface in the plane z = 0 whose
/// scalars are u. Throws Error with the name of the file if the file is missing or malformed, has
/// other cells, or has no u or one that is not finite.
vtkSmartPointer<vtkPolyData> read_solution(const std::filesystem::path& path);

/// Reads a VTU file of tetrahedra with point data `u`, which are the scalars. Throws Error as
/// read_solution does.
vtkSmartPointer<vtkUnstructuredGrid> read_body(const std::filesystem::path& path);

/// Does the same as read_solution for a deformed body: the cell data `pressure` are the scalars of the cells, and
/// the point data `displacement` (three components) are the displacements of the points.
vtkSmartPointer<vtkPolyData> read_deformed(const std::filesystem::path& path);

/// Returns the smallest and the largest u of a solution.
Range range_of(vtkPolyData& solution);
/// Returns whether no triangle crosses y = 0, where body and layer meet. A layer along the normals
/// of a curve does cross it.
bool parts_at_zero(vtkPolyData& solution);
/// Returns the smallest range that contains both.
Range joined(const Range& a, const Range& b);
/// Returns the range to draw for data: their own, or [low, low + 1] where all of them are equal
/// (for example u = 0).
Range drawn(const Range& data);

}  // namespace antilock::figures
