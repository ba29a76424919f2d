#pragma once
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"
#include "antilock/study/sweep.hpp"

namespace antilock {

/// A Sweep for a scene: it solves one scene on one mesh for several values of epsilon, and for
/// several loads.
class SceneSweep : public Sweep {
 public:
  /// Assembles the problem. Throws Error as `assemble` does.
  SceneSweep(const Scene& scene, const Space& space);

  /// Sets the thickness epsilon of a scaled layer, 0 to 1. Throws Error for any other layer, and
  /// for a layer along the normals of a curve, because such a layer has no epsilon, or its forms or
  /// its mesh depend on epsilon.
  void set_epsilon(double epsilon);
  /// Sets the load f of the body. The loads on edges and on the layer stay. Throws Error for an
  /// empty f.
  void set_load(const Field& f);

 private:
  Space space_;
  Scene scene_;
};

}  // namespace antilock
