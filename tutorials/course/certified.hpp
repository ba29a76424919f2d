#pragma once
#include "antilock/certificate/certificate.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "course/chapter.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// Writes log10 of the indicator divided by the area, as VTU with one colour per triangle.
inline void write_density(const std::filesystem::path& file, const TriangleMesh& mesh,
                          const Eigen::VectorXd& indicator) {
  Eigen::MatrixX3d corners(mesh.triangle_count(), 3);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    corners.row(t).setConstant(std::log10(std::max(indicator(t) / mesh.area(t), 1e-12)));
  write_vtu(file, mesh, corners);
}

/// Returns component k of the flux sigma, T x 3 values at the corners of the T triangles.
/// In the layer component 1 is the stress p.
inline Eigen::MatrixX3d component(const TriangleMesh& mesh, const EquilibratedFlux& flux,
                                  int k) {
  Eigen::MatrixX3d corners(mesh.triangle_count(), 3);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    corners.row(t).setConstant(flux.cell[t].s(k));
    if (mesh.region[t] == Region::body)
      corners.row(t) += flux.tau(mesh, t, Eigen::Matrix3d::Identity()).col(k).transpose();
  }
  return corners;
}

/// A scene with its Crouzeix-Raviart solution, which an exercise may change.
struct Solved : Result {
  Scene scene;

  Solved(const Scene& asked, TriangleMesh mesh)
      : Result{.space = Space(std::move(mesh), crouzeix_raviart())}, scene(asked) {
    problem = assemble(scene, space);
    solution = active_set(problem);
  }
  Certificate certified(const ConformingCompanion* v = nullptr) const {
    return certify(scene, *this, {.companion = v});
  }
  Certificate p1_certified() const {
    const Space linear(space, p1());
    const ConformingCompanion v = p1_companion(active_set(assemble(scene, linear)));
    return certified(&v);
  }
};

}  // namespace antilock::tutorial
