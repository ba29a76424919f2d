#pragma once
#include "antilock/analysis/lost_energy.hpp"
#include "antilock/io/scene_file.hpp"
#include "antilock/measure/detail/answer.hpp"

namespace antilock {

/// The discrete problem of a scene file on a space of its mesh: the scene's, or in plane strain that of two components in
/// this space (size 2 N). Throws Error.
VariationalInequality problem_of(const SceneFile& file, const Space& space);
/// The penalty to solve it with; empty: the usual one.
std::optional<double> penalty_of(const SceneFile& file, const Space& space);

/// The normal bounds of an answer alone, by x: friction's stand behind them. What contact.csv and the zone are made of.
struct NormalContact {
  VariationalInequality problem;
  Solution solution;
};
NormalContact normal_contact(const Answer& answer);

/// report_layer; in plane strain what the mesh says of a coating: conforming elements lock off columns where the length k
/// by which they resist bending is not small beside the thickness (analysis/locking.hpp). Nothing is proved of it.
std::optional<LayerReport> layer_report_of(const SceneFile& file, const Answer& answer);

/// In plane strain, T values: the pressure, -lambda div u in rubber, minus the stress in y with a coating.
Eigen::VectorXd pressure_of(const SceneFile& file, const Answer& answer);

}  // namespace antilock
