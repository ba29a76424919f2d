#include "common/paper_problem.hpp"

#include "antilock/core/error.hpp"
#include "antilock/exact/sine_load.hpp"

namespace antilock::tutorial {

Scene paper_scene(double epsilon) { return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}); }

namespace {

Truth known_truth(const Scene& scene, int log2_points) {
  std::optional<Truth> truth = truth_of(scene, log2_points);
  if (!truth)
    throw Error(
        "exact: the truth of this scene is not known; accepted: a StiffLayer, a load that is a sum of sines, and "
        "the obstacle, if any, at the distance 0");
  return std::move(*truth);
}

}  // namespace

Exact::Exact(Scene scene, int log2_points)
    : scene(std::move(scene)),
      epsilon(this->scene.epsilon().value_or(0)),
      truth(known_truth(this->scene, log2_points)),
      table(truth) {}

Errors Exact::errors(const Space& space, const Solution& solution) const {
  return measure_errors(space, solution, epsilon, reference());
}

double Exact::contact_from() const {
  const auto zones = truth.contact_zones();
  return zones.empty() ? 1 : zones.front().first;
}

std::vector<Exact> exact_solutions(const std::vector<double>& epsilons, int log2_points) {
  std::vector<Exact> all;
  all.reserve(epsilons.size());
  for (const double epsilon : epsilons) all.emplace_back(paper_scene(epsilon), log2_points);
  return all;
}

}  // namespace antilock::tutorial
