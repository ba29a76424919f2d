#pragma once
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>

#include "geometry.hpp"

class vtkCamera;

namespace antilock::figures {

/// A parallel view of a box in space, fitted into a box of the page: what VTK's camera sees, and where a place in space
/// lies on the page, so that text can be set there.
class View {
 public:
  /// `azimuth` turns the eye from the front (-y) towards +x, `elevation` lifts it; both in degrees.
  View(const Eigen::AlignedBox3d& space, const Box& page, double azimuth, double elevation);
  Point operator()(const Eigen::Vector3d& place) const;
  vtkSmartPointer<vtkCamera> camera() const;
  /// Unit vector towards the eye.
  const Eigen::Vector3d& towards_eye() const { return towards_eye_; }

 private:
  Eigen::Vector3d towards_eye_, right_, up_, focus_;
  Box page_;
  double scale_;  // pixels a unit of length
};

}  // namespace antilock::figures
