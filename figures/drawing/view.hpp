#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>

#include "drawing/geometry.hpp"

class vtkCamera;

namespace antilock::figures {

/// A parallel view of a box in space, fitted into a box of the page. It gives the camera for VTK,
/// and the place on the page of a point in space, so that text can be set there.
class View {
 public:
  /// `azimuth` turns the eye from the front (-y) towards +x, and `elevation` raises it; both are in
  /// degrees. The scale is that at which `fitted` fills the box, so that views of different spaces
  /// can be compared.
  View(const Eigen::AlignedBox3d& space, const Eigen::AlignedBox3d& fitted, const Box& page,
       double azimuth, double elevation);
  /// Returns the place of a point in space on the page, in pixels.
  Point operator()(const Eigen::Vector3d& place) const;
  vtkSmartPointer<vtkCamera> camera() const;
  /// Returns the unit vector towards the eye.
  const Eigen::Vector3d& towards_eye() const { return towards_eye_; }

 private:
  Eigen::Vector3d towards_eye_, right_, up_, focus_;
  Box page_;
  double scale_;  // pixels per unit of length
};

}  // namespace antilock::figures
