#pragma once
/// The subcommands of `antilock` and their common functions. Each subcommand receives the command
/// line from its own name on, and returns the exit status: 0 solved, 2 bad input, 3 not solved to
/// the tolerance. For 2 and 3 it may throw Error and NotConverged, which `antilock` prints.
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/runner/scene_file.hpp"

namespace antilock::subcommands {

int exact(int argc, char** argv);
int sweep(int argc, char** argv);
int estimate(int argc, char** argv);
int lockcheck(int argc, char** argv);

/// Returns whether body and layer are the unit squares of Figure 2 of [SR04] (cited in
/// problem/variational_inequality.hpp), clamped and in contact as there, because the series of the
/// exact solution is for them. It compares the box, the area and the edges of each.
bool is_unit_square(const TriangleMesh& mesh);

/// Returns the largest |u| on the contact boundary, which locking reduces.
double layer_displacement(const Space& space, const Eigen::VectorXd& u);

/// Returns one entry per triangle of the mesh: the row of p of a triangle of the layer, and no
/// meaningful number for one of the body.
std::vector<int> stress_rows(const TriangleMesh& mesh);

/// Solves the scene to a proved relative error of `accuracy` in the energy norm, starting from its
/// own mesh.
CertifiedSolution certified(const SceneFile& file, double accuracy);

}  // namespace antilock::subcommands
