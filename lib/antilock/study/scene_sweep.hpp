#pragma once
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"
#include "antilock/study/sweep.hpp"

namespace antilock {

/// One scene on one mesh, asked again and again with another epsilon or load: a Sweep in the scene's own words.
class SceneSweep : public Sweep {
 public:
  /// Assembles; throws Error as `assemble` does.
  SceneSweep(const Scene& scene, const Space& space);

  /// Another thickness of a scaled layer, 0 to 1. Throws Error for another layer: it holds none, or in its mesh.
  void set_epsilon(double epsilon);
  /// Another load of the body; what pulls at edges and layer stays. Throws Error for an empty f.
  void set_load(const Field& f);

 private:
  Space space_;
  Scene scene_;
};

}  // namespace antilock
