#include "drawing/view.hpp"

#include <vtkCamera.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace antilock::figures {

View::View(const Eigen::AlignedBox3d& space, const Eigen::AlignedBox3d& fitted, const Box& page,
           double azimuth, double elevation)
    : page_(page) {
  const double turn = azimuth * std::numbers::pi / 180, lift = elevation * std::numbers::pi / 180;
  towards_eye_ = {std::cos(lift) * std::sin(turn), -std::cos(lift) * std::cos(turn),
                  std::sin(lift)};
  right_ = {std::cos(turn), std::sin(turn), 0};
  up_ = towards_eye_.cross(right_);

  const auto seen = [&](const Eigen::AlignedBox3d& box) {
    Eigen::AlignedBox2d shadow;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d at = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      shadow.extend(Eigen::Vector2d(at.dot(right_), at.dot(up_)));
    }
    return shadow;
  };
  const Eigen::Vector2d size = seen(fitted).sizes(), centre = seen(space).center();
  scale_ = std::min(page.width / size.x(), page.height / size.y());
  focus_ = centre.x() * right_ + centre.y() * up_;
}

Point View::operator()(const Eigen::Vector3d& place) const {
  const Eigen::Vector3d from_focus = place - focus_;
  return page_.centre() + Point{scale_ * from_focus.dot(right_), scale_ * from_focus.dot(up_)};
}

vtkSmartPointer<vtkCamera> View::camera() const {
  auto camera = vtkSmartPointer<vtkCamera>::New();
  const Eigen::Vector3d eye = focus_ + 20 * towards_eye_;
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(focus_.x(), focus_.y(), focus_.z());
  camera->SetPosition(eye.x(), eye.y(), eye.z());
  camera->SetViewUp(up_.x(), up_.y(), up_.z());
  camera->SetParallelScale(0.5 * page_.height / scale_);
  camera->SetClippingRange(10, 30);
  return camera;
}

}  // namespace antilock::figures
