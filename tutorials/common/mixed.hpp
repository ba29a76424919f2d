#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/models/plane_strain.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/problem/projected.hpp"
#include "antilock/study/sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

/// What Theorem 4 asks for another a0, in numbers on one mesh: alpha of (i), by dense eigenvalues (not a number
/// beyond 1000 unknowns); the distance from u^0 to K_0h, (ii); the slope that K_0h hides, (iii): the largest int d/dy
/// v phi over the v of the kernel of a0_h with |v| = 1, phi = sin(pi x) sin(pi y), as in chapter 11.
struct Asked {
  double alpha, near, hidden;
};
Asked what_theorem_4_asks(const Space& space, const VariationalInequality& problem, const Exact& u0);

/// One row per projection, mesh and epsilon of chapter 25: its H1 error and corrections, and of the mesh alpha, the
/// distance from u^0 to K_0h, the slope that K_0h hides; and the seconds of the solution.
inline const std::vector<std::string> projection_columns{"name", "h",      "epsilon",     "h1",     "alpha",
                                                         "near", "hidden", "corrections", "seconds"};

/// Hypotheses beside conclusion, for each projection: prints and writes them, and claims what is to come out.
void judge_projections(const std::filesystem::path& out, const Table& layer, const Truth& limit, Report& report);

/// A discretisation of rubber: one element for both components.
struct Mixed {
  std::string name, file;  ///< file: of the deformed body; empty: it is not drawn
  const Element& element;
  bool pressure_per_vertex;  ///< else one per triangle
  bool stable;               ///< what theory says of its inf-sup constant
};
std::vector<Mixed> mixed_methods();

/// One row per method and epsilon: the contact force against the reference of chapter 23 in per cent, the corrections
/// of the solver, and the seconds of the method's first solution.
inline const std::vector<std::string> force_columns{"name",    "unknowns", "lambda",      "epsilon",
                                                    "percent", "pressure", "corrections", "seconds"};
/// The block of chapter 23 at epsilon = 0, in the space for both components.
VariationalInequality rubber(const Mixed& way, const Space& space);
/// One row per mesh, 1/h = 4, 8, 12: the inf-sup constant of `rubber` in the norms of a1 and of L2, "contact free" with
/// nothing held, "contact held" with the contact set of the solution held.
inline const std::vector<std::string> beta_columns{"name", "h", "contact", "beta"};
Table inf_sup_constants(const Mixed& way);
/// Pushes it at every epsilon; draws it at 0.
Table push(const Mixed& way, const Options& options);

/// Inf-sup constants and contact forces: prints and writes them, and claims what is to come out.
void judge_mixed(const std::filesystem::path& out, const Table& constants, const Table& forces, int cells,
                 Report& report);

}  // namespace antilock::tutorial
