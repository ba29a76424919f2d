#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "antilock/study/sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/rubber.hpp"
#include "common/slipping_patch.hpp"

namespace antilock::tutorial {

// What chapter 26 leaves out of its page.

/// One row per element that does not lock. patch: the error of slipping_patch_error; g = 0, g = 1e6: of Extremes; steps
/// and seconds of the active set, then of Uzawa, and the largest difference of their displacements.
inline const std::vector<std::string> check_columns{"element", "unknowns",    "patch",   "g = 0",   "g = 1e6",
                                                    "steps",   "Uzawa steps", "seconds", "Uzawa s", "apart"};
/// One row per element and epsilon. N: the normal force in all; T: |T| on one half; sticks: the length on which the
/// rubber sticks though g > 0; the corrections of the solver; by how many per cent N and T are off, where `known`.
inline const std::vector<std::string> floor_columns{"element", "lambda",      "epsilon", "locks", "N",    "T",
                                                    "sticks",  "corrections", "known",   "N off", "T off"};
/// Such a row, on `cells` squares per side. The reference is P2 with a continuous P1 pressure on graded meshes
/// (freefem/26_friction.edp), at epsilon = 1, 1e-4, 1e-8 and 0.
std::vector<Entry> floor_row(const Rubber& rubber, double epsilon, const VariationalInequality& problem,
                             const Solution& solution, int cells);

/// The largest difference of u: with g = 0 from the block without friction (an empty g), and with g = 1e6 from the
/// block whose bonds to the floor never give way.
struct Extremes {
  double none, bonded;
};
Extremes extremes_of_friction(const std::function<VariationalInequality(const Profile& g)>& pressed);

/// One row per unknown of the floor: its x, T per length, and the slip u_x.
Eigen::MatrixX3d on_floor(const Space& in_x, const VariationalInequality& problem, const Solution& solution);

/// Prints the tables; writes zones.csv, where P1 on parallel triangles (`locked`) and on crossed ones sticks and slips.
void show_friction(const std::filesystem::path& out, const Table& checks, const Table& forces, const Profile& g,
                   const Eigen::MatrixX3d& locked, const Eigen::MatrixX3d& crossed);
/// Claims what is to come out.
void judge_friction(const Table& checks, const Table& forces, int cells, Report& report);

}  // namespace antilock::tutorial
