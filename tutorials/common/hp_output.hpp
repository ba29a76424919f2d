#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/exact/truth.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/space.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

// What chapter 27 leaves out of its page.

/// mesh, series, epsilon, degree, h away from the end of contact, unknowns; h1: the H1 error; contact, below: OnContact;
/// end: where contact begins; seconds of mesh, assembly and solve.
inline const std::vector<std::string> hp_columns{"mesh", "series",  "epsilon", "degree", "h",      "unknowns",
                                                 "h1",   "contact", "below",   "end",    "seconds"};

/// Between the unknowns of Gamma_C, 32 points per edge, over the largest u there:
/// the largest error of u_h, and how far u_h is below 0.
struct OnContact {
  double error, below;
};
OnContact on_contact(const Space& space, const Eigen::VectorXd& u, const Truth& truth);

/// Prints the levels of hp at epsilon = 1 and 0; writes results.csv, picture.csv (a panel per mesh, hp on both) and
/// graded.msh. `results` has the columns above.
void write_hp(const std::filesystem::path& out, const Table& results, const TriangleMesh& drawn);

/// Claims of the rows at one epsilon: the error per level and the growing order of hp, the order of each graded degree,
/// the orders of P4 on equal cells, and what hp saves beside them.
void judge_hp(const Table& results, const Exact& exact, Report& report);

}  // namespace antilock::tutorial
