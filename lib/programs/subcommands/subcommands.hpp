#pragma once
/// What the subcommands of `antilock` share. Each takes the command line from its own name on, and returns the status:
/// 0 answered, 2 bad input, 3 not solved to the tolerance. 2 and 3 throw Error and NotConverged; `antilock` prints them.
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

/// Whether body and layer are the unit squares of Figure 2, clamped and in contact as there, of which the series is: the
/// box, the area and the edges of each say so.
bool is_unit_square(const TriangleMesh& mesh);

/// Largest |u| on the contact boundary: what locking takes away.
double layer_displacement(const Space& space, const Eigen::VectorXd& u);

/// The row of p of each layer triangle, one per triangle in their order.
std::vector<int> stress_rows(const TriangleMesh& mesh);

/// The scene solved to a proved relative error of `accuracy` in the energy norm, from its own first mesh.
CertifiedSolution certified(const SceneFile& file, double accuracy);

}  // namespace antilock::subcommands
