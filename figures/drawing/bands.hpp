#pragma once
#include <vtkSmartPointer.h>

#include <functional>
#include <vector>

#include "drawing/geometry.hpp"

class vtkContext2D;
class vtkImageData;
class vtkRenderer;

namespace antilock::figures {

/// A three-dimensional scene and the part of the page that shows it, from a parallel camera.
struct Drawing3d {
  vtkSmartPointer<vtkRenderer> renderer;
  Box where;
};

/// One piece of drawing, and how far down and up the page it reaches, in pixels.
struct Painting {
  double low, high;
  std::function<void(vtkContext2D&)> paint;  ///< in pixels of the large image
};

constexpr int oversampling = 3;  ///< pixels rendered per pixel of the image, each way

/// The image of `width` x `height` pixels, RGB: white, the scenes, then the pieces in their order. It is rendered larger
/// and averaged down, which smooths every edge; and in bands from the bottom up, because the driver holds some eight
/// copies of what it renders: of a whole page they would be a gigabyte, and half of the time would go into asking for it.
vtkSmartPointer<vtkImageData> render_in_bands(const std::vector<Drawing3d>& scenes, const std::vector<Painting>& pieces,
                                              int width, int height);

}  // namespace antilock::figures
