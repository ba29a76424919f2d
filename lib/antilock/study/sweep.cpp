#include "antilock/study/sweep.hpp"

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/problem/choose_penalty.hpp"

namespace antilock {

Sweep::Sweep(const Scene& scene, const Space& space)
    : space_(&space), scene_(scene), problem_(assemble(scene, space)), assembled_(space.mesh().triangle_count()) {
  check(problem_);
}

void Sweep::set_epsilon(double epsilon) {
  if (!std::holds_alternative<StiffLayer>(scene_.layer()))
    throw Error("sweep: epsilon does not vary in this scene; accepted: a scene with a scaled layer, (23)");
  const StiffLayer layer{epsilon};
  scene_ = Scene(scene_.body(), layer, scene_.contact());  // checks epsilon
  problem_.compliance = compliance(layer);
}

void Sweep::set_load(const Field& f) {
  scene_ = Scene({f}, scene_.layer(), scene_.contact());
  problem_.load = load_vector(*space_, f);
  const auto& region = space_->mesh().region;
  assembled_ += static_cast<int>(std::count(region.begin(), region.end(), Region::body));
}

void Sweep::set_gap(const Profile& gap) {
  if (!scene_.contact()) throw Error("sweep: this scene has no contact; accepted: a scene with an obstacle");
  scene_ = Scene(scene_.body(), scene_.layer(), UnilateralContact{gap});  // checks the ends
  problem_.lower = contact_bounds(*scene_.contact(), *space_);
}

Solution Sweep::solve(ActiveSetOptions options) {
  const double delta = moderate_delta(problem_);
  const int factorisations_before = factor_ ? factor_->factorisations : 0;
  if (!factor_)
    factor_.emplace(problem_, delta);
  else if (problem_.b.rows() > 0 && factor_->delta() != delta)
    factor_->refactor(problem_, delta);
  if (!options.start) options.start = contact_set_;

  Solution solution = active_set(problem_, *factor_, options);
  contact_set_ = solution.active;
  solution.counters.factorisations = factor_->factorisations - factorisations_before;
  if (solution.counters.factorisations == 0) solution.seconds.factor = 0;
  if (factorisations_before > 0) solution.seconds.analyse = 0;
  total_.unknowns = solution.counters.unknowns;
  total_.factorisations += solution.counters.factorisations;
  total_.solves += solution.counters.solves;
  total_.contact += solution.counters.contact;
  total_.corrections += solution.counters.corrections;
  return solution;
}

}  // namespace antilock
