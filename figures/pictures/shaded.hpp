#pragma once
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <Eigen/Dense>
#include <optional>

#include "drawing/colour_bar.hpp"

namespace antilock::figures {

/// Returns the surface of a solution with its points at (x, y, factor * u).
vtkSmartPointer<vtkPolyData> lifted(const vtkSmartPointer<vtkPolyData>& flat, double factor);

/// Adds a surface in space in the colours of viridis over the range of its scalars.
void add_coloured(vtkRenderer& renderer, const vtkSmartPointer<vtkPolyData>& surface,
                  const Range& range);
/// Adds the edges of the cells of a surface as fine and transparent lines.
void add_edges(vtkRenderer& renderer, const vtkSmartPointer<vtkPolyData>& surface,
               const Eigen::Vector3d& towards_eye);

/// Adds a surface in the colours of viridis over the range, with the lines of its mesh (fine and
/// transparent) or with the lines x, y = k / grid. Where u jumps from triangle to triangle,
/// vertical walls close the surface.
void add_surface(vtkRenderer& renderer, const vtkSmartPointer<vtkPolyData>& surface,
                 const Range& range, const std::optional<int>& grid,
                 const Eigen::Vector3d& towards_eye);

}  // namespace antilock::figures
