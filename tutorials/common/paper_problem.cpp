#include "common/paper_problem.hpp"

namespace antilock::tutorial {

Scene paper_scene(double epsilon) { return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}); }

Exact::Exact(double epsilon, int log2_points)
    : epsilon(epsilon), truth(paper_sine_load(), epsilon, true, log2_points), table(truth) {}

Exact::Exact(Truth exact) : epsilon(exact.epsilon()), truth(std::move(exact)), table(truth) {}

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
  for (const double epsilon : epsilons) all.emplace_back(epsilon, log2_points);
  return all;
}

}  // namespace antilock::tutorial
