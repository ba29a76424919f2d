#include "antilock/study/scene_sweep.hpp"

#include "antilock/core/error.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock {

SceneSweep::SceneSweep(const Scene& scene, const Space& space)
    : Sweep(assemble(scene, space)), space_(space), scene_(scene) {}

void SceneSweep::set_epsilon(double epsilon) {
  if (!std::holds_alternative<StiffLayer>(scene_.layer()))
    throw Error(
        "sweep: epsilon does not vary in this scene; accepted: a scene with a scaled layer, (23)");
  if (space_.mesh().curved())
    throw Error(
        "sweep: epsilon is part of the forms of a layer along normals; accepted: a layer below y = "
        "0");
  StiffLayer layer = std::get<StiffLayer>(scene_.layer());
  layer.epsilon = epsilon;
  scene_ = Scene(scene_.body(), layer, scene_.contact(), scene_.edges());  // checks epsilon
  problem_.compliance = class_parameter(layer);
}

void SceneSweep::set_load(const Field& f) {
  Scene next({f, scene_.body().stiffness}, scene_.layer(), scene_.contact(),
             scene_.edges());  // checks that f is there
  problem_.load = load_of(next, space_);
  scene_ = std::move(next);
}

}  // namespace antilock
