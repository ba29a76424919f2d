#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace antilock::freefem {

/// One scene of the library (P1 on structured meshes, extrapolated from 1/h = 32 and 64) against
/// the strong problem (21) on the true layer, as model_check.edp solves it: P2 on FreeFEM's own
/// mesh, one stiffness that jumps, nothing shared.
struct SceneCheck {
  std::string scene, problem;  ///< the library's effects; the row of model_check.csv
  int unknowns = 0;
  double difference = 0;  ///< of u at five places, relative to the largest |u| there
  double energy = 0;      ///< of J, relative
  double seconds = 0;
};

/// Measured: 4e-6 to 1e-4 where the layer is the same, 1e-4 to 3e-4 where epsilon = 0.01 stands for
/// the limit. Each of the mistakes below moves u by 9e-3 of the largest |u| and more, in the scenes
/// that it touches.
constexpr double model_bound = 5e-4;

/// Runs model_check.edp for every scene. `mistake` names the error that the script makes on
/// purpose: "nothing", "load" (it reaches into the layer), "stiffness" (1 in the layer) or
/// "obstacle" (from above). Its mesh has `cells` edges along the body's lower side.
std::vector<SceneCheck> model_check(const std::filesystem::path& folder,
                                    const std::string& mistake = "nothing", int cells = 120);

}  // namespace antilock::freefem
