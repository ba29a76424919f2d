#include "common/paper_problem.hpp"

#include <fmt/format.h>

#include "antilock/core/error.hpp"

namespace antilock::tutorial {

Scene paper_scene(double epsilon) { return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}); }

namespace {

Truth truth_of(const Scene& scene, int log2_points) {
  const Field& load = scene.body().load;
  const auto* sines = load.target<SineLoad>();
  const auto* function = load.target<double (*)(double, double)>();
  if (!std::holds_alternative<StiffLayer>(scene.layer()) || (!sines && !(function && *function == paper_load)))
    throw Error("exact: the truth of this scene is not known; accepted: a StiffLayer, and the load paper_load or a SineLoad");
  for (int j = 0; scene.contact() && j <= 256; ++j)
    if (const double gap = scene.contact()->gap(j / 256.0); gap != 0)
      throw Error(fmt::format("exact: the obstacle is {} away at x = {}; accepted: 0", gap, j / 256.0));
  return {sines ? *sines : paper_sine_load(), *scene.epsilon(), scene.contact().has_value(), log2_points};
}

}  // namespace

Exact::Exact(Scene scene, int log2_points)
    : scene(std::move(scene)),
      epsilon(this->scene.epsilon().value_or(0)),
      truth(truth_of(this->scene, log2_points)),
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
