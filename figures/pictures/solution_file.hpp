#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>

#include "drawing/colour_bar.hpp"

namespace antilock::figures {

/// Reads a VTU file of triangles with point data `u`: a surface in the plane z = 0 whose scalars
/// are u. Throws Error, naming the file, for one that is missing, malformed, of other cells, or
/// whose u is absent or not finite.
vtkSmartPointer<vtkPolyData> read_solution(const std::filesystem::path& path);

/// The same for a deformed body: cell data `pressure` are the cells' scalars, point data
/// `displacement` (three components) say how the points got where they are.
vtkSmartPointer<vtkPolyData> read_deformed(const std::filesystem::path& path);

/// The smallest and the largest u of a solution.
Range range_of(vtkPolyData& solution);
/// Whether no triangle crosses y = 0, where body and layer meet. A layer along the normals of a curve does cross it.
bool parts_at_zero(vtkPolyData& solution);
/// The smallest range that holds both.
Range joined(const Range& a, const Range& b);
/// The range drawn for data: their own, or [low, low + 1] where all of them are equal (u = 0, say).
Range drawn(const Range& data);

}  // namespace antilock::figures
