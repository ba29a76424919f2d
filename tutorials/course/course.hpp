#pragma once
// What almost every chapter uses: methods and meshes, the paper's problem and its exact solution, the solver, tables,
// what a solved scene leaves behind, orders by supremum, and the program around it.
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "antilock/exact/exact_table.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "antilock/study/table.hpp"
#include "course/chapter.hpp"

namespace antilock::tutorial {

/// The problem of Section 4, (23): body, scaled layer, contact. The paper gives no load; ours is f = 10 sin(2 pi x).
///
///     u in K,  a+(u, v - u) + a_x^-(u, v - u) + epsilon^-2 a_y^-(u, v - u) >= (f, v - u)   for all v in K
///
///     a+(u, v)    = int_body  grad u . grad v    the body
///     a_x^-(u, v) = int_layer d/dx u d/dx v      the layer along itself
///     a_y^-(u, v) = int_layer d/dy u d/dy v      the layer across: the stiff part, epsilon^-2 in front
///     K           = { v >= 0 on Gamma_C, v = 0 on Gamma_D }
Scene paper_scene(double epsilon);

/// The exact solution of a scene with a scaled layer, ready for whole meshes. It is made from the scene that is solved,
/// so that nothing is measured against the truth of another load.
struct Exact {
  /// Throws Error for a scene whose exact solution is not known (exact/sine_load.hpp says which is). The series has
  /// 2^log2_points points; 14 give gradients to 1e-6. The table has an eighth of them along Gamma_C, 2^10 to 2^14: 2
  /// to 30 MB.
  explicit Exact(Scene scene, int log2_points = 17);

  Errors errors(const Space& space, const Solution& solution) const;
  Reference reference() const { return antilock::reference(table); }
  double contact_from() const;  ///< the left end of the contact zone; 1 where there is none

  Scene scene;
  double epsilon;
  ExactSolution solution;
  ExactTable table;
};
/// Those of `paper_scene` for each epsilon.
std::vector<Exact> exact_solutions(const std::vector<double>& epsilons, int log2_points = 17);

/// Writes what every solved scene leaves behind: mesh.msh, mesh.freefem.msh, solution.csv, solution.vtu and contact.csv.
void write_results(const std::filesystem::path& out, const Result& result);
/// Prints the errors in every norm, absolute.
void print_errors(const std::string& what, const Errors& errors);
/// Both of them for one solved scene, with how it was solved: unknowns, iterations, KKT report, contact zone, energy,
/// seconds by stage, and what it says of its own locking.
void present(const std::filesystem::path& out, const Scene& scene, const Result& result, const std::string& what,
             const Errors& errors);

/// Orders as the course defines them: on each mesh the supremum over a parameter comes first, then the order in h from
/// one mesh to the next.
struct Supremum {
  Table rows;     ///< one row per h: h, "worst", "at" (the parameter there), "order" (from the h before)
  double denser;  ///< the largest growth of a supremum, as a factor, by every second value of the parameter
};
/// `runs` holds, for one method, a row per h and value of the parameter, meshes from coarse to fine, the values in order.
Supremum supremum(const Table& runs, const std::string& value, const std::string& parameter);

}  // namespace antilock::tutorial
