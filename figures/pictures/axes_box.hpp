#pragma once
#include <vtkBoundingBox.h>
#include <vtkRenderer.h>

#include "drawing/axis.hpp"
#include "drawing/page.hpp"
#include "drawing/panel.hpp"
#include "drawing/view.hpp"
#include "pictures/pictures.hpp"

namespace antilock::figures {

/// How much is written around an axes box: all of it, fewer numbers, or those alone.
enum class AxesDetail { full, few, least };

/// The box around a surface: floor and the two walls behind, with grid lines at the ticks.
struct AxesBox {
  Eigen::AlignedBox3d space;
  Axis x, y, u;
  double factor;  // height drawn for one unit of u
  AxesDetail detail;
  bool parts = true;  // body and layer meet at y = 0: Sigma and their names are drawn
};

/// The axes box of a domain (its x and y) and a range of u that is drawn `height` high.
AxesBox make_axes_box(const vtkBoundingBox& domain, const Range& range, double height, AxesDetail detail);

/// Puts floor and walls into a scene, and Sigma on the floor; the eye looks from high x and low y.
void add_walls(vtkRenderer& renderer, const AxesBox& axes);

/// Numbers and names along the front edges of the floor and the front edge of the left wall
/// (`height`: what it measures), and the names of the domain's parts: the layer's where there is
/// one.
void label_axes(Page& page, const View& view, const AxesBox& axes, const std::string& height);

}  // namespace antilock::figures
