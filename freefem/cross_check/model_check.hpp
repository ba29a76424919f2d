#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace antilock::freefem {

/// One scene of the library (P1 on the structured mesh, 1/h = 64) against the strong problem (22) on the true layer, as
/// model_check.edp solves it: P2 on FreeFEM's own mesh, one stiffness that jumps, nothing shared.
struct SceneCheck {
  std::string scene, problem;  ///< the library's effects; the row of model_check.csv
  int unknowns = 0;
  double difference = 0;  ///< of u at five places, relative to the largest |u| there
  double energy = 0;      ///< of J, relative; the library's from 1/h = 32 and 64, extrapolated
  double seconds = 0;
};

/// Both discretisations and the distance of epsilon = 0.01 from the limit are within 4e-4 of the truth; a wrong sign, a
/// load in the wrong place or a missing factor of epsilon moves u by 1e-2 and more.
constexpr double model_bound = 1e-3;

/// Every scene. `mistake`: what model_check.edp is told to do wrong: "nothing", "load" (reaches into the layer),
/// "stiffness" (1 in the layer) or "obstacle" (from above).
std::vector<SceneCheck> model_check(const std::filesystem::path& folder, const std::string& mistake = "nothing");

}  // namespace antilock::freefem
