#pragma once
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <optional>

#include "drawing/colour_bar.hpp"

namespace antilock::figures {

/// The surface of a solution lifted to (x, y, factor * u).
vtkSmartPointer<vtkPolyData> lifted(const vtkSmartPointer<vtkPolyData>& flat, double factor);

/// Adds a surface in viridis over the range with its mesh in fine transparent lines, or with the
/// lines x, y = k / grid. Where u jumps from triangle to triangle, the walls of the steps close the
/// surface.
void add_surface(vtkRenderer& renderer, const vtkSmartPointer<vtkPolyData>& surface, const Range& range,
                 const std::optional<int>& grid, const Eigen::Vector3d& towards_eye);

}  // namespace antilock::figures
