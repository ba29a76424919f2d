#pragma once
#include <vtkSmartPointer.h>

#include <functional>
#include <vector>

#include "drawing/geometry.hpp"

class vtkContext2D;
class vtkImageData;
class vtkRenderer;

namespace antilock::figures {

/// A three-dimensional scene with a parallel camera, and the part of the page that shows it.
struct Drawing3d {
  vtkSmartPointer<vtkRenderer> renderer;
  Box where;
};

/// One drawing operation, and its lowest and highest place on the page, in pixels.
struct Painting {
  double low, high;
  std::function<void(vtkContext2D&)> paint;  ///< in pixels of the large image
};

constexpr int oversampling = 3;  ///< pixels rendered per pixel of the image, each way

/// Returns the image of `width` x `height` pixels, RGB: white, then the scenes, then the drawing
/// operations in their order. It is rendered larger and averaged, which smooths every edge. It is
/// rendered in bands from the bottom up, because the driver keeps some eight copies of its output.
/// For a whole page they would be a gigabyte, and their allocation would take half of the time.
vtkSmartPointer<vtkImageData> render_in_bands(const std::vector<Drawing3d>& scenes,
                                              const std::vector<Painting>& pieces, int width,
                                              int height);

}  // namespace antilock::figures
