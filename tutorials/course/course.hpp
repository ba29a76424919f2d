#pragma once
// The declarations that almost every chapter uses: methods and meshes, the paper's problem
// and its exact solution, the solver, tables, the output of a solved scene, orders by
// supremum, and the main program.
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

/// Returns the problem of Section 4, (23), of the paper, [SR04] in
/// problem/variational_inequality.hpp: body, scaled layer and contact on Gamma_C, the
/// bottom of the layer. The paper does not state its load. The course uses f = 10 sin(2 pi
/// x).
///
///     u in K,  a+(u, v - u) + a_x^-(u, v - u) + epsilon^-2 a_y^-(u, v - u) >= (f, v - u)
///              for all v in K
///
///     a+(u, v)    = int_body  grad u . grad v    the body
///     a_x^-(u, v) = int_layer d/dx u d/dx v      the layer along itself
///     a_y^-(u, v) = int_layer d/dy u d/dy v      the layer across, the stiff form
///     K           = { v >= 0 on Gamma_C, v = 0 on Gamma_D, the clamped sides }
Scene paper_scene(double epsilon);

/// The exact solution of a scene with a scaled layer, as a table for all points of a mesh.
/// It is made from the scene that is solved, so that no error is measured against the
/// solution for another load.
struct Exact {
  /// Throws Error for a scene without a known exact solution (exact/sine_load.hpp lists the
  /// known ones). The series has 2^log2_points points; 2^14 points give gradients to 1e-6.
  /// The table has an eighth of them along Gamma_C, but 2^10 at least and 2^14 at most: 2
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
/// Returns the exact solutions of `paper_scene`, one per epsilon.
std::vector<Exact> exact_solutions(const std::vector<double>& epsilons,
                                   int log2_points = 17);

/// Writes the files of a solved scene: mesh.msh, mesh.freefem.msh, solution.csv,
/// solution.vtu and, with contact, contact.csv.
void write_results(const std::filesystem::path& out, const Result& result);
/// Prints the absolute errors in all norms.
void print_errors(const std::string& what, const Errors& errors);
/// Does both for one solved scene, and prints the data of the solve: unknowns, iterations,
/// KKT report, contact zone, energy, seconds per stage, and its report on locking.
void present(const std::filesystem::path& out, const Scene& scene, const Result& result,
             const std::string& what, const Errors& errors);

/// Orders as the course defines them: on each mesh it takes the supremum over a parameter,
/// and then the order of the suprema in h from one mesh to the next.
struct Supremum {
  /// One row per h: h, "worst" (the supremum), "at" (the parameter there), "order" (from
  /// the h before).
  Table rows;
  /// The largest factor by which a supremum grows from every second value of the parameter
  /// to all of them.
  double denser;
};
/// `runs` has, for one method, a row per h and value of the parameter: the meshes from
/// coarse to fine, the values in ascending or descending order.
Supremum supremum(const Table& runs, const std::string& value,
                  const std::string& parameter);

}  // namespace antilock::tutorial
