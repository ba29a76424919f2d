#include "antilock/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace antilock {
namespace {

using Obstacle = ObstacleError::Obstacle;

void check_epsilon(const std::string& model, double epsilon, double smallest,
                   const std::string& why) {
  if (!(epsilon >= smallest && epsilon <= 1))
    throw Error(
        fmt::format("{} layer: epsilon = {} is out of range; accepted {}", model, epsilon, why));
}

}  // namespace

Scene::Scene(Body body, Layer layer, std::optional<UnilateralContact> contact,
             std::vector<BoundaryCondition> edges)
    : body_(std::move(body)),
      layer_(std::move(layer)),
      contact_(std::move(contact)),
      edges_(std::move(edges)) {
  if (!body_.load) throw Error("body: no load given; accepted: a function f(x, y)");
  for (const BoundaryCondition& edge : edges_)
    if (edge.kind != BoundaryCondition::Kind::free && !edge.value)
      throw Error("edge group " + edge.group + ": no value given; accepted: a function of x and y");
  const auto* stiff = std::get_if<StiffLayer>(&layer_);
  if (stiff != nullptr && !(stiff->s > 0 && std::isfinite(stiff->s)))
    throw Error(fmt::format("scaled layer: s = {}; accepted: s > 0", stiff->s));
  if (stiff != nullptr)
    check_epsilon("scaled", stiff->epsilon, 0, "0 < epsilon <= 1, or exactly 0 (the rigid limit)");
  if (const auto* thin = std::get_if<ThinLayer>(&layer_))
    check_epsilon("thin", thin->epsilon, 1e-3,
                  "1e-3 <= epsilon <= 1 (below, use the scaled layer)");
  if (!contact_) return;
  if (!contact_->gap) throw Error("contact: no gap given; accepted: a function gap(x)");
  for (const double x : contact_->zero_at)
    for (const auto& [which, bound] :
         {std::pair(Obstacle::gap, &contact_->gap), {Obstacle::ceiling, &contact_->upper_obstacle}})
      // sin(pi) in double precision is 1.2e-16
      if (*bound && !((*bound)(x) >= -1e-12 * std::max(1.0, std::abs((*bound)(0.5)))))
        throw ObstacleError(which,
                            fmt::format("contact: {0}({1}) = {2}, but u = 0 is prescribed there; "
                                        "accepted: {0} >= 0 at x = {3}",
                                        which == Obstacle::gap ? "gap" : "ceiling", x, (*bound)(x),
                                        fmt::join(contact_->zero_at, " and x = ")));
}

void check_upper_obstacle(const UnilateralContact& contact, double x) {
  if (!contact.upper_obstacle) return;
  const double lower = -contact.gap(x), upper = contact.upper_obstacle(x);
  if (upper < lower - 1e-12 * std::max(1.0, std::abs(lower)))  // the round-off of two formulas
    throw ObstacleError(Obstacle::ceiling,
                        fmt::format("contact: ceiling({0:.6g}) = {1:.6g} is below the obstacle, "
                                    "-gap({0:.6g}) = {2:.6g}; accepted: "
                                    "ceiling >= -gap",
                                    x, upper, lower));
}

std::string Scene::beyond_the_paper() const {
  if (!edges_.empty()) return "edges in named groups";
  if (body_.stiffness) return "a stiffness of the body";
  const auto* stiff = std::get_if<StiffLayer>(&layer_);
  return stiff != nullptr && stiff->s != 1 ? "a layer of its own stiffness"
                                           : beyond_the_certificate();
}

std::string Scene::beyond_the_certificate() const {
  for (const BoundaryCondition& edge : edges_)
    if (edge.kind == BoundaryCondition::Kind::spring) return "a spring on the group " + edge.group;
  if (contact_ && contact_->upper_obstacle) return "a ceiling";
  const auto* stiff = std::get_if<StiffLayer>(&layer_);
  return stiff != nullptr && stiff->load ? "a load on the layer" : "";
}

double Scene::layer_depth() const {
  if (const auto* thin = std::get_if<ThinLayer>(&layer_)) return thin->epsilon;
  return std::holds_alternative<StiffLayer>(layer_) ? 1 : 0;
}

std::optional<double> Scene::epsilon() const {
  if (const auto* stiff = std::get_if<StiffLayer>(&layer_)) return stiff->epsilon;
  if (const auto* thin = std::get_if<ThinLayer>(&layer_)) return thin->epsilon;
  return std::holds_alternative<VentcelLayer>(layer_) ? std::optional(0.0) : std::nullopt;
}

std::vector<std::string> Scene::effects() const {
  std::vector<std::string> names;
  if (!std::holds_alternative<NoLayer>(layer_)) names.emplace_back("layer");
  if (contact_) names.emplace_back("contact");
  return names;
}

double paper_load(double x, double) { return 10 * std::sin(2 * std::numbers::pi * x); }

}  // namespace antilock
