#pragma once
#include <vtkBoundingBox.h>
#include <vtkRenderer.h>

#include "drawing/axis.hpp"
#include "drawing/page.hpp"
#include "drawing/panel.hpp"
#include "drawing/view.hpp"
#include "pictures/pictures.hpp"

namespace antilock::figures {

/// The amount of text around an axes box: all numbers and names; fewer numbers; fewer numbers and
/// no names of body, layer and Sigma.
enum class AxesDetail { full, few, least };

/// The box around a surface: the floor and the two walls behind, with grid lines at the ticks.
struct AxesBox {
  Eigen::AlignedBox3d space;
  Axis x, y, u;
  double factor;  // units of length that are drawn for one unit of u
  AxesDetail detail;
  // Whether body and layer meet at y = 0. Sigma, the line between them, and their names are then
  // drawn.
  bool parts = true;
};

/// Returns the axes box of a domain (its x and y) and of a range of u that is drawn `height` high.
AxesBox make_axes_box(const vtkBoundingBox& domain, const Range& range, double height,
                      AxesDetail detail);

/// Adds floor and walls to a scene, and Sigma on the floor. The eye looks from high x and low y.
void add_walls(vtkRenderer& renderer, const AxesBox& axes);

/// Draws numbers and names along the front edges of the floor and the front edge of the left wall
/// (`height` is the name of the quantity there), and the names of body and, if there is one, layer.
void label_axes(Page& page, const View& view, const AxesBox& axes, const std::string& height);

}  // namespace antilock::figures
